"""What a page may do: its content security policy, and pages that hold no script inside.

The policy stands in every page, so it holds on any host, also where no headers can be set, and
from a folder (file:, whose pages are no origin that 'self' could mean). It allows scripts that are
files of this site and no others, so what extensions and theme write into the pages becomes a file.
CONTRIBUTING.md tells which headers a host should send besides; Netlify takes them from `_headers`.
"""

import re

from pages import change_all, pages_of, version, way_up
from places import SITE

SOURCES = {
    "default-src": "'self' file:",
    "script-src": "'self' file:",
    "style-src": "'self' file: 'unsafe-inline'",  # KaTeX places its letters with style attributes
    "img-src": "'self' file: data:",
    "worker-src": "'self' blob:",  # the copy without a network; the painter of the explorers
    "frame-src": "'none'",
    "object-src": "'none'",
    "base-uri": "'none'",
    "form-action": "'self' file:",
}
POLICY = "; ".join(f"{name} {allowed}" for name, allowed in SOURCES.items())
META = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
HEADERS = {
    "Content-Security-Policy": POLICY,
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "strict-origin-when-cross-origin",
    "Permissions-Policy": "accelerometer=(self), gyroscope=(self), magnetometer=(self), "
    "camera=(), geolocation=(), microphone=()",
}
START = "_static/start.js"
HEAD = re.compile(r'<head>(?:\s*<meta charset="utf-8"\s*/?>)?')
INLINE = re.compile(r"\s*<script(?![^>]*\bsrc=)[^>]*>(.*?)</script>", re.DOTALL)
DECLARES = re.compile(r"^(let|const|var|function)\b")
NOT_NEEDED = (
    "DOCUMENTATION_OPTIONS.pagename",  # nothing asks for it
    "DOCUMENTATION_OPTIONS.search_as_you_type = false",  # as if it were not said
    "// Activate the search field on page load",  # search.js does it
)
PRINTS = ' onclick="window.print()"'
# Of Sphinx, for Indonesian only, which has one form for every number
PLURAL = re.compile(r"new Function\(\s*\"n\",\s*`return \(\$\{catalog\.plural_expr\}\)`,?\s*\)")


# --- pages without scripts inside ---------------------------------------------------------------


def take_out_scripts(folder):
    """What all pages of one language do first goes into one file; nothing makes code of a text."""
    inside = {page: scripts_in(page) for page in pages_of(folder)}
    common = list(dict.fromkeys(script for scripts in inside.values() for script in scripts))
    for page, scripts in inside.items():
        missing = [script for script in common if script not in scripts]
        if scripts and missing:
            raise SystemExit(f"{page}: only other pages hold these scripts: {missing}")
    (folder / START).write_text("\n".join(map(protected, common)), encoding="utf-8")
    here = version(folder / START)
    change_all(folder, lambda page, text: without_scripts(folder, page, text, here))
    forbid_making_code(folder / "_static" / "doctools.js")


def scripts_in(page):
    """The scripts that stand in a page and are needed."""
    scripts = [script.strip() for script in INLINE.findall(page.read_text(encoding="utf-8"))]
    return [script for script in scripts if not script.startswith(NOT_NEEDED)]


def protected(script):
    """A script that fails, where storage is switched off, leaves the next one alone."""
    if DECLARES.match(script):
        return script
    return f"try {{\n{script}\n}} catch {{ }}"


def without_scripts(folder, page, text, here):
    start = f'<script src="{way_up(folder, page)}{START}?v={here}"></script>'
    first = INLINE.search(text)
    if first:
        rest = INLINE.sub("", text[first.end() :])
        text = f"{text[: first.start()]}\n    {start}{rest}"
    return text.replace(PRINTS, " data-print")


def forbid_making_code(script):
    text, count = PLURAL.subn("() => 0", script.read_text(encoding="utf-8"))
    if count != 1 or "new Function" in text:
        raise SystemExit(f"{script} makes code of a text in another way than we know")
    script.write_text(text, encoding="utf-8")


# --- the policy ---------------------------------------------------------------------------------


def write_policy(folder):
    """Into every page of a folder, before anything that it could forbid."""
    change_all(folder, lambda page, text: with_policy(text))


def with_policy(text):
    made, count = HEAD.subn(lambda found: f"{found[0]}\n  {META}", text, count=1)
    if not count:
        raise SystemExit(f"A page without a head: {text[:200]}")
    return made


def write_headers():
    """For Netlify and Cloudflare Pages; other hosts take it for a file that nobody asks for."""
    lines = ["/*", *(f"  {name}: {value}" for name, value in HEADERS.items())]
    (SITE / "_headers").write_text("\n".join(lines) + "\n", encoding="utf-8")
