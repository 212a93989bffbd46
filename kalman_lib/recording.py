"""Recordings of a gyroscope, an accelerometer and a magnetometer: files of phone apps in, one tidy Recording out.

`read_recording` understands the exports of phyphox and Sensor Logger and a plain CSV; `read_ximu` the recording that
comes with the book; `rest_seconds` says how long a recording lies still at its start. A sensor is recognised by the
unit in its header, so the language of the header does not matter. Whatever cannot be understood raises InputError;
whatever was converted, resampled or left out is told in Recording.notes.

The body frame is forward-right-down (FRD). A phone's own axes are x to the right edge, y to the top edge and z out of
the screen; so forward = y, right = x, down = -z. The accelerometer measures specific force: at rest it points up.
"""
import csv
import gzip
import io
import re
import unicodedata
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .spreadsheet import InputError, decode, read_sheets, to_number

GRAVITY = 9.80665                           # m/s2, the standard g
MAX_ROWS, MAX_BYTES = 2_000_000, 400_000_000        # of a file, of all files
GAP = 0.1                                   # s; a longer pause is told
MAX_RATE = 60.0                             # rad/s

AXES = {"phone": np.array([[0, 1, 0], [1, 0, 0], [0, 0, -1]]), "flu": np.diag([1, -1, -1]),
        "frd": np.eye(3, dtype=int)}        # body axis = row times sensor axis
AXES_NAMES = {"phone": ("those of a phone (x right, y to the top edge, z out of the screen)",
                        "sumbu ponsel (x ke kanan, y ke tepi atas, z keluar dari layar)"),
              "flu": ("forward-left-up", "depan-kiri-atas"), "frd": ("forward-right-down", "depan-kanan-bawah")}
NAMES = {"gyr": ("gyroscope", "giroskop"), "acc": ("accelerometer", "akselerometer"),
         "linear": ("accelerometer without gravity", "akselerometer tanpa gravitasi"),
         "gravity": ("gravity sensor", "sensor gravitasi"), "mag": ("magnetometer", "magnetometer"),
         "orientation": ("orientation", "orientasi")}
UNITS = {                                   # unit as _column writes it -> (what it measures, factor to SI)
    "rad/s": ("gyr", 1.0), **dict.fromkeys(("deg/s", "°/s", "dps", "degrees/s", "degree/s"), ("gyr", np.pi / 180)),
    "m/s2": ("acc", 1.0), "m/s/s": ("acc", 1.0), "g": ("acc", GRAVITY),
    **dict.fromkeys(("μt", "ut", "nt", "mt", "t", "G", "mG", "gauss"), ("mag", 1.0)),       # any scale will do
    **dict.fromkeys(("s", "sec", "seconds"), ("time", 1.0)), "ms": ("time", 1e-3),
    "μs": ("time", 1e-6), "us": ("time", 1e-6), "ns": ("time", 1e-9),
}
ACCEPTED = "rad/s, deg/s, °/s; m/s2, m/s^2, g; s, ms, us, ns"
SENSOR_WORD = re.compile("^[ga]$|gyr|giro|acc|accel|acel|beschl|percep")     # needs a unit we know
LINEAR_WORD = re.compile(r"linear|linier|lineal|linéaire|user|(without|ohne|tanpa|sin|sans|senza|sem) g")
GRAVITY_WORD = re.compile("gravit|schwerkraft")
SENSOR_LOGGER = {"gyroscope": "gyr", "totalacceleration": "acc", "accelerometer": "linear", "gravity": "gravity",
                 "magnetometer": "mag", "orientation": "orientation"}       # file -> what is in it


@dataclass(frozen=True, eq=False)
class Recording:
    """What three sensors measured at N times, in the body frame forward-right-down (FRD).

    t (N,) s, from 0; gyr (N, 3) rad/s; acc (N, 3) m/s2, specific force: (0, 0, -9.81) at rest and level; mag (N, 3) in
    any scale, or None; rate: samples per second; notes: what was converted, resampled or left out, a list of {"en", "id"};
    reference: the device's own roll, pitch, yaw (N, 3) rad, north-east-down, or None.
    """
    t: np.ndarray
    gyr: np.ndarray
    acc: np.ndarray
    mag: np.ndarray | None
    rate: float
    notes: list
    reference: np.ndarray | None = None


