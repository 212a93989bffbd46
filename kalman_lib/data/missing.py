"""Numbers that stand for "not measured": -999, 8888, -127, ..."""

import re

import numpy as np

from .units import words_of

CODES = [sign * code for sign in (1.0, -1.0) for code in (999, 9999, 99999, 999.9, 9999.9, 8888)]
CODES += [-99.0, -99.9, -127.0, 85.0]
OF_THERMOMETERS = (-127.0, 85.0)  # DS18B20: not connected, not yet measured
THERMOMETERS = set("suhu temp temperature temperatur ds t °c c".split())
FAR = 2  # spans of the other values, and this share of the code, lie between
SHARE = 0.1
EXPLAINED = re.compile(r"\s*([+-]?[0-9]{2,6}(?:[.,][0-9])?)\s{0,9}[:=]?\s{0,9}(\D{3,80})")
MEANINGS = re.compile(
    r"tidak|tak |hilang|kosong|missing|no data|not |invalid|error|rusak|absent", re.IGNORECASE
)


def codes_in(texts):
    """The codes that lines around a table explain: "8888: data tidak terukur"."""
    found = []
    for text in texts:
        match = EXPLAINED.match(text[:200])
        if match and MEANINGS.search(match[2]):
            found.append(float(match[1].replace(",", ".")))
    return found


def suspects(name, unit, values, explained):
    """(codes, doubtful codes): what stands for a gap in a column, and what only may."""
    codes = sorted(set(explained) & set(values[np.isin(values, explained)].tolist()))
    doubtful = []
    rest = values[np.isfinite(values) & ~np.isin(values, [*CODES, *codes])]
    if len(rest) == 0:  # there is nothing to judge them by
        others = [code for code in CODES if code not in OF_THERMOMETERS and code not in codes]
        return codes, [code for code in others if (values == code).any()]
    low, high = float(rest.min()), float(rest.max())
    for code in CODES:
        away = max(low - code, code - high)
        is_far = away > FAR * (high - low) and away > SHARE * abs(code)
        if code in codes or not is_far or not (values == code).any():
            continue
        doubtful.append(code) if _is_doubtful(code, name, unit) else codes.append(code)
    return codes, doubtful


def _is_doubtful(code, name, unit):
    """A thermometer's code is one only where temperatures may stand."""
    if code not in OF_THERMOMETERS:
        return False
    is_named = any(sign.isalpha() for sign in name)
    is_thermometer = bool(THERMOMETERS & set(words_of(name))) or unit.lower() in ("°c", "c", "degc")
    return is_named and not is_thermometer


def counted(codes, values):
    """[(code, how often it occurs), ...] of those that occur."""
    counts = [(code, int((values == code).sum())) for code in codes]
    return [(code, count) for code, count in counts if count]


def taken(counts):
    """The note on codes that were taken as gaps."""
    return {
        "en": f"taken as missing: {_listed(counts)}",
        "id": f"dianggap kosong: {_listed(counts).replace('.', ',')}",
    }


def doubted(counts):
    """The note on codes that may be gaps."""
    return {
        "en": f"{_listed(counts)} may stand for missing, but was kept",
        "id": f"{_listed(counts).replace('.', ',')} mungkin berarti kosong, tetapi tetap dipakai",
    }


def _listed(counts):
    return ", ".join(f"{code:.15g} ({count}x)" for code, count in counts.items())
