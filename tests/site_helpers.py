"""The built book in a browser: how a page is opened, and what is noted about it."""

import functools
import gzip
import html.parser
from pathlib import Path

from weigh import PACKED

ROOT = Path(__file__).resolve().parent.parent
WITHOUT_LANGUAGE = {"404.html", "unkept.html"}
AXE = ROOT / "book" / "node_modules" / "axe-core" / "axe.min.js"
LANGUAGES = {"id": "en", "en": "id"}  # each with the other one
PHONE = {"width": 390, "height": 844}
WIDE = {"width": 1280, "height": 900}
# What only this page has; the frame around it, the same on all pages, is the slower half
OWN = {"include": ["article", "#text", ".bd-sidebar-secondary"]}
VIEWS = {"phone, light": (PHONE, "light"), "laptop, dark": (WIDE, "dark", OWN)}
# Rules besides those that axe-core takes by itself; in the dark every contrast is the higher one
LIGHT = {"label-content-name-mismatch": {"enabled": True}}
DARK = {
    **LIGHT,
    "color-contrast": {"enabled": False},
    "color-contrast-enhanced": {"enabled": True},
}
RULES = {"light": LIGHT, "dark": DARK}

# What a page says outside its prose; a letter alone (σ, w, "m = 1") is a symbol, no word
CHROME_TEXTS = r"""() => {
  const texts = [];
  const add = text => {
    text = (text || "").replace(/\s+/g, " ").trim();
    if (/\p{L}\p{L}/u.test(text)) texts.push(text);
  };
  const chrome = ".admonition-title, .caption-number, .headerlink, button, summary, .copybtn";
  const inProse = element => element.closest("article") && !element.closest(chrome);
  const isNoText = element => /^(SCRIPT|STYLE|NOSCRIPT)$/.test(element.tagName)
    || element.closest("a.language-switcher, .katex, .highlight pre");
  const named = ["title", "aria-label", "placeholder", "alt", "data-bs-title",
    "data-bs-original-title", "data-tooltip", "data-toggle-hint"];
  for (const element of document.querySelectorAll("body *")) {
    if (isNoText(element) || inProse(element)) continue;
    for (const name of named) add(element.getAttribute(name));
    for (const node of element.childNodes) if (node.nodeType === Node.TEXT_NODE) add(node.data);
  }
  add(document.title);
  return texts;
}"""
IMAGES = """() => [...document.images].map(image => ({
  alt: image.getAttribute('alt'),
  src: image.getAttribute('src').slice(0, 80),
  decorative: image.closest('[aria-hidden=true], [role=presentation]') !== null,
}))"""
# What a screen reader stumbles over: headings out of order, tables without heads, silent equations
ORDER = r"""() => {
  const wrong = [];
  const levelOf = heading => Number(heading.ariaLevel || heading.tagName[1]);
  const anyHeading = ':is(article, #text) :is(h1, h2, h3, h4, h5, h6)';
  const headings = [...document.querySelectorAll(anyHeading)];
  headings.reduce((above, heading) => {
    if (levelOf(heading) > above + 1) wrong.push(`h${above} above: ${heading.textContent}`);
    return levelOf(heading);
  }, 0);
  if (headings.filter(heading => levelOf(heading) === 1).length !== 1) wrong.push('not one h1');
  const filled = [...document.querySelectorAll('table')].filter(table => table.textContent.trim());
  for (const table of filled) {
    const heads = [...table.querySelectorAll('th')];
    if (!heads.length || !heads.every(head => head.textContent.trim())) {
      wrong.push(`table: ${table.textContent.trim().slice(0, 40)}`);
    }
  }
  for (const equation of document.querySelectorAll('.katex')) {
    const spoken = equation.querySelector('.katex-mathml > math');
    const shown = equation.querySelector('.katex-html[aria-hidden=true]');
    const isHidden = equation.closest('[aria-hidden=true]:not(section)'); // but slides to come
    if (!spoken || !shown || isHidden || getComputedStyle(spoken).display === 'none') {
      wrong.push(`equation: ${equation.textContent.slice(0, 40)}`);
    }
  }
  return wrong;
}"""
# The addresses of whatever the page needs until it stands still. Fonts are those in use: where the
# page before has the same style sheet, the browser notes the fonts of that one, too.
FETCHED = """() => document.fonts.ready.then(() => {
  const noted = performance.getEntriesByType('resource').map(entry => entry.name);
  const isFace = rule => rule instanceof CSSFontFaceRule;
  const sheets = [...document.styleSheets];
  const rules = sheets.flatMap(sheet => [...sheet.cssRules].filter(isFace).map(rule =>
    new URL(rule.style.getPropertyValue('src').match(/url\\("?([^")]+)/)[1], sheet.href).href));
  const inUse = [...document.fonts].map((face, i) => face.status === 'loaded' && rules[i]);
  const others = noted.filter(address => !address.endsWith('.woff2'));
  return [location.href, ...others, ...inUse.filter(Boolean)];
})"""
# Thousands of parts that are all alike are slow to check
SIMPLIFY = """() => {
  document.querySelectorAll('.katex').forEach(part => part.textContent = 'x');
  const code = [...document.querySelectorAll('.highlight')];
  code.slice(5).forEach(part => part.textContent = 'x');
}"""
VIOLATIONS = """([within, rules]) => axe
  .run(within || document, {resultTypes: ['violations'], rules})
  .then(result => result.violations.map(found => [
    found.id, ...found.nodes.slice(0, 4).map(node => node.target.join(' ')),
  ]))"""


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
        if tag == "kalman-explorer":  # "gyro.drift:" leads to it, with settings behind the colon
            names = (attributes["paper"], attributes.get("view"))
            self.ids.add(".".join(filter(None, names)) + ":")


