"""Every live explorer of the built book: usable by everyone, and nothing a reader types can harm.

Explorers are found in the built pages; none is listed here.
"""

import re

import pytest
from conftest import ROOT
from explorer_helpers import (
    PAPERS,
    PHONE,
    PICTURE,
    explorers,
    pages_with_explorers,
    shown,
)

NUMBERS = "details.explorer-numbers"

# Texts that are the same in both languages on purpose
SAME_TEXT = {"optimum (rad)", "sensor", "filter ± 2σ", "filter, x"}
SAME_TEXT |= {
    f"{axis}{more}" for axis in ("roll", "pitch") for more in ("", " (°)", "z (°)", "true (°)")
} | {"yawtrue (°)", "yawz (°)", "xtrue"}


@pytest.mark.parametrize("scheme", ["http", "file"])
@pytest.mark.parametrize("language", ["id", "en"])
def test_every_explorer_lives_without_an_error(scheme, language, site, server, opened):
    base, seen = {"http": server, "file": site.as_uri()}[scheme], set()
    for path in pages_with_explorers(site, language):
        page, trouble = opened(path, base=base)
        for element in page.locator("kalman-explorer").all():
            paper = element.get_attribute("paper")
            alive = element.evaluate(
                "e => e.explorer?.r !== undefined && e.explorer.message.hidden"
            )
            assert alive, paper
            assert element.locator("> img").is_visible() != alive
            seen.add(paper)
        assert trouble == [], path
    assert seen == set(PAPERS)


def test_without_a_script_the_picture_stays(site, server, chromium):
    context = chromium.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(f"{server}/{pages_with_explorers(site, 'id')[0].relative_to(site).as_posix()}")
    assert page.locator("kalman-explorer > img").first.is_visible()
    context.close()


# --- everyone -----------------------------------------------------------------------------------


def test_every_slider_moves_the_picture(site, opened):
    for name, _, trouble, element in explorers(site, opened):
        dead = element.evaluate(
            """async e => {"""
            + PICTURE
            + """
          const open = () => {
            for (const box of e.querySelectorAll('input[type=checkbox]')) {
              if (!box.checked) box.click();
            }
          };
          const usable = part => part.offsetParent && !part.disabled, dead = [];
          open();
          await drawn();
          let sliders = 0;
          for (const slider of e.querySelectorAll('input[type=range]')) {
            if (!usable(slider)) continue;
            const pictures = [];
            sliders++;
            for (const end of ['min', 'max']) {
              slider.value = slider[end];
              slider.dispatchEvent(new Event('input', { bubbles: true }));
              await drawn();
              e.explorer.draw(true);
              await e.explorer.painted();
              pictures.push(picture(e));
              const message = e.querySelector('.explorer-message');
              if (!message.hidden) dead.push(`${slider.id}: ${message.textContent}`);
            }
            if (pictures[0] === pictures[1]) dead.push(slider.id);
            e.explorer.reset();
            open();
            await drawn();
          }
          e.explorer.reset();
          return sliders ? dead : ['no slider'];
        }"""
        )
        assert dead == [] and trouble == [], name