class Sheet(NamedTuple):
    """A table: values (T, columns), NaN where a cell is empty; place and lines (T,) are for messages."""
    place: str
    names: list
    values: np.ndarray
    lines: np.ndarray


class Signal(NamedTuple):
    """One sensor, a key of NAMES, as recorded: t (n,) s, values (n, 3) in SI units and its own axes."""
    kind: str
    t: np.ndarray
    values: np.ndarray
    place: str
    lines: np.ndarray
    source: str             # "units", "plain" (gx, ax, mx) or "logger" (Sensor Logger)


def read_recording(files, axes=None):
    """Files of one recording -> Recording.

    files   {name: bytes}, or a path (file, .zip or folder), or a list of paths. Understood are
            phyphox         CSV, .zip of CSVs or .xlsx; headers such as "Gyroscope x (rad/s)", in any language
            Sensor Logger   .zip or its CSVs: Gyroscope, TotalAcceleration (or Accelerometer and Gravity), Magnetometer,
                            Orientation, Metadata
            a plain CSV     "t (s), gx (deg/s), gy .., ax (g), .., mx (uT), .."; the unit in the header decides
    axes    the sensors' own axes: "phone", "flu" (forward-left-up) or "frd"; None: "phone" for the apps, "frd" for a
            plain CSV

    Everything is interpolated linearly to the times of the gyroscope, over the time that all sensors cover.

    InputError: a sensor is missing, a unit is unknown or cannot be right, a cell is no number, times do not increase,
    sensors do not overlap in time, or a file is empty, too large or of another kind.
    """
    if axes not in (None, *AXES):
        raise ValueError(f"axes must be None or one of {list(AXES)}. / axes harus None atau salah satu dari itu.")
    notes, signals, device = [], {}, {}
    for name, content in _open(files).items():
        if Path(name).stem.lower() == "metadata":       # of Sensor Logger: android or ios
            device = next(csv.DictReader(io.StringIO(decode(content) or ""), restval=""), {})
            continue
        for sheet in _sheets(name, content):
            for signal in _signals(sheet, notes):
                _keep(signals, signal)
    signals = {kind: _clean(signal, notes) for kind, signal in signals.items()}
    _total_acceleration(signals, device, notes)
    _check_magnitudes(signals["gyr"], signals["acc"])
    if axes is None:
        axes = "frd" if signals["gyr"].source == "plain" else "phone"
        if axes == "frd" and signals["acc"].values[:10, 2].mean() > 5:
            _say(notes, "az is positive at the start, so the device begins upside down; if its z points up, choose the "
                 "axes flu or phone.",
                 "az positif pada awalnya, jadi alat mulai dalam keadaan terbalik; jika sumbu z-nya ke atas, pilihlah "
                 "sumbu flu atau phone.")
    _say(notes, f"Axes taken: {AXES_NAMES[axes][0]}.", f"Sumbu yang dipakai: {AXES_NAMES[axes][1]}.")
    t, columns = _resample(signals, notes)
    gyr, acc, mag = (columns[kind] @ AXES[axes].T if kind in columns else None for kind in ("gyr", "acc", "mag"))
    if mag is None:
        _say(notes, "There is no magnetometer; the heading can only be followed, not measured.",
             "Tidak ada magnetometer; arah hadap hanya dapat diikuti, tidak terukur.")
    reference = _phone_reference(columns.get("orientation"), acc, axes, device, notes)
    recording = Recording(t - t[0], gyr, acc, mag, 1 / np.median(np.diff(t)), notes, reference)
    if rest := rest_seconds(recording):
        _say(notes, f"The recording lies still for its first {rest:.2f} s.",
             f"Rekaman diam selama {rest:.2f} s pertama.")
    else:
        _say(notes, "The recording does not begin at rest; let the device lie still for some seconds first.",
             "Rekaman tidak dimulai dalam keadaan diam; biarkan alat diam beberapa detik lebih dahulu.")
    return recording


