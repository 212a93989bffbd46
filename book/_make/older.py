"""The edition of an earlier year says on every page that there is a newer one, and leads there.

Who keeps an old edition on its host writes the address of the newest one into `newest` of
book_edition in _config.yml and builds the old one once more.
"""

import html

from edition import edition
from pages import change_all

HEADING = "</h1>"
WORDS = {
    "id": "Ini edisi {version} tahun {year}. Halaman yang sama ada dalam",
    "en": "This is edition {version} of {year}. The same page is in",
}
NEWEST = {"id": "edisi terbaru", "en": "the newest edition"}


def lead_to_newest(folder, language):
    """Below the title of every page of one language; the newest edition has no such line."""
    newest = edition()["newest"].rstrip("/")
    if newest:
        change_all(
            folder,
            lambda page, text: text.replace(
                HEADING, f"{HEADING}\n{line(f'{newest}/{language}', folder, page, language)}", 1
            ),
        )


def line(newest, folder, page, language):
    about = edition()
    words = WORDS[language].format(version=about["version"], year=about["date"][:4])
    address = html.escape(f"{newest}/{page.relative_to(folder).as_posix()}")
    link = f'<a href="{address}">{NEWEST[language]}</a>'
    return f'<p class="older-edition">{html.escape(words)} {link}.</p>'
