"""The live explorers of the built book: the same numbers as Python, usable by everyone, and nothing a reader types can harm.

Papers are found in kalman_lib.papers, explorers in the built pages; none is listed here.
"""
import dataclasses
import functools
import gzip
import importlib
import inspect
import itertools
import json
import math
import pkgutil
import re
import shutil
import sys

import numpy as np
import pytest

import kalman_lib.papers
from kalman_lib import chi2_bounds, kalman_filter, nees, nis, rmse, rts_smooth
from kalman_lib.papers import describe
from conftest import ROOT

sys.path.insert(0, str(ROOT / "book" / "_ext"))
import explorers as explorers_to_bundle  # noqa: E402

SOURCES = ROOT / "book" / "explorers"
PAPERS = sorted(module.name for module in pkgutil.iter_modules(kalman_lib.papers.__path__))
OWN_MOTION = {"quadrotor"}                  # simulate is a flight, not the model's own noise: see the end of this file
PHONE = {"width": 390, "height": 844}
SETS = 50
RELATIVE, SCALE = 1e-9, 1e-12               # |js - py| <= RELATIVE |py| + SCALE max |py| of that component over time

# Texts that are the same in both languages on purpose
SAME_TEXT = {"optimum (rad)"}

RUN = """text => {
  const { papers, filters, metrics } = KalmanExplorers;
  const numbers = list => list && Float64Array.from(list, value => value === null ? NaN : value);
  return JSON.stringify(JSON.parse(text).map(({ paper, p, z, u, x }) => {
    const { model, run, twins = {} } = papers[paper];
    const data = { z: numbers(z), u: numbers(u), x: numbers(x) }, { n, m } = model(p);
    data.T = data.z.length / m;
    const result = run(p, data), smooth = filters.rtsSmooth(result), out = {};
    for (const name of ["x_pred", "P_pred", "x", "P", "y", "S", "K"]) out[name] = Array.from(result[name]);
    Object.assign(out, { x_smooth: Array.from(smooth.x), P_smooth: Array.from(smooth.P),
      rmse: Array.from(metrics.rmse(data.x, result.x, n)), nees: Array.from(metrics.nees(data.x, result.x, result.P, n)),
      nis: Array.from(metrics.nis(result.y, result.S, m)) });
    out.twins = Object.fromEntries(Object.entries(twins).map(([name, call]) => [name, [call(p, data, result)].flatMap(value => typeof value === "number" ? [value] : Array.from(value))]));
    return out;
  }));
}"""


# --- the pages ------------------------------------------------------------------------------------------------------

def pages_with_explorers(site, language):
    return [path for path in sorted((site / language).rglob("*.html")) if "<kalman-explorer" in path.read_text(encoding="utf-8")]


@pytest.fixture(scope="module")
def opened(site, server, chromium):
    """A page with an explorer -> a browser page that is ready, and what went wrong on it. Kept open for all tests."""
    kept, contexts = {}, []

    def open_page(path, base=server, **options):
        options = {"viewport": PHONE, "reduced_motion": "reduce", "service_workers": "block", **options}
        key = (path, base, str(options))
        if key not in kept:
            context = chromium.new_context(**options)
            contexts.append(context)
            page, trouble = context.new_page(), []
            page.on("console", lambda message: trouble.append(message.text) if message.type == "error" else None)
            page.on("pageerror", lambda error: trouble.append(f"{error}\n{error.stack}"))
            page.on("dialog", lambda dialog: (trouble.append(dialog.message), dialog.dismiss()))
            page.goto(f"{base}/{path.relative_to(site).as_posix()}")
            page.evaluate("document.fonts.ready.then(() => true)")
            kept[key] = page, trouble
        return kept[key]
    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture(scope="module")
def bundle(opened, site):
    """A page that has loaded the script as a reader's page does."""
    return opened(pages_with_explorers(site, "en")[0])[0]


def live(page):
    return [element for element in page.locator("kalman-explorer").all() if "live" in (element.get_attribute("class") or "")]


def explorers(site, opened, language="id", **options):
    """(name, browser page, trouble, locator) of every explorer that is live."""
    for path in pages_with_explorers(site, language):
        page, trouble = opened(path, **options)
        for element in live(page):
            yield f"{path.stem}: {element.get_attribute('paper')}", page, trouble, element


# --- the same numbers -----------------------------------------------------------------------------------------------

def value_in(meta, low_to_high):
    """The value of a field at a place from 0 to 1 between its ends; a log field that may be 0 starts there."""
    low, high = meta["min"], meta["max"]
    if low_to_high in (0, 1):
        return (low, high)[low_to_high]
    if meta["log"]:
        first = math.log10(low) if low > 0 else math.log10(high) - 16
        return 10 ** (first + low_to_high * (math.log10(high) - first))
    return low + low_to_high * (high - low)


def parameter_sets(Params, rng):
    """The defaults, both ends of every field, SETS random ones over all ranges, and as many near the defaults."""
    table = describe(Params)
    whole = {name for name, meta in table.items() if isinstance(meta["default"], int) and isinstance(meta["step"], int) and meta["unit"] == "" and meta["min"] == 1}
    near = [Params(**{name: meta["default"] if name in whole else min(max(meta["default"] * rng.uniform(0.85, 1.15), meta["min"]), meta["max"])
                      for name, meta in table.items()}) for _ in range(SETS)]
    places = [{name: end} for name in table for end in (0, 1)] + [{name: rng.uniform() for name in table} for _ in range(SETS)]
    yield Params()
    for place in places:
        values = {name: value_in(table[name], at) for name, at in place.items()}
        yield Params(**{name: round(value) if name in whole else float(value) for name, value in values.items()})
    yield from near


def trim(trajectory, T):
    return dataclasses.replace(trajectory, x=trajectory.x[:T], z=trajectory.z[:T], u=None if trajectory.u is None else trajectory.u[:T])


@functools.cache
def cases(name):
    """All (Params, Trajectory) of a paper: some with missed measurements; a run that explodes as long as it stays below 1e12, where
    a difference of two such numbers still has digits."""
    module, rng, found = importlib.import_module(f"kalman_lib.papers.{name}"), np.random.default_rng(2026), []
    for number, p in enumerate(parameter_sets(module.Params, rng)):
        with np.errstate(all="ignore"):
            trajectory = module.simulate(p, rng)
        calm = (np.abs(trajectory.z) < 1e12).all(axis=1) & (np.abs(trajectory.x) < 1e12).all(axis=1)
        T = min(len(calm) if calm.all() else int(np.argmin(calm)), 300)
        if T < 2:
            continue
        trajectory = trim(trajectory, T)
        if number % 5 == 4:
            z = trajectory.z.copy()
            z[3::7] = np.nan
            trajectory = dataclasses.replace(trajectory, z=z)
        found.append((p, trajectory))
    return found


def close(ours, theirs, columns, doubt=0):
    """None, or where JavaScript and Python differ most. doubt: what Python's own rounding leaves open."""
    ours = np.array([np.nan if value is None else value for value in ours], dtype=float).reshape(-1, columns)
    theirs = np.asarray(theirs, dtype=float).reshape(-1, columns)
    if ours.shape != theirs.shape:
        return f"{ours.shape} against {theirs.shape}"
    if not np.array_equal(np.isnan(ours), np.isnan(theirs)):
        return "NaN in one of them only"
    size = np.nan_to_num(np.abs(theirs))
    wrong = np.nan_to_num(np.abs(ours - theirs)) - (RELATIVE * size + SCALE * size.max(axis=0, initial=0) + doubt)
    if wrong.max(initial=-1) <= 0:
        return None
    k, i = np.unravel_index(np.argmax(wrong), wrong.shape)
    return f"step {k}, component {i}: {ours[k, i]!r} against {theirs[k, i]!r}"


