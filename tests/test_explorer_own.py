"""Data of the reader's own in the page: sheets, codes for missing, where it starts, files."""

import numpy as np
import pytest
from explorer_helpers import estimates, paste, set_state, shown
from own_helpers import form_in, from_the_first
from workbook_helpers import xlsx


@pytest.fixture(params=["id", "en"])
def form(request, opened, site):
    yield from form_in(request.param, opened, site)


def choose(element, name, content):
    file = {"name": name, "mimeType": "", "buffer": content}
    element.locator("input[type=file]").set_input_files(file)


def shows(element, *z):
    """Wait until these are the measurements that the explorer shows."""
    element.page.wait_for_function(
        "([e, z]) => JSON.stringify([...e.explorer.r.z]) === JSON.stringify(z)",
        arg=[element.element_handle(), list(z)],
    )


def test_a_workbook_is_read_in_the_page_and_its_sheet_chosen(form):
    _, element, language = form
    data = [["Waktu", "Suhu (°C)"], *([k, 20.5 + k] for k in range(4))]
    choose(element, "a.xlsx", xlsx([["Info"], [2026]], data, [["v"], [7], [8], [9]]))
    shows(element, 20.5, 21.5, 22.5, 23.5)
    outcome = element.locator(".explorer-outcome")
    for word in {"id": ("lembar: Data 2", "°C"), "en": ("sheet: Data 2", "°C")}[language]:
        assert word in outcome.inner_text()
    sheet = element.get_by_label({"id": "Lembar", "en": "Sheet"}[language], exact=True)
    sheet.select_option("Data 3")
    shows(element, 7, 8, 9)


def test_codes_for_missing_are_told_and_can_be_kept(form):
    _, element, language = form
    paste(element, "v\n21\n-999\n22\n21")
    shows(element, 21, None, 22, 21)
    assert "-999 (1x)" in element.locator(".explorer-outcome").inner_text()
    label = {"id": "Bilangan yang berarti kosong", "en": "Numbers that mean missing"}[language]
    element.get_by_label(label, exact=True).select_option("none")
    shows(element, 21, -999, 22, 21)
    set_state(element, missing="auto")
    other = {"id": "Bilangan lain", "en": "Other numbers"}[language]
    element.get_by_label(other).fill("22; −999")
    element.get_by_label(other).press("Enter")
    shows(element, 21, None, None, 21)


def test_own_data_start_at_the_first_measurement(form):
    _, element, language = form
    paste(element, "p\n1000010\n1000012\n1000011")
    x = estimates(element)
    np.testing.assert_allclose(x, from_the_first(np.array([1000010.0, 1000012, 1000011]))[0])
    assert x[0] == 1000010
    words = {"id": "mulai dari pengukuran pertama", "en": "starts at the first measurement"}[
        language
    ]
    assert words in element.locator(".explorer-outcome").inner_text()
    label = {"id": "mulai dari pengukuran pertama", "en": "start at the first measurement"}[
        language
    ]
    element.get_by_label(label).uncheck()
    shown(element)
    assert estimates(element)[0] != 1000010


def test_a_corrected_file_can_be_chosen_again(form, tmp_path):
    page, element, _ = form
    path = tmp_path / "a.csv"
    for content, z in (("v\n1\n2\n3", (1, 2, 3)), ("v\n1\n2\n4", (1, 2, 4))):
        path.write_text(content)
        with page.expect_file_chooser() as chooser:
            element.locator("input[type=file]").click()
        chooser.value.set_files(path)
        shows(element, *z)


def test_a_file_that_the_browser_cannot_read_is_told(form):
    _, element, language = form
    element.evaluate("""e => {
      const gone = new File(["1"], "gone.csv");
      gone.arrayBuffer = async () => { throw new DOMException("gone", "NotFoundError"); };
      const drop = new Event("drop", { bubbles: true, cancelable: true });
      drop.dataTransfer = { files: [gone] };
      e.querySelector("input[type=file]").dispatchEvent(drop);
    }""")
    words = {"id": "tidak dapat dibaca", "en": "cannot read"}[language]
    element.locator(".explorer-message").filter(has_text=words).wait_for()


# --- numbers in fields ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text, language, value",
    [
        ("100.000", "en", 100),
        ("100,000", "id", 100),
        ("100.000", "id", ("dapat berarti 100000 atau 100,000", "may mean 100000 or 100,000")),
        ("1,000", "en", ("dapat berarti 1000 atau 1.000", "may mean 1000 or 1.000")),
        ("0.125", "id", 0.125),
        ("1.5", "id", 1.5),
        ("1.000.000", "id", 1e6),
        ("1.234,5", "id", 1234.5),
        ("1,234.5", "en", 1234.5),
        ("10 000", "id", 1e4),
        ("1\u00a0234,5", "en", 1234.5),
        ("\u22122,5", "en", -2.5),
        ("1,2,3", "id", ("bukan bilangan", "is not a number")),
        ("9" * 30000 + "x", "id", ("bukan bilangan", "is not a number")),
    ],
)
def test_a_thousand_in_a_field_is_known_or_asked_about(text, language, value, bundle):
    answer = bundle.evaluate(
        """([text, language]) => {
          try { return KalmanExplorers.input.number(text, language); }
          catch ({ id, en }) { return [id, en]; }
        }""",
        [text, language],
    )
    if isinstance(value, tuple):
        assert all(part in said for part, said in zip(value, answer))
    else:
        assert answer == value
