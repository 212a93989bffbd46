"""The hand check of an explorer: not yet, a hint, then the answer; never one question twice."""

import conftest  # noqa: F401  (the build's own modules can be imported)
import pytest
from conftest import listen
from explorer_helpers import PHONE
from page_helpers import LANGUAGES, built

NOT_YET = {"id": "Belum. ", "en": "Not yet. "}
ANSWER = {"id": "Jawabannya ", "en": "The answer is "}


@pytest.fixture(scope="module")
def pages(tmp_path_factory):
    return built("notebooks/02_smoother", tmp_path_factory.mktemp("page"))


@pytest.fixture(params=LANGUAGES)
def asked(request, pages, chromium):
    """(language, the form of the page, which has asked its question)"""
    page = chromium.new_page(viewport=PHONE, reduced_motion="reduce")
    trouble = listen(page)
    page.goto(pages[request.param].as_uri())
    element = page.locator("kalman-explorer:not([view])").first
    page.wait_for_function(
        "e => e.querySelector('.explorer-question')?.textContent", arg=element.element_handle()
    )
    yield request.param, element
    assert trouble == []
    page.close()


def answer(element, text):
    element.locator(".explorer-check input").fill(text)
    element.locator(".explorer-check input").press("Enter")
    return element.locator(".explorer-verdict").inner_text()


def reveal(element):
    return element.locator(".explorer-check button[type=button]").first


def test_the_answer_is_shown_after_two_wrong_ones(asked):
    language, element = asked
    field = element.locator(".explorer-check input")
    assert not reveal(element).is_visible()
    assert answer(element, "12345").startswith(NOT_YET[language])
    assert not reveal(element).is_visible()
    assert "abc" in answer(element, "abc")
    assert field.get_attribute("aria-invalid") == "true" and not reveal(element).is_visible()
    assert answer(element, "12345").startswith(NOT_YET[language])
    assert field.get_attribute("aria-invalid") is None
    reveal(element).click()
    value = element.evaluate("e => e.explorer.t.decimal(e.explorer.question.answer, 4)")
    told = element.locator(".explorer-verdict").inner_text()
    assert told.startswith(f"{ANSWER[language]}{value}. ") and "{" not in told
    assert not reveal(element).is_visible()


def test_no_question_follows_itself_and_each_begins_anew(asked):
    _, element = asked
    for _ in range(2):
        answer(element, "12345")
    assert reveal(element).is_visible()
    questions = [element.locator(".explorer-question").inner_text()]
    for _ in range(20):
        element.locator(".explorer-check button[type=button]").last.click()
        questions.append(element.locator(".explorer-question").inner_text())
        assert not reveal(element).is_visible()
        assert element.locator(".explorer-verdict").inner_text() == ""
    assert all(a != b for a, b in zip(questions, questions[1:]))
