"""Chapter 2 in the page: the online filter, one measurement at a time."""

import re

import numpy as np
import pytest
from explorer_helpers import estimates, picture, shown

from kalman_lib.papers import smoother

nan = np.nan


WORDS = {
    "clear": {"id": "Kosongkan", "en": "Clear"},
    "none": {"id": "Belum ada pengukuran", "en": "No measurement yet"},
    "field": {"id": "Pengukuran baru", "en": "New measurement"},
    "add": {"id": "Tambahkan", "en": "Add"},
    "silent": {"id": "Tidak datang", "en": "It does not arrive"},
    "was silent": {"id": "tidak datang", "en": "did not arrive"},
    "drop": {"id": "Buang yang terakhir", "en": "Drop the last one"},
}


@pytest.mark.parametrize("language", ["id", "en"])
def test_the_online_view(language, opened, site):
    page, trouble = opened(site / language / "notebooks" / "02_smoother.html")
    element = page.locator("kalman-explorer[view=online]")
    word = {name: words[language] for name, words in WORDS.items()}
    assert element.evaluate("e => e.explorer.key") == "smoother.online"
    click(element, word["clear"])
    assert word["none"] in outcome(element)
    field = element.get_by_label(word["field"])
    z = type_numbers(element, field, element.get_by_role("button", name=word["add"]))
    click(element, word["silent"])
    p = smoother.Params(Q=1e-3, R=0.09, P0=1000)
    x, *_ = smoother.scalar_filter(np.array([*z, nan]), p)
    np.testing.assert_allclose(estimates(element), x, rtol=1e-12)
    assert word["was silent"] in outcome(element)
    refuse_bad_numbers(element, field)
    click(element, word["drop"])
    assert len(estimates(element)) == 3 and trouble == []
    assert re.search(r"K\s*=", element.locator(".explorer-equations").inner_text())
    element.evaluate("e => e.explorer.reset()")


def click(element, name):
    element.get_by_role("button", name=name).click()
    shown(element)


def outcome(element):
    return element.locator(".explorer-outcome").inner_text()


def type_numbers(element, field, button):
    """Three measurements, with Enter and with the button -> their values."""
    z = []
    for text, value in (("25,5", 25.5), ("26.5", 26.5), ("\u22121e1", -10)):
        field.fill(text)
        if len(z) % 2:
            button.click()
        else:
            field.press("Enter")
        shown(element)
        z.append(value)
        assert field.input_value() == ""
    return z


def refuse_bad_numbers(element, field):
    before = picture(element)
    for bad in ("", "abc", "<b>1</b>", "=1+1", "1e999", "NaN"):
        field.fill(bad)
        field.press("Enter")
        message = element.locator(".explorer-message")
        message.wait_for(state="visible")
        assert bad in message.inner_text() and message.locator("*").count() == 0
        assert picture(element) == before
