"""What a phone fetches at the first view of a page, page by page: python tests/bench_pages.py (or
make bench). LCP: when its largest part is there at slow 4G and 4x CPU, of use on an idle machine.
Prints, asserts nothing; test_light.py holds the limits of bytes and CLS.
"""

from conftest import ROOT, browser
from weigh import first_view, largest_paint, packing_host

SITE = ROOT / "_build" / "site"


def main(site=SITE, languages=("id", "en")):
    print(f"{'page':46} {'kB':>6} {'requests':>8} {'CLS':>6} {'LCP s':>6}")
    with browser() as chromium, packing_host(site) as address:
        for language in languages:
            for path in sorted((site / language).rglob("*.html")):
                name = path.relative_to(site).as_posix()
                size, requests, shift = first_view(chromium, f"{address}/{name}")
                seconds = largest_paint(chromium, f"{address}/{name}") / 1000
                numbers = f"{size / 1000:6.0f} {requests:8} {shift:6.3f} {seconds:6.2f}"
                print(f"{name:46} {numbers}", flush=True)


if __name__ == "__main__":
    main()