def rest_seconds(recording, window=0.25):
    """Seconds of rest at the start of a Recording, a multiple of the window; 0.0 if it does not begin at rest.

    At rest every gyroscope axis spreads by less than 0.06 rad/s and turns by less than 0.2 rad/s on average, every
    accelerometer axis spreads by less than 0.5 m/s2 and stays within 0.5 m/s2 of its first mean.
    """
    size = max(int(round(window * recording.rate)), 2)
    count = len(recording.t) // size
    if count == 0:
        return 0.0
    gyr, acc = (values[:count * size].reshape(count, size, 3) for values in (recording.gyr, recording.acc))
    still = ((gyr.std(axis=1) < 0.06) & (np.abs(gyr.mean(axis=1)) < 0.2) & (acc.std(axis=1) < 0.5)
             & (np.abs(acc.mean(axis=1) - acc[0].mean(axis=0)) < 0.5)).all(axis=1)
    windows = np.argmin([*still, False])
    return float(recording.t[windows * size - 1]) + 1 / recording.rate if windows else 0.0


def read_ximu(path):
    """The x-IMU recording of the book (notebooks/data/ximu.csv.gz) -> Recording with the device's own angles.

    12,626 samples at 256 Hz, real and unsmoothed. The device's frame is forward-left-up with angles in a world whose
    z points up; here both are turned to forward-right-down and north-east-down. Its angles come with every second
    sample (reference[::2]); those in between are interpolated. Its yaw starts anywhere: compare it without its offset.
    """
    with gzip.open(path, "rt", encoding="ascii") as file:
        table = np.genfromtxt(file, delimiter=",", skip_header=1)
    t = np.arange(len(table)) / 256
    turn = AXES["flu"]
    known = np.isfinite(table[:, 9])
    reference = _interpolate_angles(t, t[known], np.radians(table[known, 9:12]) @ turn)
    notes = []
    _say(notes, "Real data of an x-IMU; units and axes were converted, nothing was smoothed.",
         "Data nyata dari sebuah x-IMU; satuan dan sumbunya diubah, tidak ada yang dihaluskan.")
    _say(notes, "The device gives its own angles at 128 Hz; between them they are interpolated.",
         "Alat itu memberi sudutnya sendiri pada 128 Hz; di antaranya sudut itu diinterpolasi.")
    return Recording(t, np.radians(table[:, 0:3]) @ turn, GRAVITY * table[:, 3:6] @ turn, table[:, 6:9] @ turn, 256.0,
                     notes, reference)


# --- files -> sheets -------------------------------------------------------------------------------------------------

def _open(files):
    if not isinstance(files, dict):
        paths = [Path(path) for path in ([files] if isinstance(files, (str, Path)) else files)]
        for path in paths:
            if not path.exists():
                raise InputError(f"There is no file {str(path)!r}.", f"Tidak ada berkas {str(path)!r}.")
        paths = [part for path in paths for part in (sorted(path.rglob("*")) if path.is_dir() else [path])]
        paths = [path for path in paths
                 if path.is_file() and path.suffix.lower() in (".csv", ".txt", ".tsv", ".xlsx", ".xls", ".zip")]
        _check_size(sum(path.stat().st_size for path in paths))
        files = {str(path): path.read_bytes() for path in paths}
    tables = {}
    for name, content in files.items():
        if bytes(content[:2]) == b"PK" and not name.lower().endswith(".xlsx"):
            try:
                with zipfile.ZipFile(io.BytesIO(content)) as archive:
                    parts = [part for part in archive.infolist()
                             if part.filename.lower().endswith((".csv", ".txt", ".tsv"))]
                    _check_size(sum(map(len, tables.values())) + sum(part.file_size for part in parts))
                    tables |= {f"{name}/{part.filename}": archive.read(part) for part in parts}
            except (zipfile.BadZipFile, NotImplementedError, RuntimeError, OSError, zlib.error) as error:
                raise InputError(f"The archive {name!r} cannot be unpacked ({error}).",
                                 f"Arsip {name!r} tidak dapat dibuka ({error}).") from None
        else:
            tables[name] = bytes(content)
        _check_size(sum(map(len, tables.values())))
    tables = {name: content for name, content in tables.items()             # folders of phyphox and macOS
              if not {"meta", "__macosx"} & set(Path(name.lower()).parts[:-1])}
    if not tables:
        raise InputError("There is no table in the files; a .csv, .zip or .xlsx export is needed.",
                         "Tidak ada tabel dalam berkas; diperlukan ekspor .csv, .zip atau .xlsx.")
    return tables


