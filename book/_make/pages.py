"""The finished pages of one language, as the steps behind the build read and change them."""

import hashlib


def pages_of(folder):
    return sorted(folder.rglob("*.html"))


def text_of_all(folder):
    return "".join(page.read_text(encoding="utf-8") for page in pages_of(folder))


def change_all(folder, change):
    """change(page, text) -> the text of every page as it shall be."""
    for page in pages_of(folder):
        text = page.read_text(encoding="utf-8")
        page.write_text(change(page, text), encoding="utf-8")


def way_up(folder, page):
    """From a page to the folder of its language: "../" as often as needed."""
    return "../" * (len(page.relative_to(folder).parts) - 1)


def version(path):
    """For the address of a file: another content has another address, so no older copy is taken."""
    return hashlib.sha256(path.read_bytes()).hexdigest()[:8]
