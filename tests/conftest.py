"""What several test files share: outside programs, the built site, a real browser."""
import os
import shutil
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent


def need_program(*names, install):
    """The path of the first program found. Missing: skip with one line, or fail where KALMAN_STRICT=1 (CI)."""
    for name in names:
        if path := shutil.which(name):
            return path
    message = f"{names[0]} is missing; install it with: {install}"
    if os.environ.get("KALMAN_STRICT") == "1":
        pytest.fail(message)
    pytest.skip(message)


@pytest.fixture(scope="session")
def chromium():
    """Debian's Chromium under Playwright; a test opens contexts of its own (chromium.new_context)."""
    from playwright.sync_api import sync_playwright
    path = need_program("chromium", "chromium-browser", "google-chrome", install="apt-get install chromium")
    with tempfile.TemporaryDirectory() as profile, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=[
            "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
            "--disable-component-update", "--disable-sync", f"--disk-cache-dir={profile}"])
        yield browser
        browser.close()
