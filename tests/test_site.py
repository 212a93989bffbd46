"""The built book in a real browser: every page, both languages, over http and from file://.

Pages are found in _build/site, none is listed here. One walk over all of them (the fixture `walk`)
collects what most tests then look at."""

import html.parser
import json
import re
import urllib.parse
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
LANGUAGES = {"id": "en", "en": "id"}  # each with the other one
PHONE = {"width": 390, "height": 844}

# Texts of the chrome that are the same in both languages on purpose.
SAME_TEXT = {"Kalman", "Ctrl", "Model"}

# What axe-core may find: {rule: [(start of the element's selector, reason), ...]}
ALLOWED_AXE = {}

CHROME_TEXTS = """() => {
  const texts = [];          // a letter alone (σ, w, "m = 1") is a symbol, no word
  const add = text => { text = (text || "").replace(/\\s+/g, " ").trim(); if (/\\p{L}\\p{L}/u.test(text)) texts.push(text); };
  const inProse = element => {
    const article = element.closest("article");
    return article && !element.closest(".admonition-title, .caption-number, .headerlink, button, summary, .copybtn");
  };
  for (const element of document.querySelectorAll("body *")) {
    if (/^(SCRIPT|STYLE|NOSCRIPT)$/.test(element.tagName) || element.closest("a.language-switcher, .katex, .highlight pre")) continue;
    if (inProse(element)) continue;
    for (const name of ["title", "aria-label", "placeholder", "alt", "data-bs-title", "data-bs-original-title", "data-tooltip", "data-toggle-hint"])
      add(element.getAttribute(name));
    for (const node of element.childNodes) if (node.nodeType === Node.TEXT_NODE) add(node.data);
  }
  add(document.title);
  return texts;
}"""


class Reader(html.parser.HTMLParser):
    """The ids and the addresses in one page."""

    def __init__(self, path):
        super().__init__()
        self.ids, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.ids |= {attributes[name] for name in ("id", "name") if attributes.get(name)}
        self.links += [attributes[name] for name in ("href", "src") if attributes.get(name)]


def pages_of(site):
    return sorted(site.rglob("*.html"))


def is_redirect(path):
    return 'http-equiv="refresh"' in path.read_text(
        encoding="utf-8"
    ) or "location.replace" in path.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def bases(site, server):
    return {"http": server, "file": site.as_uri()}


@pytest.fixture(scope="module")
def walk(site, bases, chromium):
    """Every page, over http and file://: what went wrong, and (over http) what the page holds."""
    axe = ROOT / "book" / "node_modules" / "axe-core" / "axe.min.js"
    found = []
    for scheme, base in bases.items():
        context = chromium.new_context(
            viewport=PHONE, reduced_motion="reduce", service_workers="block"
        )
        page = context.new_page()
        trouble = []
        page.on(
            "request",
            lambda request, base=base: (
                trouble.append(f"asks {request.url}")
                if not request.url.startswith((base, "data:", "blob:"))
                else None
            ),
        )
        page.on(
            "requestfailed",
            lambda request: (
                trouble.append(f"failed {request.url} ({request.failure})")
                if "ABORTED" not in request.failure
                or not (request.url.startswith("blob:") or request.is_navigation_request())
                else None
            ),
        )  # given up, for the next page came first
        page.on(
            "response",
            lambda response: (
                trouble.append(f"{response.status} {response.url}")
                if response.status >= 400
                else None
            ),
        )
        page.on(
            "console",
            lambda message: (
                trouble.append(f"console: {message.text}") if message.type == "error" else None
            ),
        )
        page.on("pageerror", lambda error: trouble.append(f"script error: {error}"))
        for path in pages_of(site):
            trouble.clear()
            name = path.relative_to(site).as_posix()
            page.goto(f"{base}/{name}", wait_until="load")
            entry = {"scheme": scheme, "name": name, "trouble": list(trouble)}
            found.append(entry)
            if is_redirect(path):
                page.wait_for_selector("article")  # the page it leads to
                continue
            entry["width"] = page.evaluate("document.documentElement.scrollWidth")
            if scheme == "http":
                entry["lang"] = page.evaluate("document.documentElement.lang")
                entry["title"] = page.title()
                entry["images"] = page.evaluate(
                    "[...document.images].map(i => ({alt: i.getAttribute('alt'), src: "
                    "i.getAttribute('src').slice(0, 80),"
                    " decorative: i.closest('[aria-hidden=true], [role=presentation]') !== null}))"
                )
                entry["chrome"] = page.evaluate(CHROME_TEXTS)
                entry["axe"] = {}
                page.evaluate(axe.read_text(encoding="utf-8"))
                page.evaluate("""() => {        // thousands of parts that are all alike: slow
                  document.querySelectorAll('.katex').forEach(e => e.textContent = 'x');
                  [...document.querySelectorAll('.highlight')].slice(5).forEach(e => e.textContent = 'x');
                }""")
                for theme, rules in (
                    ("light", None),
                    ("dark", {"type": "tag", "values": ["cat.color"]}),
                ):
                    page.evaluate(
                        "theme => { document.documentElement.dataset.theme = theme }", theme
                    )
                    entry["axe"][theme] = page.evaluate(
                        "rules => axe.run({resultTypes: ['violations'], ...rules && {runOnly: "
                        "rules}}).then(result => result.violations"
                        ".map(v => ({rule: v.id, impact: v.impact, nodes: v.nodes.map(n => "
                        "n.target.join(' '))})))",
                        rules,
                    )
            entry["trouble"] = list(trouble)
        context.close()
    return found


