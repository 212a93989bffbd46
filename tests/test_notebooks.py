"""What every chapter and page owes its readers: two languages that say the same, short code,
figures that are described."""

import json
import re
from pathlib import Path
from statistics import median

import pytest

ROOT = Path(__file__).resolve().parent.parent
NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
CHAPTERS = [path for path in NOTEBOOKS if not path.stem.endswith("_deeper")]
PAGES = sorted((ROOT / "book").glob("*.md"))
EXPLORER = re.compile(r"^explore\(.*\)$")
SLIDER = re.compile(r"^@interact\(", re.MULTILINE)


def cells(path):
    return json.loads(path.read_text(encoding="utf-8"))["cells"]


def code_cells(path):
    return [cell for cell in cells(path) if cell["cell_type"] == "code"]


def tags(cell):
    return cell["metadata"].get("tags", [])


def text(cell):
    return "".join(cell["source"])


def pairs(path):
    """[(Indonesian text, English text)] of a notebook or of a Markdown page."""
    if path.suffix == ".ipynb":
        prose = [cell for cell in cells(path) if cell["cell_type"] == "markdown"]
        return [(text(a), text(b)) for a, b in zip(prose[::2], prose[1::2])]
    blocks = re.split(r"^\+\+\+.*$", path.read_text(encoding="utf-8"), flags=re.MULTILINE)[1:]
    return list(zip(blocks[::2], blocks[1::2]))


def plain(markdown):
    """Without code, mathematics, links' addresses and roles: the words alone."""
    return re.sub(
        r"```.*?```|\$\$.*?\$\$|\$[^$]*\$|`[^`]*`|\{\w+\}|\]\([^)]*\)|<[^>]*>",
        " ",
        markdown,
        flags=re.DOTALL,
    )


def skeleton(markdown):
    """What both languages must share: heading levels, equations, citations, links, exercises, list
    items, code."""
    maths = re.findall(r"\$\$.+?\$\$|\$[^$\n]+\$", markdown, flags=re.DOTALL)
    return {
        "headings": [
            len(level)
            for level in re.findall(
                r"^(#+) ", re.sub(r"```.*?```", "", markdown, flags=re.DOTALL), flags=re.MULTILINE
            )
        ],
        "equations": sorted(
            re.sub(
                r"\s+",
                "",
                m.replace("{,}", ".").replace(r",\;", ",").replace(r";\\", ",\\").replace(";", ","),
            )
            for m in maths
        ),
        "citations": sorted(re.findall(r"\{cite\}`([^`]+)`", markdown)),
        "links": sorted(
            re.sub(r"(filter-kalman|kalman-filter)\.zip", "zip", link)
            for link in re.findall(r'\]\(([^)]+)\)|href="([^"]+)"', markdown)
            for link in link
            if link
        ),
        "exercises": len(
            re.findall(r"^\*\*(?:Latihan|Exercise) \d+", markdown, flags=re.MULTILINE)
        ),
        "items": len(re.findall(r"^\s*(?:[-*]|\d+\.) ", markdown, flags=re.MULTILINE)),
        "rows": len(re.findall(r"^\|", markdown, flags=re.MULTILINE)),
        "code": re.findall(r"^```bash\n(.*?)```", markdown, flags=re.DOTALL | re.MULTILINE),
    }


def test_there_are_chapters_and_pages():
    assert len(NOTEBOOKS) >= 2 and len(PAGES) >= 6


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_prose_comes_in_pairs_indonesian_first(path):
    languages = []
    for cell in cells(path):
        mine = [tag for tag in tags(cell) if tag.startswith("lang-")]
        assert len(mine) == (cell["cell_type"] == "markdown"), text(cell)[:60]
        languages += mine if mine else [None]
    for first, second in zip([None] + languages, languages + [None]):
        assert (first == "lang-id") == (second == "lang-en")


@pytest.mark.parametrize("path", NOTEBOOKS + PAGES, ids=lambda path: path.stem)
def test_both_languages_have_the_same_skeleton(path):
    assert pairs(path)
    for indonesian, english in pairs(path):
        a, b = skeleton(indonesian), skeleton(english)
        for part in a:
            assert a[part] == b[part], f"{part} of: {indonesian.strip()[:70]}"


