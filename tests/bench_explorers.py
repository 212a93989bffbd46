"""How the explorers feel, in a real browser: python tests/bench_explorers.py (or make bench). Prints, asserts nothing.

Per explorer, at its defaults and 1280 px: milliseconds of one `input` event's filter and redraw (median, 95 %), and from the
event to the painted frame; frames per second while a slider is dragged with the processor slowed down four times.
"""
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

# One new value per painted frame, as a finger gives it; the slider goes to and fro around its place.
DRAG = """async ([index, count]) => {
  const element = document.querySelectorAll('kalman-explorer')[index], sliders = [...element.querySelectorAll('input[type=range]')].filter(s => s.offsetParent && !s.disabled);
  const frame = () => new Promise(done => requestAnimationFrame(done)), work = [], painted = [];
  element.scrollIntoView();
  element.addEventListener('explorer-drawn', event => work.push(event.detail));
  await frame();
  const start = performance.now();
  for (let i = 0; i < count; i++) {
    const slider = sliders[Math.floor(i / 30) % sliders.length], middle = slider.start ??= Number(slider.value);
    const reach = 0.08 * (slider.max - slider.min);
    slider.value = middle + reach * Math.sin(2 * Math.PI * (i % 30) / 29);
    const time = performance.now();
    slider.dispatchEvent(new Event('input', { bubbles: true }));
    await frame();
    const channel = new MessageChannel(), after = new Promise(done => { channel.port1.onmessage = done; });
    channel.port2.postMessage(0);
    await after;                                // the frame is handed over
    painted.push(performance.now() - time);
  }
  const seconds = (performance.now() - start) / 1000;
  element.explorer.reset();
  return { work: work.slice(5), painted: painted.slice(5), rate: count / seconds };
}"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


def main():
    subprocess.run([sys.executable, str(ROOT / "book" / "build.py")], check=True, stdout=subprocess.DEVNULL)
    folder = SITE / "en" / "_static" / "vendor" / "explorers"
    sizes = {file.name: len(gzip.compress(file.read_bytes(), 9)) for file in sorted(folder.iterdir())}
    print("gzip:", ", ".join(f"{name} {size / 1000:.1f} kB" for name, size in sizes.items()), f"(together {sum(sizes.values()) / 1000:.1f} of 60 kB)")
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(SITE))) as server, sync_playwright() as playwright:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        browser = playwright.chromium.launch(executable_path="/usr/bin/chromium", args=["--no-sandbox", "--disable-gpu", "--disable-quic"])
        print(f"{'explorer':18}{'filter + redraw':>24}{'input -> frame':>18}{'frames/s':>10}{'4x slower':>11}")
        for path in sorted((SITE / "en").rglob("*.html")):
            if "<kalman-explorer" not in path.read_text(encoding="utf-8"):
                continue
            page = browser.new_context(viewport={"width": 1280, "height": 900}, service_workers="block").new_page()
            page.goto(f"http://127.0.0.1:{server.server_port}/{path.relative_to(SITE).as_posix()}")
            slow = page.context.new_cdp_session(page)
            for index, key in enumerate(page.evaluate("[...document.querySelectorAll('kalman-explorer')].map(e => e.explorer?.key)")):
                if key is None:
                    continue
                quick = page.evaluate(DRAG, [index, 240])
                slow.send("Emulation.setCPUThrottlingRate", {"rate": 4})
                throttled = page.evaluate(DRAG, [index, 240])
                slow.send("Emulation.setCPUThrottlingRate", {"rate": 1})
                work = sorted(quick["work"])
                print(f"{key:18}{statistics.median(work):9.2f} ms, 95 %{work[int(0.95 * len(work))]:6.2f}{statistics.median(quick['painted']):15.1f} ms"
                      f"{quick['rate']:10.0f}{throttled['rate']:11.0f}")
            page.context.close()
        browser.close()
        server.shutdown()


if __name__ == "__main__":
    main()
