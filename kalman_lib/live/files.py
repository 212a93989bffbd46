"""What the kernel does for an explorer: it reads recordings and writes workbooks.

Twin of book/explorers/jupyter/kernel.js, which asks. Arrays travel as buffers of float64.
"""

import io

import numpy as np

from ..data import InputError, read_recording, rest_seconds, write_workbook

XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet"


def answer(question, buffers):
    """The answer to a question of the explorer: (message, buffers).

    A mistake of the reader's is the message {"error": {id, en}}.
    """
    contents = [bytes(buffer) for buffer in buffers]
    try:
        if question.get("write") == "workbook":
            return written(question, contents)
        files = dict(zip(question["names"], contents))
        return recording(files, question.get("axes") or None)
    except InputError as error:
        return {"error": {"id": error.id, "en": error.en}}, []
    except Exception as error:  # the reader must see it, too
        return {"error": unexpected(error)}, []


def unexpected(error):
    """A mistake of ours, or of Python's: its own words are English, or both with a slash."""
    en, _, id = str(error).partition(" / ")
    return {
        "id": f"Berkas ini tidak dapat dibaca ({type(error).__name__}: {id or en}).",
        "en": f"This file cannot be read ({type(error).__name__}: {en}).",
    }


def recording(files, axes):
    """The sensors of a phone's recording; the device's own angles, if any, stand for the truth."""
    found = read_recording(files, axes)
    rest_s = rest_seconds(found)  # 0: it begins in motion
    arrays = {
        "t": found.t,
        "gyr": found.gyr,
        "acc": found.acc,
        "mag": found.mag,
        "truth": found.reference,
    }
    known = {name: values for name, values in arrays.items() if values is not None}
    note = {language: " ".join(note[language] for note in found.notes) for language in ("id", "en")}
    message = {"arrays": list(known), "rest_s": rest_s, "note": note}
    return message, [as_buffer(values) for values in known.values()]


def written(question, contents):
    """The workbook with live formulas, chart and notes, for the measurements and their settings."""
    z = np.frombuffer(contents[question["arrays"].index("z")])
    book = io.BytesIO()
    settings = {name: question[name] for name in ("Q", "R", "x0", "P0")}
    write_workbook(book, z, **settings, name=question["name"])
    return {"name": "kalman.xlsx", "type": XLSX}, [book.getvalue()]


def as_buffer(values):
    return np.ascontiguousarray(values, dtype=float).tobytes()