@pytest.fixture(scope="module")
def pages(walk):
    """The pages with content, as seen over http, by name."""
    return {entry["name"]: entry for entry in walk if "chrome" in entry}


def twin(name):
    """The same page in the other language."""
    language, rest = name.split("/", 1)
    return f"{LANGUAGES[language]}/{rest}"


def test_every_page_is_there_in_both_languages(site, pages):
    names = {path.relative_to(site).as_posix() for path in pages_of(site)} - {"index.html"}
    assert len(names) >= 20
    assert {twin(name) for name in names} == names
    assert {name for name in pages if "/notebooks/" in name}, "no chapter was built"


def test_no_request_leaves_the_site_and_nothing_fails(walk):
    assert {
        (entry["scheme"], entry["name"]): entry["trouble"] for entry in walk if entry["trouble"]
    } == {}


def test_language_and_title(pages):
    for name, entry in pages.items():
        assert entry["lang"] == name.split("/")[0], name
        assert " | " not in entry["title"]
        assert entry["title"] != pages[twin(name)]["title"], name


def test_no_page_scrolls_sideways_on_a_phone(walk):
    assert {
        (entry["scheme"], entry["name"]): entry["width"]
        for entry in walk
        if entry.get("width", 0) > PHONE["width"]
    } == {}


def test_the_header_fits_a_narrow_phone(server, chromium, site):
    page = chromium.new_page()
    for language in LANGUAGES:
        for path in sorted((site / language / "notebooks").glob("*.html")):
            page.goto(f"{server}/{language}/notebooks/{path.name}")
            for width in (360, 320):
                page.set_viewport_size({"width": width, "height": 700})
                assert page.evaluate("document.documentElement.scrollWidth") <= width, (path, width)
    page.close()


def test_the_contents_of_a_page_close_when_a_section_is_chosen(server, chromium):
    page = chromium.new_page(viewport=PHONE)
    page.goto(f"{server}/id/notebooks/01_theory.html")
    page.locator(
        "button.secondary-toggle:visible, .sidebar-toggle.secondary-toggle:visible"
    ).first.click()
    dialog = page.locator("#pst-secondary-sidebar-modal")
    dialog.locator("a[href='#the-five-equations']").click()
    page.wait_for_function("!document.getElementById('pst-secondary-sidebar-modal').open")
    assert page.url.endswith("#the-five-equations")
    page.close()


