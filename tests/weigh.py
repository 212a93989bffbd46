"""What a phone fetches to show a page for the first time: a host that packs, and a browser."""

import contextlib
import functools
import gzip
import http.server
import threading
from pathlib import Path

PHONE = dict(
    viewport={"width": 390, "height": 844}, is_mobile=True, has_touch=True, device_scale_factor=2
)
TEXT, CHAPTER = 180_000, 320_000  # bytes at the first view of a page, packed
PACKED = (".html", ".css", ".js", ".svg", ".webmanifest")
SHIFTS = """
  window.shifted = 0;
  const count = e => { if (!e.hadRecentInput) shifted += e.value; };
  const add = list => list.getEntries().forEach(count);
  new PerformanceObserver(add).observe({ type: 'layout-shift', buffered: true });"""

SLOW_4G = {  # as Lighthouse has it: bytes a second, ms
    "offline": False,
    "latency": 562.5,
    "downloadThroughput": 184_320,
    "uploadThroughput": 84_375,
}
SLOW_CPU = 4  # times slower
LARGEST = """
  window.largest = 0;
  const last = list => list.getEntries().forEach(e => { largest = e.startTime; });
  new PerformanceObserver(last).observe({ type: 'largest-contentful-paint', buffered: true });"""


class Packing(http.server.SimpleHTTPRequestHandler):
    """A static host that sends texts packed with gzip, as hosts do."""

    def do_GET(self):
        path = Path(self.translate_path(self.path.partition("?")[0]))
        if not path.is_file():
            return self.send_error(404)
        content = path.read_bytes()
        self.send_response(200)
        self.send_header("Content-Type", self.guess_type(path))
        if path.suffix in PACKED:
            content = gzip.compress(content, 9)
            self.send_header("Content-Encoding", "gzip")
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def log_message(self, *arguments):
        pass


@contextlib.contextmanager
def packing_host(folder):
    handler = functools.partial(Packing, directory=str(folder))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@contextlib.contextmanager
def never_there(browser, watching):
    """(page, its DevTools) of a phone that knows nothing yet, where a script watches."""
    context = browser.new_context(service_workers="block", **PHONE)
    page = context.new_page()
    page.add_init_script(watching)
    devtools = context.new_cdp_session(page)
    devtools.send("Network.enable")
    yield page, devtools
    context.close()


def first_view(browser, address):
    """(bytes, requests, shift of the layout) of a page in a browser that was never there."""
    fetched = []
    with never_there(browser, SHIFTS) as (page, devtools):
        devtools.on(
            "Network.loadingFinished", lambda event: fetched.append(event["encodedDataLength"])
        )
        page.goto(address, wait_until="networkidle")
        page.evaluate("document.fonts.ready.then(() => true)")
        shifted = page.evaluate("shifted")
    return sum(fetched), len(fetched), shifted


def largest_paint(browser, address):
    """ms until the largest thing of the first screen is painted (LCP), at slow 4G and 4x CPU."""
    with never_there(browser, LARGEST) as (page, devtools):
        devtools.send("Network.emulateNetworkConditions", SLOW_4G)
        devtools.send("Emulation.setCPUThrottlingRate", {"rate": SLOW_CPU})
        page.goto(address, wait_until="networkidle")
        return page.evaluate("largest")
