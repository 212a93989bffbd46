"""What a reader with a poor connection fetches: bytes, not times."""

import re

import pytest
from weigh import CHAPTER, TEXT, first_view, packing_host

MOST_SHIFT = 0.02


def heaviest(site, pattern):
    pages = [path for path in site.glob(pattern) if "<kalman-explorer" in path.read_text()]
    return max(pages, key=lambda path: path.stat().st_size)


@pytest.mark.parametrize("language", ["id", "en"])
def test_the_first_view_is_light_and_still(language, site, chromium):
    pages = {
        f"{language}/book/intro.html": TEXT,
        f"{language}/book/bekal.html": TEXT,
        heaviest(site, f"{language}/notebooks/*.html").relative_to(site).as_posix(): CHAPTER,
        f"{language}/notebooks/06_quadrotor.html": CHAPTER,
    }
    with packing_host(site) as address:
        for page, limit in pages.items():
            size, requests, shift = first_view(chromium, f"{address}/{page}")
            assert 20_000 < size <= limit and requests > 5, (page, size)
            assert shift <= MOST_SHIFT, (page, shift)


def test_one_style_sheet_for_all_pages(site):
    made = ["all.css", "embed.css", "slides.css"]
    for language in ("id", "en"):
        folder = site / language
        assert sorted(path.name for path in folder.rglob("*.css")) == made
        for page in folder.rglob("*.html"):
            sheets = re.findall(r'<link[^>]*stylesheet"[^>]*>', page.read_text(encoding="utf-8"))
            wanted = 2 if page.parent.name == "slides" else 1  # those with one of their own
            assert len(sheets) in (0, wanted), page
            assert bool(sheets) == (
                'http-equiv="refresh"' not in page.read_text(encoding="utf-8")
            ), page


def test_whatever_a_sheet_or_a_page_names_is_there(site):
    for language in ("id", "en"):
        folder = site / language
        css = (folder / "_static" / "all.css").read_text(encoding="utf-8")
        for font in re.findall(r'url\(["\']?([^"\')]+\.woff2)', css):
            if "fontawesome" not in font:  # named by the theme, never used: the icons are drawn
                assert (folder / "_static" / font).exists(), font
        for page in folder.rglob("*.html"):
            text = page.read_text(encoding="utf-8")
            for name in re.findall(r'<img[^>]*src="([^"]+)"', text):
                assert name.startswith("data:") or (page.parent / name).exists(), (page, name)


def test_no_picture_is_larger_than_its_other_format(site):
    for picture in (site / "id" / "_images").glob("*.webp"):
        assert picture.stat().st_size > 0 and not picture.with_suffix(".png").exists()


def test_no_script_keeps_a_page_from_its_text(site):
    """But the one that chooses the theme; the others are fetched at once and run at the end, in
    the order of before."""
    for language in ("id", "en"):
        for page in (site / language / "notebooks").glob("*.html"):
            head, _, body = page.read_text(encoding="utf-8").partition("</head>")
            (theme,) = re.findall(r'<script src="([^"]+)"', head)
            assert "/start.js" in theme and head.index("all.css") < head.index(theme)
            hints = re.findall(r'<link rel="preload" as="script" href="([^"]+)">', head)
            assert len(hints) > 4 and hints == re.findall(r'<script src="([^"]+)"', body)
            assert "/book.js" in hints[-2] and "/offline.js" in hints[-1]