def test_labels_targets_and_keyboard(site, opened):
    for name, page, _, element in explorers(site, opened):
        small = element.evaluate("""e => {
          const parts = [...e.querySelectorAll('input, button, select, textarea, summary')];
          const small = part => {
            const target = part.type === 'checkbox' ? part.closest('label') : part;
            const box = target.getBoundingClientRect();
            return box.width > 0 && (box.height < 43.9 || box.width < 43.9);
          };
          return parts.filter(small).map(part => part.outerHTML.slice(0, 90));
        }""")
        assert small == [], name
        for slider in element.locator("input[type=range]:visible:not(:disabled)").all():
            assert slider.evaluate("e => e.labels[0].textContent.trim()") and re.search(
                r"\d", slider.get_attribute("aria-valuetext")
            )
        for field in element.locator("input[type=text]").all():
            assert field.get_attribute("aria-label") or field.evaluate("e => e.labels.length")
        slider = element.locator("input[type=range]:visible:not(:disabled)").last
        slider.focus()
        before = slider.get_attribute("aria-valuetext")
        page.keyboard.press("PageUp")
        shown(element)
        page.keyboard.press("ArrowRight")
        shown(element)
        assert slider.get_attribute("aria-valuetext") != before, name
        assert slider.evaluate("e => getComputedStyle(e).outlineStyle") != "none"
        page.wait_for_function(
            """e => {
              const said = e.querySelector('[aria-live]');
              const shown = e.querySelector('.explorer-outcome');
              return said.textContent === shown.textContent;
            }""",
            arg=element.element_handle(),
        )
        element.evaluate("e => e.explorer.reset()")


def test_the_numbers_of_the_figures_as_a_table(site, opened):
    for name, page, _, element in explorers(site, opened):
        details = element.locator("details.explorer-numbers")
        details.evaluate("e => { e.open = true }")
        page.wait_for_function("e => e.querySelector('table')", arg=details.element_handle())
        assert (
            details.locator("tbody tr").count() > 3 and details.locator("thead th").count() > 3
        ), name
        assert page.evaluate("document.documentElement.scrollWidth") <= PHONE["width"]
        for canvas in element.locator("canvas").all():
            assert len(canvas.get_attribute("aria-label")) > 30


def test_accessibility(site, opened):
    axe = (ROOT / "book" / "node_modules" / "axe-core" / "axe.min.js").read_text(encoding="utf-8")
    for language in ("id", "en"):
        for path in pages_with_explorers(site, language):
            page, _ = opened(path, color_scheme="light")  # of its own, for it is cut short
            page.evaluate(
                f"document.querySelectorAll('{NUMBERS}').forEach(e => {{ e.open = true }})"
            )
            page.wait_for_function(
                f"[...document.querySelectorAll('{NUMBERS}')].every(e => e.querySelector('table'))"
            )
            page.evaluate("""() => {
              const all = names => document.querySelectorAll(names);
              // a few rows of the long tables are enough
              all('.explorer-table tbody tr:nth-child(n + 4)').forEach(row => row.remove());
              // thousands of parts: slow
              all('.katex, .highlight').forEach(e => { e.textContent = 'x'; });
            }""")
            page.evaluate(axe)
            themes = ("light", "dark") if language == "id" else ("light",)  # only the words differ
            for theme in themes:
                page.evaluate("theme => { document.documentElement.dataset.theme = theme }", theme)
                found = page.evaluate("""async () => {
                  const { violations } = await axe.run('kalman-explorer');
                  const places = nodes => nodes.map(node => node.target.join(' ')).slice(0, 4);
                  return violations.map(({ id, nodes }) => [id, places(nodes)]);
                }""")
                assert found == [], (path, theme)
            page.evaluate("""() => {
              document.documentElement.dataset.theme = 'light';
              document.querySelectorAll('details.explorer-numbers').forEach(e => {
                e.open = false;
                e.querySelector('table').dataset.shape = '';
              });
            }""")


def texts(element):
    return element.evaluate("""async e => {
      e.explorer.renderNow(false);
      e.explorer.draw(true);  // a plot out of sight has no legend yet
      e.explorer.words(true);
      for (const numbers of e.querySelectorAll('details.explorer-numbers')) {
        numbers.open = true;
        while (!numbers.querySelector('td')) await new Promise(requestAnimationFrame);
      }
      const copy = e.cloneNode(true);
      copy.querySelectorAll('sub, .explorer-plot[hidden]').forEach(part => part.remove());
      const words = 'button, label, option, summary, th, p, .explorer-title, .explorer-key';
      const named = '[aria-label]:not(.explorer-line)';
      return [
        ...Array.from(copy.querySelectorAll(words), part => part.textContent.trim()),
        ...Array.from(copy.querySelectorAll(named), part => part.getAttribute('aria-label')),
      ];
    }""")


