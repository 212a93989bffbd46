"""The exercises of a page in a browser: they answer, they remember, and everybody can use them."""

import conftest  # noqa: F401  (the build's own modules can be imported)
import pytest
from conftest import ROOT, listen
from exercise_cells import in_language, in_notebook
from explorer_helpers import PHONE
from page_helpers import LANGUAGES, built
from site_helpers import SIMPLIFY, violations

PAGE = "notebooks/02_smoother"
FOUND = in_notebook(ROOT / f"{PAGE}.ipynb")
SAID = {"id": ("Benar.", "Belum."), "en": ("Right.", "Not yet.")}


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    """The chapter in both languages, with the outputs that it stores."""
    return built(PAGE, tmp_path_factory.mktemp("chapter"))


@pytest.fixture(params=LANGUAGES)
def opened(request, pages, chromium):
    """(language, browser page, trouble) of the chapter on a phone that knows nothing yet."""
    context = chromium.new_context(viewport=PHONE, reduced_motion="reduce")
    page = context.new_page()
    trouble = listen(page)
    page.goto(pages[request.param].as_uri())
    yield request.param, page, trouble
    assert trouble == []
    context.close()


def exercise(page, number):
    return page.locator(f'.exercise[data-exercise="{number}"]')


def answer(page, number, value, language):
    """Give an answer as a reader does, a number with the decimal sign of the language."""
    element = exercise(page, number)
    fields = element.locator("input")
    if fields.first.get_attribute("type") == "radio":
        fields.nth(value).check()
        element.locator("button[type=submit]").click()
    else:
        typed = str(value).replace(".", ",") if language == "id" and value != str(value) else value
        fields.fill(str(typed))
        fields.press("Enter")
    return element.locator(".exercise-verdict")


def test_every_exercise_stands_below_its_question(opened):
    language, page, _ = opened
    numbers = page.locator(".exercise").evaluate_all("all => all.map(e => e.dataset.exercise)")
    assert numbers == [found.number for found in FOUND]
    for found in FOUND:
        element = exercise(page, found.number)
        name = {"id": "Latihan", "en": "Exercise"}[language]
        named = element.evaluate(
            "e => document.getElementById(e.getAttribute('aria-labelledby')).textContent"
        )
        assert named == f"{name} {found.number}."
        before = element.evaluate("e => e.previousElementSibling.textContent")
        assert before.startswith(named)
    names = page.evaluate("[...document.querySelectorAll('[id^=exercise-]')].map(e => e.id)")
    assert len(set(names)) == len(names) >= 3 * len(FOUND)
    assert page.locator(".tag_exercise, .tag_proof").count() == 0
    assert "assert " not in page.locator("section#exercises").inner_text()
    assert page.locator(".exercise-solution:visible").count() == 0


def test_right_answers_and_typical_mistakes(opened):
    language, page, _ = opened
    right, wrong = SAID[language]
    for found in FOUND:
        about = in_language(found.about, language)
        for place, mistake in enumerate(about["mistakes"]):
            verdict = answer(page, found.number, mistake["answer"], language)
            assert verdict.locator("b").inner_text().startswith(wrong.rstrip("."))
            assert verdict.locator("[data-hint]").get_attribute("data-hint") == str(place)
        verdict = answer(page, found.number, about["answer"], language)
        assert verdict.inner_text() == right
        assert exercise(page, found.number).locator("summary").is_visible()
        for other in about.get("accept", []):
            assert answer(page, found.number, other, language).inner_text() == right
    count = len(FOUND)
    assert f"{count} / {count}" in page.locator(".exercise-progress").inner_text()


def test_first_hint_second_hint_then_the_solution(opened):
    language, page, _ = opened
    solution = exercise(page, "2.2").locator(".exercise-solution")
    verdict = answer(page, "2.2", 55, language)
    assert verdict.locator("[data-hint]").get_attribute("data-hint") == "hint"
    assert not solution.is_visible()
    verdict = answer(page, "2.2", 55, language)
    assert verdict.locator("[data-hint]").get_attribute("data-hint") == "second"
    solution.locator("summary").click()
    assert solution.locator(".katex").first.is_visible()
    assert page.locator(".katex-error").count() == 0