def test_print_shows_the_page_and_no_chrome_even_from_the_dark_theme(server, chromium):
    page = chromium.new_page(color_scheme="dark")
    page.goto(f"{server}/id/notebooks/01_theory.html")
    assert (
        page.evaluate("getComputedStyle(document.querySelector('article figure img')).filter")
        != "none"
    )
    page.emulate_media(media="print")
    assert page.locator("article h1").first.is_visible()
    assert not page.locator(
        ".bd-header-article, .bd-sidebar-primary, .prev-next-footer"
    ).first.is_visible()
    assert (
        page.evaluate("getComputedStyle(document.querySelector('article figure img')).filter")
        == "none"
    )
    colours = page.evaluate(
        "[...new Set([...document.querySelectorAll('.highlight pre span')].map(s => "
        "getComputedStyle(s).color))]"
    )
    assert colours == ["rgb(0, 0, 0)"]
    solutions = page.locator("details")
    assert solutions.count() > 5 and not solutions.first.is_visible()  # closed: not printed
    page.evaluate(
        "document.querySelectorAll('details').forEach(details => { details.open = true })"
    )
    assert solutions.first.is_visible()  # opened: printed
    page.close()


def test_every_image_has_an_alt_text_in_the_language_of_its_page(pages):
    for name, entry in pages.items():
        others = pages[twin(name)]["images"]
        assert len(others) == len(entry["images"]), name
        for image, other in zip(entry["images"], others):
            if image["decorative"]:
                continue
            assert (image["alt"] or "").strip() and "_images/" not in image["alt"], (name, image)
            assert image["alt"] != other["alt"], (name, image)


def test_no_english_in_the_chrome_of_the_indonesian_pages(pages):
    english = {
        text for name, entry in pages.items() if name.startswith("en/") for text in entry["chrome"]
    }
    left = {
        text: name
        for name, entry in pages.items()
        if name.startswith("id/")
        for text in entry["chrome"]
        if text in english and text not in SAME_TEXT
    }
    assert len(english) > 20
    assert left == {}


def test_accessibility(pages):
    problems = []
    for name, entry in pages.items():
        for theme, violations in entry["axe"].items():
            for violation in violations:
                allowed = tuple(start for start, reason in ALLOWED_AXE.get(violation["rule"], []))
                nodes = [
                    node
                    for node in violation["nodes"]
                    if not (allowed and node.startswith(allowed))
                ]
                if violation["impact"] in ("serious", "critical") and nodes:
                    problems.append((name, theme, violation["rule"], nodes[:4]))
    assert problems == []


def test_every_link_leads_somewhere(site):
    readers = {path: Reader(path) for path in pages_of(site)}
    dead = []
    for path, reader in readers.items():
        for link in reader.links:
            address = urllib.parse.urlsplit(link)
            if address.scheme or address.netloc:
                continue
            target = (
                path
                if not address.path
                else (path.parent / urllib.parse.unquote(address.path)).resolve()
            )
            fragment = urllib.parse.unquote(address.fragment)
            if not target.is_file():
                dead.append((path.relative_to(site).as_posix(), link))
            elif (
                fragment and target in readers and fragment not in readers[target].ids | {"choose"}
            ):
                dead.append((path.relative_to(site).as_posix(), link))
    assert dead == []


def test_pages_name_their_other_language(site):
    for path in pages_of(site):
        text = path.read_text(encoding="utf-8")
        if "bd-article-container" not in text:
            continue
        links = dict(re.findall(r'<link rel="alternate" hreflang="([\w-]+)" href="([^"]+)">', text))
        assert set(links) == {"id", "en", "x-default"}, path
        name = path.relative_to(site).as_posix()
        assert (path.parent / links[name[:2]]).resolve() == path
        assert (path.parent / links[LANGUAGES[name[:2]]]).resolve() == site / twin(name)
        assert (path.parent / links["x-default"]).resolve() == site / "index.html"


