"""The archive that a reader takes home: it says how it runs, and its links lead somewhere."""

import json
import re
import zipfile
from pathlib import PurePosixPath

import pytest

NAMES = {"id": "filter-kalman", "en": "kalman-filter"}
LINK = re.compile(r"\]\(((?!https?:|mailto:|attachment:|#)[^)#\s]+)")


@pytest.fixture(params=NAMES, scope="module")
def archive(request, site):
    top = NAMES[request.param]
    with zipfile.ZipFile(site / request.param / f"{top}.zip") as opened:
        yield request.param, top, opened


def test_its_readme_says_in_one_language_how_it_runs(archive):
    language, top, opened = archive
    text = opened.read(f"{top}/README.md").decode()
    commands = re.search(r"```bash\n(.*?)```", text, re.DOTALL)[1].splitlines()
    assert len(commands) == 2 and '-e ".[notebook]"' in commands[0] and "{{" not in text
    assert ("Buku catatan" in text) == (language == "id")
    assert ("The notebooks" in text) == (language == "en")


def test_every_link_in_it_leads_to_something_in_it(archive):
    _, top, opened = archive
    names = set(opened.namelist())
    checked = 0
    for name in names:
        if name.endswith(".ipynb"):
            cells = json.loads(opened.read(name))["cells"]
            prose = ["".join(c["source"]) for c in cells if c["cell_type"] == "markdown"]
        elif name.endswith("README.md"):
            prose = [opened.read(name).decode()]
        else:
            continue
        for address in LINK.findall("\n".join(prose)):
            parts = []
            for part in (PurePosixPath(name).parent / address).parts:
                parts = parts[:-1] if part == ".." else [*parts, part]
            there = "/".join(parts)
            assert any(other == there or other.startswith(f"{there}/") for other in names), (
                name,
                address,
            )
            checked += 1
    assert checked > 20