def test_a_number_that_reads_in_two_ways_is_asked_about(opened):
    language, page, _ = opened
    verdict = answer(page, "2.6", "137.000", language)
    field = exercise(page, "2.6").locator("input")
    assert field.get_attribute("aria-invalid") == "true"
    buttons = verdict.locator("button")
    assert buttons.all_inner_texts() == ["137", "137000"]
    assert page.locator(".exercise-progress").inner_text().count("0 / ")
    buttons.first.click()
    assert verdict.inner_text() == SAID[language][0]
    assert field.get_attribute("aria-invalid") is None


@pytest.mark.parametrize("text", ["", "abc", "1,234.5", "<b>1</b>", "1/3"])
def test_what_is_no_number_is_told_right_below_and_not_counted(opened, text):
    language, page, _ = opened
    verdict = answer(page, "2.2", text, language)
    field = exercise(page, "2.2").locator("input")
    assert field.get_attribute("aria-invalid") == "true"
    assert f"{verdict.get_attribute('id')}" in field.get_attribute("aria-describedby")
    assert text in verdict.inner_text() and verdict.locator("b").count() == 0
    below = verdict.bounding_box()["y"] - field.bounding_box()["y"]
    assert 0 < below < 120
    field.press_sequentially("1")
    assert field.get_attribute("aria-invalid") is None
    assert page.locator(".exercise-progress button").is_hidden()


def go_until(page, address, progress):
    """Open the address; what another tab stored may reach this one a moment later."""
    for _ in range(50):
        page.goto(address)
        if progress in page.locator(".exercise-progress").inner_text():
            return
        page.wait_for_timeout(100)
    assert progress in page.locator(".exercise-progress").inner_text()


def test_the_progress_is_there_after_a_reload_and_in_the_other_language(opened, pages):
    """Another tab looks first, while the page that stored stays open: from file:// Chromium may end
    a page's process before it has handed over what was stored in its last moment."""
    language, page, _ = opened
    answer(page, "2.2", 0.27, language)
    answer(page, "2.4", 55, language)
    answer(page, "2.4", 56, language)
    answer(page, "2.3", 2, language)
    assert "2 / 6" in page.locator(".exercise-progress").inner_text()
    tab = page.context.new_page()
    trouble_of_tab = listen(tab)
    for path in pages.values():
        go_until(tab, path.as_uri(), "2 / 6")
        assert tab.locator(".exercise-tick").count() == 2
        assert exercise(tab, "2.2").locator("input").input_value() in ("0.27", "0,27")
        assert exercise(tab, "2.3").locator("input").nth(2).is_checked()
        assert exercise(tab, "2.4").locator("summary").is_visible()
        assert not exercise(tab, "2.1").locator("summary").is_visible()
    page.reload()
    assert "2 / 6" in page.locator(".exercise-progress").inner_text()
    page.locator(".exercise-progress button").click()
    assert "0 / 6" in page.locator(".exercise-progress").inner_text()
    assert page.evaluate("document.activeElement.className") == "exercise-progress"
    assert page.locator(".exercise-tick").count() == 0
    go_until(tab, page.url, "0 / 6")
    assert tab.locator(".exercise-tick").count() == 0
    assert tab.evaluate("Object.keys(localStorage).filter(key => /exercise/.test(key))") == []
    assert trouble_of_tab == []


def test_an_exercise_that_has_changed_forgets_the_old_answer(opened):
    language, page, _ = opened
    page.add_init_script(
        """localStorage.setItem('filter-kalman/exercise/2.2',
        JSON.stringify({ wrong: 0, value: 0.5, typed: '0.5' }));
        localStorage.setItem('filter-kalman/exercise/2.4', 'no JSON');"""
    )
    page.reload()
    assert "0 / 6" in page.locator(".exercise-progress").inner_text()
    assert answer(page, "2.4", 6.4, language).inner_text() == SAID[language][0]


# --- for everybody --------------------------------------------------------------------------------


def test_where_storage_is_switched_off_everything_else_works(pages, chromium):
    context = chromium.new_context(viewport=PHONE)
    context.add_init_script(
        "Object.defineProperty(window, 'localStorage', { get() { throw new Error('off'); } })"
    )
    page = context.new_page()
    trouble = listen(page)
    page.goto(pages["en"].as_uri())
    assert answer(page, "2.2", 0.27, "en").inner_text() == "Right."
    page.locator(".exercise-progress button").click()
    assert not [text for text in trouble if "exercise" in text]
    context.close()


