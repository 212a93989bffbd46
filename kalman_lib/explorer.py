"""The explorers of the book inside a notebook: explore("gyro") shows the element of the page.

Alone imports anywidget. The element computes and draws by itself, without the kernel; the settings
are known on both sides:

    e = explore("gyro", gyro.Params(sigma_w=5))
    e.params            # a gyro.Params with what the reader has chosen by now
    e.params = gyro.Params(sigma_v=2)
    e.state = {"seed": 7}

It is made by book/_ext/explorers.py from book/explorers, like the pages' own.
"""

import base64
import importlib
import json
import math
from dataclasses import asdict, fields

import numpy as np
import traitlets
from IPython import get_ipython
from IPython.display import display

from .live.files import answer
from .live.made import made
from .live.notebook import LANGUAGES, language_of_notebook
from .live.pictures import picture
from .papers import check

try:
    import anywidget
except ImportError as missing:
    raise ImportError(
        "Explorers need anywidget: pip install anywidget. "
        "(Explorer memerlukan anywidget: pip install anywidget.)"
    ) from missing

_shown = {}  # cell -> (number of its run, the explorers that it showed then)


def explore(paper, p=None, view=None):
    """Show the explorer of a paper ("gyro") and return it.

    p: a Params of that paper, or None; view: the name of one of its views, None: the first one.
    """
    explorer = Explorer(paper, p, view)
    if get_ipython() is not None:
        _forget_the_last_run(explorer)
        explorer.show()
    return explorer


class Explorer(anywidget.AnyWidget):
    """One explorer: .params is a Params of the paper, .state every setting.

    Both follow the reader, and both can be set.
    """

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)
    paper = traitlets.Unicode().tag(sync=True)
    view = traitlets.Unicode().tag(sync=True)
    language = traitlets.Enum(LANGUAGES, "id").tag(sync=True)
    choose = traitlets.Bool().tag(sync=True)  # are there buttons for the language?
    start = traitlets.Dict().tag(sync=True)  # where "start again" leads
    state = traitlets.Dict().tag(sync=True)

    def __init__(self, paper, p=None, view=None):
        views = _views(paper)
        view = view or next(iter(views))
        if view not in views:
            raise ValueError(
                f"{paper!r} has no view {view!r}; it has {', '.join(views)}. / "
                f"{paper!r} tidak punya tampilan {view!r}; yang ada {', '.join(views)}."
            )
        self.Params = importlib.import_module(f"{__package__}.papers.{paper}").Params
        self.name_of_params = f"{__package__}.papers.{paper}.Params"
        self.is_first = view == next(iter(views))
        self.shown_in = None  # the run of a cell that has shown it
        language = language_of_notebook()
        start = views[view] | ({} if p is None else self._settings_of(p))
        super().__init__(
            paper=paper,
            view=view,
            language=language or LANGUAGES[0],
            choose=not language,
            start=start,
            state=start,
            _esm=made("widget.js"),
            _css=made("widget.css"),
        )
        self.on_msg(self._answer)

    # --- the settings -----------------------------------------------------------------------------

    @property
    def params(self):
        """The Params that the reader, or a cell, has chosen."""
        return self._params_in(self.state)

    @params.setter
    def params(self, p):
        self.state = self._settings_of(p)

    def _params_in(self, state):
        return self.Params(**{field.name: state[field.name] for field in fields(self.Params)})

    def _settings_of(self, p):
        if not isinstance(p, self.Params):
            name = self.name_of_params
            raise TypeError(f"a {name} is needed, not {p!r} / diperlukan {name}, bukan {p!r}")
        check(p)
        return asdict(p)

    @traitlets.validate("state")
    def _complete(self, proposal):
        """What is left out stays as it is; an unknown name or a value out of range is refused."""
        given = {name: _plain(value) for name, value in proposal["value"].items()}
        known = self.start | self.state
        if unknown := sorted(set(given) - set(known)):
            raise ValueError(
                f"unknown setting {unknown[0]!r}; there are {', '.join(known)}. / "
                f"pengaturan {unknown[0]!r} tidak dikenal; yang ada {', '.join(known)}."
            )
        state = self.state | given
        check(self._params_in(state))
        return state

    # --- shown in a notebook ----------------------------------------------------------------------

    def show(self):
        """Live where there is a kernel; elsewhere a picture inside the element of the book."""
        self.shown_in = _run()
        data, metadata = self._bundle()
        display(data, metadata=metadata, raw=True)

    def _bundle(self):
        data, metadata = super()._repr_mimebundle_()
        view = "" if self.is_first else f' view="{self.view}"'
        data["text/plain"] = f"[{self.paper}]"
        data["text/html"] = (
            f'<kalman-explorer paper="{self.paper}"{view}>{self._image()}</kalman-explorer>'
        )
        return data, metadata

    def _image(self):
        figure = picture(self.paper, self.view, self.params)
        content = base64.b64encode(figure.png(dpi=150)).decode()
        return f'<img alt="" src="data:image/png;base64,{content}">'

    def _ipython_display_(self):
        """As the last value of a cell: once more, but not in the run that has just shown it."""
        if self.shown_in is None or self.shown_in != _run():
            self.show()

    def _answer(self, _, question, buffers):
        message, contents = answer(question, buffers)
        self.send({**message, "number": question["number"]}, contents)


# --- what was made from book/explorers ------------------------------------------------------------


def _views(paper):
    """{view: where its settings start} of one paper, the first view first."""
    papers = json.loads(made("starts.json"))
    if paper not in papers:
        raise ValueError(
            f"no explorer is called {paper!r}; there are {', '.join(papers)}. / "
            f"tidak ada penjelajah bernama {paper!r}; yang ada {', '.join(papers)}."
        )
    return papers[paper]


def _plain(value):
    """A value as JSON can hold it: NaN in a list, a measurement that is missing, is None."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and math.isnan(value) else value


# --- the notebook around --------------------------------------------------------------------------


def _run():
    """Which run of which cell this is: (cell, number)."""
    shell = get_ipython()
    parent = shell.get_parent() if hasattr(shell, "get_parent") else {}
    return parent.get("metadata", {}).get("cellId"), getattr(shell, "execution_count", None)


def _forget_the_last_run(explorer):
    """What the same cell showed before is gone from the screen: close it, so that none piles up."""
    cell, number = _run()
    if cell is None:
        return
    last, old = _shown.get(cell, (number, []))
    if last != number:
        for gone in old:
            gone.close()
        old = []
    _shown[cell] = number, [*old, explorer]
