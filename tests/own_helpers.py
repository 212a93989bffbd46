"""The form of chapter 2, with data of the reader's own."""

from explorer_helpers import shown

from kalman_lib.papers import smoother


def from_the_first(z):
    """What the form shows of the reader's own z: the first value starts the filter, and counts
    once."""
    R = smoother.Params().R
    return smoother.scalar_filter(z, smoother.Params(x0=z[0], P0=1e6 * R))


def form_in(language, opened, site):
    """Yields (browser page, the form, language); what happens to it is undone at the end."""
    page, trouble = opened(site / language / "notebooks" / "02_smoother.html")
    element = page.locator("kalman-explorer:not([view])").first
    yield page, element, language
    element.evaluate("e => e.explorer.reset()")
    shown(element)
    assert trouble == [], "; ".join(map(str, trouble))
    assert not element.locator(".explorer-message").is_visible()