def test_without_a_script_the_question_and_its_solution_are_there(pages, chromium):
    context = chromium.new_context(java_script_enabled=False, viewport=PHONE)
    page = context.new_page()
    page.goto(pages["id"].as_uri())
    element = exercise(page, "2.3")
    assert element.locator("fieldset label").count() == 4
    assert element.locator("fieldset label").first.is_visible()
    assert not element.locator("button").is_visible()
    element.locator("summary").click()
    assert element.locator(".exercise-worked").is_visible()
    assert not element.locator(".exercise-hints").is_visible()
    context.close()


def test_without_a_script_paper_has_the_solution_below_the_question(pages, chromium):
    context = chromium.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(pages["en"].as_uri())
    page.emulate_media(media="print")
    for found in FOUND:
        element = exercise(page, found.number)
        assert element.locator(".exercise-worked").is_visible()
        assert not element.locator("button").first.is_visible()
        assert not element.locator(".exercise-hints").is_visible()
    assert exercise(page, "2.3").locator("fieldset label").first.is_visible()
    context.close()


def test_with_one_the_solutions_are_a_sheet_behind_the_page(opened):
    _, page, _ = opened
    page.emulate_media(media="print")
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    sheet = page.locator("article > .exercise-sheet")
    assert sheet.is_visible() and sheet.locator(".exercise-worked").count() == len(FOUND)
    assert page.locator(".exercise .exercise-worked:visible").count() == 0
    assert exercise(page, "2.3").locator("fieldset label").first.is_visible()
    assert page.locator(".exercise button:visible, .exercise-hints:visible").count() == 0
    page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert sheet.count() == 0


def test_it_fits_a_phone_also_with_large_letters(opened):
    language, page, _ = opened
    for found in FOUND:
        answer(
            page,
            found.number,
            in_language(found.about, language)["mistakes"][0]["answer"],
            language,
        )
    for size in ("100%", "200%"):
        page.evaluate("size => { document.documentElement.style.fontSize = size }", size)
        edges = page.locator(".exercise").evaluate_all(
            "all => all.flatMap(e => [...e.querySelectorAll('input, button, p, label')]"
            ".filter(part => part.offsetParent).map(part => part.getBoundingClientRect().right))"
        )
        assert max(edges) <= PHONE["width"], size
        targets = page.locator(".exercise :is(button, label:has(input), input[type=text])")
        for box in targets.evaluate_all(
            "all => all.filter(e => e.offsetParent).map(e => e.getBoundingClientRect().height)"
        ):
            assert box >= 44


def test_it_is_accessible_in_both_themes(opened):
    language, page, trouble = opened
    answer(page, "2.2", "abc", language)
    answer(page, "2.4", 55, language)
    answer(page, "2.1", -0.4712, language)
    page.evaluate(SIMPLIFY)
    page.evaluate(
        "document.querySelectorAll('article section:not(#exercises):not(:has("
        "#exercises)), kalman-explorer').forEach(part => part.remove())"
    )
    for theme in ("light", "dark"):
        assert violations(page, page.viewport_size, theme) == [], theme
    trouble.clear()  # axe asks for the style sheets, which file:// refuses


def test_hints_and_solutions_are_not_searched(pages):
    index = (pages["en"].parent.parent / "searchindex.js").read_text(encoding="utf-8")
    (solution,) = (found.about["solution"]["en"] for found in FOUND if found.number == "2.3")
    assert "hundredfold" in solution and "hundredfold" not in index
    assert "aswan" in index  # of the text


def test_a_page_has_the_words_of_its_language(pages):
    for language, other in (("id", "en"), ("en", "id")):
        static = pages[language].parent.parent / "_static"
        script = (static / "vendor/exercises/exercises.js").read_text(encoding="utf-8")
        assert SAID[language][1] in script and SAID[other][1] not in script
        text = pages[language].read_text(encoding="utf-8")
        for found in FOUND:
            mine, theirs = (found.about["hint"][name].split("$")[0] for name in (language, other))
            assert mine in text and theirs not in text


def test_only_a_page_with_exercises_loads_them(pages):
    references = pages["en"].parent.parent / "book" / "references.html"
    assert "vendor/exercises" not in references.read_text(encoding="utf-8")
    assert pages["en"].read_text(encoding="utf-8").count("vendor/exercises/exercises.js") == 1
