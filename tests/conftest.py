"""What several test files share: outside programs, the built site, a real browser."""

import contextlib
import functools
import http.server
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "book" / "_ext"))

PATIENCE = 180_000  # ms; a wait ends as soon as its condition holds, this is for a busy machine
START_AGAIN = "document.querySelectorAll('kalman-explorer').forEach(e => e.explorer?.reset())"

# What Chromium leaves out. The first two are hidden pages that belong to the address bar: with them
# every window that a test opens loads three pages instead of one. The others are on Playwright's
# own list, which ours replaces.
LEFT_OUT = [
    "WebUIOmniboxPopup",
    "WebUIOmniboxAimPopup",
    "AvoidUnnecessaryBeforeUnloadCheckSync",
    "DestroyProfileOnBrowserClose",
    "HttpsUpgrades",
    "HttpsFirstBalancedModeAutoEnable",
    "MediaRouter",
    "NetworkTimeServiceQuerying",
    "OptimizationHints",
    "PaintHolding",
    "ThirdPartyStoragePartitioning",
]


def need_program(*names, install):
    """The path of the first program found. Missing: skip with one line, or fail where
    KALMAN_STRICT=1 (CI)."""
    for name in names:
        if path := shutil.which(name):
            return path
    message = f"{names[0]} is missing; install it with: {install}"
    if os.environ.get("KALMAN_STRICT") == "1":
        pytest.fail(message)
    pytest.skip(message)


@contextlib.contextmanager
def browser():
    """Debian's Chromium under Playwright."""
    from playwright.sync_api import sync_playwright

    path = need_program(
        "chromium", "chromium-browser", "google-chrome", install="apt-get install chromium"
    )
    with tempfile.TemporaryDirectory() as profile, sync_playwright() as playwright:
        started = playwright.chromium.launch(
            executable_path=path,
            args=[
                "--no-sandbox",
                "--disable-gpu",
                "--disable-quic",
                "--no-first-run",
                "--disable-background-networking",
                "--disable-component-update",
                "--disable-sync",
                f"--disk-cache-dir={profile}",
                f"--disable-features={','.join(LEFT_OUT)}",
            ],
        )
        started.new_context = patient(started.new_context)
        started.new_page = patient(started.new_page)
        yield started
        started.close()


def patient(make):
    """The browser's function that makes a context or a page, with time for a busy machine.

    Playwright waits for a function by evaluating a text, which the policy of our pages forbids; so
    it is passed by, except where a test says bypass_csp=False (test_csp.py, the walk of test_site).
    """

    @functools.wraps(make)
    def made(**options):
        context = make(**{"bypass_csp": True, **options})
        context.set_default_timeout(PATIENCE)
        return context

    return made


@pytest.fixture(scope="session")
def chromium():
    """The browser; a test opens contexts of its own (chromium.new_context)."""
    with browser() as started:
        yield started


@pytest.fixture(scope="session")
def site():
    """The built book, _build/site; built first if anything changed since (seconds, or nothing to
    do)."""
    result = subprocess.run(
        [sys.executable, str(ROOT / "book" / "build.py")], cwd=ROOT, capture_output=True, text=True
    )
    if result.returncode != 0:
        reasons = [
            line
            for line in (result.stdout + result.stderr).splitlines()
            if "WARNING" in line or "Error" in line
        ]
        pytest.fail(
            "the book does not build (python book/build.py):\n" + "\n".join(reasons[:10]),
            pytrace=False,
        )
    return ROOT / "_build" / "site"


@pytest.fixture(scope="session")
def server(site):
    """The address of the site over http, as any static server gives it."""

    class Quiet(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *args):
            pass

    class Server(http.server.ThreadingHTTPServer):
        def handle_error(self, request, address):  # a page was closed before it had everything
            pass

    with Server(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site))) as httpd:
        threading.Thread(target=httpd.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{httpd.server_port}"
        httpd.shutdown()


@pytest.fixture(scope="session")
def bases(site, server):
    """The two ways to open the book."""
    return {"http": server, "file": site.as_uri()}


def listen(page):
    """A list that takes up whatever goes wrong on a page from now on."""
    trouble = []

    def hear(message):
        if message.type == "error":
            trouble.append(message.text)

    def refuse(dialog):
        trouble.append(dialog.message)
        dialog.dismiss()

    page.on("console", hear)
    page.on("pageerror", lambda error: trouble.append(f"{error}\n{error.stack}"))
    page.on("dialog", refuse)
    return trouble


@pytest.fixture(scope="module")
def opened(site, server, chromium):
    """A page of the book -> a browser page that is ready, and what went wrong on it.

    Kept open for all tests of a file; each finds its explorers as a reader does at first.
    """
    kept, contexts = {}, []
    usual = {
        "viewport": {"width": 390, "height": 844},
        "reduced_motion": "reduce",
        "service_workers": "block",
    }

    def open_page(path, base=server, **options):
        options = {**usual, **options}
        key = (path, base, str(options))
        if key not in kept:
            context = chromium.new_context(**options)
            contexts.append(context)
            page = context.new_page()
            trouble = listen(page)
            page.goto(f"{base}/{path.relative_to(site).as_posix()}")
            page.evaluate("document.fonts.ready.then(() => true)")
            kept[key] = page, trouble
        else:
            kept[key][0].evaluate(START_AGAIN)
        return kept[key]

    yield open_page
    for context in contexts:
        context.close()


@pytest.fixture(scope="session")
def bundle(chromium, tmp_path_factory):
    """A blank page with the core and all papers, in both languages: for what the explorers
    compute."""
    import explorers

    folder = tmp_path_factory.mktemp("explorers")
    papers = explorers.bundle(folder, None)
    page = chromium.new_page()
    core, *others = explorers.scripts(papers)
    for name in (core, *explorers.rooms(), *others):
        page.add_script_tag(path=folder / f"{name}.js")
    yield page
    page.close()


@pytest.fixture(scope="session")
def laboratory(tmp_path_factory):
    """The address of pages with the explorers that read a phone's sensors: id.html, en.html."""
    import sensors_helpers

    folder = sensors_helpers.laboratory(tmp_path_factory.mktemp("sensors"))
    server = sensors_helpers.serve(folder)
    yield f"http://127.0.0.1:{server.server_port}"
    server.shutdown()


@pytest.fixture
def phone_page(chromium, laboratory):
    """The English one of these pages, in a browser that nobody else has used."""
    context = chromium.new_context(accept_downloads=True, reduced_motion="reduce")
    page = context.new_page()
    trouble = listen(page)
    page.goto(f"{laboratory}/en.html")
    yield page
    context.close()
    assert trouble == []


@pytest.fixture
def flag(tmp_path):
    """The file that makes the accident of accident.py happen, as long as it exists."""
    path = tmp_path / "flag"
    path.touch()
    return path


@pytest.fixture
def usual_ctrl_c():
    """Ctrl+C as it is at a keyboard: what a shell runs in the background does not get it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
