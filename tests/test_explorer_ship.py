"""Chapter 4 in the page: the fit, and recordings of the reader."""

import dataclasses
import math
import re

import numpy as np
import pytest
from explorer_helpers import RELATIVE, SETS, pages_with_explorers, picture, set_state, shown

from kalman_lib import kalman_filter, rts_smooth
from kalman_lib.papers import ship


def run_of(site, opened, language):
    """(browser page, trouble, locator) of the view that takes recordings."""
    path = next(
        path
        for path in pages_with_explorers(site, language)
        if '<kalman-explorer paper="ship">' in path.read_text(encoding="utf-8")
    )
    page, trouble = opened(path)
    return page, trouble, page.locator('kalman-explorer[paper="ship"]:not([view])')


def test_ship_continues_two_speeds_as_one_does_by_hand(bundle):
    """0.9 and 1 m/s: 1.6 - 0.72, then a straight line, then the mean of both."""
    said = bundle.evaluate(
        """models => models.map(([a1, a2]) => {
          const { compute } = KalmanExplorers.papers.ship.views.poles;
          return Array.from(compute({ a1, a2 }).s.subarray(0, 5));
        })""",
        [[1.6, -0.8], [2, -1], [0.5, 0.5]],
    )
    expected = [
        [0.9, 1, 0.88, 0.608, 0.2688],
        [0.9, 1, 1.1, 1.2, 1.3],
        [0.9, 1, 0.95, 0.975, 0.9625],
    ]
    assert np.allclose(said, expected, rtol=1e-12)


def test_ship_a_pole_follows_the_pointer(bundle):
    """Above the real axis both move as mirror images; on it the nearer one moves alone."""
    drag = """([[x, y], [a1, a2]]) => {
      const { poles, views } = KalmanExplorers.papers.ship;
      const moved = views.poles.plots[0].drag(x, y, { a1, a2 }, { poles: poles(a1, a2) });
      return poles(moved.a1, moved.a2).flat();
    }"""
    above = bundle.evaluate(drag, [[0.3, -0.6], [1.6, -0.8]])
    assert np.allclose(above, [0.3, 0.6, 0.3, -0.6], atol=1e-12)
    beside = bundle.evaluate(drag, [[-0.4, 0.01], [1.4, -0.48]])  # poles at 0.8 and 0.6
    assert np.allclose(beside, [0.8, 0, -0.4, 0], atol=1e-12)
    landed = bundle.evaluate(drag, [[0.5, 0.01], [1.6, -0.8]])
    assert np.allclose(landed, [0.5, 0, 0.5, 0], atol=1e-6)


@pytest.mark.parametrize("real", [0.8, 0.3, 0, -0.4])
def test_ship_a_dragged_pole_tells_the_noise_that_moves_it_there(real, bundle):
    sigma = bundle.evaluate(
        """([x, s]) => {
          const { compute, plots } = KalmanExplorers.papers.ship.views.noise;
          return plots[0].drag(x, 0, s, compute(s, {})).sigma;
        }""",
        [real, {"sigma": 0.1, "seed": 2}],
    )
    still = ship.towing_run(np.random.default_rng(0), 0)[1].x[:, 0]
    pole = ship.poles(*ship.expected_fit(still, sigma)[1:])[1].real
    assert abs(pole - real) < 0.06  # between two points of the curve


def test_ship_the_fit_and_what_noise_does_to_it_as_in_python(bundle):
    rng = np.random.default_rng(4)
    still = ship.towing_run(rng, 0)[1].x[:, 0]
    sigmas = [0, 1e-3, 0.01, 0.1, 0.5]
    series = [still + sigma * rng.normal(size=len(still)) for sigma in sigmas] + [
        ship.simulate(ship.Params(), rng).z[:, 0] for _ in range(SETS)
    ]
    ours = bundle.evaluate(
        """([series, sigmas]) => {
      const { towing_run, fit, expected_fit, poles } = KalmanExplorers.papers.ship, { x,
        t } = towing_run(KalmanExplorers.random.generator(1), 0);
      const fits = series.map(z => Array.from(fit(Float64Array.from(z)))),
        expected = sigmas.map(sigma => Array.from(expected_fit(x, sigma)));
      return { x: Array.from(x), t: Array.from(t), fits, expected, poles: fits.map(([, a1, a2]) =>
        poles(a1, a2).flat()),
               none: [[1, 2, 3, 4, 5, 6], [2, 2, 2, 2, 2, 2, 2], [1, 2], [1, 2, 4, 8, 16,
                 32]].map(z => fit(Float64Array.from(z))) };
    }""",
        [[z.tolist() for z in series], sigmas],
    )
    assert np.allclose(ours["x"], still, rtol=1e-12, atol=1e-15) and np.allclose(
        ours["t"], 0.1 * np.arange(len(still))
    )
    for z, theta, pair in zip(series, ours["fits"], ours["poles"]):
        p = ship.fitted(z, ship.Params())
        assert np.allclose(theta, [p.c, p.a1, p.a2], rtol=RELATIVE, atol=0)
        assert np.allclose(
            np.reshape(pair, (2, 2)) @ [1, 1j], ship.poles(p.a1, p.a2), rtol=1e-7
        )  # a root of a small difference
    for sigma, theta in zip(sigmas, ours["expected"]):
        assert np.allclose(
            theta, ship.expected_fit(still, sigma), rtol=1e-8 if sigma == 0 else RELATIVE, atol=0
        )
    assert ours["none"] == [None] * 4


