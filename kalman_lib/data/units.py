"""The words of a header: which unit, and is it a time, the number of a row, a measurement?"""

import re

LONGEST = 200  # characters of a header that are looked at

TIME_UNITS = {  # unit as it is called here -> (seconds, other spellings)
    "s": (1.0, "sec secs second seconds detik dtk"),
    "ms": (1e-3, "msec millis millisecond milliseconds milidetik mdetik"),
    "us": (1e-6, "µs μs usec micros microsecond microseconds mikrodetik"),
    "ns": (1e-9, "nsec nanos nanosecond nanoseconds nanodetik"),
    "min": (60.0, "mins minute minutes menit mnt"),
    "h": (3600.0, "hr hrs hour hours jam"),
    "d": (86400.0, "day days hari"),
}
SPEED_UNITS = {  # the same of speeds, in m/s
    "m/s": (1.0, "mps m/sec m/detik ms-1 m.s-1"),
    "cm/s": (0.01, "cm/sec cm/detik"),
    "km/h": (1 / 3.6, "kmh kph kmph km/jam km/hr km/hour"),
    "kn": (1852 / 3600, "kt kts knot knots"),
}
OTHER_UNITS = """
    m cm mm km mph m/s2 m/s/s g °C C ℃ degC Celsius °F F K % %RH RH Pa hPa kPa mbar bar atm ppm ppb
    V mV Volt Volts A mA W mW kW Wh kWh Ah mAh N kN kg lx lux dB Hz L l ml mL m3 L/s L/min m3/s m3/h
    deg ° rad deg/s °/s dps rad/s rad/sec deg/sec T uT µT μT G mG µg/m3 ug/m3 mg/L pH rpm TS RN
""".split()
CURRENCIES = ("Rp", "IDR", "US$", "USD", "EUR", "$", "€", "£")
AGGREGATES = {"avg", "smp", "min", "max", "std", "tot", "mean", "inst"}  # a line of some loggers

UNITS = {*TIME_UNITS, *SPEED_UNITS, *OTHER_UNITS}
LONG_UNITS = {unit.lower() for unit in UNITS if len(unit) > 2}  # in any letters
LONGEST_UNIT = 20  # characters
SPELLINGS = {
    word.lower(): unit
    for table in (TIME_UNITS, SPEED_UNITS)
    for unit, (_, words) in table.items()
    for word in [unit, *words.split()]
}
LONG_TIME_WORDS = {word for word, unit in SPELLINGS.items() if unit in TIME_UNITS and len(word) > 3}

TIME_WORDS = set(
    "t time times timestamp waktu tanggal tgl date datetime jam pukul epoch unix utc elapsed lap "
    "year tahun bulan month".split()
)
CLOCK_WORDS = {"pukul", "jam", "waktu", "time"}
ROW_WORDS = set(
    "no nomor nr num number index indeks idx id row baris record rec urut # n k".split()
)
SPEED_WORDS = set("v speed velocity kecepatan laju kec".split())
VALUE_WORDS = SPEED_WORDS | set(
    "suhu temp temperature temperatur z y value nilai measurement measured terukur pengukuran data "
    "reading level tinggi height jarak distance posisi position tekanan pressure humidity rh "
    "kelembapan kelembaban debit flow gaya force voltage tegangan volume berat massa t".split()
)
SIDE_WORDS = set(
    "lat latitude lintang lon long lng longitude bujur flag status quality battery baterai sat "
    "satellites accuracy run channel kanal x".split()
)


def canonical(text):
    """ "m / s²" -> "m/s2", "detik" -> "s", "km/jam" -> "km/h"; others as they are."""
    plain = text.replace("²", "2").replace("³", "3").replace("^", "").replace(" ", "")
    return SPELLINGS.get(plain.lower(), plain)


def is_unit(text):
    """Is it a unit that we know?"""
    if len(text) > LONGEST_UNIT or text == "":
        return False
    unit = canonical(text)
    return text in UNITS or unit in UNITS or unit.lower() in LONG_UNITS


def words_of(header):
    """The words of a header in small letters, without brackets and what stands in them."""
    return re.findall(r"[^\W\d_]+|#", _without_brackets(header[:LONGEST])[0].lower())


def unit_of(header):
    """The unit that a header names, "" if it names none."""
    name, brackets = _without_brackets(header[:LONGEST])
    for inside in brackets:
        is_plain = len(inside) <= 10 and not set(inside) & set(" :")
        if is_unit(inside) or 0 < len(inside) <= 4 or (is_plain and set(inside) & set("/°%²^")):
            return canonical(inside)
    after_comma = name.rpartition(",")[2].strip()
    if "," in name and is_unit(after_comma):
        return canonical(after_comma)
    return _unit_in_words(name)


def _unit_in_words(name):
    """ "speed_kmh", "time_ms", "seconds_elapsed", "Suhu °C": the unit is a word of the name."""
    words = re.split(r"[\s_]+", name.strip())
    is_time = bool(TIME_WORDS & set(words_of(name)))
    last = words[-1]
    if len(words) > 1 and last.lower() == "ms" and not is_time:
        return "m/s" if SPEED_WORDS & set(words_of(name)) else "ms"
    if len(words) > 1 and len(last) > 1 and is_unit(last):
        return canonical(last)
    if len(words) > 1 and last.lower() == "s" and is_time:
        return "s"
    for word in words:
        if word.lower() in LONG_TIME_WORDS or (len(words) == 1 and word in ("s", "ms", "us", "ns")):
            return canonical(word)
    return ""


def _without_brackets(header):
    """ "Temp (°C) [1]" -> ("Temp ", ["°C", "1"])."""
    outside, inside = [""], []
    for sign in header:
        if sign in "([":
            inside.append("")
            into = inside
        elif sign in ")]":
            into = outside
        else:
            into = outside if not inside or into is outside else inside
            into[-1] += sign
    return outside[0], [text.strip() for text in inside]


# --- what a column is ---------------------------------------------------------------------------


def names_time(header, unit):
    """Does the name, or the unit, say that it is a time?"""
    if unit:
        return unit in TIME_UNITS
    return bool(TIME_WORDS & set(words_of(header)))


def names_row(header):
    """Does the name say that it counts the rows?"""
    words = words_of(header)
    return 0 < len(words) <= 2 and words[0] in ROW_WORDS and set(words) <= ROW_WORDS


def names_measurement(header, words=VALUE_WORDS):
    return bool(words & set(words_of(header)))


def names_side(header):
    """A place, a state or a number of the logger: no measurement anybody filters first."""
    return bool(SIDE_WORDS & set(words_of(header)))
