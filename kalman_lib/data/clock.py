"""Dates and clock times -> seconds.

A moment is (date, clock, zone): date None or (form, year, month, day), where form "?" says that
month and day may be the other way round; clock None or (hours, minutes, seconds or None); zone in
seconds. All of one column are understood alike.
"""

import re

LONGEST = 45  # characters
DAY = 86400
HALF_DAY = 43200
MONTHS = {
    name: number
    for number, names in enumerate(
        "jan feb mar apr mei,may jun jul agu,agt,aug sep okt,oct nov des,dec".split(), start=1
    )
    for name in names.split(",")
}
MAY_BE_TIME = re.compile("[0-9]{1,4}[-/.: ]|[A-Za-z]{3,9} [0-9]")
YEAR_FIRST = re.compile(r"([0-9]{4})([-/.])([0-9]{1,2})\2([0-9]{1,2})")
YEAR_LAST = re.compile(r"([0-9]{1,2})([-/.])([0-9]{1,2})\2([0-9]{4})")
SHORT_YEAR = re.compile(r"([0-9]{1,2})([-/])([0-9]{1,2})\2([0-9]{2})")
MONTH_NAMED = re.compile(r"([0-9]{1,2})[ -]([A-Za-z]{3,9})[ -]([0-9]{4}|[0-9]{2})")
MONTH_FIRST = re.compile(r"([A-Za-z]{3,9}) ([0-9]{1,2}),? ([0-9]{4})")
CLOCK = re.compile(
    r"([0-9]{1,3}):([0-9]{2})(?::([0-9]{2})(?:[.,]([0-9]{1,9}))?)?(?: ?([AaPp])\.?[Mm]\.?)?"
    r"(?: ?(Z|UTC|GMT|WIB|WITA|WIT|[+-][0-9]{2}:?[0-9]{2}))?"
)
MINUTES = re.compile(r"([0-9]{1,3}):([0-9]{2})[.,]([0-9]{1,9})")
DOTTED = re.compile(r"([0-9]{1,2})\.([0-9]{2})(?:\.([0-9]{2}))?")
BETWEEN = re.compile(r"T|[ ,_]+")


def is_time(text):
    """Is the text a date, a clock time, or both?"""
    return moment(text) is not None


def moment(text):
    """ "2024-01-01 10:00" -> (("ymd", 2024, 1, 1), (10, 0, None), 0); None if it is none."""
    if len(text) > LONGEST or not MAY_BE_TIME.match(text):
        return None
    date, rest = _date(text)
    if date is None:
        return _with_clock(None, text)
    if rest == "":
        return date, None, 0
    gap = BETWEEN.match(rest)
    return _with_clock(date, rest[gap.end() :]) if gap else None


def dotted(text):
    """ "10.30", as clocks are written in Indonesian; None if it is none."""
    found = DOTTED.fullmatch(text)
    if not found:
        return None
    hours, minutes, seconds = (int(part or 0) for part in found.groups())
    if hours > 23 or minutes > 59 or seconds > 59:
        return None
    return None, (hours, minutes, float(seconds) if found[3] else None), 0


def _with_clock(date, text):
    if found := MINUTES.fullmatch(text):
        seconds = float(f"{int(found[2])}.{found[3]}")
        return (date, (0, int(found[1]), seconds), 0) if seconds < 60 else None
    found = CLOCK.fullmatch(text)
    if not found:
        return None
    hours, minutes = int(found[1]), int(found[2])
    seconds = float(f"{found[3]}.{found[4] or 0}") if found[3] else None
    if minutes > 59 or (seconds or 0) >= 61:
        return None
    if found[5]:
        hours = hours % 12 + 12 * (found[5] in "Pp")
    return date, (hours, minutes, seconds), _zone(found[6])


def _zone(text):
    """ "+07:00" -> 25200 s; others stand for what the clocks around show."""
    if not text or text[0] not in "+-":
        return 0
    minutes = 60 * int(text[1:3]) + int(text[-2:])
    return -60 * minutes if text[0] == "-" else 60 * minutes