def test_every_text_is_in_the_language_of_its_page(site, opened):
    spoken = {
        language: [texts(element) for *_, element in explorers(site, opened, language)]
        for language in ("id", "en")
    }
    assert spoken["id"]
    repeated = set()
    for ours, theirs in zip(spoken["id"], spoken["en"], strict=True):
        assert len(ours) == len(theirs)
        for text in set(ours) & set(theirs) - SAME_TEXT:
            if re.search(r"[a-z]{4}", re.sub("pred|true|smooth", "", text)):
                repeated.add(text)
        points = [text for text in ours if re.search(r"\d\.\d", text)]
        assert not points, "a decimal point in Indonesian"
    assert repeated == set()


@pytest.mark.parametrize("language", ["id", "en"])
def test_every_choice_of_a_list_works(language, site, opened):
    for name, _, trouble, element in explorers(site, opened, language):
        for choice in element.locator("select:visible").all():
            for value in choice.evaluate("e => [...e.options].map(option => option.value)"):
                choice.select_option(value)
                shown(element)
                said = (
                    element.locator(".explorer-outcome").inner_text()
                    + element.locator(".explorer-message").inner_text()
                )
                broken = re.search("undefined|NaN|failed|gagal", said)
                assert said and not broken, (name, value, said)
                assert element.locator(".explorer-message").is_hidden(), (name, value)
        assert trouble == [], name
        element.evaluate("e => e.explorer.reset()")


def test_a_finger_that_scrolls_over_a_figure_changes_nothing(site, opened):
    for name, _, _, element in explorers(site, opened):
        if element.locator("canvas.draggable").count() == 0:
            continue
        settings = [
            element.evaluate(
                """async (e, ways) => {"""
                + PICTURE
                + """
          const canvas = e.querySelector('canvas.draggable'), box = canvas.getBoundingClientRect();
          for (const [type, x, y] of ways) canvas.dispatchEvent(new PointerEvent(type, {
            bubbles: true, isPrimary: true, pointerType: 'touch',
            pointerId: 1, clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
          await drawn();
          return JSON.stringify(e.explorer.s);
        }""",
                ways,
            )
            for ways in (
                [],
                [("pointerdown", 0.3, 0.2), ("pointermove", 0.3, 0.6), ("pointercancel", 0.3, 0.6)],
                [("pointerdown", 0.3, 0.2), ("pointermove", 0.4, 0.2), ("pointerup", 0.4, 0.2)],
            )
        ]
        assert settings[0] == settings[1] != settings[2], name
        element.evaluate("e => e.explorer.reset()")


@pytest.mark.parametrize("width", [640, 320])
def test_zoomed_in_nothing_is_cut_off(width, site, opened):
    """A window of 1280 pixels zoomed to 200 % and to 400 % leaves the page 640 and 320 of them."""
    for name, page, _, element in explorers(
        site, opened, viewport={"width": width, "height": 450}, device_scale_factor=1280 / width
    ):
        wide = element.evaluate("""e => {
          const scrolls = '.explorer-equations, .explorer-table';
          const parts = [...e.querySelectorAll('.explorer *')].filter(part => part.offsetParent);
          const isCut = part => part.getBoundingClientRect().right > innerWidth + 1;
          const wide = parts.filter(part => isCut(part) && !part.closest(scrolls));
          return wide.map(part => part.className || part.tagName);
        }""")
        assert wide == [] and page.evaluate("document.documentElement.scrollWidth <= innerWidth"), (
            name
        )
        for part in element.locator(
            "button:visible, input[type=range]:visible, select:visible"
        ).all()[:6]:
            part.scroll_into_view_if_needed()
            box = part.bounding_box()
            assert box["x"] >= 0 and box["x"] + box["width"] <= width and box["height"] >= 43.9, (
                name
            )