@pytest.mark.parametrize("scheme", ["http", "file"])
def test_the_switcher_leads_to_the_same_section_and_back(scheme, bases, chromium, site):
    longest = max(
        (site / "id" / "notebooks").glob("*.html"),
        key=lambda path: path.read_text(encoding="utf-8").count("<section id="),
    )
    name = longest.relative_to(site / "id").as_posix()
    context = chromium.new_context(viewport=PHONE, reduced_motion="reduce", service_workers="block")
    page = context.new_page()
    page.goto(f"{bases[scheme]}/id/{name}")
    section = page.evaluate(
        "(() => { const s = document.querySelectorAll('article section section'); return "
        "s[Math.floor(s.length / 2)].id })()"
    )
    page.evaluate("id => document.getElementById(id).scrollIntoView()", section)
    for language, lang_name in (("en", "English"), ("id", "Bahasa Indonesia")):
        switcher = page.locator("a.language-switcher")
        assert switcher.inner_text() == lang_name and switcher.get_attribute("lang") == language
        box = switcher.bounding_box()  # not switcher.click(), which may scroll
        page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        page.wait_for_url(f"**/{language}/{name}#{section}", timeout=5000)
        assert page.evaluate("localStorage.getItem('book-language')") == language
        assert (
            -5
            < page.evaluate(
                "id => document.getElementById(id).getBoundingClientRect().top", section
            )
            < PHONE["height"] / 2
        )
    context.close()


def test_the_first_page_chooses_and_remembers_the_language(server, chromium):
    for locale, language in (("id-ID", "id"), ("ms-MY", "id"), ("en-GB", "en"), ("fr-FR", "en")):
        context = chromium.new_context(locale=locale)
        page = context.new_page()
        page.goto(f"{server}/index.html")
        page.wait_for_url(f"**/{language}/**")
        page.locator("a.language-switcher").click()
        page.wait_for_url(f"**/{LANGUAGES[language]}/**")
        page.goto(f"{server}/index.html")
        page.wait_for_url(f"**/{LANGUAGES[language]}/**")
        context.close()


def test_after_one_visit_the_book_opens_without_a_network(server, chromium, site):
    """One page is read; then the network is gone, and every other page of that language still
    opens, figures included."""
    context = chromium.new_context(viewport=PHONE)
    page = context.new_page()
    page.goto(f"{server}/id/book/intro.html")
    page.evaluate("navigator.serviceWorker.ready.then(worker => worker.active.state)")
    context.set_offline(True)
    pages = [path for path in pages_of(site / "id") if not is_redirect(path)]
    assert len(pages) >= 7
    for path in pages:
        page.goto(f"{server}/id/{path.relative_to(site / 'id').as_posix()}")
        page.wait_for_selector("h1")
        page.evaluate(
            "document.querySelectorAll('img').forEach(image => { image.loading = 'eager' })"
        )
        page.wait_for_function("[...document.images].every(image => image.complete)")
        assert page.evaluate("[...document.images].every(image => image.naturalWidth > 0)"), (
            path.name
        )
    with pytest.raises(Exception, match="ERR_INTERNET_DISCONNECTED"):
        page.goto(f"{server}/en/book/intro.html")  # the network really is gone
    context.close()


def test_without_javascript(server, chromium, site):
    context = chromium.new_context(java_script_enabled=False, viewport=PHONE)
    page = context.new_page()
    page.goto(f"{server}/index.html")
    assert page.locator("a[hreflang]").count() == 2 and page.locator("a[hreflang=en]").is_visible()
    page.locator("a[hreflang=en]").click()
    assert "/en/" in page.url
    page.locator("a.language-switcher").click()
    assert "/id/" in page.url
    chapter = min((site / "id" / "notebooks").glob("*.html"))
    page.goto(f"{server}/id/notebooks/{chapter.name}")
    assert page.locator(".katex-html").count() == page.locator(".katex math").count() > 0
    context.close()


