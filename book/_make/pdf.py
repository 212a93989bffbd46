"""One PDF a language, made from the built site by Chromium: tagged, with outline and page numbers.

python book/_make/pdf.py (make pdf) writes them into _build/pdf and puts the site together again,
with a link to the PDF on every page and in the readers' archives.
"""

import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "_ext")]
import assemble  # noqa: E402
import steady  # noqa: E402
from places import SITE  # noqa: E402
from whole import write_whole  # noqa: E402

FOOTER = (
    '<div style="width:100%;text-align:center;font:8pt sans-serif;color:#555">'
    '<span class="pageNumber"></span></div>'
)
ARGUMENTS = ["--no-sandbox", "--disable-gpu", "--allow-file-access-from-files"]


def main():
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    if not chromium:
        sys.exit("Chromium is missing; install it with: apt-get install chromium")
    if not (SITE / "index.html").exists():
        sys.exit("There is no built book: make book")
    assemble.PDFS.mkdir(exist_ok=True)
    for language, name in assemble.ZIP_NAMES.items():
        document = write_whole(language)
        try:
            print_pdf(chromium, document, assemble.PDFS / f"{name}.pdf")
        finally:
            document.unlink()
    assemble.assemble(assemble.built_pages())
    print(*sorted(assemble.PDFS.glob("*.pdf")), sep="\n")


def print_pdf(chromium, document, target):
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=ARGUMENTS)
        page = browser.new_context(java_script_enabled=False).new_page()
        page.set_default_timeout(600_000)  # ms
        page.goto(document.as_uri(), wait_until="load")
        page.pdf(
            path=target,
            tagged=True,
            outline=True,
            prefer_css_page_size=True,
            print_background=True,
            display_header_footer=True,
            header_template="<span></span>",
            footer_template=FOOTER,
        )
        browser.close()
    pack(target)


def pack(path):
    """Chromium leaves the many small parts of a tagged document as they are, and notes the minute
    in which it made them."""
    import pikepdf

    with pikepdf.open(path, allow_overwriting_input=True) as document:
        for made in ("/CreationDate", "/ModDate"):
            document.docinfo[made] = f"D:{steady.date():%Y%m%d}000000Z"
        document.save(
            path,
            deterministic_id=True,
            object_stream_mode=pikepdf.ObjectStreamMode.generate,
            recompress_flate=True,
        )


if __name__ == "__main__":
    main()
