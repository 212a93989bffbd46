"""Chapter 2 in the page: the online filter, one measurement at a time."""

import re

import numpy as np
import pytest
from explorer_helpers import estimates, picture, shown

from kalman_lib.papers import smoother

nan = np.nan


@pytest.mark.parametrize("language", ["id", "en"])
def test_the_online_view(language, opened, site):
    page, trouble = opened(site / language / "notebooks" / "02_smoother.html")
    element = page.locator("kalman-explorer[view=online]")
    assert element.evaluate("e => e.explorer.key") == "smoother.online"
    element.get_by_role("button", name={"id": "Kosongkan", "en": "Clear"}[language]).click()
    shown(element)
    assert {"id": "Belum ada pengukuran", "en": "No measurement yet"}[language] in element.locator(
        ".explorer-outcome"
    ).inner_text()
    field, button = (
        element.get_by_label({"id": "Pengukuran baru", "en": "New measurement"}[language]),
        element.get_by_role("button", name={"id": "Tambahkan", "en": "Add"}[language]),
    )
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
    element.get_by_role(
        "button", name={"id": "Tidak datang", "en": "It does not arrive"}[language]
    ).click()
    shown(element)
    p = smoother.Params(Q=1e-3, R=0.09, P0=1000)
    np.testing.assert_allclose(
        estimates(element), smoother.scalar_filter(np.array([*z, nan]), p)[0], rtol=1e-12
    )
    assert {"id": "tidak datang", "en": "did not arrive"}[language] in element.locator(
        ".explorer-outcome"
    ).inner_text()
    before = picture(element)
    for bad in ("", "abc", "<b>1</b>", "=1+1", "1e999", "NaN"):
        field.fill(bad)
        field.press("Enter")
        message = element.locator(".explorer-message")
        message.wait_for(state="visible")
        assert (
            bad in message.inner_text()
            and message.locator("*").count() == 0
            and picture(element) == before
        )
    element.get_by_role(
        "button", name={"id": "Buang yang terakhir", "en": "Drop the last one"}[language]
    ).click()
    shown(element)
    assert len(estimates(element)) == 3 and trouble == []
    assert re.search(r"K\s*=", element.locator(".explorer-equations").inner_text())
    element.evaluate("e => e.explorer.reset()")