def python_numbers(module, name, p, trajectory, result):
    """What the Python function `name` says; its parameters are found by their names (x: all states where P is wanted, too, else
    the first). A complex number counts as two; NaN alone: the function refuses."""
    function = getattr(module, name)
    wanted = [parameter.name for parameter in inspect.signature(function).parameters.values() if parameter.default is parameter.empty]
    known = {"p": p, "z": trajectory.z[:, 0], "truth": trajectory.x[:, 0], "result": result, "K": result.K[0, 0, 0],
             **{word: trajectory for word in ("flight", "walk", "run", "trajectory")}, **dataclasses.asdict(p),
             "x": result.x if "P" in wanted else result.x[:, 0], "P": result.P}
    try:
        parts = [np.ravel(part) for part in np.atleast_1d(function(*(known[word] for word in wanted)))]
    except ValueError:
        return np.array([np.nan])
    values = np.concatenate(parts)
    return values.view(float) if np.iscomplexobj(values) else values


def well_conditioned(P):
    sigma = np.sqrt(np.einsum("kii->ki", P))
    return (sigma > 0).all() and np.linalg.cond(P / (sigma[:, :, None] * sigma[:, None, :])).max() < 1e4


def in_python(module, p, t, twins):
    """What Python computes: key -> (array, columns); no inverse of a covariance that has none worth the name."""
    with np.errstate(all="ignore"):
        result = kalman_filter(module.model(p), t.z, t.u)
        n, m = t.x.shape[1], t.z.shape[1]
        numbers = {key: (getattr(result, key), size) for key, size in dict(x_pred=n, P_pred=n * n, x=n, P=n * n, y=m, S=m * m, K=n * m).items()}
        numbers |= {"rmse": (rmse(t.x, result.x), n), "nis": (nis(result.y, result.S), 1)}
        if well_conditioned(result.P):
            numbers["nees"] = nees(t.x, result.x, result.P), 1
        if well_conditioned(result.P_pred):
            smooth = rts_smooth(result)
            numbers |= {"x_smooth": (smooth.x, n), "P_smooth": (smooth.P, n * n)}
        for key in twins:
            values = python_numbers(module, key, p, t, result)
            numbers[key] = values, len(values)
    return numbers


def doubts(module, p, t, twins, numbers):
    """How much Python's numbers change when z and p change in their last digit, times 100: key -> array. Where a filter is chaotic
    (the beetle's, far from the truth) or subtracts huge numbers (a ship at 10^7 m/s), this is far more than 10^-9."""
    rng, moved = np.random.default_rng(0), {}
    for _ in range(3):
        z = t.z * (1 + 4.5e-16 * rng.choice([-1, 1], size=t.z.shape))
        near = {name: value * (1 + 4.5e-16 * rng.choice([-1, 1])) for name, value in dataclasses.asdict(p).items() if isinstance(value, float)}
        ends = describe(type(p))
        q = dataclasses.replace(p, **{name: min(max(value, ends[name]["min"]), ends[name]["max"]) for name, value in near.items()})
        for key, (values, columns) in in_python(module, q, dataclasses.replace(t, z=z), twins).items():
            if key in numbers and np.size(values) == np.size(numbers[key][0]):
                change = np.nan_to_num(np.abs(np.reshape(values, (-1, columns)) - np.reshape(numbers[key][0], (-1, columns))))
                moved[key] = np.maximum(moved.get(key, 0), change)
    return {key: 100 * (change.max(axis=0) if "smooth" in key else np.maximum.accumulate(change)) for key, change in moved.items()}


def differences(name, page):
    """Where JavaScript and Python disagree on one paper, one sentence after the other."""
    module, all_cases = importlib.import_module(f"kalman_lib.papers.{name}"), cases(name)
    assert len(all_cases) > 2 * len(describe(module.Params)) + SETS
    listed = lambda values: None if values is None else [None if value != value else value for value in np.ravel(values).tolist()]
    question = [{"paper": name, "p": dataclasses.asdict(p), "z": listed(t.z), "u": listed(t.u), "x": listed(t.x)} for p, t in all_cases]
    answers = json.loads(page.evaluate(RUN, json.dumps(question)))
    compared = set()
    for number, ((p, t), answer) in enumerate(zip(all_cases, answers)):
        twins = answer.pop("twins")
        numbers, answer = in_python(module, p, t, twins), answer | twins
        compared |= set(numbers)
        wrong = {key for key, (theirs, columns) in numbers.items() if close(answer[key], theirs, columns)}
        doubt = doubts(module, p, t, twins, numbers) if wrong and number > 0 else {}        # the default case has no excuse
        for key in sorted(wrong):
            if trouble := close(answer[key], *numbers[key], doubt.get(key, 0)):
                yield f"{key}: {trouble} ({p})"
    assert {"x", "P", "K", "rmse", "nis", "nees", "x_smooth", "P_smooth"} <= compared


@pytest.mark.parametrize("name", PAPERS)
def test_the_page_computes_what_python_computes(name, bundle):
    assert bundle.evaluate("name => name in KalmanExplorers.papers", name), f"book/explorers/papers/{name}.js is missing"
    assert list(itertools.islice(differences(name, bundle), 3)) == []


@pytest.mark.parametrize("name", PAPERS)
def test_one_wrong_sign_is_found(name, tmp_path, chromium):
    """The comparison itself is tested: the first parameter in the JavaScript model gets a minus."""
    sources = tmp_path / "explorers"
    shutil.copytree(SOURCES, sources)
    file = sources / "papers" / f"{name}.js"
    before, model, after = file.read_text(encoding="utf-8").partition("export function model(p) {")
    file.write_text(before + model + re.sub(r"(?<!\.\.)\bp\.(?=[A-Za-z])", "-p.", after, count=1), encoding="utf-8")
    explorers_to_bundle.bundle(tmp_path, "en", sources)
    page = chromium.new_page()
    page.add_script_tag(path=tmp_path / "explorers.js")
    assert next(differences(name, page), None) is not None
    page.close()


@pytest.mark.parametrize("name", sorted(set(PAPERS) - OWN_MOTION))
def test_the_noise_of_the_page_is_that_of_the_model(name, bundle):
    mean = bundle.evaluate("""name => {
      const { papers, tables, random, metrics } = KalmanExplorers, { model, simulate, run } = papers[name];
      const p = Object.fromEntries(Object.entries(tables[name]).map(([key, field]) => [key, field.default]));
      const means = Array.from({ length: 100 }, (_, seed) => {
        const data = simulate(p, random.generator(seed)), result = run(p, data);
        return metrics.mean(metrics.nis(result.y, result.S, result.m)) / result.m;
      });
      return metrics.mean(means);
    }""", name)
    assert 0.93 < mean < 1.07


def test_normal_numbers_and_their_seeds(bundle):
    moments, same, other = bundle.evaluate("""() => {
      const { generator } = KalmanExplorers.random, rng = generator(1), sums = [0, 0, 0, 0];
      for (let i = 0; i < 400000; i++) { const v = rng.normal(); for (let j = 0; j < 4; j++) sums[j] += v ** (j + 1) / 400000; }
      return [sums, generator(5).normal() === generator(5).normal(), generator(5).normal() === generator(6).normal()];
    }""")
    assert same and not other
    assert moments == pytest.approx([0, 1, 0, 3], abs=0.03)