def test_ship_tells_uneven_sampling_with_the_words_of_python(bundle):
    times = [
        [0, 1, 2, 3, 4, 5],
        [0, 0.1, 0.2, 0.31, 0.4, 0.55],
        [3, 3.25, 3.5, 3.75, 9],
        [0, 1, 1, 2, 3],
        [0, 2, 1, 3, 4, 5],
        [0, 1, 2],
        [0, 1, math.nan, 3, 4, 5],
    ]
    said = bundle.evaluate(
        """times => times.map(t => {
      try { const { dt, uneven, en,
        id } = KalmanExplorers.papers.ship.sampling(Float64Array.from(t, v => v ?? NaN));
      return [dt, uneven, en, id]; }
      catch ({ en, id }) { return [`${en} / ${id}`]; } })""",
        [[None if value != value else value for value in t] for t in times],
    )
    for t, ours in zip(times, said):
        try:
            sampled = ship.sampling(t)
        except ValueError as error:
            assert ours == [str(error)]
        else:
            assert ours[0] == pytest.approx(sampled.dt, rel=1e-12) and ours[1:] == [
                sampled.uneven,
                sampled.en,
                sampled.id,
            ]


def own_run(rows=200):
    """The text of a recording in ms and km/h with decimal comma, and its (t, z) in s and m/s."""
    t, z = (
        50.0 * np.arange(rows),
        np.round(3.6 * ship.towing_run(np.random.default_rng(5))[1].z[:rows, 0], 3),
    )
    text = "waktu\tkecepatan\n" + "\n".join(
        f"{a:g}\t{b:.3f}".replace(".", ",") for a, b in zip(t, z)
    )
    return text, t / 1000, z / 3.6


@pytest.mark.parametrize("way", ["pasted", "file"])
@pytest.mark.parametrize("language", ["id", "en"])
def test_ship_filters_a_recording_of_the_reader_as_python_does(way, language, site, opened):
    page, _, element = run_of(site, opened, language)
    text, t, z = own_run()
    hand_over(text, way, page, element)
    element.locator("select").nth(0).select_option("ms")
    element.locator("select").nth(1).select_option("km/h")
    element.get_by_text({"id": "penghalus", "en": "smoother"}[language]).first.click()
    shown(element)
    assert not element.locator(".explorer-message").is_visible()
    p = dataclasses.replace(ship.fitted(z, ship.Params()), x0=z[0], P0=0.01)
    smooth = rts_smooth(kalman_filter(ship.model(p), z, np.ones(len(z))))
    r = element.evaluate(
        """e => {
          const { data, p, x, root } = e.explorer.r;
          const theta = [p.c, p.a1, p.a2];
          return { t: [...data.t], z: [...data.z], theta, x: [...x], root: [...root] };
        }"""
    )
    for name, theirs in {
        "t": t,
        "z": z,
        "theta": [p.c, p.a1, p.a2],
        "x": smooth.x[:, 0],
        "root": np.sqrt(smooth.P[:, 0, 0]),
    }.items():
        assert np.allclose(r[name], theirs, rtol=RELATIVE, atol=1e-12), name
    outcome = element.locator(".explorer-outcome").inner_text()
    assert getattr(ship.sampling(t), language) in outcome
    then_an_uneven_one_and_back(text, language, element)
    element.evaluate("e => e.explorer.reset()")


