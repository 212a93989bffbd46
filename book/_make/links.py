"""Follow every link that leads out of the built site, and say which lead nowhere.

Needs the built book (make book) and a network. A host that refuses programs (401, 403, 429) is
only told: a person may still open the page.
"""

import html
import re
import sys
import urllib.error
import urllib.request
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SITE = Path(__file__).resolve().parent.parent.parent / "_build" / "site"
LINK = re.compile(r'<a\b[^>]*href="(https?://[^"#]+)')
REFUSES_PROGRAMS = {401, 403, 429}
PATIENCE = 30  # s


def links_of(site):
    """{address: a page that holds it}"""
    found = {}
    for page in sorted(site.rglob("*.html")):
        for address in LINK.findall(page.read_text(encoding="utf-8")):
            found.setdefault(html.unescape(address), page.relative_to(site).as_posix())
    return found


def answer(address):
    """None if the page is there, or what is wrong with it."""
    request = urllib.request.Request(address, headers={"User-Agent": "Mozilla/5.0"})
    try:
        with urllib.request.urlopen(request, timeout=PATIENCE):
            return None
    except urllib.error.HTTPError as error:
        return f"{error.code}"
    except (urllib.error.URLError, TimeoutError, OSError) as error:
        return str(error)


def main():
    if not (SITE / "index.html").exists():
        sys.exit("There is no built book: make book")
    links = links_of(SITE)
    with ThreadPoolExecutor(8) as pool:
        answers = dict(zip(links, pool.map(answer, links)))
    wrong = {address: said for address, said in answers.items() if said}
    for address, said in wrong.items():
        print(f"{said}: {address} (in {links[address]})")
    lost = [said for said in wrong.values() if said not in map(str, REFUSES_PROGRAMS)]
    print(f"{len(links)} links, {len(lost)} lead nowhere.")
    sys.exit(bool(lost))


if __name__ == "__main__":
    main()