@pytest.mark.parametrize("dof, runs", [(1, 1), (1, 500), (2, 10), (3, 200), (6, 37)])
def test_chi_square_bounds(dof, runs, bundle):
    assert bundle.evaluate("([dof, runs]) => KalmanExplorers.metrics.chi2Bounds(dof, runs)", [dof, runs]) == pytest.approx(chi2_bounds(dof, runs), rel=1e-9)


@pytest.mark.parametrize("language, other", [("id", "en"), ("en", "id")])
def test_ranges_and_words_come_from_python(language, other, site, opened):
    tables = opened(pages_with_explorers(site, language)[0])[0].evaluate("KalmanExplorers.tables")
    for name in PAPERS:
        expected = describe(importlib.import_module(f"kalman_lib.papers.{name}").Params)
        assert tables[name] == {field: {key: value for key, value in meta.items() if key != other} for field, meta in expected.items()}


def test_a_page_loads_the_words_of_its_language(site):
    """The words of the other one are left out where both stand side by side: those of every view's name, for one."""
    for language in ("id", "en"):
        script = (site / language / "_static" / "vendor" / "explorers" / "explorers.js").read_text(encoding="utf-8")
        for path in (SOURCES / "papers").glob("*.js"):
            for pair in re.findall(r'name: \{ id: "([^"]+)", en: "([^"]+)" \}', path.read_text(encoding="utf-8")):
                assert [text in script for text in pair] == [language == "id", language == "en"], pair


# --- who may import whom --------------------------------------------------------------------------------------------

ALLOWED = {"linalg.js": set(), "words.js": set(), "random.js": {"linalg.js"}, "filters.js": {"linalg.js"}, "metrics.js": {"linalg.js"}, "painter.js": set(), "plot.js": {"painter.js"}, "xlsx.js": set(), "spreadsheet.js": {"words.js"},
           "explorer.js": {"words.js", "random.js", "plot.js", "painter.js"}}
PURE = {"linalg.js", "filters.js", "metrics.js", "random.js", "words.js"}


@pytest.mark.parametrize("path", sorted(SOURCES.rglob("*.js")), ids=lambda path: path.name)
def test_import_rules(path):
    text = path.read_text(encoding="utf-8")
    imported = {name.rsplit("/", 1)[-1] for name in re.findall(r'^(?:import|export)[^;]*? from "([^"]+)"', text, re.M) if not name.startswith("data/")}
    in_papers = path.parent.name == "papers"
    allowed = PURE | {file.name for file in SOURCES.glob("*.js")} - {"painter.js", "plot.js", "explorer.js"} if in_papers else ALLOWED.get(path.name, PURE)
    assert imported <= allowed, f"{path.name} may not import {imported - allowed}"
    code = "\n".join(line for line in text.splitlines() if not line.lstrip().startswith(("//", "*", "/*")))
    if path.name not in ("plot.js", "explorer.js"):
        assert not re.search(r"\b(document|innerHTML|localStorage)\b|(?<!\.)\bwindow[.\[]", code), f"{path.name} must not touch the document"
    assert "innerHTML" not in code and "insertAdjacentHTML" not in code and "eval(" not in code


# --- how it is loaded -----------------------------------------------------------------------------------------------

def test_script_and_style_are_small_and_only_where_they_are_needed(site):
    for path in site.rglob("*.html"):
        text = path.read_text(encoding="utf-8")
        script = re.findall(r'<script[^>]*vendor/explorers/explorers\.js[^>]*>', text)
        assert len(script) == ("<kalman-explorer" in text) and all(" defer" in tag for tag in script), path
    folder = site / "id" / "_static" / "vendor" / "explorers"
    sizes = {file.name: len(gzip.compress(file.read_bytes(), 9)) for file in folder.iterdir()}
    assert set(sizes) == {"explorers.js", "explorers.css"} and sum(sizes.values()) <= 60_000, sizes


@pytest.mark.parametrize("scheme", ["http", "file"])
@pytest.mark.parametrize("language", ["id", "en"])
def test_every_explorer_lives_without_an_error(scheme, language, site, server, opened):
    base, seen = {"http": server, "file": site.as_uri()}[scheme], set()
    for path in pages_with_explorers(site, language):
        page, trouble = opened(path, base=base)
        for element in page.locator("kalman-explorer").all():
            paper = element.get_attribute("paper")
            alive = element.evaluate("e => e.explorer?.r !== undefined && e.explorer.message.hidden")
            assert alive, paper
            assert element.locator("> img").is_visible() != alive
            seen.add(paper)
        assert trouble == [], path
    assert seen == set(PAPERS)


@pytest.mark.parametrize("scheme", ["http", "file"])
def test_the_picture_is_the_same_without_a_second_thread(scheme, site, server, chromium):
    base, drawn = {"http": server, "file": site.as_uri()}[scheme], {}
    for threads in (True, False):
        context = chromium.new_context(viewport={"width": 1280, "height": 900}, service_workers="block", color_scheme="light")
        if not threads:
            context.add_init_script("delete window.Worker")
        page = context.new_page()
        page.goto(f"{base}/{pages_with_explorers(site, 'en')[0].relative_to(site).as_posix()}")
        element = page.locator("kalman-explorer").first
        element.scroll_into_view_if_needed()
        page.evaluate("document.fonts.ready.then(() => true)")
        shown(element)
        element.evaluate("async e => { e.explorer.draw(true); await e.explorer.painted(); }")
        drawn[threads] = element.evaluate("""e => [...e.querySelectorAll('canvas')].map(canvas => {
          const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).getContext('2d');
          copy.drawImage(canvas, 0, 0);
          return copy.getImageData(0, 0, canvas.width, canvas.height).data.filter((value, i) => i % 4 === 3 && value > 0).length;
        })""")
        refused = element.evaluate("""e => { try { return e.querySelector('canvas').getContext('2d') === null; } catch { return true; } }""")
        assert refused == threads               # a canvas that was handed over has no context in the page
        context.close()
    assert min(drawn[True]) > 1000 and drawn[True] == pytest.approx(drawn[False], rel=0.02)


def test_print_and_no_script_show_the_picture(site, server, chromium, opened):
    for name, page, _, element in explorers(site, opened):
        page.set_viewport_size({"width": 900, "height": 900})
        page.emulate_media(media="print")
        assert element.locator("> img").is_visible() and not element.locator(".explorer").is_visible(), name
        page.emulate_media(media="screen")
        page.set_viewport_size(PHONE)
    context = chromium.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(f"{server}/{pages_with_explorers(site, 'id')[0].relative_to(site).as_posix()}")
    assert page.locator("kalman-explorer > img").first.is_visible()
    context.close()


# --- everyone ------------------------------------------------------------------------------------------------------

PICTURE = """
  const pixels = canvas => {                    // of a canvas that another thread paints: through a second one
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height }).getContext('2d');
    copy.drawImage(canvas, 0, 0);
    return copy.getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, value, i) => (sum * 31 + value * (i & 3)) | 0, 7);
  };
  const picture = e => [...e.querySelectorAll('canvas')].map(canvas => canvas.width && pixels(canvas)).join() + e.querySelector('.explorer-outcome').textContent + e.querySelector('.explorer-equations').textContent;
  const drawn = async () => {
    await new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 5))));
    e.explorer.words(true);                     // they follow only some times a second
    await e.explorer.painted();
  };"""


