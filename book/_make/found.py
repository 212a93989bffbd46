"""What search engines, hosts and lost readers ask for: sitemap, robots, the page 404."""

from xml.sax.saxutils import escape

from edition import edition
from kept import plain_page
from places import SITE

NOT_LISTED = {"index.html", "search.html", "genindex.html"}
NOT_LISTED_FOLDERS = {"slides", "embed"}  # they say what a chapter says


def write_found(page):
    """page: where the book begins. The sitemap needs the address of the site, 404 its path."""
    address = edition()["address"].rstrip("/")
    (SITE / ".nojekyll").write_bytes(b"")
    root = f"{address}/" if address else "/"
    (SITE / "404.html").write_text(plain_page("404.html", page=page, root=root), encoding="utf-8")
    robots = "User-agent: *\nAllow: /\n"
    if address:
        robots += f"Sitemap: {address}/sitemap.xml\n"
        (SITE / "sitemap.xml").write_text(sitemap(address), encoding="utf-8")
    (SITE / "robots.txt").write_text(robots, encoding="utf-8")


def sitemap(address):
    """Every page with its twin in the other language."""
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9"'
        ' xmlns:xhtml="http://www.w3.org/1999/xhtml">',
    ]
    for page in sorted((SITE / "id").rglob("*.html")):
        if page.name in NOT_LISTED or page.parent.name in NOT_LISTED_FOLDERS:
            continue
        name = page.relative_to(SITE / "id").as_posix()
        twins = "".join(
            f'<xhtml:link rel="alternate" hreflang="{code}" '
            f'href="{escape(f"{address}/{code}/{name}")}"/>'
            for code in ("id", "en")
        )
        lines += [
            f"<url><loc>{escape(f'{address}/{code}/{name}')}</loc>{twins}</url>"
            for code in ("id", "en")
        ]
    return "\n".join([*lines, "</urlset>\n"])
