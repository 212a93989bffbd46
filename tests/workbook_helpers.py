"""Workbooks for the tests, and LibreOffice, which computes them."""

import io
import subprocess
from pathlib import Path

import numpy as np
from conftest import need_program
from openpyxl import Workbook

from kalman_lib.data.workbook_parts import FIRST
from kalman_lib.papers import smoother

nan = np.nan

INDONESIAN = """<?xml version="1.0" encoding="UTF-8"?>
<oor:items xmlns:oor="http://openoffice.org/2001/registry">
<item oor:path="/org.openoffice.Setup/L10N">
<prop oor:name="ooSetupSystemLocale" oor:op="fuse"><value>id-ID</value></prop></item>
</oor:items>"""


def libreoffice(profile, kind, out, files):
    """Convert the files in one call, with Indonesian settings; a second try, as two starts at once
    may collide."""
    soffice = need_program("soffice", "libreoffice", install="apt-get install libreoffice-calc")
    (profile / "user").mkdir(parents=True, exist_ok=True)
    if not (profile / "user/registrymodifications.xcu").exists():
        (profile / "user/registrymodifications.xcu").write_text(INDONESIAN)
    command = [
        soffice,
        f"-env:UserInstallation={profile.as_uri()}",
        "--headless",
        "--convert-to",
        kind,
        "--outdir",
        str(out),
        *map(str, files),
    ]
    for _ in range(2):
        result = subprocess.run(command, capture_output=True, text=True, timeout=300)
        if all(
            (out / Path(file).with_suffix("." + kind[:4].rstrip(":")).name).exists()
            for file in files
        ):
            return
    raise AssertionError(result.stderr)


def gappy(seed, T, scale=1.0):
    """A random walk with a tenth of its values missing, and a run of gaps at the start."""
    rng = np.random.default_rng(seed)
    z = scale * np.cumsum(rng.normal(size=T)) + scale * rng.normal(size=T)
    z[rng.random(T) < 0.1] = nan
    z[:2] = nan
    return z


CASES = {  # name: (z, Q, R, x0, P0)
    "paper": (smoother.MEASURED, 1e-5, 1e-5, 0, 1),
    "gaps": (gappy(1, 300), 0.7, 2.3, -1.5, 10),
    "full": (np.random.default_rng(2).normal(size=200), 1e-3, 1, 0.25, 4),
    "small_ratio": (gappy(3, 200), 1e-12, 1, 0, 1),
    "large_ratio": (gappy(4, 200), 1, 1e-12, 0, 1),
    "tiny_units": (gappy(5, 100, 1e-9), 1e-18, 3e-18, 0, 1e-18),
    "huge_units": (gappy(6, 100, 1e9), 1e18, 3e18, 1e9, 1e18),
    "still": (gappy(7, 100), 0, 1, 0, 5),
    "known": (gappy(8, 50), 0, 1, 0.5, 0),
    "one": (np.array([2.0]), 1, 1, 0, 1),
    "nothing": (np.full(5, nan), 1, 1, 3, 1),
    "long": (gappy(9, 20_000), 0.1, 4, 0, 1),
    "changed": (smoother.MEASURED, 1e-5, 1e-3, 0, 1),  # R is changed in the sheet, from 1e-5
}
NAMES = [
    "=1+1",
    "+1+1",
    "-1+1",
    "@SUM(1)",
    "\t=1+1",
    "\r=1+1",
    '=HYPERLINK("http://x")',
    "=cmd|' /C calc'!A0",
]


def table(sheet, columns):
    """The numbers of a sheet, (columns, T); an empty cell or text is NaN."""
    rows = sheet.iter_rows(min_row=FIRST, max_col=columns, values_only=True)
    return np.array([[x if isinstance(x, (int, float)) else nan for x in row] for row in rows]).T


def xlsx(*sheets):
    """A workbook with these sheets, each a list of rows -> bytes."""
    book = Workbook()
    book.remove(book.active)
    for k, rows in enumerate(sheets, start=1):
        sheet = book.create_sheet(f"Data {k}")
        for row in rows:
            sheet.append(row)
    target = io.BytesIO()
    book.save(target)
    return target.getvalue()
