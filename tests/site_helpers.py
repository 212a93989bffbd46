"""The built book in a browser: how a page is opened, and what is noted about it."""

import html.parser
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WITHOUT_LANGUAGE = {"404.html", "unkept.html"}
AXE = ROOT / "book" / "node_modules" / "axe-core" / "axe.min.js"
LANGUAGES = {"id": "en", "en": "id"}  # each with the other one
PHONE = {"width": 390, "height": 844}
THEMES = {"light": None, "dark": {"type": "tag", "values": ["cat.color"]}}

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
# Thousands of parts that are all alike are slow to check
SIMPLIFY = """() => {
  document.querySelectorAll('.katex').forEach(part => part.textContent = 'x');
  const code = [...document.querySelectorAll('.highlight')];
  code.slice(5).forEach(part => part.textContent = 'x');
}"""
VIOLATIONS = """rules => axe
  .run({resultTypes: ['violations'], ...rules && {runOnly: rules}})
  .then(result => result.violations.map(found => ({
    rule: found.id, impact: found.impact, nodes: found.nodes.map(node => node.target.join(' ')),
  })))"""


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
    return 'http-equiv="refresh"' in text or "location.replace" in text


def note_trouble(page, base):
    """A list that takes up whatever goes wrong on a page from now on, or is asked of others."""
    trouble = []

    def on_request(request):
        if not request.url.startswith((base, "data:", "blob:")):
            trouble.append(f"asks {request.url}")

    def on_failure(request):
        is_replaced = request.url.startswith("blob:") or request.is_navigation_request()
        if "ABORTED" in request.failure and is_replaced:
            return  # given up, for the next page came first
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
    """Language, title, pictures and chrome of the page, and what axe-core finds in both themes."""
    entry = {
        "lang": page.evaluate("document.documentElement.lang"),
        "title": page.title(),
        "images": page.evaluate(IMAGES),
        "chrome": page.evaluate(CHROME_TEXTS),
        "axe": {},
    }
    page.evaluate(AXE.read_text(encoding="utf-8"))
    page.evaluate(SIMPLIFY)
    for theme, rules in THEMES.items():
        page.evaluate("theme => { document.documentElement.dataset.theme = theme }", theme)
        entry["axe"][theme] = page.evaluate(VIOLATIONS, rules)
    return entry