def _check_size(size):
    if size > MAX_BYTES:
        raise InputError(f"The files hold {size // 10**6} MB; the limit is {MAX_BYTES // 10**6} MB.",
                         f"Berkas berisi {size // 10**6} MB; batasnya {MAX_BYTES // 10**6} MB.")


def _sheets(name, content):
    place = name if len(name) <= 60 else "..." + name[-57:]
    if not content.strip():
        raise _empty(place)
    if name.lower().endswith(".xlsx"):
        tables = read_sheets(name, content, skip=("Metadata Device", "Metadata Time"))      # so phyphox calls them
        return [Sheet(f"{place}, {title}", list(table.columns), np.column_stack(list(table.columns.values())),
                      table.lines) for title, table in tables.items()]
    text = decode(content) if name.lower().endswith((".csv", ".txt", ".tsv")) else None
    if text is None:
        raise InputError(f"{place}: not a .csv, .zip or .xlsx file; export the recording as one of these.",
                         f"{place}: bukan berkas .csv, .zip atau .xlsx; eksporlah rekaman sebagai salah satunya.")
    try:
        return [_read_csv(place, text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n"))]
    except csv.Error as error:
        raise InputError(f"{place}: the text is no table ({error}).",
                         f"{place}: teksnya bukan tabel ({error}).") from None


def _empty(place):
    return InputError(f"{place}: the file is empty.", f"{place}: berkasnya kosong.")


def _read_csv(place, text):
    """The text of a CSV -> Sheet; empty cells become NaN, columns of no sensor are passed over."""
    rows = text.count("\n")
    if rows > MAX_ROWS + 10:
        raise InputError(f"{place}: {rows} rows are too many; the limit is {MAX_ROWS}.",
                         f"{place}: {rows} baris terlalu banyak; batasnya {MAX_ROWS}.")
    start = re.match(r"([^\S\n]*(#.*)?\n)*", text).end()            # where the header begins
    line = text.count("\n", 0, start) + 1
    header, _, body = text[start:].partition("\n")
    header, body = header.strip(), body.rstrip()
    if header == "" or header[0] == "#":
        raise _empty(place)
    separator = next((sign for sign in "\t;," if sign in header), ",")
    names = [name.strip() for name in next(csv.reader([header], delimiter=separator, skipinitialspace=True))]
    if all(to_number(name, ".") is not None or to_number(name, ",") is not None for name in names):
        raise InputError(f"{place}, line {line}: a line with the names and units of the columns is needed above the "
                         "numbers.", f"{place}, baris {line}: diperlukan baris judul berisi nama dan satuan kolom di "
                         "atas bilangan.")
    if not body:
        raise InputError(f"{place}: there is no row below the header.", f"{place}: tidak ada baris di bawah judul.")
    wanted = [k for k, name in enumerate(names) if _column(name)[3] or name in ("roll", "pitch", "yaw")]
    comma, rows = separator != "," and "," in body, body.count("\n") + 1
    values = np.full((rows, len(names)), np.nan)
    try:
        if comma and "." in body or '"' in body or "\n\n" in body or body.count(separator) != rows * (len(names) - 1):
            raise ValueError
        with io.TextIOWrapper(io.BytesIO((body.replace(",", ".") if comma else body).encode()), encoding="utf-8") as file:
            values[:, wanted] = np.loadtxt(file, delimiter=separator, ndmin=2, comments=None, usecols=wanted)
        return Sheet(place, names, values, line + 1 + np.arange(rows))
    except ValueError:                              # not only numbers
        return _read_cells(place, names, body, separator, line, wanted)


def _read_cells(place, names, body, separator, line, wanted):
    """The same, cell by cell."""
    quoted = re.search(r'"[+-]?[0-9]+,[0-9]+([eE][+-]?[0-9]+)?"', body[:5000])
    sign = "," if separator != "," and "," in body or quoted else "."
    values, lines = [], []
    for cells in (reader := csv.reader(io.StringIO(body), delimiter=separator, skipinitialspace=separator != "\t")):
        at = line + reader.line_num
        if not any(map(str.strip, cells)):
            continue
        if len(cells) != len(names):
            raise InputError(f"{place}, line {at}: {len(cells)} cells instead of {len(names)}.",
                             f"{place}, baris {at}: {len(cells)} sel, seharusnya {len(names)}.")
        row = np.full(len(names), np.nan)
        row[wanted] = [_number(place, at, names[k], cells[k].strip(), sign) for k in wanted]
        values.append(row)
        lines.append(at)
    return Sheet(place, names, np.array(values), np.array(lines))


def _number(place, line, name, cell, sign):
    number = None if sign == "," and "." in cell else to_number(cell, sign)
    if number is None:
        en, id = ("", "") if sign == "." else (" (others have a decimal comma)", " (yang lain memakai koma desimal)")
        raise InputError(f"{place}, line {line}, column {name[:40]!r}: {cell[:40]!r} is not a number{en}.",
                         f"{place}, baris {line}, kolom {name[:40]!r}: {cell[:40]!r} bukan bilangan{id}.")
    return number


# --- sheets -> signals -----------------------------------------------------------------------------------------------

def _column(header):
    """"Gyroscope x (rad/s)" -> ("gyroscope", "x", "rad/s", "gyr"), the last one "time", a key of NAMES, "unknown" (unit),
    "logger" (a bare x, y, z) or None."""
    name, axis, unit = header.strip(), None, None
    if match := re.fullmatch(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]", name):
        name, unit = match.groups()
        unit = unicodedata.normalize("NFKC", unit).replace("^", "").replace(" ", "")        # m/s², m/s^2 -> m/s2
        unit = unit if unit in ("G", "mG") else unit.lower()                                # gauss, not gravity
    name = name.lower()
    if match := re.fullmatch(r"(.*?)[\s_.-]*([xyz])", name):
        name, axis = match.groups()
    kind, _ = UNITS.get(unit, (None, 0))
    if axis is None:
        kind = "time" if kind == "time" or name in ("t", "time", "seconds_elapsed") else None
    elif kind not in ("gyr", "acc", "mag"):
        kind = ("logger" if name == "" else "mag" if name == "m" or "mag" in name else
                "unknown" if SENSOR_WORD.search(name) else None)
    return name, axis, unit, kind


def _signals(sheet, notes):
    if "seconds_elapsed" in sheet.names:
        return _sensor_logger(sheet)
    groups, clock = {}, None                        # (stem, kind, clock) -> {axis: column}; the time to the left
    for k, header in enumerate(sheet.names):
        header = re.sub(r" \(\d+\)$", "", header)    # from read_sheets
        stem, axis, unit, kind = _column(header)
        if kind == "unknown" or kind == "time" and unit not in (None, *UNITS):
            raise InputError(f"{sheet.place}: column {header[:40]!r} must have its unit in parentheses, one of {ACCEPTED}.",
                             f"{sheet.place}: kolom {header[:40]!r} harus memuat satuannya dalam kurung, salah satu dari "
                             f"{ACCEPTED}.")
        if kind == "time":
            clock = (k, UNITS.get(unit, ("time", 1.0))[1])
            if unit is None:
                _say(notes, f"{sheet.place}: column {header!r} has no unit; seconds were taken.",
                     f"{sheet.place}: kolom {header!r} tanpa satuan; dipakai detik.")
        elif kind and kind != "logger":
            groups.setdefault((stem, kind, clock), {})[axis] = (k, UNITS.get(unit, ("mag", 1.0))[1])
    signals = []
    for (stem, kind, clock), columns in groups.items():
        if len(columns) < 3:
            continue                                # a single "y (g)"
        if clock is None:
            raise InputError(f"{sheet.place}: there is no column of time, such as 't (s)', left of the sensor.",
                             f"{sheet.place}: tidak ada kolom waktu, misalnya 't (s)', di kiri sensor.")
        if kind == "acc":
            kind = "linear" if LINEAR_WORD.search(stem) else "gravity" if GRAVITY_WORD.search(stem) else kind
        values = np.column_stack([sheet.values[:, k] * factor for k, factor in map(columns.get, "xyz")])
        k, factor = columns["x"]
        if factor != 1:
            si = "rad/s" if kind == "gyr" else "m/s2"
            _say(notes, f"{sheet.place}: {sheet.names[k]} and its like were converted to {si}.",
                 f"{sheet.place}: {sheet.names[k]} dan sejenisnya diubah ke {si}.")
        source = "plain" if stem in ("g", "gyr", "a", "acc", "m", "mag") else "units"
        signals.append(Signal(kind, sheet.values[:, clock[0]] * clock[1], values, sheet.place, sheet.lines, source))
    return signals


def _sensor_logger(sheet):
    """A CSV of Sensor Logger, which has SI units."""
    kind = SENSOR_LOGGER.get(Path(sheet.place).stem.lower())
    wanted = ("roll", "pitch", "yaw") if kind == "orientation" else ("x", "y", "z")
    column = dict(zip(sheet.names, sheet.values.T))
    if kind is None or not column.keys() >= set(wanted):
        return []
    return [Signal(kind, column["seconds_elapsed"], np.column_stack([column[name] for name in wanted]), sheet.place,
                   sheet.lines, "logger")]


def _keep(signals, signal):
    if other := signals.get(signal.kind):
        en, id = NAMES[signal.kind]
        raise InputError(f"The {en} comes twice, in {other.place} and in {signal.place}; give one recording.",
                         f"Sensor {id} ada dua kali, di {other.place} dan di {signal.place}; berikan satu rekaman.")
    signals[signal.kind] = signal


# --- signals -> Recording --------------------------------------------------------------------------------------------

def _rows(signal, keep):
    return signal._replace(t=signal.t[keep], values=signal.values[keep], lines=signal.lines[keep])


def _clean(signal, notes):
    """The Signal without empty and repeated rows."""
    (en, id), place = NAMES[signal.kind], signal.place
    empty = np.isnan(signal.values).all(axis=1)     # phyphox fills short columns
    bad = ~empty & ~(np.isfinite(signal.values).all(axis=1) & np.isfinite(signal.t))
    if bad.any():
        line = signal.lines[np.argmax(bad)]
        raise InputError(f"{place}, line {line}: a value of the {en} or its time is missing or infinite.",
                         f"{place}, baris {line}: nilai {id} atau waktunya kosong atau tak hingga.")
    signal = _rows(signal, ~empty)
    n, least = len(signal.t), 10 if signal.kind == "gyr" else 2
    if n < least:
        raise InputError(f"{place}: the {en} has only {n} measurements; at least {least} are needed.",
                         f"{place}: {id} hanya memiliki {n} pengukuran; diperlukan sedikitnya {least}.")
    if empty[:n].any():                             # not only at the end
        _say(notes, f"{place}: {empty.sum()} rows without a value of the {en} were left out.",
             f"{place}: {empty.sum()} baris tanpa nilai {id} tidak dipakai.")
    repeated = np.append(False, (np.diff(signal.t) == 0) & (np.diff(signal.values, axis=0) == 0).all(axis=1))
    if repeated.any():
        _say(notes, f"{place}: {repeated.sum()} rows that repeat the one before were left out.",
             f"{place}: {repeated.sum()} baris yang mengulang baris sebelumnya tidak dipakai.")
    signal = _rows(signal, ~repeated)
    back = np.diff(signal.t) <= 0
    if back.any():
        line = signal.lines[np.argmax(back) + 1]
        raise InputError(f"{place}, line {line}: the time of the {en} does not increase.",
                         f"{place}, baris {line}: waktu {id} tidak bertambah.")
    return signal


def _total_acceleration(signals, device, notes):
    """See to it that signals has "gyr" and "acc", with gravity and in the sign of Android."""
    linear, gravity = signals.get("linear"), signals.get("gravity")
    if "acc" not in signals and linear and gravity:
        inside = (linear.t >= gravity.t[0]) & (linear.t <= gravity.t[-1])
        if inside.sum() < 2:
            raise _no_overlap(linear, gravity)
        total = _rows(linear, inside)
        signals["acc"] = total._replace(kind="acc", values=total.values + _interpolate(total.t, gravity))
        _say(notes, "Acceleration without gravity and gravity were added.",
             "Percepatan tanpa gravitasi dan gravitasi dijumlahkan.")
    if "acc" not in signals and linear:
        raise InputError(f"{linear.place}: this accelerometer has no gravity in it; record the one with g "
                         "(phyphox) or also TotalAcceleration or Gravity (Sensor Logger).",
                         f"{linear.place}: akselerometer ini tanpa gravitasi; rekamlah yang memakai g "
                         "(phyphox) atau juga TotalAcceleration atau Gravity (Sensor Logger).")
    for kind, header in (("gyr", "Gyroscope x (rad/s)"), ("acc", "Acceleration x (m/s^2)")):
        if kind not in signals:
            en, id = NAMES[kind]
            raise InputError(f"There is no {en} in the files; record one, with headers such as {header!r}.",
                             f"Tidak ada {id} dalam berkas; rekamlah, dengan judul seperti {header!r}.")
    acc = signals["acc"]
    # Sensor Logger on iOS turns the sign, unless "Standardise Units & Frames" is on (its COORDINATES.md and
    # CROSSPLATFORM.md); phyphox on iOS multiplies by -9.81 (its ExperimentSensorInput.swift)
    if acc.source == "logger" and _is_apple(device):
        signals["acc"] = acc._replace(values=-acc.values)
        _say(notes, "iPhone: the sign of the acceleration was turned.", "iPhone: tanda percepatan dibalik.")
    elif acc.source == "logger" and not device.get("platform"):
        _say(notes, "Metadata.csv is missing: the signs of Android were taken (an iPhone's acceleration is opposite).",
             "Metadata.csv tidak ada: dipakai tanda Android (percepatan iPhone berlawanan).")


def _is_apple(device):
    return device.get("platform", "").lower() == "ios" and device.get("standardisation", "").lower() != "true"


def _check_magnitudes(gyr, acc):
    rates, g = np.abs(gyr.values).max(axis=1), np.median(np.linalg.norm(acc.values, axis=1))
    if rates.max() > MAX_RATE:
        line = gyr.lines[np.argmax(rates)]
        raise InputError(f"{gyr.place}, line {line}: {rates.max():.0f} rad/s is faster than any such sensor measures "
                         f"({MAX_RATE:.0f}); is the unit deg/s?",
                         f"{gyr.place}, baris {line}: {rates.max():.0f} rad/s melebihi kemampuan sensor seperti itu "
                         f"({MAX_RATE:.0f}); apakah satuannya deg/s?")
    if not 6 < g < 14:
        raise InputError(f"{acc.place}: half of the accelerations are below {g:.2f} m/s2, but with gravity they lie "
                         "around 9.8; either gravity was taken out or the unit in the header is wrong.",
                         f"{acc.place}: separuh percepatan di bawah {g:.2f} m/s2, padahal dengan gravitasi nilainya "
                         "sekitar 9,8; gravitasinya dihilangkan atau satuan di judul salah.")


def _resample(signals, notes):
    """{kind: Signal} -> t (N,) s and {kind: values at t}."""
    parts = {kind: signals[kind] for kind in ("gyr", "acc", "mag", "orientation") if kind in signals}
    gyr = parts["gyr"]
    t = gyr.t
    for signal in parts.values():
        t = t[(t >= signal.t[0]) & (t <= signal.t[-1])]
        if len(t) < 10:
            raise _no_overlap(gyr, signal)
    rates = {kind: 1 / np.median(np.diff(signal.t)) for kind, signal in parts.items()}
    en, id = (", ".join(f"{NAMES[kind][k]} {rate:.4g} Hz" for kind, rate in rates.items()) for k in (0, 1))
    same = all(np.array_equal(signal.t, gyr.t) for signal in parts.values())
    _say(notes, f"Rates: {en}" + ("." if same else "; all were interpolated linearly to the gyroscope's times."),
         f"Laju: {id}" + ("." if same else "; semua diinterpolasi linear ke waktu giroskop."))
    if len(t) < len(gyr.t):
        _say(notes, f"Only the {t[-1] - t[0]:.2f} s that all sensors cover are kept, of {gyr.t[-1] - gyr.t[0]:.2f} s.",
             f"Hanya {t[-1] - t[0]:.2f} s yang dicakup semua sensor dipakai, dari {gyr.t[-1] - gyr.t[0]:.2f} s.")
    for kind, signal in parts.items():
        pauses = np.diff(signal.t)
        long = (pauses > max(GAP, 3 / rates[kind])) & (signal.t[1:] > t[0]) & (signal.t[:-1] < t[-1])
        if long.any():
            worst = np.argmax(pauses * long)
            pause, start = f"{pauses[worst]:.2f} s", f"{signal.t[worst] - t[0]:.2f} s"
            _say(notes, f"Gaps of the {NAMES[kind][0]}: {long.sum()}; the longest, {pause}, begins at {start}.",
                 f"Celah {NAMES[kind][1]}: {long.sum()}; yang terpanjang, {pause}, mulai pada {start}.")
    return t, {kind: _interpolate_angles(t, signal.t, signal.values) if kind == "orientation" else
               _interpolate(t, signal) for kind, signal in parts.items()}


def _no_overlap(one, other):
    return InputError(f"{one.place} ({one.t[0]:.2f} to {one.t[-1]:.2f} s) and {other.place} ({other.t[0]:.2f} to "
                      f"{other.t[-1]:.2f} s) have fewer than 10 times of the gyroscope in common.",
                      f"{one.place} ({one.t[0]:.2f} sampai {one.t[-1]:.2f} s) dan {other.place} ({other.t[0]:.2f} "
                      f"sampai {other.t[-1]:.2f} s) memiliki kurang dari 10 waktu giroskop yang sama.")


def _interpolate(t, signal):
    return np.column_stack([np.interp(t, signal.t, column) for column in signal.values.T])


def _interpolate_angles(t, times, angles):
    """Roll, pitch, yaw (n, 3) rad at times (n,) -> at t (N,): through quaternions, as angles jump at +-180 degrees."""
    q = _quaternions(angles)
    flips = np.cumprod(np.append(1, np.where((q[1:] * q[:-1]).sum(axis=1) < 0, -1, 1)))      # q and -q are one attitude
    q = np.column_stack([np.interp(t, times, part) for part in (q * flips[:, None]).T])
    return _angles(q / np.linalg.norm(q, axis=1, keepdims=True))


def _quaternions(angles):
    """Roll, pitch, yaw (N, 3) rad -> unit quaternions (N, 4), w first, body to north-east-down."""
    (cr, cp, cy), (sr, sp, sy) = np.cos(angles.T / 2), np.sin(angles.T / 2)
    return np.column_stack([cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy,
                            cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy])


def _angles(q):
    """The inverse of _quaternions."""
    w, x, y, z = q.T
    return np.column_stack([np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
                            np.arcsin(np.clip(2 * (w * y - z * x), -1, 1)),
                            np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))])


