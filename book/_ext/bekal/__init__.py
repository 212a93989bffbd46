"""Draws the pictures of the page "Bekal / What we need" (book/bekal.md), one for each idea.

    style.py      paper and pen: every label stays readable on a phone
    chance.py     mean, variance, RMSE, bells, covariance, white noise, chi-square, NEES
    belief.py     conditional probability, Bayes, likelihood
    matrices.py   vector, matrix, product, transpose, covariance matrix, inverse, eigenvalue
    change.py     derivative, Taylor, discretisation, Jacobian, Hessian, complex number

A picture holds numbers, symbols and units, and no decimal sign, since one picture serves both
languages; its words stand in the page, in both languages. A new
idea: a function here under its name, its text below `(bekal-<name>)=` in the page, its numbers in
tests/bekal_checks.py.
"""

from pathlib import Path

import offline

HERE = Path(__file__).parent
ROOMS = ("chance", "belief", "matrices", "change")


def pictures():
    """{name of the idea: the function that draws it}, in the order of the page."""
    from . import belief, chance, change, matrices

    found = {}
    for room in (chance, belief, matrices, change):
        found |= room.PICTURES
    return found


def file_of(name):
    return offline.VENDOR / f"bekal-{name}.png"


def draw(app=None):
    """Only when a file that has a say in them is newer than a picture."""
    sources = [*HERE.glob("*.py"), *(offline.BOOK.parent / "kalman_lib" / "plots").rglob("*.py")]
    newest = max(path.stat().st_mtime for path in sources)
    for name, picture in pictures().items():
        file = file_of(name)
        if not file.exists() or file.stat().st_mtime < newest:
            offline.write_if_new(file, picture().png())
            file.touch()


def setup(app):
    app.connect("builder-inited", draw)
    return {"parallel_read_safe": True}
