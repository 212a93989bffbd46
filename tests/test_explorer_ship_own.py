"""Chapter 4 in the page: recordings of the reader's own."""

import dataclasses
import re

import numpy as np
import pytest
from explorer_helpers import RELATIVE, picture, set_state, shown
from test_explorer_ship import run_of

from kalman_lib import kalman_filter, rts_smooth
from kalman_lib.papers import ship


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
    choose_units(element, language, "ms", "km/h")
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


LABELS = {
    "id": ("Satuan waktu", "Satuan kecepatan", "Kolom waktu", "Kolom kecepatan"),
    "en": ("Unit of time", "Unit of speed", "Time column", "Speed column"),
}


def choose_units(element, language, time, speed):
    for label, unit in zip(LABELS[language], (time, speed)):
        element.get_by_label(label, exact=True).select_option(unit)


@pytest.mark.parametrize("language", ["id", "en"])
def test_ship_takes_columns_and_units_from_the_header(language, site, opened):
    """Neither the number of the row nor anything else is the time; units are in the header."""
    _, trouble, element = run_of(site, opened, language)
    _, t, z = own_run(60)
    rows = [f"{k};{1000 * a:g};{k % 5};{3.6 * b:.4f}" for k, (a, b) in enumerate(zip(t, z), 1)]
    head = "Logger 7\n\nNo;t (ms);suhu;v (km/h)\n"
    element.locator("textarea").fill(head + "\n".join(rows).replace(".", ","))
    shown(element)
    r = element.evaluate("e => [[...e.explorer.r.data.t], [...e.explorer.r.data.z]]")
    np.testing.assert_allclose(r[0], t - t[0], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(r[1], z, atol=1e-4)
    outcome = element.locator(".explorer-outcome").inner_text()
    words = {"id": ("kolom t (ms)", "kolom v (km/h)"), "en": ("column t (ms)", "column v (km/h)")}
    assert all(word in outcome for word in words[language])
    element.locator("textarea").fill(
        "jam;v\n" + "\n".join(f"10:00:{k // 2:02d};{z[k]:.4f}" for k in range(60))
    )
    shown(element)
    r = element.evaluate("e => [[...e.explorer.r.data.t], [...e.explorer.r.data.z]]")
    np.testing.assert_allclose(r[0], np.arange(30))  # equal times were averaged
    np.testing.assert_allclose(r[1], z.round(4).reshape(-1, 2).mean(axis=1))
    element.evaluate("e => e.explorer.reset()")
    shown(element)
    assert trouble == []


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
    element.locator("textarea").fill("\n".join(["run;a;b", *lines]))
    message = element.locator(".explorer-message")
    message.wait_for(state="visible")  # no name tells which column is which
    _, _, time, speed = LABELS[language]
    element.get_by_label(speed).select_option("b")
    element.get_by_label(time).select_option("a")
    shown(element)
    assert not message.is_visible()
    z = element.evaluate("e => Array.from(e.explorer.r.data.z)")
    expected = run.z[:, 0].round(4)
    assert np.isnan(z[40]) and np.allclose(np.delete(z, 40), np.delete(expected, 40))
    element.get_by_label(time).select_option("b")
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
