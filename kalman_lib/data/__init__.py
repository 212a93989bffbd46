"""Readers' files: tables and recordings in, workbooks out. Imports nothing else of ours.

A table (one column of time, some of numbers) goes through `read_text` or `read_file`, the sensors
of a phone through `read_recording`. What cannot be understood raises InputError, one sentence in
each language; what was assumed or left out is told in the result.

    errors.py       InputError
    cells.py        one cell: a number, a gap, or neither
    grid.py         a text -> its cells
    sheets.py       an Excel workbook -> its cells (openpyxl)
    table.py        Table, read_text, read_file, read_sheets
    workbook.py     write_workbook; how it looks: workbook_parts.py, what it says: workbook_words.py

    recording.py    Recording, read_recording, rest_seconds; served by these, in this order:
    archives.py     files, folders and archives -> tables
    csvs.py         a table -> Sheet, numbers under headers
    columns.py      a header -> which sensor, axis and unit
    signals.py      sheets -> signals, one a sensor
    sensors.py      is everything there, with units that make sense?
    resample.py     signals -> values at the times of the gyroscope
    angles.py       roll, pitch and yaw that a device reports
    words.py        names of the sensors, notes
    ximu.py         read_ximu: the recording that comes with the book
"""

from .errors import InputError
from .recording import Recording, read_recording, rest_seconds
from .table import Table, read_file, read_sheets, read_text
from .workbook import write_workbook
from .ximu import read_ximu

__all__ = [
    "InputError",
    "Recording",
    "Table",
    "read_file",
    "read_recording",
    "read_sheets",
    "read_text",
    "read_ximu",
    "rest_seconds",
    "write_workbook",
]
