"""How the explorers feel, in a real browser: python tests/bench_explorers.py (or make bench).
Prints, asserts nothing.

Per explorer, at its defaults and 1280 px: milliseconds of one `input` event's filter and drawing
(median, 95 %), and from the event to the painted canvas; frames per second while a slider is
dragged, also with the page slowed down four times. (That is DevTools' slowdown: it reaches the
page's own thread, not the one that paints the canvases. What that one needs for a frame is the
last column, unslowed.)"""

import functools
import gzip
import http.server
import statistics
import subprocess
import sys
import threading
from pathlib import Path

from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parent.parent
SITE = ROOT / "_build" / "site"
sys.path.insert(0, str(ROOT / "book" / "_ext"))

# One new value per frame, as a finger gives it; the slider goes to and fro around its place.
DRAG = """async ([index, count]) => {
  const element = document.querySelectorAll('kalman-explorer')[index], { explorer } = element,
    work = [], painted = [], painting = [];
  const sliders = [...element.querySelectorAll('input[type=range]')].filter(s => s.offsetParent &&
    !s.disabled);
  const frame = () => new Promise(done => requestAnimationFrame(() => setTimeout(done))),
    now = () => performance.now();
  let time;
  const drawn = ({ detail }) => {
    const [asked, handed] = [time, now()];
    work.push(detail);
    explorer.painted().then(() => { painted.push(now() - asked); painting.push(now() - handed); });
  };
  element.scrollIntoView();
  await frame();
  element.addEventListener('explorer-drawn', drawn);
  const start = now();
  for (let i = 0; i < count; i++) {
    const slider = sliders[Math.floor(i / 30) % sliders.length],
      middle = slider.start ??= Number(slider.value);
    const turn = 2 * Math.PI * (i % 30) / 29;
    slider.value = middle + 0.08 * (slider.max - slider.min) * Math.sin(turn);
    time = now();
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await frame();
  }
  await explorer.painted();
  const seconds = (now() - start) / 1000;
  element.removeEventListener('explorer-drawn', drawn);
  explorer.reset();
  return { work: work.slice(5), painted: painted.slice(5), painting: painting.slice(5),
    rate: painted.length / seconds };
}"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


def main():
    build = [sys.executable, str(ROOT / "book" / "build.py")]
    subprocess.run(build, check=True, stdout=subprocess.DEVNULL)
    print_sizes()
    handler = functools.partial(Quiet, directory=str(SITE))
    with (
        http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server,
        sync_playwright() as playwright,
    ):
        threading.Thread(target=server.serve_forever, daemon=True).start()
        browser = playwright.chromium.launch(
            executable_path="/usr/bin/chromium",
            args=["--no-sandbox", "--disable-gpu", "--disable-quic"],
        )
        print(
            f"{'explorer':18}{'filter + drawing':>24}{'input -> painted':>18}"
            f"{'frames/s':>10}{'4x slower':>11}{'painting':>12}"
        )
        for path in sorted((SITE / "en").rglob("*.html")):
            is_again = path.parent.name in ("slides", "embed")  # what its chapter shows
            if not is_again and "<kalman-explorer" in path.read_text(encoding="utf-8"):
                name = path.relative_to(SITE).as_posix()
                time_page(browser, f"http://127.0.0.1:{server.server_port}/{name}")
        browser.close()
        server.shutdown()


def print_sizes():
    import explorers

    # as they were made: the site joins their style sheet with the others
    made = ROOT / "_build" / "work" / "en" / "_build" / "html"
    folder = made / "_static" / "vendor" / "explorers"
    sizes = {}
    for file in sorted(folder.iterdir()):
        sizes[file.name] = len(gzip.compress(file.read_bytes(), 9)) / 1000
    core = sizes.pop("core.js") + sizes.pop("core.css")
    rooms = {room: sizes.pop(f"{room}.js") for room in explorers.rooms()}
    print("gzip of what is fetched when a reader needs it:", rooms)
    print(
        f"gzip: the core {core:.1f} kB, and with one paper (of 45 kB):",
        ", ".join(f"{name.removesuffix('.js')} {core + size:.1f}" for name, size in sizes.items()),
    )


def time_page(browser, address):
    """One line for each explorer of a page."""
    window = {"width": 1280, "height": 900}
    page = browser.new_context(viewport=window, service_workers="block").new_page()
    page.goto(address)
    slow = page.context.new_cdp_session(page)
    keys = page.evaluate(
        "[...document.querySelectorAll('kalman-explorer')].map(e => e.explorer?.key)"
    )
    for index, key in enumerate(keys):
        if key is None:
            continue
        quick = page.evaluate(DRAG, [index, 240])
        slow.send("Emulation.setCPUThrottlingRate", {"rate": 4})
        throttled = page.evaluate(DRAG, [index, 240])
        slow.send("Emulation.setCPUThrottlingRate", {"rate": 1})
        work = sorted(quick["work"])
        print(
            f"{key:18}{statistics.median(work):9.2f} ms,"
            f" 95 %{work[int(0.95 * len(work))]:6.2f}"
            f"{statistics.median(quick['painted']):15.1f} ms"
            f"{quick['rate']:10.0f}{throttled['rate']:11.0f}"
            f"{statistics.median(quick['painting']):9.1f} ms"
        )
    page.context.close()


if __name__ == "__main__":
    main()
