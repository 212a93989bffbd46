"""Chapter 6 in the page: recordings of phone apps are opened as Jupyter's kernel opens them."""

import numpy as np
import pytest
from conftest import listen
from explorer_helpers import shown
from recording_files import TILTED, own, phyphox, sensor_logger, zipped

from kalman_lib.data import read_recording, rest_seconds
from kalman_lib.papers import quadrotor

PAGE = """<!doctype html><html lang="{language}"><meta charset="utf-8"><title>.</title>
<meta name="viewport" content="width=device-width">
<link rel="icon" href="data:,"><link rel="stylesheet" href="core.css">
<script defer src="core.js"></script><script defer src="quadrotor.js"></script>
<body class="bd-article"><kalman-explorer paper="quadrotor"></kalman-explorer>"""
WORDS = {
    "id": dict(axes="Sumbu alat", back="Kembali ke penerbangan sintetis", flu="depan-kiri-atas"),
    "en": dict(axes="Axes of the device", back="Back to the synthetic flight", flu="forward-left"),
}
READ = """e => {
  const { t, gyr, acc, mag, truth, rest_s } = e.explorer.r.flight;
  const list = values => Array.from(values, v => Number.isNaN(v) ? null : v);
  const { angles } = e.explorer.r.result;
  return [...[t, gyr, acc, mag, truth].map(list), [rest_s], Array.from(angles)];
}"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    import explorers

    made = tmp_path_factory.mktemp("pages")
    for language in WORDS:
        explorers.bundle(made / language, language)
        (made / language / "page.html").write_text(PAGE.format(language=language), encoding="utf-8")
    return made


@pytest.fixture(params=WORDS)
def flight(request, folder, chromium):
    context = chromium.new_context(viewport={"width": 390, "height": 844}, reduced_motion="reduce")
    page = context.new_page()
    trouble = listen(page)
    page.goto((folder / request.param / "page.html").as_uri())
    element = page.locator("kalman-explorer")
    shown(element)
    element.words = WORDS[request.param]
    element.language = request.param
    yield element
    assert trouble == []
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    context.close()


def choose(element, files):
    chosen = [{"name": name, "mimeType": "", "buffer": data} for name, data in files.items()]
    element.locator("input[type=file]").set_input_files(chosen)


def wait(element, script, argument=None):
    page = element.page
    page.wait_for_function(f"([e, value]) => {script}", arg=[element.element_handle(), argument])
    shown(element)


def same(element, files, axes=None):
    """What the page shows is what Python reads and filters, to 1e-9."""
    found = read_recording(files, axes)
    rest = rest_seconds(found)
    method = quadrotor.METHODS["paper"]
    result = quadrotor.attitude(found.t, found.gyr, found.acc, found.mag, rest, method)
    *arrays, rest_s, angles = [np.array(values, dtype=float) for values in element.evaluate(READ)]
    expected = (found.t, found.gyr, found.acc, found.mag, found.reference)
    for ours, theirs in zip(arrays, expected):
        if theirs is None:
            assert np.isnan(ours).all()
        else:
            np.testing.assert_allclose(ours, np.ravel(theirs), rtol=1e-9, atol=1e-9)
    assert rest_s[0] == pytest.approx(rest, abs=1e-9)
    apart = quadrotor.wrap(angles.reshape(-1, 3) - result.angles)
    assert np.abs(apart).max() < 1e-9


@pytest.mark.parametrize("kind", ["phyphox", "phyphox.zip", "logger.zip", "plain"])
def test_a_recording_of_each_app(kind, flight):
    files = {
        "phyphox": phyphox(TILTED),
        "phyphox.zip": {"run.zip": zipped(phyphox(TILTED, "id"))},
        "logger.zip": {"run.zip": zipped(sensor_logger(TILTED)[0])},
        "plain": own(),
    }[kind]
    choose(flight, files)
    wait(flight, "e.explorer.s.recording")
    same(flight, files)
    note = read_recording(files).notes[-1][flight.language]
    assert note in flight.locator(".explorer-outcome").inner_text()


def test_other_axes_and_the_way_back(flight):
    files = own()
    choose(flight, files)
    wait(flight, "e.explorer.s.recording")
    flight.get_by_label(flight.words["axes"]).select_option("flu")
    flight.locator(".explorer-outcome", has_text=flight.words["flu"]).wait_for()
    same(flight, files, "flu")
    flight.get_by_role("button", name=flight.words["back"]).click()
    wait(flight, "e.explorer.s.recording === null")
    assert flight.get_by_label(flight.words["axes"]).is_hidden()


def test_what_cannot_be_read_is_one_sentence_and_the_figure_stays(flight):
    message = flight.locator(".explorer-message")
    before = flight.evaluate("e => Array.from(e.explorer.r.result.angles.slice(0, 9))")
    for files in (
        {"phone.csv": b"Time (s);Gyroscope x (rad/s)\n0;1\n"},
        {"phone.xls": b"\xd0\xcf\x11\xe0" * 50},
        {"phone.zip": b"PK\x03\x04" + b"\0" * 50},
        own(cells={(5, 4): "x"}),
    ):
        with pytest.raises(ValueError) as refused:
            read_recording(files)
        choose(flight, files)
        sentence = getattr(refused.value, flight.language)
        message.get_by_text(sentence, exact=True).wait_for()
    assert flight.evaluate("e => Array.from(e.explorer.r.result.angles.slice(0, 9))") == before
    choose(flight, own())
    wait(flight, "e.explorer.s.recording")
    assert message.is_hidden()