def _date(text):
    """(date, the rest of the text); (None, text) if it does not begin with one."""
    if found := YEAR_FIRST.match(text):
        date = ("ymd", int(found[1]), int(found[3]), int(found[4]))
    elif found := YEAR_LAST.match(text) or SHORT_YEAR.match(text):
        date = ("?", _year(found[4]), int(found[3]), int(found[1]))
    elif (found := MONTH_NAMED.match(text)) and _month(found[2]):
        date = ("dmy", _year(found[3]), _month(found[2]), int(found[1]))
    elif (found := MONTH_FIRST.match(text)) and _month(found[1]):
        date = ("dmy", int(found[3]), _month(found[1]), int(found[2]))
    else:
        return None, text
    _, _, b, c = date
    is_day = 1 <= b <= 12 and 1 <= c <= 31
    is_other = date[0] == "?" and 1 <= c <= 12 and 1 <= b <= 31
    return (date, text[found.end() :]) if is_day or is_other else (None, text)


def _year(text):
    year = int(text)
    if len(text) > 2:
        return year
    return year + (2000 if year < 70 else 1900)


def _month(text):
    return MONTHS.get(text[:3].lower())


# --- a column of moments -> seconds -------------------------------------------------------------


class NoTimes(ValueError):
    """They are not times of one kind."""


def seconds_of(moments):
    """Moments (None: a gap) -> (seconds, what had to be assumed); NoTimes: not of one kind.

    Assumed: "day" or "month" (what stands first in a date), "midnight" (it was passed).
    """
    known = [one for one in moments if one is not None]
    has_date = {date is not None for date, _, _ in known}
    if len(has_date) != 1:
        raise NoTimes
    assumed = set()
    if has_date == {False}:
        return _clock_seconds(moments, assumed), assumed
    month_first = _month_comes_first([date for date, _, _ in known], assumed)
    return [one and _seconds_on_day(one, month_first) for one in moments], assumed


def _seconds_on_day(one, month_first):
    (form, year, month, day), clock, zone = one
    if form == "?" and month_first:
        month, day = day, month
    if not 1 <= month <= 12:
        raise NoTimes
    return DAY * days(year, month, day) + _of_clock(clock or (0, 0, 0)) - zone


def _of_clock(clock):
    hours, minutes, seconds = clock
    return 3600 * hours + 60 * minutes + (seconds or 0)


def _clock_seconds(moments, assumed):
    """Clock times alone: they go on after midnight, and count minutes where they are no hours."""
    clocks = [one[1] for one in moments if one]
    is_short = all(seconds is None for _, _, seconds in clocks)
    scale = 1 / 60 if is_short and any(hours > 23 for hours, _, _ in clocks) else 1
    result, added, before = [], 0, None
    for one in moments:
        if one is None:
            result.append(None)
            continue
        now = _of_clock(one[1]) * scale
        if before is not None and now < before - HALF_DAY:
            added += DAY
            assumed.add("midnight")
        before = now
        result.append(now + added)
    return result


def _month_comes_first(dates, assumed):
    """Is 01/02/2026 the second of January? Only if some date can be nothing else."""
    open_dates = [(b, c) for form, _, b, c in dates if form == "?"]
    if not open_dates:
        return False
    as_day = all(b <= 12 for b, _ in open_dates)
    as_month = all(c <= 12 for _, c in open_dates)
    if not as_day and not as_month:
        raise NoTimes
    if as_day and as_month:
        assumed.add("day")
    return not as_day


def days(year, month, day):
    """Days since 1970-01-01 (Howard Hinnant, days_from_civil)."""
    year -= month <= 2
    era = year // 400
    of_era = year - 400 * era
    of_year = (153 * (month + (-3 if month > 2 else 9)) + 2) // 5 + day - 1
    return 146097 * era + 365 * of_era + of_era // 4 - of_era // 100 + of_year - 719468