@pytest.mark.parametrize("scheme", ["http", "file"])
@pytest.mark.parametrize(
    "language, word, status",
    [("id", "penguatan", "halaman ditemukan"), ("en", "gain", "page(s) matching")],
)
def test_search(scheme, language, word, status, bases, chromium):
    page = chromium.new_page()
    errors = []
    page.on(
        "console", lambda message: errors.append(message.text) if message.type == "error" else None
    )
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(f"{bases[scheme]}/{language}/search.html?q={word}")
    page.wait_for_selector("#search-results li a")
    page.wait_for_function(
        "text => document.querySelector('#search-results').innerText.includes(text)", arg=status
    )
    if language == "id":
        assert page.locator("#search-results h2").inner_text() == "Hasil pencarian"
    page.goto(f"{bases[scheme]}/{language}/search.html?q=qqqqzzzz")
    page.wait_for_function(
        "() => document.querySelector('#search-results .search-summary').innerText.length > 20"
    )
    assert ("Tidak ada halaman" in page.locator("#search-results").inner_text()) == (
        language == "id"
    )
    assert errors == []
    page.close()


def test_texts_that_appear_on_a_click(server, chromium, site):
    chapter = min((site / "id" / "notebooks").glob("*.html"))
    context = chromium.new_context(permissions=["clipboard-read", "clipboard-write"])
    page = context.new_page()
    page.goto(f"{server}/id/notebooks/{chapter.name}")
    button = page.locator("button.copybtn:visible").first
    assert button.get_attribute("data-tooltip") == "Salin"
    button.scroll_into_view_if_needed()
    button.dispatch_event("click")  # it shows only while the mouse is over its code
    page.wait_for_selector(
        "button.copybtn[data-tooltip='Tersalin!']", state="attached", timeout=5000
    )
    assert "Copy" not in page.evaluate(
        "[...document.querySelectorAll('.copybtn')].map(b => b.innerHTML).join()"
    )
    context.close()


@pytest.mark.parametrize("language", LANGUAGES)
def test_downloads_hold_one_language_and_the_outputs(language, site):
    sources = [
        path
        for folder in ("book", "notebooks")
        for path in (ROOT / folder).glob("*.*")
        if path.suffix in (".ipynb", ".md")
    ]
    checked = 0
    for source in sources:
        download = site / language / "_sources" / source.relative_to(ROOT)
        if not download.exists():
            continue
        checked += 1
        text = download.read_text(encoding="utf-8")
        assert f"lang-{LANGUAGES[language]}" not in text
        if source.suffix == ".md":
            assert "+++" not in text and text.strip()
            continue
        original, copy = json.loads(source.read_text(encoding="utf-8")), json.loads(text)
        others = [
            "".join(cell["source"])
            for cell in original["cells"]
            if f"lang-{LANGUAGES[language]}" in cell["metadata"].get("tags", [])
        ]
        assert others and not [cell for cell in copy["cells"] if "".join(cell["source"]) in others]
        assert any(cell.get("outputs") for cell in copy["cells"])
        assert "application/vnd.jupyter.widget-view+json" not in text
        assert not any("book" in cell["metadata"] for cell in copy["cells"])
        assert "{cite}" not in text
        if "welch2006" in source.read_text(encoding="utf-8"):
            assert {"id": "Welch dan Bishop, 2006", "en": "Welch and Bishop, 2006"}[
                language
            ] in text
        assert "kalman_lib" in "".join(copy["cells"][1]["source"])  # says what it needs to run
    assert checked >= 3


@pytest.mark.parametrize("name", ["id/filter-kalman", "en/kalman-filter"])
def test_the_zip_holds_what_is_needed_to_run_the_chapters(name, site):
    with zipfile.ZipFile(site / f"{name}.zip") as archive:
        names = {
            Path(entry).relative_to(Path(name).name).as_posix() for entry in archive.namelist()
        }
    wanted = {path.relative_to(ROOT).as_posix() for path in (ROOT / "notebooks").glob("*.ipynb")}
    wanted |= {path.relative_to(ROOT).as_posix() for path in (ROOT / "kalman_lib").rglob("*.py")}
    assert wanted | {"requirements.txt", "requirements.lock", "pyproject.toml"} <= names