@pytest.mark.parametrize(
    "path",
    [path for path in NOTEBOOKS + PAGES if path.stem != "glossary"],  # it quotes other terms
    ids=lambda path: path.stem,
)
def test_indonesian_speaks_to_us_in_the_book_s_own_terms(path):
    unwanted = (
        r"\b(anda|kamu|saya|standar deviasi|deviasi standar|kovarian|varian|penapis|tapis|taksiran"
        r"|dimana|merubah)\b"
    )
    for indonesian, english in pairs(path):
        found = re.findall(unwanted, plain(indonesian), flags=re.IGNORECASE)
        assert not found, f"{found} in: {indonesian.strip()[:70]}"
        assert not re.search(r"\b(yang|dengan|untuk|adalah|kita)\b", plain(english)), english[:70]
        assert not re.search(r"\b(the|which|with|because)\b", plain(indonesian)), indonesian[:70]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_code_cells_are_short(path):
    lengths = [len(text(cell).splitlines()) for cell in code_cells(path)]
    assert max(lengths) <= 12
    assert median(lengths) <= 9  # of 76 characters: as much as six lines of the width before


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_every_figure_is_described_in_both_languages(path):
    figures = 0
    for cell in code_cells(path):
        data = [output.get("data", {}) for output in cell["outputs"]]
        if any(
            "image/png" in d or "kalman-explorer" in "".join(d.get("text/html", "")) for d in data
        ):
            figures += 1
            for words in (cell["metadata"]["book"]["alt"], cell["metadata"]["book"]["caption"]):
                assert set(words) == {"id", "en"} and words["id"] != words["en"]
                assert min(len(words["id"]), len(words["en"])) > 30
    assert figures >= 3


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_only_live_widgets_skip_the_comparison(path):
    for cell in code_cells(path):
        skips = {"nbval-ignore-output", "nbval-skip", "raises-exception"} & set(tags(cell))
        is_live = bool(EXPLORER.search(text(cell)) or SLIDER.search(text(cell)))
        assert bool(skips) == is_live, text(cell)
        assert "NBVAL" not in text(cell) and skips <= {"nbval-ignore-output"}
        if EXPLORER.search(text(cell)):
            assert len(text(cell).splitlines()) == 1  # nothing else hides behind the explorer


@pytest.mark.parametrize("path", CHAPTERS, ids=lambda path: path.stem)
def test_one_visible_cell_with_a_slider_that_the_reader_can_change(path):
    (cell,) = [cell for cell in code_cells(path) if SLIDER.search(text(cell))]
    assert not {"hide-input", "hide-cell"} & set(tags(cell))
    lines = text(cell).splitlines()
    assert len(lines) <= 10 and max(map(len, lines)) <= 76 and "def " in text(cell)
    assert any(
        "image/png" in output["data"] for output in cell["outputs"]
    )  # on paper: what it draws first


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_outputs_are_stored_in_order_and_without_machine_traces(path):
    content = path.read_text(encoding="utf-8")
    counts = [cell["execution_count"] for cell in code_cells(path)]
    assert counts == list(range(1, len(counts) + 1))
    assert not any(
        output["output_type"] == "error" or output.get("name") == "stderr"
        for cell in code_cells(path)
        for output in cell["outputs"]
    )
    assert not re.search(r"/home/|/root/|/tmp/|/Users/|C:\\\\", content)
    assert '"widgets"' not in content and "widget-view+json" not in content


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_random_numbers_have_a_seed(path):
    for cell in code_cells(path):
        assert not re.search(r"default_rng\(\s*\)|np\.random\.(?!default_rng)", text(cell)), text(
            cell
        )


def exercises(path):
    """The cells that ask check()."""
    return [cell for cell in code_cells(path) if "exercise" in tags(cell)]


WITH_EXERCISES = [path for path in NOTEBOOKS if exercises(path) or path in CHAPTERS]


@pytest.mark.parametrize("path", WITH_EXERCISES, ids=lambda path: path.stem)
def test_at_least_six_exercises_of_every_kind_answer(path):
    kinds = [cell["metadata"]["book"]["exercise"]["kind"] for cell in exercises(path)]
    assert len(kinds) == sum(skeleton(english)["exercises"] for _, english in pairs(path))
    if path in CHAPTERS:
        assert len(kinds) >= 6 and set(kinds) == {"number", "choice", "code"}
        code = "\n".join(text(cell) for cell in code_cells(path))
        assert re.search("^from kalman_lib.exercises import check$", code, re.MULTILINE)


@pytest.mark.parametrize("path", WITH_EXERCISES, ids=lambda path: path.stem)
def test_an_exercise_waits_for_its_answer_and_a_proof_stands_behind_it(path):
    after_exercise = False
    for cell in cells(path):
        if "exercise" in tags(cell):
            assert re.fullmatch(r'check\("\d+\.\d+", \.\.\.\)', text(cell))
            assert cell["outputs"] == []
        if "proof" in tags(cell):
            assert after_exercise, "a proof stands directly after its exercise"
            assert "hide-cell" in tags(cell) and "assert " in text(cell)
            assert cell["metadata"]["jupyter"] == {"source_hidden": True, "outputs_hidden": True}
        after_exercise = "exercise" in tags(cell)


def test_every_citation_is_used_and_known():
    known = set(
        re.findall(
            r"^@\w+\{(\w+),",
            (ROOT / "book/references.bib").read_text(encoding="utf-8"),
            re.MULTILINE,
        )
    )
    used = {
        key
        for path in NOTEBOOKS + PAGES
        for _, english in pairs(path)
        for keys in skeleton(english)["citations"]
        for key in keys.split(",")
    }
    assert used == known
