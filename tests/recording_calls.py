"""A plugin of pytest that keeps what the tests of recordings hand to read_recording, and what comes
out: `python -m pytest -p recording_calls --calls FILE tests/test_recording*.py`.

So one set of small inputs drives both hosts, see test_recording_twin.py."""

import functools
import os
import pickle
from pathlib import Path

import kalman_lib.data
from kalman_lib.data import InputError, rest_seconds
from kalman_lib.data.archives import _read_paths

MOST_BYTES = 2_000_000  # of one input: what is huge has a test of its own
calls = []


def named(files):
    """{name: bytes} of what read_recording takes; None: there are no such files, or huge ones."""
    if not isinstance(files, dict):
        try:
            files = _read_paths([files] if isinstance(files, (str, Path)) else files)
        except InputError:
            return None
    files = {name: bytes(content) for name, content in files.items()}
    return files if sum(map(len, files.values())) <= MOST_BYTES else None


def keeping(read):
    @functools.wraps(read)
    def kept(files, axes=None):
        given = named(files)
        try:
            found = read(files, axes)
        except InputError as error:
            remember(given, axes, {"error": [error.id, error.en]})
            raise
        remember(given, axes, answer(found))
        return found

    return kept


def remember(files, axes, found):
    if files is not None:
        test = os.environ["PYTEST_CURRENT_TEST"].partition("::")[2].partition("[")[0].split()[0]
        calls.append({"files": files, "axes": axes, "found": found, "test": test})


def answer(found):
    """A Recording as the page gives it."""
    arrays = {name: getattr(found, name) for name in ("t", "gyr", "acc", "mag", "reference")}
    lists = {
        name: None if values is None else values.ravel().tolist() for name, values in arrays.items()
    }
    notes = [[note["id"], note["en"]] for note in found.notes]
    return {**lists, "rate": float(found.rate), "rest_s": rest_seconds(found), "notes": notes}


def pytest_addoption(parser):
    parser.addoption("--calls")


def pytest_configure(config):
    kalman_lib.data.read_recording = keeping(kalman_lib.data.read_recording)


def pytest_sessionfinish(session):
    Path(session.config.getoption("--calls")).write_bytes(pickle.dumps(calls))
