"""The JupyterLite that `make lite` has built: everything that it names is there."""

import hashlib
import json
import re
import sys
import urllib.parse

import pytest
from conftest import PATIENCE, ROOT
from packaging.utils import canonicalize_name

sys.path.insert(0, str(ROOT / "book" / "_make"))

import lite
from edition import edition
from first_cell import wheel_name
from places import LITE
from test_lite import NAMES
from test_offline_copy import host


def test_what_its_first_page_opens_is_there():
    links = re.findall(r'href="(lab[^"]*)"', (LITE / lite.START).read_text(encoding="utf-8"))
    assert len(links) == 2 * len(NAMES)
    for link in links:
        address = urllib.parse.urlsplit(link)
        (path,) = urllib.parse.parse_qs(address.query)["path"]
        listed = LITE / "api" / "contents" / path.split("/")[0] / "all.json"
        names = [entry["name"] for entry in json.loads(listed.read_text())["content"]]
        assert (LITE / address.path).is_file() and (LITE / "files" / path).is_file()
        assert path.split("/")[1] in names and "data" in names


def test_its_index_has_every_wheel_with_its_hash():
    index = json.loads((LITE / "pypi" / "all.json").read_text())
    assert {canonicalize_name(name) for name in index} == {"kalman-lib", *lite.WHEELS}
    files = [
        file
        for package in index.values()
        for release in package["releases"].values()
        for file in release
    ]
    for file in files:
        content = (LITE / "pypi" / file["filename"]).read_bytes()
        assert hashlib.sha256(content).hexdigest() == file["digests"]["sha256"]
    assert wheel_name(edition()["version"]) in [file["filename"] for file in files]


def test_its_settings_name_what_is_there():
    settings = json.loads((LITE / "jupyter-lite.json").read_text())["jupyter-config-data"]
    kernel = settings["litePluginSettings"][lite.KERNEL]
    for url in kernel["pipliteUrls"]:
        assert (LITE / url.partition("?")[0]).is_file()
    if "pyodideUrl" in kernel:  # a Pyodide of our own
        folder = (LITE / kernel["pyodideUrl"]).parent
        assert (folder / "pyodide-lock.json").is_file() and (folder / "pyodide.mjs").is_file()
    shown = {extension["name"] for extension in settings["federated_extensions"]}
    assert {"anywidget", "@jupyter-widgets/jupyterlab-manager"} <= shown


@pytest.mark.skipif(
    not (LITE / "static" / "pyodide").exists(), reason="no Pyodide here: make lite PYODIDE=folder"
)
def test_its_first_cell_takes_the_wheel_from_here_and_asks_nobody_else(chromium):
    context = chromium.new_context(viewport={"width": 1280, "height": 900})
    asked = []
    context.on("request", lambda request: asked.append(request.url))
    with host(LITE) as (address, _):
        page = context.new_page()
        page.goto(f"{address}/{lite.START}#en-{NAMES[0]}")
        page.locator("li:visible a").click()
        cell = page.locator(".jp-CodeCell").first
        cell.locator(".cm-content").click()
        name = wheel_name(edition()["version"])
        with context.expect_event("request", lambda request: name in request.url, timeout=PATIENCE):
            page.keyboard.press("Shift+Enter")
        context.close()
    assert [url for url in asked if not url.startswith((address, "data:", "blob:"))] == []