def pages_of(site):
    """Every page that has a language; those that a host shows where there is none say both."""
    found = (path for path in site.rglob("*.html") if path.name not in WITHOUT_LANGUAGE)
    return sorted(path for path in found if site / "lite" not in path.parents)  # JupyterLite's own


def twin(name):
    """The same page in the other language."""
    language, rest = name.split("/", 1)
    return f"{LANGUAGES[language]}/{rest}"


def is_redirect(path):
    text = path.read_text(encoding="utf-8")
    return 'http-equiv="refresh"' in text or "choose.js" in text


def note_trouble(page, base):
    """A list that takes up whatever goes wrong on a page from now on, or is asked of others."""
    trouble = []

    def on_request(request):
        if not request.url.startswith((base, "data:", "blob:")):
            trouble.append(f"asks {request.url}")

    def on_failure(request):
        if "ABORTED" in request.failure:
            return  # given up, for the next page came first, or a smaller window another font
        trouble.append(f"failed {request.url} ({request.failure})")

    def on_response(response):
        if response.status >= 400:
            trouble.append(f"{response.status} {response.url}")

    def on_console(message):
        if message.type == "error":
            trouble.append(f"console: {message.text}")

    page.on("request", on_request)
    page.on("requestfailed", on_failure)
    page.on("response", on_response)
    page.on("console", on_console)
    page.on("pageerror", lambda error: trouble.append(f"script error: {error}"))
    return trouble


def visit(page, path, scheme, address, trouble):
    """Open one page -> what went wrong, and what it holds."""
    trouble.clear()
    page.goto(address, wait_until="load")
    entry = {"scheme": scheme, "trouble": list(trouble)}
    if is_redirect(path):
        page.wait_for_selector("article")  # the page it leads to
        return entry
    if path.parent.name == "slides":
        page.wait_for_selector("html.ready")  # parted into slides, and the controls named
    entry["width"] = page.evaluate("document.documentElement.scrollWidth")
    if scheme == "http":
        entry |= contents(page)
    entry["trouble"] = list(trouble)
    return entry


def contents(page):
    """Language, title, pictures, chrome and order of the page, what it fetched on a phone, and what
    axe-core finds in both views."""
    entry = {
        "lang": page.evaluate("document.documentElement.lang"),
        "title": page.title(),
        "images": page.evaluate(IMAGES),
        "chrome": page.evaluate(CHROME_TEXTS),
        "order": page.evaluate(ORDER),
        "fetched": page.evaluate(FETCHED),
    }
    page.evaluate(SIMPLIFY)
    entry["axe"] = {view: violations(page, *look) for view, look in VIEWS.items()}
    page.set_viewport_size(PHONE)
    return entry


def violations(page, size, theme, within=None):
    """What axe-core finds on a page that is open; within: a part of it."""
    page.set_viewport_size(size)
    page.evaluate("theme => { document.documentElement.dataset.theme = theme }", theme)
    if not page.evaluate("'axe' in window"):
        page.evaluate(AXE.read_text(encoding="utf-8"))
    return page.evaluate(VIOLATIONS, [within, RULES[theme]])


def weight(site, server, addresses):
    """Bytes of these addresses as a host sends them, without what each answer says of itself."""
    inside = {address.partition("?")[0] for address in addresses if address.startswith(server)}
    return sum(packed_size(site / address.removeprefix(f"{server}/")) for address in inside)


@functools.cache
def packed_size(path):
    content = path.read_bytes()
    return len(gzip.compress(content, 9) if path.suffix in PACKED else content)