def _phone_reference(angles, acc, axes, device, notes):
    """Sensor Logger's roll, pitch, yaw (N, 3) rad -> ours, or None if their meaning is not certain.

    On Android they are those of SensorManager.getOrientation (COORDINATES.md): yaw and roll as ours, pitch turned.
    """
    if angles is None:
        return None
    sure = axes == "phone" and not _is_apple(device)
    angles = angles * [1, -1, 1]
    roll, pitch, _ = angles.T
    up = np.column_stack([np.sin(pitch), -np.sin(roll) * np.cos(pitch), -np.cos(roll) * np.cos(pitch)])
    tilt = np.degrees(np.median(np.arccos(np.clip((up * acc).sum(axis=1) / np.linalg.norm(acc, axis=1), -1, 1))))
    if not sure or tilt > 10:
        _say(notes, "The app's own orientation was left out: its convention is not certain here"
             + (f" (it differs from gravity by {tilt:.0f} degrees)." if sure else "."),
             "Orientasi dari aplikasi tidak dipakai: konvensinya tidak pasti di sini"
             + (f" (berbeda {tilt:.0f} derajat dari gravitasi)." if sure else "."))
        return None
    _say(notes, f"Reference: the app's own orientation; its tilt differs from gravity by {tilt:.1f} degrees (median).",
         f"Acuan: orientasi dari aplikasi; kemiringannya berbeda {tilt:.1f} derajat dari gravitasi (median).")
    return angles


def _say(notes, en, id):
    notes.append({"en": en, "id": id})
