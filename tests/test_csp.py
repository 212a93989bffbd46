"""The content security policy: in every page, strict, and nothing in the book needs more.

Over all pages, test_site.py walks with an ear for what the browser refuses."""

import base64
import hashlib
import os
import re
import shutil
import sys

import pytest
from conftest import ROOT, listen
from weigh import packing_host

sys.path.insert(0, str(ROOT / "book" / "_make"))

import policy

META = re.compile(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">')
INSIDE = re.compile(r"<script(?![^>]*\bsrc=)[^>]*>(.*?)</script>", re.DOTALL)
HANDLER = re.compile(r"<[a-z][^<>]*\son[a-z]+\s*=", re.IGNORECASE)
WALK = {  # page: what is there when its scripts have run
    "index.html": "article",
    "404.html": "h1",
    "unkept.html": "h1",
    "en/notebooks/03_gyro.html": "kalman-explorer.live canvas",
    "en/slides/03_gyro.html": "html.ready",
    "en/embed/gyro.drift.html": "kalman-explorer.live canvas",
    "en/search.html?q=noise": "#search-results li, .search li",
    "id/search.html?q=derau": "#search-results li, .search li",
    "id/book/teaching.html": ".embed-lines pre",
}
BOTH_WORK = """async () => {
  for (const registration of await navigator.serviceWorker.getRegistrations()) {
    const worker = registration.active ?? registration.waiting ?? registration.installing;
    while (worker.state !== 'activated') {
      await new Promise(done => worker.addEventListener('statechange', done, { once: true }));
    }
  }
}"""
REFUSED = """() => {
  window.refused = [];
  document.addEventListener('securitypolicyviolation', event =>
    refused.push(`${event.violatedDirective}: ${event.blockedURI}`));
}"""


def rules(text):
    """{directive: its sources} of a policy."""
    parts = [part.split() for part in text.split(";")]
    return {name: sources for name, *sources in parts}


def all_pages(site):
    return {path: path.read_text(encoding="utf-8") for path in sorted(site.rglob("*.html"))}


# --- the files ----------------------------------------------------------------------------------


def test_every_page_holds_the_policy_before_anything_that_it_could_forbid(site):
    pages = all_pages(site)
    assert {path.parent.name for path in pages} >= {"notebooks", "book", "slides", "embed", "site"}
    for path, text in pages.items():
        (found,) = META.findall(text)
        assert found == policy.POLICY, path
        before = text[: text.index("<meta http-equiv")]
        assert not re.search(r"<(script|link|style|body|img)\b", before), path


def test_the_policy_is_strict():
    found = rules(policy.POLICY)
    scripts = found["script-src"]
    assert "'unsafe-inline'" not in scripts and "'unsafe-eval'" not in policy.POLICY
    assert "'unsafe-hashes'" not in scripts and not {"*", "https:", "http:", "data:"} & set(scripts)
    assert found["default-src"] == ["'self'", "file:"]
    assert found["worker-src"] == ["'self'", "blob:"]
    assert found["object-src"] == found["base-uri"] == ["'none'"]
    hosts = [source for sources in found.values() for source in sources if "." in source]
    assert hosts == []


def test_no_script_and_no_handler_stands_in_a_page(site):
    hashes = re.findall(r"'sha256-([^']+)'", policy.POLICY)
    seen = set()
    for path, text in all_pages(site).items():
        for script in INSIDE.findall(text):
            digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
            assert digest in hashes, (path, script[:80])
            seen.add(digest)
        assert not HANDLER.search(text), (path, HANDLER.search(text)[0])
        assert "javascript:" not in text, path
    assert seen == set(hashes)  # each belongs to a script that is there


def test_no_script_makes_code_of_a_text(site):
    for path in site.rglob("*.js"):
        text = path.read_text(encoding="utf-8")
        found = re.search(r"\beval\(|new Function\(|set(Timeout|Interval)\(\s*[\"'`]", text)
        assert not found, (path, found)


def write_page(folder, name, *scripts):
    page = folder / name
    page.parent.mkdir(parents=True, exist_ok=True)
    page.write_text("<head></head>" + "".join(f"<script>{text}</script>" for text in scripts))
    return page


def a_small_book(tmp_path, *scripts):
    static = tmp_path / "_static"
    static.mkdir()
    plural = 'f = new Function("n", `return (${catalog.plural_expr})`);'
    (static / "doctools.js").write_text(plural)
    pages = [write_page(tmp_path, name, *scripts) for name in ("book/a.html", "index.html")]
    return static, pages


def test_scripts_of_a_page_go_into_a_file_in_their_order(tmp_path):
    pagename = "DOCUMENTATION_OPTIONS.pagename = 'a';"
    static, (page, _) = a_small_book(tmp_path, "lost.storage = 1;", pagename, "let hint = 'x';")
    policy.take_out_scripts(tmp_path)
    text = page.read_text()
    assert re.findall(r"<script[^>]*>", text) == [
        re.search(r'<script src="\.\./_static/start\.js\?v=\w{8}">', text)[0]
    ]
    start = (static / "start.js").read_text()
    assert (
        start.index("try {\nlost.storage") < start.index("\nlet hint") and "pagename" not in start
    )
    assert (static / "doctools.js").read_text() == "f = () => 0;"


def test_a_script_that_we_do_not_know_stops_the_build(tmp_path):
    _, (page, _) = a_small_book(tmp_path, "let hint = 'x';")
    page.write_text(page.read_text() + "<script>somethingNew()</script>")
    with pytest.raises(SystemExit, match="somethingNew"):
        policy.take_out_scripts(tmp_path)


def test_headers_for_who_deploys(site):
    """The file for Netlify sends the policy of the pages, and the instructions say what is sent."""
    lines = (site / "_headers").read_text(encoding="utf-8").splitlines()
    assert lines[0] == "/*"
    sent = dict(line.strip().split(": ", 1) for line in lines[1:])
    assert sent == policy.HEADERS and sent["Content-Security-Policy"] == policy.POLICY
    assert "frame-ancestors" not in policy.POLICY  # bare pages stand in frames of others
    told = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for name, value in policy.HEADERS.items():
        assert f'add_header {name} "{value}" always;' in told, name


# --- in a browser -------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def subpath(site, tmp_path_factory):
    """The address of the book in a folder of a host."""
    folder = tmp_path_factory.mktemp("host")
    shutil.copytree(site, folder / "some" / "book", copy_function=os.link)
    with packing_host(folder) as address:
        yield f"{address}/some/book"


@pytest.mark.parametrize("scheme", ["folder of a host", "file"])
def test_nothing_is_refused(scheme, site, subpath, chromium):
    base = subpath if scheme != "file" else site.as_uri()
    context = chromium.new_context(service_workers="block", bypass_csp=False)
    context.add_init_script(f"({REFUSED})()")
    page = context.new_page()
    trouble = listen(page)
    for name, sign in WALK.items():
        page.goto(f"{base}/{name}")
        page.locator(sign).first.wait_for(state="attached")
        for element in page.locator("kalman-explorer.live").all():
            element.evaluate("e => Promise.all(e.explorer.plots.map(plot => plot.coming))")
            assert element.evaluate("e => e.explorer.message.hidden"), name
        assert page.evaluate("refused") == [] and trouble == [], name
    context.close()


def test_a_script_of_somebody_else_is_refused(subpath, chromium):
    page = chromium.new_page(service_workers="block", bypass_csp=False)
    page.goto(f"{subpath}/en/book/about.html")
    page.evaluate("""() => {
      const script = document.createElement('script');
      script.textContent = 'window.stolen = true';
      document.body.append(script);
      const link = document.createElement('a');
      link.setAttribute('onclick', 'window.stolen = true');
      link.click();
    }""")
    assert page.evaluate("window.stolen") is None
    page.close()


def test_what_the_menu_offers_prints_the_page(subpath, chromium):
    page = chromium.new_page(service_workers="block", bypass_csp=False)
    page.goto(f"{subpath}/en/notebooks/01_theory.html")
    page.evaluate("window.print = () => { window.printed = true }")
    page.evaluate("document.querySelector('[data-print]').click()")
    assert page.evaluate("window.printed") is True
    page.close()


def test_the_copy_without_a_network_works_under_the_policy(subpath, chromium):
    context = chromium.new_context(bypass_csp=False)
    context.add_init_script(f"({REFUSED})()")
    page = context.new_page()
    page.goto(f"{subpath}/en/book/about.html")
    page.locator(".offline-word", has_text="This book is kept").wait_for()
    page.evaluate(BOTH_WORK)
    context.set_offline(True)
    page.goto(f"{subpath}/en/notebooks/03_gyro.html")
    page.locator("kalman-explorer.live canvas").first.wait_for()
    page.goto(f"{subpath}/")
    page.wait_for_url("**/en/book/intro.html")
    assert page.evaluate("refused") == []
    context.close()