def picture(element):
    """What the explorer shows, as one text that differs when anything in it does."""
    return element.evaluate(f"e => {{ {PICTURE} return picture(e); }}")


def shown(element):
    """After the next drawing."""
    element.evaluate(f"e => {{ {PICTURE} return drawn(); }}")


def test_every_slider_moves_the_picture(site, opened):
    for name, page, trouble, element in explorers(site, opened):
        dead = element.evaluate("""async e => {""" + PICTURE + """
          const open = () => { for (const box of e.querySelectorAll('input[type=checkbox]')) if (!box.checked) box.click(); };
          const usable = part => part.offsetParent && !part.disabled, dead = [];
          open();
          await drawn();
          let sliders = 0;
          for (const slider of e.querySelectorAll('input[type=range]')) {
            if (!usable(slider)) continue;
            const pictures = [];
            sliders++;
            for (const end of ['min', 'max']) {
              slider.value = slider[end];
              slider.dispatchEvent(new Event('input', { bubbles: true }));
              await drawn();
              e.explorer.draw(true);
              await e.explorer.painted();
              pictures.push(picture(e));
              const message = e.querySelector('.explorer-message');
              if (!message.hidden) dead.push(`${slider.id}: ${message.textContent}`);
            }
            if (pictures[0] === pictures[1]) dead.push(slider.id);
            e.explorer.reset();
            open();
            await drawn();
          }
          e.explorer.reset();
          return sliders ? dead : ['no slider'];
        }""")
        assert dead == [] and trouble == [], name


def test_labels_targets_and_keyboard(site, opened):
    for name, page, _, element in explorers(site, opened):
        small = element.evaluate("""e => [...e.querySelectorAll('input, button, select, textarea, summary')].filter(part => {
          const box = (part.type === 'checkbox' ? part.closest('label') : part).getBoundingClientRect();
          return box.width > 0 && (box.height < 43.9 || box.width < 43.9); }).map(part => part.outerHTML.slice(0, 90))""")
        assert small == [], name
        for slider in element.locator("input[type=range]:visible:not(:disabled)").all():
            assert slider.evaluate("e => e.labels[0].textContent.trim()") and re.search(r"\d", slider.get_attribute("aria-valuetext"))
        for field in element.locator("input[type=text]").all():
            assert field.get_attribute("aria-label") or field.evaluate("e => e.labels.length")
        slider = element.locator("input[type=range]:visible:not(:disabled)").last
        slider.focus()
        before = slider.get_attribute("aria-valuetext")
        page.keyboard.press("PageUp")
        shown(element)
        page.keyboard.press("ArrowRight")
        shown(element)
        assert slider.get_attribute("aria-valuetext") != before, name
        assert slider.evaluate("e => getComputedStyle(e).outlineStyle") != "none"
        page.wait_for_function("e => e.querySelector('[aria-live]').textContent === e.querySelector('.explorer-outcome').textContent", arg=element.element_handle())
        element.evaluate("e => e.explorer.reset()")


def test_the_numbers_of_the_figures_as_a_table(site, opened):
    for name, page, _, element in explorers(site, opened):
        details = element.locator("details.explorer-numbers")
        details.evaluate("e => { e.open = true }")
        page.wait_for_function("e => e.querySelector('table')", arg=details.element_handle())
        assert details.locator("tbody tr").count() > 3 and details.locator("thead th").count() > 3, name
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        for canvas in element.locator("canvas").all():
            assert len(canvas.get_attribute("aria-label")) > 30


