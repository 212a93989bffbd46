"""Mends what the theme writes around a page: for screen readers, keyboards, and both languages.

What stands inside a page is mended by book/_ext/languages.py (mend_markup).
"""

import re

from pages import change_all

VIEWPORT = re.compile(r'(<meta name="viewport"[^>]*>)\s*<meta name="viewport"[^>]*>')
SEARCH = re.compile(r'(<button class="btn search-button-field[^>]*?)\s+aria-label="[^"]*"')
BRANCH = re.compile(r'<summary>(?=<span class="toctree-toggle")')
LOGO = re.compile(r'<div class="sidebar-primary-item">(?=\s*<a class="navbar-brand)')
# Bootstrap's script is left out: what a browser shows for a title is enough
BOOTSTRAP = re.compile(r'\s+data-bs-(?:placement|toggle)="[^"]*"')
# A data file lies once on the site, where notebooks ask for it (the theme shows a sign of a font
# that is left out)
DOWNLOAD = re.compile(
    r'<a class="reference download internal" download="" href="([./]*)_downloads/\w+/([^"]+)">'
    r'<span class="xref download myst">(.*?)</span></a>'
)
DATA = r'<a class="reference internal" download href="\1_sources/notebooks/data/\2">\3</a>'
TWICE = re.compile(r"<title>(.+?) &#8212; \1</title>")  # the first page is called as the book is
SKIP = 'href="#main-content"'
CONTENT = re.compile('(<article class="bd-article"|<div class="bd-search-container")>')
WORDS = {
    "id": {"branch": "Halaman di bawahnya", "book": "Buku"},
    "en": {"branch": "Pages below", "book": "Book"},
}


def mend(folder, language):
    """Every page of one language."""
    change_all(folder, lambda page, text: mended(text, WORDS[language]))


def mended(text, words):
    text = VIEWPORT.sub(r"\1", text)
    text = SEARCH.sub(r"\1", text)  # its words name it
    text = BRANCH.sub(f'<summary aria-label="{words["branch"]}">', text)
    logo = f'<div class="sidebar-primary-item" role="navigation" aria-label="{words["book"]}">'
    text = LOGO.sub(logo, text)
    text = DOWNLOAD.sub(DATA, text)
    text = TWICE.sub(r"<title>\1</title>", text)
    text = BOOTSTRAP.sub("", text.replace("data-bs-title=", "title="))
    if CONTENT.search(text):  # the skip link passes the toolbar, too
        text = text.replace(SKIP, 'href="#text"')
        text = CONTENT.sub(r'\1 id="text" tabindex="-1">', text, count=1)
    return text
