"""The page reads recordings as Python does: everything that the tests of recordings hand to
read_recording goes to readRecording of book/explorers/files, too."""

import base64
import io
import json
import os
import pickle
import struct
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from conftest import ROOT
from recording_calls import answer
from recording_files import TILTED, phyphox

from kalman_lib.data import read_recording

SOURCES = ("", "_apps", "_found", "_refused")
ARRAYS = ("t", "gyr", "acc", "mag", "reference")
OLD_XLS = "this .xls file cannot be read here; open it and save it as .xlsx, or export a .csv."
READ = """async calls => {
  const { input, papers } = KalmanExplorers;
  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
  const plain = (_, value) => ArrayBuffer.isView(value) ? Array.from(value) : value;
  const answers = [];
  for (const [files, axes] of calls) {
    try {
      const opened = files.map(([name, text]) => ({ name, bytes: bytes(text) }));
      const { notes, ...found } = await papers.quadrotor.readRecording(opened, axes);
      answers.push({ ...found, notes: notes.map(({ id, en }) => [id, en]) });
    } catch (error) {
      if (!(error instanceof input.InputError)) throw error;
      answers.push({ error: [error.id, error.en] });
    }
  }
  return JSON.stringify(answers, plain);
}"""


@pytest.fixture(scope="module")
def calls(tmp_path_factory):
    """[{files, axes, found}, ...]: what the tests of recordings ask, and what Python answers."""
    file = tmp_path_factory.mktemp("calls") / "calls"
    tests = [f"tests/test_recording{name}.py" for name in SOURCES]
    path = os.pathsep.join([str(ROOT / "tests"), str(ROOT)])
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-p",
        "recording_calls",
        "-p",
        "no:cacheprovider",
    ]
    made = subprocess.run(
        [*command, f"--calls={file}", *tests],
        cwd=ROOT,
        env={**os.environ, "PYTHONPATH": path},
        capture_output=True,
        text=True,
    )
    assert made.returncode == 0, made.stdout[-2000:]
    return pickle.loads(file.read_bytes())


def in_the_page(bundle, calls):
    """The answers of the page: [{t, gyr, ..., notes} or {error}, ...]"""
    listed = [
        [
            [[name, base64.b64encode(content).decode()] for name, content in call["files"].items()],
            call["axes"],
        ]
        for call in calls
    ]
    return json.loads(bundle.evaluate(READ, listed))


def difference(ours, theirs):
    """What differs between the page and Python, None if nothing does."""
    if "error" in ours or "error" in theirs:
        return None if ours == theirs else (ours.get("error"), theirs.get("error"))
    for name in ARRAYS:
        values, expected = ours[name], theirs[name]
        if (values is None) != (expected is None):
            return name
        if values is not None and not np.allclose(values, expected, rtol=1e-9, atol=1e-9):
            return name
    for name in ("rate", "rest_s"):
        if ours[name] != pytest.approx(theirs[name], rel=1e-9):
            return name, ours[name], theirs[name]
    pairs = [pair for pair in zip(ours["notes"], theirs["notes"]) if pair[0] != pair[1]]
    same = len(ours["notes"]) == len(theirs["notes"])
    return None if same and not pairs else (pairs, ours["notes"][-1], theirs["notes"][-1])


def differing(bundle, calls):
    return [
        (call["test"], list(call["files"]), call["axes"], found)
        for call, answer in zip(calls, in_the_page(bundle, calls))
        if (found := difference(answer, call["found"]))
    ]


OLD_WORKBOOKS = ("test_an_old_workbook_of_phyphox", "test_a_damaged_old_workbook_is_one_sentence")
SPOILT = "test_every_archive_with_a_changed_byte_is_read_or_refused"


def test_the_page_reads_and_refuses_what_python_does(bundle, calls):
    alike = [call for call in calls if call["test"] not in (*OLD_WORKBOOKS, SPOILT)]
    assert len(alike) > 150
    assert sum("error" in call["found"] for call in alike) > 50
    assert differing(bundle, alike) == []


def test_an_old_workbook_is_refused_with_what_to_do(bundle, calls):
    old = [call for call in calls if call["test"] in OLD_WORKBOOKS]
    answers = in_the_page(bundle, old)
    assert len(old) >= 5 and all(OLD_XLS in answer["error"][1] for answer in answers)
    assert all("simpanlah sebagai .xlsx" in answer["error"][0] for answer in answers)


def test_a_spoilt_archive_is_read_or_refused(bundle, calls):
    """Which of both may differ from Python, where the byte tells only what nobody needs."""
    spoilt = [call for call in calls if call["test"] == SPOILT]
    answers = in_the_page(bundle, spoilt)
    assert len(answers) > 300
    assert all(answer.get("error") or len(answer["t"]) for answer in answers)


def test_what_unpacks_to_much_is_refused_before_it_is_unpacked(bundle):
    """Its size is told in the archive; where that is a lie, the unpacking ends in time."""
    lines = "t (s),x (rad/s)\n" + "0," + "0" * 70_000_000
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.csv", lines)
    honest = content.getvalue()
    told = struct.pack("<I", len(lines))
    lying = honest.replace(told, struct.pack("<I", 1000))
    assert lying != honest
    calls = [{"files": {"a.zip": content}, "axes": None} for content in (honest, lying)]
    errors = [answer["error"] for answer in in_the_page(bundle, calls)]
    for (id, en), size in zip(errors, (70, 60)):
        assert id == f"Berkas berisi {size} MB; batasnya 60 MB."
        assert en == f"The files hold {size} MB; the limit is 60 MB."


@pytest.mark.parametrize("axes", ["frd", "flu", "phone", "y x -z", "-z y x"])
def test_other_axes_are_those_of_python(axes, bundle):
    files = phyphox(TILTED)
    found = read_recording(files, axes)
    assert differing(bundle, [dict(files=files, axes=axes, found=answer(found), test="")]) == []


@pytest.mark.parametrize("axes", ["x y -z", "x x z", "x y", "xyz"])
def test_axes_of_no_frame_are_refused_in_a_sentence(axes, bundle):
    call = dict(files=phyphox(TILTED), axes=axes)
    (answer,) = in_the_page(bundle, [call])
    assert all(axes in text and text.endswith(".") for text in answer["error"])