def test_accessibility(site, opened):
    axe = (ROOT / "book" / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")
    for language in ("id", "en"):
        for path in pages_with_explorers(site, language):
            page, _ = opened(path)
            page.evaluate("document.querySelectorAll('details.explorer-numbers').forEach(e => { e.open = true })")
            page.wait_for_function("[...document.querySelectorAll('details.explorer-numbers')].every(e => e.querySelector('table'))")
            page.evaluate("""() => {               // a few rows of the long tables are enough
              document.querySelectorAll('.explorer-table tbody tr:nth-child(n + 4)').forEach(row => row.remove());
              document.querySelectorAll('.katex, .highlight').forEach(e => { e.textContent = 'x'; });      // thousands of parts: slow
            }""")
            page.evaluate(axe)
            for theme in ("light", "dark") if language == "id" else ("light",):        # only the words differ
                page.evaluate("theme => { document.documentElement.dataset.theme = theme }", theme)
                found = page.evaluate("axe.run('kalman-explorer').then(r => r.violations.map(v => [v.id, v.nodes.map(n => n.target.join(' ')).slice(0, 4)]))")
                assert found == [], (path, theme)
            page.evaluate("""() => {
              document.documentElement.dataset.theme = 'light';
              document.querySelectorAll('details.explorer-numbers').forEach(e => { e.open = false; e.querySelector('table').dataset.shape = ''; });
            }""")


def texts(element):
    return element.evaluate("""e => (e = e.cloneNode(true), e.querySelectorAll('sub').forEach(part => part.remove()), e) && [...e.querySelectorAll('button, label, option, summary, th, p, .explorer-title, .explorer-key')].map(part => part.textContent.trim())
      .concat([...e.querySelectorAll('[aria-label]:not(.explorer-line)')].map(part => part.getAttribute('aria-label')))""")


def test_every_text_is_in_the_language_of_its_page(site, opened):
    spoken = {language: [texts(element) for *_, element in explorers(site, opened, language)] for language in ("id", "en")}
    assert spoken["id"] and len(spoken["id"]) == len(spoken["en"])
    for ours, theirs in zip(spoken["id"], spoken["en"]):
        assert len(ours) == len(theirs)
        words = [text for text in ours if re.search(r"[a-z]{4}", re.sub("pred|true|smooth", "", text)) and text not in SAME_TEXT]
        assert [text for text in words if text in theirs] == []
        assert not [text for text in ours if re.search(r"\d\.\d", text)], "a decimal point in Indonesian"


@pytest.mark.parametrize("language", ["id", "en"])
def test_every_choice_of_a_list_works(language, site, opened):
    for name, _, trouble, element in explorers(site, opened, language):
        for choice in element.locator("select:visible").all():
            for value in choice.evaluate("e => [...e.options].map(option => option.value)"):
                choice.select_option(value)
                shown(element)
                said = element.locator(".explorer-outcome").inner_text() + element.locator(".explorer-message").inner_text()
                assert said and not re.search("undefined|NaN|failed|gagal", said), (name, value, said)
                assert element.locator(".explorer-message").is_hidden(), (name, value)
        assert trouble == [], name
        element.evaluate("e => e.explorer.reset()")


def test_a_finger_that_scrolls_over_a_figure_changes_nothing(site, opened):
    for name, _, _, element in explorers(site, opened):
        if element.locator("canvas.draggable").count() == 0:
            continue
        settings = [element.evaluate("""async (e, ways) => {""" + PICTURE + """
          const canvas = e.querySelector('canvas.draggable'), box = canvas.getBoundingClientRect();
          for (const [type, x, y] of ways) canvas.dispatchEvent(new PointerEvent(type, { bubbles: true, isPrimary: true, pointerType: 'touch',
            pointerId: 1, clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
          await drawn();
          return JSON.stringify(e.explorer.s);
        }""", ways) for ways in ([], [("pointerdown", 0.3, 0.2), ("pointermove", 0.3, 0.6), ("pointercancel", 0.3, 0.6)],
                                 [("pointerdown", 0.3, 0.2), ("pointermove", 0.4, 0.2), ("pointerup", 0.4, 0.2)])]
        assert settings[0] == settings[1] != settings[2], name
        element.evaluate("e => e.explorer.reset()")


# --- the address, and bad input -------------------------------------------------------------------------------------

def test_the_address_keeps_the_settings(site, opened, server, chromium):
    for name, page, _, element in explorers(site, opened):
        slider = element.locator("input[type=range]:visible:not(:disabled)").last
        slider.focus()
        page.keyboard.press("End")
        shown(element)
        state, key = element.evaluate("e => [e.explorer.s, e.explorer.key]")
        address = page.url
        assert f"#{key}:" in address, name
        other = page.context.new_page()
        other.goto(address)
        assert other.evaluate("key => [...document.querySelectorAll('kalman-explorer')].find(e => e.explorer?.key === key).explorer.s", key) == state
        other.wait_for_function("key => { const top = [...document.querySelectorAll('kalman-explorer')].find(e => e.explorer?.key === key).getBoundingClientRect().top; return top > -5 && top < 300 }", arg=key)
        section = other.evaluate("document.querySelector('article section section').id")
        other.evaluate("id => { location.hash = id }", section)         # an ordinary anchor still works
        assert other.url.endswith(f"#{section}")
        other.close()
        element.evaluate("e => e.explorer.reset()")
        assert f"{key}:" not in page.url


@pytest.mark.parametrize("language", ["id", "en"])
@pytest.mark.parametrize("bad", ["seed=<img src=x onerror=alert(1)>", "<script>alert(1)</script>=1", "seed==cmd|' /C calc'!A0", "seed=1e308",
                                 "seed=NaN", "seed=", "nothing=1", "seed=-5", "%E0%A4%A", "__proto__=1", "seed=" + "9" * 5000])
def test_a_bad_address_is_refused_in_one_sentence(language, bad, site, opened):
    page, trouble = opened(pages_with_explorers(site, language)[0])
    element = live(page)[0]
    shown(element)
    key, before = element.evaluate("e => [e.explorer.key, e.explorer.s]")
    drawn = picture(element)
    page.evaluate("text => { location.hash = text }", f"{key}:{bad}")
    message = element.locator(".explorer-message")
    message.wait_for(state="visible")
    text = message.inner_text()
    assert len(text) < 250 and text.endswith(".") and text.count("\n") == 0
    assert ("diterima" in text or "alamat" in text) == (language == "id")
    assert element.evaluate("e => e.explorer.s") == before and picture(element) == drawn
    assert message.locator("*").count() == 0 and trouble == []
    element.evaluate("e => e.explorer.reset()")
    message.wait_for(state="hidden")
    assert f"{key}:" not in page.url


def test_bad_numbers_are_refused_and_the_picture_stays(site, opened):
    for name, page, _, element in explorers(site, opened):
        field = element.locator(".explorer-control:visible input.explorer-value:not(:disabled)").last
        element.evaluate("async e => { e.explorer.draw(true); await e.explorer.painted(); }")      # those out of sight, too
        good, drawn = field.input_value(), picture(element)
        for bad in ("abc", "<b>1</b>", "=1+1", "1e308", "NaN", "", "1,2,3"):
            field.fill(bad)
            field.press("Enter")
            message = element.locator(".explorer-message")
            message.wait_for(state="visible")
            assert (bad in message.inner_text() or "diterima" in message.inner_text()) and message.locator("*").count() == 0, (name, bad)
            assert picture(element) == drawn
        field.fill(good)
        field.press("Enter")
        message.wait_for(state="hidden")


# --- the hand check -------------------------------------------------------------------------------------------------

@pytest.mark.parametrize("language", ["id", "en"])
def test_the_hand_check(language, site, opened):
    for name, page, _, element in explorers(site, opened, language):
        page.wait_for_function("e => e.querySelector('.explorer-question').textContent", arg=element.element_handle())
        asked = element.evaluate("""async e => {
          const form = e.querySelector('form'), verdict = form.querySelector('.explorer-verdict'), field = form.querySelector('input'), asked = [];
          const say = text => { field.value = text; form.requestSubmit(); return [verdict.className, verdict.textContent, verdict.querySelectorAll('b').length]; };
          for (let i = 0; i < 12; i++) {
            const { answer } = e.explorer.question;
            asked.push([form.querySelector('.explorer-question').textContent, say(answer.toPrecision(6).replace('.', ',')), say((1.7 * answer + 3).toPrecision(6)), say('<b>x</b>')]);
            form.querySelector('button[type=button]').click();
            await new Promise(done => setTimeout(done));
          }
          return asked;
        }""")
        for question, right, wrong, typed in asked:
            assert right[0].endswith("right"), (name, question, right)
            assert wrong[0].endswith("wrong") and len(wrong[1]) > 5 and "{" not in wrong[1] + question, (name, question, wrong)
            assert typed[0].endswith("wrong") and "<b>x</b>" in typed[1] and typed[2] == 0
        assert len({question for question, *_ in asked}) >= 3, name


# --- chapters 4 and 5: what only they have ---------------------------------------------------------------------------

def explorer_of(paper, site, opened, language="id", **options):
    """(browser page, trouble, locator) of the first live explorer of this paper; no other page is opened."""
    path = next(path for path in pages_with_explorers(site, language) if f'paper="{paper}"' in path.read_text(encoding="utf-8"))
    page, trouble = opened(path, **options)
    return page, trouble, next(element for element in live(page) if element.get_attribute("paper") == paper)


def set_state(element, **changes):
    element.evaluate("(e, changes) => e.explorer.change(changes)", changes)
    shown(element)


def test_ship_the_fit_and_what_noise_does_to_it_as_in_python(bundle):
    from kalman_lib.papers import ship
    rng = np.random.default_rng(4)
    still = ship.towing_run(rng, 0)[1].x[:, 0]
    sigmas = [0, 1e-3, 0.01, 0.1, 0.5]
    series = [still + sigma * rng.normal(size=len(still)) for sigma in sigmas] + [ship.simulate(ship.Params(), rng).z[:, 0] for _ in range(SETS)]
    ours = bundle.evaluate("""([series, sigmas]) => {
      const { towing_run, fit, expected_fit, poles } = KalmanExplorers.papers.ship, { x, t } = towing_run(KalmanExplorers.random.generator(1), 0);
      const fits = series.map(z => Array.from(fit(Float64Array.from(z)))), expected = sigmas.map(sigma => Array.from(expected_fit(x, sigma)));
      return { x: Array.from(x), t: Array.from(t), fits, expected, poles: fits.map(([, a1, a2]) => poles(a1, a2).flat()),
               none: [[1, 2, 3, 4, 5, 6], [2, 2, 2, 2, 2, 2, 2], [1, 2], [1, 2, 4, 8, 16, 32]].map(z => fit(Float64Array.from(z))) };
    }""", [[z.tolist() for z in series], sigmas])
    assert np.allclose(ours["x"], still, rtol=1e-12, atol=1e-15) and np.allclose(ours["t"], 0.1 * np.arange(len(still)))
    for z, theta, pair in zip(series, ours["fits"], ours["poles"]):
        p = ship.fitted(z, ship.Params())
        assert np.allclose(theta, [p.c, p.a1, p.a2], rtol=RELATIVE, atol=0)
        assert np.allclose(np.reshape(pair, (2, 2)) @ [1, 1j], ship.poles(p.a1, p.a2), rtol=1e-7)       # a root of a small difference
    for sigma, theta in zip(sigmas, ours["expected"]):
        assert np.allclose(theta, ship.expected_fit(still, sigma), rtol=1e-8 if sigma == 0 else RELATIVE, atol=0)
    assert ours["none"] == [None] * 4


def test_ship_tells_uneven_sampling_with_the_words_of_python(bundle):
    from kalman_lib.papers import ship
    times = [[0, 1, 2, 3, 4, 5], [0, 0.1, 0.2, 0.31, 0.4, 0.55], [3, 3.25, 3.5, 3.75, 9], [0, 1, 1, 2, 3], [0, 2, 1, 3, 4, 5], [0, 1, 2], [0, 1, math.nan, 3, 4, 5]]
    said = bundle.evaluate("""times => times.map(t => {
      try { const { dt, uneven, en, id } = KalmanExplorers.papers.ship.sampling(Float64Array.from(t, v => v ?? NaN)); return [dt, uneven, en, id]; }
      catch ({ en, id }) { return [`${en} / ${id}`]; } })""", [[None if value != value else value for value in t] for t in times])
    for t, ours in zip(times, said):
        try:
            sampled = ship.sampling(t)
        except ValueError as error:
            assert ours == [str(error)]
        else:
            assert ours[0] == pytest.approx(sampled.dt, rel=1e-12) and ours[1:] == [sampled.uneven, sampled.en, sampled.id]


def own_run(rows=200):
    """The text of a recording in ms and km/h with decimal comma, and its (t, z) in s and m/s."""
    from kalman_lib.papers import ship
    t, z = 50.0 * np.arange(rows), np.round(3.6 * ship.towing_run(np.random.default_rng(5))[1].z[:rows, 0], 3)
    text = "waktu\tkecepatan\n" + "\n".join(f"{a:g}\t{b:.3f}".replace(".", ",") for a, b in zip(t, z))
    return text, t / 1000, z / 3.6


@pytest.mark.parametrize("way", ["pasted", "file"])
@pytest.mark.parametrize("language", ["id", "en"])
def test_ship_filters_a_recording_of_the_reader_as_python_does(way, language, site, opened):
    from kalman_lib.papers import ship
    page, _, element = explorer_of("ship", site, opened, language)
    text, t, z = own_run()
    if way == "pasted":
        element.locator("textarea").fill(text)
    else:
        element.locator("input[type=file]").set_input_files({"name": "kapal.csv", "mimeType": "text/csv", "buffer": text.encode()})
        page.wait_for_function("e => e.explorer.r.data.truth === null", arg=element.element_handle())
    shown(element)
    element.locator("select").nth(0).select_option("ms")
    element.locator("select").nth(1).select_option("km/h")
    element.get_by_text({"id": "penghalus", "en": "smoother"}[language]).first.click()
    shown(element)
    assert not element.locator(".explorer-message").is_visible()
    p = dataclasses.replace(ship.fitted(z, ship.Params()), x0=z[0], P0=0.01)
    smooth = rts_smooth(kalman_filter(ship.model(p), z, np.ones(len(z))))
    r = element.evaluate("e => { const { data, p, x, root } = e.explorer.r; return { t: [...data.t], z: [...data.z], theta: [p.c, p.a1, p.a2], x: [...x], root: [...root] }; }")
    for name, theirs in {"t": t, "z": z, "theta": [p.c, p.a1, p.a2], "x": smooth.x[:, 0], "root": np.sqrt(smooth.P[:, 0, 0])}.items():
        assert np.allclose(r[name], theirs, rtol=RELATIVE, atol=1e-12), name
    outcome = element.locator(".explorer-outcome").inner_text()
    assert getattr(ship.sampling(t), language) in outcome
    uneven = text.replace("\n500\t", "\n510\t")
    element.locator("textarea").fill(uneven)
    shown(element)
    assert {"id": "tidak seragam", "en": "unevenly spaced"}[language] in element.locator(".explorer-outcome").inner_text()
    element.get_by_role("button", name={"id": "Kembali", "en": "Back"}[language]).click()
    shown(element)
    assert element.evaluate("e => e.explorer.r.data.truth !== null") and element.locator("textarea").input_value() == ""
    element.evaluate("e => e.explorer.reset()")


BAD_RECORDINGS = ["0 1\n1 2\n2 <img src=x onerror=alert(1)>", "<script>alert(1)</script>", "0;1\n1;2\n2;=cmd|' /C calc'!A0", "0 1\n1 1e308\n2 3\n3 1\n4 2\n5 1", "NaN", "1\n2\n3\n4\n5\n6",
                  "0 1\n1 2\n1 3\n2 1\n3 2\n4 5", "0 1\n1 1\n2 1\n3 1\n4 1\n5 1", "0 1\n1 2\n2", "0 0\n1 1e7\n2 0\n3 5\n4 1\n5 2\n6 2", "0 1\n1 2e9\n2 3\n3 4\n4 5\n5 6\n6 1", "\n".join(f"{k} {k % 7}" for k in range(200_001))]


@pytest.mark.parametrize("language", ["id", "en"])
def test_ship_refuses_what_is_no_recording_in_one_sentence(language, site, opened):
    _, trouble, element = explorer_of("ship", site, opened, language)
    shown(element)
    drawn = picture(element)
    message = element.locator(".explorer-message")
    for bad in BAD_RECORDINGS:
        set_state(element, text=bad)
        text = message.inner_text()
        assert message.is_visible() and text.endswith(".") and len(text) < 250 and "\n" not in text, (bad[:50], text)
        assert not re.search("failed|gagal|undefined", text), (bad[:50], text)
        assert picture(element) == drawn and message.locator("*").count() == 0, bad[:50]
    set_state(element, text=None)
    assert not message.is_visible()
    for name, content in {"kapal.xlsx": b"PK\x03\x04" + bytes(100), "foto.csv": bytes(range(256)), "empty.txt": b""}.items():
        element.locator("input[type=file]").set_input_files({"name": name, "mimeType": "text/plain", "buffer": content})
        message.wait_for(state="visible")
        shown(element)
        assert message.inner_text().endswith(".") and picture(element) == drawn, name
        set_state(element, file=None)
        message.wait_for(state="hidden")
    assert trouble == []
    element.evaluate("e => e.explorer.reset()")


def test_beetle_with_the_bearing_as_in_python(bundle):
    from kalman_lib.papers import beetle
    rng, cases = np.random.default_rng(6), []
    for _ in range(SETS):
        p = beetle.Params(theta0=rng.uniform(-1, 1), theta=rng.uniform(-1, 1), v=rng.uniform(1, 4), R_bearing=10 ** rng.uniform(-4, -2), dt=rng.uniform(0.1, 1))
        cases.append((p, beetle.simulate(p, rng, 40, bearing=True)))
    answers = bundle.evaluate("""cases => cases.map(([p, z]) => {
      const { bearing_model, away_sigma } = KalmanExplorers.papers.beetle, r = KalmanExplorers.filters.kalmanFilter(bearing_model(p), Float64Array.from(z));
      return { x: Array.from(r.x), P: Array.from(r.P), K: Array.from(r.K), s: Array.from(away_sigma(r.x, r.P, 4)) }; })""",
                              [[dataclasses.asdict(p), np.ravel(walk.z).tolist()] for p, walk in cases])
    for (p, walk), answer in zip(cases, answers):
        result = kalman_filter(beetle.bearing_model(p), walk.z)
        for name, theirs in {"x": result.x, "P": result.P, "K": result.K, "s": beetle.away_sigma(result.x[:, :3], result.P[:, :3, :3])}.items():
            assert not close(answer[name], np.reshape(theirs, (-1, np.size(answer[name]) // 40)), np.size(answer[name]) // 40, 1e-11), (name, p)


@pytest.mark.parametrize("width", [640, 320])
def test_zoomed_in_nothing_is_cut_off(width, site, opened):
    """A window of 1280 pixels zoomed to 200 % and to 400 % leaves the page 640 and 320 of them."""
    for name, page, trouble, element in explorers(site, opened, viewport={"width": width, "height": 450}, device_scale_factor=1280 / width):
        wide = element.evaluate("""e => [...e.querySelectorAll('.explorer *')].filter(part => part.offsetParent && part.getBoundingClientRect().right > innerWidth + 1
          && !part.closest('.explorer-equations, .explorer-table')).map(part => part.className || part.tagName)""")
        assert wide == [] and page.evaluate("document.documentElement.scrollWidth <= innerWidth"), name
        for part in element.locator("button:visible, input[type=range]:visible, select:visible").all()[:6]:
            part.scroll_into_view_if_needed()
            box = part.bounding_box()
            assert box["x"] >= 0 and box["x"] + box["width"] <= width and box["height"] >= 43.9, name


@pytest.mark.parametrize("motion", ["reduce", "no-preference"])
def test_beetle_walks_only_for_who_wants_motion(motion, site, opened):
    page, trouble, element = explorer_of("beetle", site, opened, reduced_motion=motion)
    play = element.locator(".explorer-control.buttons button").first
    play.scroll_into_view_if_needed()
    for expected in (0, 20):
        play.click()
        if motion == "reduce":
            shown(element)
            assert element.evaluate("e => e.explorer.s.moment") == expected
    if motion == "no-preference":                       # the first press started it, the second stopped it
        assert element.evaluate("e => e.explorer.playing") is None
        play.click()
        page.wait_for_function("e => e.explorer.s.moment > 0.5 && e.explorer.s.moment < 15", arg=element.element_handle())
        assert play.inner_text() == "Berhenti"
        play.click()
    element.evaluate("e => e.explorer.reset()")
    assert trouble == []


def test_beetle_what_the_distance_cannot_show_and_the_bearing_can(site, opened):
    *_, element = explorer_of("beetle", site, opened, "en")
    left = {}
    for bearing in (False, True):
        set_state(element, bearing=bearing)
        left[bearing] = element.evaluate("e => [e.explorer.r.theta.share.at(-1), e.explorer.r.s.share.at(-1)]")
        assert ("The distance shows only s" in element.locator(".explorer-outcome").inner_text()) != bearing
    assert left[False][0] > 0.4 and left[False][1] < 0.1 and left[True][0] < 0.1
    element.evaluate("e => e.explorer.reset()")


@pytest.mark.parametrize("changes", [{}, {"sigma_w": 0.3, "sigma_v": 2.0, "T": 0.02, "duration": 5.0}])
def test_gyro_the_map_of_a_wrong_sigma_is_pythons(changes, site, opened):
    """Every cell of both maps; the chosen pair; and 500 runs of the page stay near it."""
    from kalman_lib.papers import gyro
    page, *_ = explorer_of("gyro", site, opened, "en")
    element = page.locator("kalman-explorer[view=mismatch]")
    set_state(element, **changes, times_w=3, times_v=0.25)
    page.wait_for_function("e => e.explorer.r.runs.count === 500 && !e.explorer.work", arg=element.element_handle())
    shown(element)
    ours = element.evaluate("""e => { const { cost, nees, best, wrong, runs } = e.explorer.r, places = [...Array(31).keys()].map(i => i - 15);
      return { best, wrong, runs: runs.count, cost: places.map(j => places.map(i => cost(i, j))), nees: places.map(j => places.map(i => nees(i, j))) }; }""")
    p, times = gyro.Params(**changes), 10 ** (np.arange(-15, 16) / 15)
    rmse_, nees_ = gyro.expected(p, times * p.sigma_w, times[:, np.newaxis] * p.sigma_v)
    assert np.allclose(np.array(ours["cost"]) * ours["best"], rmse_, rtol=RELATIVE) and np.allclose(ours["nees"], nees_, rtol=RELATIVE)
    wrong = gyro.expected(p, 3 * p.sigma_w, 0.25 * p.sigma_v)
    assert ours["wrong"] == pytest.approx(wrong, rel=RELATIVE) and ours["runs"] == 500
    said = [float(word) for word in re.findall(r"runs.*RMSE ([\d.]+) rad, NEES ([\d.]+)\.$", element.locator(".explorer-outcome").inner_text())[0]]
    assert said == [pytest.approx(expected, rel=0.03) for expected in wrong]
    element.evaluate("e => e.explorer.reset()")


# --- chapter 6: the attitude filter, which is not the general one ---------------------------------------------------

SAME_TEXT |= {f"{axis}{more}" for axis in ("roll", "pitch") for more in ("", " (°)", "z (°)", "true (°)")} | {"yawtrue (°)", "yawz (°)", "xtrue"}

ATTITUDE = """text => {
  const { quadrotor } = KalmanExplorers.papers, { flights, questions } = JSON.parse(text), list = values => Array.from(values, value => value === value ? value : null);
  const numbers = values => Float64Array.from(values, value => value ?? NaN), memos = {};
  const recordings = flights.map(({ rest_s, ...parts }) => ({ rest_s, ...Object.fromEntries(Object.entries(parts).map(([name, values]) => [name, numbers(values)])) }));
  return JSON.stringify(questions.map(({ flight, how, method }) => {
    const base = method ? quadrotor.METHODS[method] : {}, recording = recordings[flight];
    const { angles, z, u, s, y, P, R, dynamic } = quadrotor.attitude(recording, { ...base, ...how }, memos[flight + method] ??= {});
    return { angles: list(angles), z: list(z), u: list(u), s: list(s), y: list(y), P: list(P), R: list(R), dynamic: list(dynamic),
             galat: list(quadrotor.galat(recording.truth, angles)), rmse_deg: list(quadrotor.rmse_deg(recording.truth, angles)) };
  }));
}"""


@functools.cache
def recordings():
    """Name -> (sensors as `attitude` takes them, truth): a flight, its first 50 s with one sensor after the other switched off, or
    with gaps, and a fast swing."""
    from kalman_lib.papers import quadrotor
    flight = quadrotor.simulate(quadrotor.Params(), np.random.default_rng(6))
    t, gyr, acc, mag, truth = (part[:2500] for part in (flight.t, flight.gyr, flight.acc, flight.mag, flight.truth))
    nothing, holes = np.full_like(acc, np.nan), (acc.copy(), mag.copy())
    holes[0][2000:2100], holes[1][1000:1500] = np.nan, np.nan
    swing = quadrotor.swing(quadrotor.Params(dt=0.04), np.random.default_rng(1))
    return {"flight": (flight.sensors, flight.truth), "swing": (swing.sensors, swing.truth)} | {
        name: ((t, *sensors, quadrotor.REST), truth) for name, sensors in {
            "start": (gyr, acc, mag), "no gyr": (0 * gyr, acc, mag), "no acc": (gyr, nothing, mag), "no mag": (gyr, acc, nothing),
            "nothing": (gyr, nothing, nothing), "gaps": (gyr, *holes)}.items()}


def methods():
    """(recording, method, changes): the three methods on every recording, the ends of every slider, random settings, one correction
    left out."""
    table, rng = describe(importlib.import_module("kalman_lib.papers.quadrotor").Params), np.random.default_rng(7)
    sliders = ("m", "q", "window", "threshold")
    ends = [{slider: table[slider][end]} for slider in sliders for end in ("min", "max")]
    some = [{slider: value_in(table[slider], rng.uniform()) for slider in sliders} for _ in range(12)]
    yield from ((name, method, {}) for name in recordings() for method in ("literal", "paper", "adaptive"))
    yield from (("start", method, change) for change in ends + some for method in ("literal", "paper"))
    yield "start", "paper", {"m": 0.16, "threshold": 1, "window": 0.13}       # 6.5 steps: the half goes to the even number
    yield from (("start", "paper", {"without": [name]}) for name in ("midpoint", "rest mean", "rest variance", "wrapping"))


@pytest.mark.filterwarnings("ignore:The pitch reaches")
def test_the_attitude_filter_of_the_page_is_pythons(bundle):
    from kalman_lib.papers import quadrotor
    listed = lambda values: [None if value != value else value for value in np.ravel(values).tolist()]
    names, asked, theirs = list(recordings()), list(methods()), []
    questions = [{"flight": names.index(name), "method": method, "how": change | ({"q": change["q"] * quadrotor.DEG ** 2} if "q" in change else {})}
                 for name, method, change in asked]
    for (name, *_), question in zip(asked, questions):
        (t, gyr, acc, mag, rest_s), truth = recordings()[name]
        how = dataclasses.replace(quadrotor.METHODS[question["method"]], **question["how"])
        result = quadrotor.attitude(t, gyr, acc, mag, rest_s, how)
        theirs.append({key: getattr(result, key) for key in ("angles", "z", "u", "s", "y", "P", "R")} | {
            "dynamic": quadrotor.is_dynamic(t, mag, t - t[0] <= rest_s, how.window, how.threshold)[:, np.newaxis],
            "galat": quadrotor.galat(truth, result.angles)[np.newaxis], "rmse_deg": quadrotor.rmse_deg(truth, result.angles)[np.newaxis]})
    parts = dict(zip(("t", "gyr", "acc", "mag", "rest_s"), range(5)))
    flights = [{"truth": listed(truth)} | {part: listed(sensors[i]) if part != "rest_s" else sensors[i] for part, i in parts.items()}
               for sensors, truth in recordings().values()]
    found = []
    for (name, method, change), expected, answer in zip(asked, theirs, ask_in_parts(bundle, flights, questions)):
        for key, values in expected.items():
            got = np.array([np.nan if value is None else value for value in answer[key]], dtype=float).reshape(values.shape)
            angle = key in ("angles", "z", "y")
            if angle:                               # +180 and -180 degrees are the same, and Python's wrap rounds as pi does
                got = values + quadrotor.wrap(got - values)
            if trouble := close(got.ravel(), values, values.shape[1], SCALE if angle else 0):
                found.append(f"{name}, {method}, {change}, {key}: {trouble}")
    assert found[:5] == [] and len(asked) > 65


def ask_in_parts(page, flights, questions):
    """The answers of the page, a few at a time: one text of all would hold a hundred megabytes."""
    for start in range(0, len(questions), 6):
        some = questions[start:start + 6]
        used = sorted({question["flight"] for question in some})
        text = json.dumps({"flights": [flights[i] for i in used], "questions": [question | {"flight": used.index(question["flight"])} for question in some]})
        yield from json.loads(page.evaluate(ATTITUDE, text))


def test_the_sensors_alone_say_what_they_say_in_python(bundle):
    """tilt, printed_tilt, heading, euler_rates and wrap, at random vectors and angles beyond a whole turn."""
    from kalman_lib.papers import quadrotor
    rng = np.random.default_rng(3)
    v, angles = rng.normal(size=(200, 3)), rng.uniform(-8, 8, size=(200, 2))
    ours = bundle.evaluate("""([v, angles]) => {
      const { tilt, printed_tilt, heading, euler_rates, wrap } = KalmanExplorers.papers.quadrotor;
      return v.map((row, k) => [...tilt(...row), ...printed_tilt(...row), heading(...row, ...angles[k]), ...euler_rates(row, ...angles[k]), ...angles[k].map(wrap)]);
    }""", [v.tolist(), angles.tolist()])
    rates = [quadrotor.euler_rates(row, *angle) for row, angle in zip(v, angles)]
    theirs = np.column_stack([quadrotor.tilt(v), quadrotor.printed_tilt(v), quadrotor.heading(v, *angles.T), rates, quadrotor.wrap(angles)])
    assert close(np.ravel(ours), theirs, theirs.shape[1]) is None


def test_the_flight_of_the_page_is_flown_as_pythons(bundle):
    """Without noise both fly the same; with noise, sensors, NIS and the errors of the three methods agree over some flights."""
    from kalman_lib.papers import quadrotor
    calm = quadrotor.Params(sigma_gyr=0.01, sigma_acc=0.01, sigma_mag=0.01, bias=0, sway=0)
    ours = bundle.evaluate("""p => {
      const { simulate } = KalmanExplorers.papers.quadrotor, flight = simulate(p, KalmanExplorers.random.generator(1));
      return Object.fromEntries(["t", "truth", "x", "gyr", "acc", "z"].map(name => [name, Array.from(flight[name])]));
    }""", dataclasses.asdict(calm))
    flight = quadrotor.simulate(calm, np.random.default_rng(1))
    for name, values, tolerance in (("t", flight.t, 1e-9), ("truth", flight.truth, 1e-6), ("x", flight.x, 1e-6), ("gyr", flight.gyr, 2e-3), ("acc", flight.acc, 0.12)):
        off = np.reshape(ours[name], values.shape) - values
        assert np.abs(quadrotor.wrap(off) if name in ("truth", "x") else off).max() < tolerance, name
    numbers = bundle.evaluate("""p => Array.from({ length: 6 }, (_, seed) => {
      const { simulate, attitude, rmse_deg, run, METHODS } = KalmanExplorers.papers.quadrotor, { random, metrics } = KalmanExplorers;
      const flight = simulate(p, random.generator(seed)), result = run(p, flight);
      return [...["literal", "paper", "adaptive"].flatMap(name => rmse_deg(flight.truth, attitude(flight, METHODS[name]).angles).slice(0, 2)),
              ...rmse_deg(flight.truth, flight.z), metrics.mean(metrics.nis(result.y, result.S, 3))];
    })""", dataclasses.asdict(quadrotor.Params()))
    theirs = []
    for seed in range(6):
        flight = quadrotor.simulate(quadrotor.Params(), np.random.default_rng(seed))
        result = kalman_filter(quadrotor.model(quadrotor.Params()), flight.z, flight.u)
        theirs.append([*np.ravel([quadrotor.rmse_deg(flight.truth, quadrotor.estimate(*flight.sensors, name))[:2] for name in ("literal", "paper", "adaptive")]),
                       *quadrotor.rmse_deg(flight.truth, flight.z), nis(result.y, result.S).mean()])
    assert np.mean(numbers, axis=0) == pytest.approx(np.mean(theirs, axis=0), rel=0.25)
