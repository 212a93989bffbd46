"""One page of the book, built alone with the outputs that its notebook stores: seconds, not
minutes."""

import sys

import pytest
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book"))
import build

LANGUAGES = ("id", "en")


def built(page, folder, languages=LANGUAGES):
    """{language: the HTML file}; folder: where it is built."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(build, "BUILD", folder)
        build.prepare()
        made = {language: build.build_page(page, language) for language in languages}
    assert all(made.values())
    return made
