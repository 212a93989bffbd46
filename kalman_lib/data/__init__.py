"""Readers' files: tables and recordings in, workbooks out. Imports nothing else of ours.

A table goes through `read_table`, the sensors of a phone through `read_recording`. What cannot be
understood raises InputError, one sentence in each language; what was assumed or left out is told in
the notes of the result.

    errors.py       InputError
    table.py        read_table, Table; served by these, in this order:
    sources.py      a path, bytes or a text -> what kind of file it is
    limits.py       how much is read
    sheets.py       an Excel workbook, an archive of texts -> grids of cells; XML: openxml.py
    lists.py        a list as programs write it -> its cells
    grid.py         a text -> its cells; which way of parting it is right: readings.py
    block.py        where in a grid the table is, with its header
    build.py        its columns -> values; the decimal sign: decimals.py
    cells.py        one cell: a number, a gap, or neither
    clock.py        dates and clock times -> seconds
    units.py        the words of a header
    roles.py        which column is the time, which one was measured
    missing.py      numbers that stand for a gap
    notes.py        what was understood, in words
    series.py       two columns -> times in seconds and measurements
    workbook.py     write_workbook; how it looks: workbook_parts.py, what it says: workbook_words.py

    recording.py    Recording, read_recording, rest_seconds; served by these, in this order:
    archives.py     files, folders and archives -> tables; with sheets.py it shares zips.py
    csvs.py         a table -> Sheet, numbers under headers
    columns.py      a header -> which sensor, axis and unit
    signals.py      sheets -> signals, one a sensor
    sensors.py      is everything there, with units that make sense?
    axes.py         the sensors' axes -> forward, right, down
    dip.py          is the angle between gravity and field the same in every pose?
    xls.py          old Excel workbooks (xlrd)
    resample.py     signals -> values at the times of the gyroscope
    angles.py       roll, pitch and yaw that a device reports
    words.py        names of the sensors, notes
    ximu.py         read_ximu: the recording that comes with the book
"""

from .errors import InputError
from .recording import Recording, read_recording, rest_seconds
from .table import Table, read_table
from .workbook import write_workbook
from .ximu import read_ximu

__all__ = [
    "InputError",
    "Recording",
    "Table",
    "read_recording",
    "read_table",
    "read_ximu",
    "rest_seconds",
    "write_workbook",
]