def hand_over(text, way, page, element):
    """Give the recording to the explorer: pasted, or as a file."""
    if way == "pasted":
        element.locator("textarea").fill(text)
    else:
        file = {"name": "kapal.csv", "mimeType": "text/csv", "buffer": text.encode()}
        element.locator("input[type=file]").set_input_files(file)
        is_read = "e => e.explorer.r.data.truth === null"
        page.wait_for_function(is_read, arg=element.element_handle())
    shown(element)


def then_an_uneven_one_and_back(text, language, element):
    uneven = text.replace("\n500\t", "\n510\t")
    element.locator("textarea").fill(uneven)
    shown(element)
    assert {"id": "tidak seragam", "en": "unevenly spaced"}[language] in element.locator(
        ".explorer-outcome"
    ).inner_text()
    element.get_by_role("button", name={"id": "Kembali", "en": "Back"}[language]).click()
    shown(element)
    assert (
        element.evaluate("e => e.explorer.r.data.truth !== null")
        and element.locator("textarea").input_value() == ""
    )


@pytest.mark.parametrize("language", ["id", "en"])
def test_ship_chooses_among_several_columns(language, site, opened):
    _, trouble, element = run_of(site, opened, language)
    t, run = ship.towing_run(np.random.default_rng(3))
    lines = [
        f"7;{a:.1f};{'' if k == 40 else f'{b:.4f}'}" for k, (a, b) in enumerate(zip(t, run.z[:, 0]))
    ]
    element.locator("textarea").fill("\n".join(["run;t;v", *lines]))
    message = element.locator(".explorer-message")
    message.wait_for(state="visible")  # the first two columns are the wrong ones
    time, speed = {"id": ("Kolom waktu", "Kolom kecepatan"), "en": ("Time column", "Speed column")}[
        language
    ]
    element.get_by_label(speed).select_option("v")
    element.get_by_label(time).select_option("t")
    shown(element)
    assert not message.is_visible()
    z = element.evaluate("e => Array.from(e.explorer.r.data.z)")
    expected = run.z[:, 0].round(4)
    assert np.isnan(z[40]) and np.allclose(np.delete(z, 40), np.delete(expected, 40))
    element.get_by_label(time).select_option("v")
    message.wait_for(state="visible")
    assert {"id": "berbeda", "en": "different"}[language] in message.inner_text()
    element.evaluate("e => e.explorer.reset()")
    shown(element)
    assert trouble == []


BAD_RECORDINGS = [
    "0 1\n1 2\n2 <img src=x onerror=alert(1)>",
    "<script>alert(1)</script>",
    "0;1\n1;2\n2;=cmd|' /C calc'!A0",
    "0 1\n1 1e308\n2 3\n3 1\n4 2\n5 1",
    "NaN",
    "1\n2\n3\n4\n5\n6",
    "0 1\n1 2\n1 3\n2 1\n3 2\n4 5",
    "0 1\n1 1\n2 1\n3 1\n4 1\n5 1",
    "0 1\n1 2\n2",
    "0 0\n1 1e7\n2 0\n3 5\n4 1\n5 2\n6 2",
    "0 1\n1 2e9\n2 3\n3 4\n4 5\n5 6\n6 1",
    "\n".join(f"{k} {k % 7}" for k in range(200_001)),
]


@pytest.mark.parametrize("language", ["id", "en"])
def test_ship_refuses_what_is_no_recording_in_one_sentence(language, site, opened):
    _, trouble, element = run_of(site, opened, language)
    shown(element)
    drawn = picture(element)
    message = element.locator(".explorer-message")
    for bad in BAD_RECORDINGS:
        set_state(element, text=bad)
        text = message.inner_text()
        assert (
            message.is_visible() and text.endswith(".") and len(text) < 250 and "\n" not in text
        ), (bad[:50], text)
        assert not re.search("failed|gagal|undefined", text), (bad[:50], text)
        assert picture(element) == drawn and message.locator("*").count() == 0, bad[:50]
    set_state(element, text=None)
    assert not message.is_visible()
    for name, content in {
        "kapal.xlsx": b"PK\x03\x04" + bytes(100),
        "foto.csv": bytes(range(256)),
        "empty.txt": b"",
    }.items():
        element.locator("input[type=file]").set_input_files({
            "name": name,
            "mimeType": "text/plain",
            "buffer": content,
        })
        message.wait_for(state="visible")
        shown(element)
        assert message.inner_text().endswith(".") and picture(element) == drawn, name
        set_state(element, file=None)
        message.wait_for(state="hidden")
    assert trouble == []
    element.evaluate("e => e.explorer.reset()")
