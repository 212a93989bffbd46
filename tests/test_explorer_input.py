"""What readers type into the explorers: addresses, numbers, answers. Nothing of it can harm."""

import pytest
from explorer_helpers import explorers, live, pages_with_explorers, picture, shown

# The explorer that belongs to a key of the address
WITH_KEY = (
    """[...document.querySelectorAll('kalman-explorer')].find(e => e.explorer?.key === key)"""
)


# --- the address, and bad input -----------------------------------------------------------------


def test_the_address_keeps_the_settings(site, opened, server, chromium):
    for name, page, _, element in explorers(site, opened):
        slider = element.locator("input[type=range]:visible:not(:disabled)").last
        slider.focus()
        page.keyboard.press("End")
        shown(element)
        state, key = element.evaluate("e => [e.explorer.s, e.explorer.key]")
        address = page.url
        assert f"#{key}:" in address, name
        other = page.context.new_page()
        other.goto(address)
        assert (
            other.evaluate(
                f"key => {WITH_KEY}.explorer.s",
                key,
            )
            == state
        )
        other.wait_for_function(
            f"""key => {{
              const {{ top }} = {WITH_KEY}.getBoundingClientRect();
              return top > -5 && top < 300;
            }}""",
            arg=key,
        )
        section = other.evaluate("document.querySelector('article section section').id")
        other.evaluate("id => { location.hash = id }", section)  # an ordinary anchor still works
        assert other.url.endswith(f"#{section}")
        other.close()
        element.evaluate("e => e.explorer.reset()")
        assert f"{key}:" not in page.url


@pytest.mark.parametrize("language", ["id", "en"])
@pytest.mark.parametrize(
    "bad",
    [
        "seed=<img src=x onerror=alert(1)>",
        "<script>alert(1)</script>=1",
        "seed==cmd|' /C calc'!A0",
        "seed=1e308",
        "seed=NaN",
        "seed=",
        "nothing=1",
        "seed=-5",
        "%E0%A4%A",
        "__proto__=1",
        "seed=" + "9" * 5000,
    ],
)
def test_a_bad_address_is_refused_in_one_sentence(language, bad, site, opened):
    page, trouble = opened(pages_with_explorers(site, language)[0])
    element = live(page)[0]
    shown(element)
    key, before = element.evaluate("e => [e.explorer.key, e.explorer.s]")
    drawn = picture(element)
    page.evaluate("text => { location.hash = text }", f"{key}:{bad}")
    message = element.locator(".explorer-message")
    message.wait_for(state="visible")
    text = message.inner_text()
    assert len(text) < 250 and text.endswith(".") and text.count("\n") == 0
    assert ("diterima" in text or "alamat" in text) == (language == "id")
    assert element.evaluate("e => e.explorer.s") == before and picture(element) == drawn
    assert message.locator("*").count() == 0 and trouble == []
    element.evaluate("e => e.explorer.reset()")
    message.wait_for(state="hidden")
    assert f"{key}:" not in page.url


def test_bad_numbers_are_refused_and_the_picture_stays(site, opened):
    for name, _, _, element in explorers(site, opened):
        field = element.locator(
            ".explorer-control:visible input.explorer-value:not(:disabled)"
        ).last
        element.evaluate(
            "async e => { e.explorer.draw(true); await e.explorer.painted(); }"
        )  # those out of sight, too
        good, drawn = field.input_value(), picture(element)
        for bad in ("abc", "<b>1</b>", "=1+1", "1e308", "NaN", "", "1,2,3"):
            field.fill(bad)
            field.press("Enter")
            message = element.locator(".explorer-message")
            message.wait_for(state="visible")
            assert (
                bad in message.inner_text() or "diterima" in message.inner_text()
            ) and message.locator("*").count() == 0, (name, bad)
            assert picture(element) == drawn
        field.fill(good)
        field.press("Enter")
        message.wait_for(state="hidden")


# --- the hand check -----------------------------------------------------------------------------


@pytest.mark.parametrize("language", ["id", "en"])
def test_the_hand_check(language, site, opened):
    for name, page, _, element in explorers(site, opened, language):
        if not element.evaluate("e => e.explorer.view.question !== undefined"):
            continue  # a view to play with asks nothing
        page.wait_for_function(
            "e => e.querySelector('.explorer-question').textContent", arg=element.element_handle()
        )
        asked = element.evaluate("""async e => {
          const form = e.querySelector('form'), verdict = form.querySelector('.explorer-verdict'),
            field = form.querySelector('input'), asked = [];
          const say = text => { field.value = text; form.requestSubmit();
          return [verdict.className, verdict.textContent, verdict.querySelectorAll('b').length]; };
          for (let i = 0; i < 12; i++) {
            const { answer } = e.explorer.question;
            asked.push([form.querySelector('.explorer-question').textContent,
              say(answer.toPrecision(6).replace('.', ',')),
              say((3 * Math.abs(answer) + 7).toPrecision(6)), say('<b>x</b>')]);
            [...form.querySelectorAll('button[type=button]')].at(-1).click();  // another question
            await new Promise(done => setTimeout(done));
          }
          return asked;
        }""")
        for question, right, wrong, typed in asked:
            assert right[0].endswith("right"), (name, question, right)
            not_yet = {"id": "Belum. ", "en": "Not yet. "}[language]
            assert wrong[0].endswith("wrong") and wrong[1].startswith(not_yet), (name, wrong)
            assert len(wrong[1]) > len(not_yet) + 5 and "{" not in wrong[1] + question, name
            assert typed[0].endswith("wrong") and "<b>x</b>" in typed[1] and typed[2] == 0
        questions = [question for question, *_ in asked]
        assert all(a != b for a, b in zip(questions, questions[1:])), f"{name}: asked twice"
        assert len(set(questions)) >= 3, name
