"""What the tests of the live explorers share: finding them, changing them, and comparing
numbers."""

import json
import math
import pkgutil

import numpy as np
from conftest import ROOT

import kalman_lib.papers

SOURCES = ROOT / "book" / "explorers"
PAPERS = sorted(module.name for module in pkgutil.iter_modules(kalman_lib.papers.__path__))
PHONE = {"width": 390, "height": 844}
SETS = 50  # of random parameters
RELATIVE, SCALE = (
    1e-9,
    1e-12,
)  # |js - py| <= RELATIVE |py| + SCALE max |py| of that component over time

# --- explorers of the built book ----------------------------------------------------------------


def pages_with_explorers(site, language):
    return [
        path
        for path in sorted((site / language).rglob("*.html"))
        # they show those of their chapters: test_slides.py, test_embed.py
        if path.parent.name not in ("slides", "embed")
        and "<kalman-explorer" in path.read_text(encoding="utf-8")
    ]


def live(page):
    return [
        element
        for element in page.locator("kalman-explorer").all()
        if "live" in (element.get_attribute("class") or "")
    ]


def explorers(site, opened, language="id", **options):
    """(name, browser page, trouble, locator) of every explorer that is live."""
    for path in pages_with_explorers(site, language):
        page, trouble = opened(path, **options)
        for element in live(page):
            yield f"{path.stem}: {element.get_attribute('paper')}", page, trouble, element


def explorer_of(paper, site, opened, language="id", **options):
    """(browser page, trouble, locator) of the first live explorer of this paper; no other page
    is opened."""
    path = next(
        path
        for path in pages_with_explorers(site, language)
        if f'paper="{paper}"' in path.read_text(encoding="utf-8")
    )
    page, trouble = opened(path, **options)
    return (
        page,
        trouble,
        next(element for element in live(page) if element.get_attribute("paper") == paper),
    )


def set_state(element, **changes):
    element.evaluate("(e, changes) => e.explorer.change(changes)", changes)
    shown(element)


# --- what they show -----------------------------------------------------------------------------

PICTURE = """
  const pixels = canvas => {
    // of a canvas that another thread paints: through a second one
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width,
      height: canvas.height }).getContext('2d');
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, value, i) =>
      (sum * 31 + value * (i & 3)) | 0, 7);
  };
  const picture = e => [
    [...e.querySelectorAll('canvas')].map(canvas => canvas.width && pixels(canvas)).join(),
    e.querySelector('.explorer-outcome').textContent,
    e.querySelector('.explorer-equations').textContent,
  ].join('');
  const frames = () => new Promise(done => requestAnimationFrame(() =>
    requestAnimationFrame(() => setTimeout(done, 5))));
  const drawn = async () => {
    await frames();
    if (e.explorer.coming) { // what reads files or sensors is fetched when it is first needed
      await e.explorer.coming;
      await frames();
    }
    e.explorer.words(true);                     // they follow only some times a second
    await e.explorer.painted();
  };"""


def picture(element):
    """What the explorer shows, as one text that differs when anything in it does."""
    return element.evaluate(f"e => {{ {PICTURE} return picture(e); }}")


def shown(element):
    """After the next drawing."""
    element.evaluate(f"e => {{ {PICTURE} return drawn(); }}")


def paste(element, text):
    element.locator("textarea").evaluate(
        "(e, text) => { e.value = text; e.dispatchEvent(new Event('input', { bubbles: true })); }",
        text,
    )
    shown(element)


def estimates(element):
    return np.array(element.evaluate("e => Array.from(e.explorer.r.result.x)"))


# --- numbers ------------------------------------------------------------------------------------


def listed(values):
    """Numbers as JSON can hold them: NaN is null."""
    if values is None:
        return None
    return [None if math.isnan(value) else value for value in np.ravel(values).tolist()]


def close(ours, theirs, columns, doubt=0):
    """None, or where JavaScript and Python differ most. doubt: what Python's own rounding leaves
    open."""
    ours = np.array([np.nan if value is None else value for value in ours], dtype=float).reshape(
        -1, columns
    )
    theirs = np.asarray(theirs, dtype=float).reshape(-1, columns)
    if ours.shape != theirs.shape:
        return f"{ours.shape} against {theirs.shape}"
    if not np.array_equal(np.isnan(ours), np.isnan(theirs)):
        return "NaN in one of them only"
    size = np.nan_to_num(np.abs(theirs))
    wrong = np.nan_to_num(np.abs(ours - theirs)) - (
        RELATIVE * size + SCALE * size.max(axis=0, initial=0) + doubt
    )
    if wrong.max(initial=-1) <= 0:
        return None
    k, i = np.unravel_index(np.argmax(wrong), wrong.shape)
    return f"step {k}, component {i}: {ours[k, i]!r} against {theirs[k, i]!r}"


def value_in(meta, low_to_high):
    """The value of a field at a place from 0 to 1 between its ends; a log field that may be 0
    starts there."""
    low, high = meta["min"], meta["max"]
    if low_to_high in (0, 1):
        return (low, high)[low_to_high]
    if meta["log"]:
        first = math.log10(low) if low > 0 else math.log10(high) - 16
        return 10 ** (first + low_to_high * (math.log10(high) - first))
    return low + low_to_high * (high - low)


# --- what readers bring -------------------------------------------------------------------------


def javascript(page, call, *arguments):
    """The answer of a function of the page's script; a mistake of the reader's as {"error": [id,
    en]}."""
    return json.loads(
        page.evaluate(
            """([call, args]) => {
      const { input, papers } = KalmanExplorers, bytes = text => Uint8Array.from(atob(text), c =>
        c.charCodeAt(0));
      const plain = value => value instanceof Map ? [...value].map(([name, column]) => [name,
        Array.from(column)]) : ArrayBuffer.isView(value) ? Array.from(value) : value;
      const answers = args.map(given => {
        try {
          return eval(call)(given, { ...papers.smoother, bytes });
        } catch (error) {
          if (!(error instanceof input.InputError)) throw error;
          return { error: [error.id, error.en] };
        }
      });
      return JSON.stringify(answers, (_, value) => typeof value === "number" &&
        Number.isNaN(value) ? "nan" : plain(value));
    }""",
            [call, list(arguments)],
        ),
        parse_constant=float,
    )
