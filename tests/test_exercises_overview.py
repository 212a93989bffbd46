"""The page that lists all exercises for lecturers."""

import conftest  # noqa: F401  (the build's own modules can be imported)
from exercise_cells import everywhere
from explorer_helpers import PHONE
from page_helpers import built


def test_lecturers_find_every_exercise_with_its_answers(chromium, tmp_path):
    page = chromium.new_page(viewport=PHONE)
    page.goto(built("book/exercises", tmp_path, ["id"])["id"].as_uri())
    everything = page.locator("article").inner_text()
    links = page.locator(".exercise-overview td:first-child a")
    assert links.all_inner_texts() == [found.number for found in everywhere()]
    address = links.first.get_attribute("href")
    assert address.startswith("../notebooks/") and "#exercise-" in address
    rows = page.locator(".exercise-overview tbody > tr")
    for row, found in zip(rows.all(), everywhere()):
        mistakes = row.locator("td").nth(3).locator("li")
        assert mistakes.count() == len(found.about["mistakes"])
        if found.about["kind"] == "code":
            assert found.about["answer"] in row.inner_text()
    assert "−0,4712 ± 0,00005" in everything and "137 ± 0,5 (10⁸ m³)" in everything
    assert page.locator("script[src*='vendor/exercises']").count() == 0
    assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
    page.close()
