"""Mends what the theme writes around a page: for screen readers, keyboards, and both languages.

What stands inside a page is mended by book/_ext/languages.py (mend_markup).
"""

import re

from pages import change_all

VIEWPORT = re.compile(r'(<meta name="viewport"[^>]*>)\s*<meta name="viewport"[^>]*>')
SEARCH = re.compile(r'(<button class="btn search-button-field[^>]*?)\s+aria-label="[^"]*"')
BRANCH = re.compile(r'<summary>(?=<span class="toctree-toggle")')
LOGO = re.compile(r'<div class="sidebar-primary-item">(?=\s*<a class="navbar-brand)')
SKIP = 'href="#main-content"'
ARTICLE = '<article class="bd-article">'
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
    if ARTICLE in text:  # the skip link passes the toolbar, too
        text = text.replace(SKIP, 'href="#text"')
        text = text.replace(ARTICLE, '<article class="bd-article" id="text" tabindex="-1">')
    return text
