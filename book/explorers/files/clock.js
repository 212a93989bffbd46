// Dates and clock times -> seconds. Twin of kalman_lib/data/clock.py.
//
// A moment is {date, clock, zone}: date null or [form, year, month, day], where form "?" says that month and
// day may be the other way round; clock null or [hours, minutes, seconds or null]; zone in seconds. All of
// one column are understood alike.

const LONGEST = 45; // letters
const DAY = 86400;
const HALF_DAY = 43200;
const MONTHS = new Map();
"jan feb mar apr mei,may jun jul agu,agt,aug sep okt,oct nov des,dec".split(" ").forEach((names, i) => {
  names.split(",").forEach((name) => MONTHS.set(name, i + 1));
});
const MAY_BE_TIME = /^(?:[0-9]{1,4}[-/.: ]|[A-Za-z]{3,9} [0-9])/;
const YEAR_FIRST = /^([0-9]{4})([-/.])([0-9]{1,2})\2([0-9]{1,2})/;
const YEAR_LAST = /^([0-9]{1,2})([-/.])([0-9]{1,2})\2([0-9]{4})/;
const SHORT_YEAR = /^([0-9]{1,2})([-/])([0-9]{1,2})\2([0-9]{2})/;
const MONTH_NAMED = /^([0-9]{1,2})[ -]([A-Za-z]{3,9})[ -]([0-9]{4}|[0-9]{2})/;
const MONTH_FIRST = /^([A-Za-z]{3,9}) ([0-9]{1,2}),? ([0-9]{4})/;
const CLOCK = new RegExp(
  "^([0-9]{1,3}):([0-9]{2})(?::([0-9]{2})(?:[.,]([0-9]{1,9}))?)?(?: ?([AaPp])\\.?[Mm]\\.?)?" +
    "(?: ?(Z|UTC|GMT|WIB|WITA|WIT|[+-][0-9]{2}:?[0-9]{2}))?$",
);
const MINUTES = /^([0-9]{1,3}):([0-9]{2})[.,]([0-9]{1,9})$/;
const DOTTED = /^([0-9]{1,2})\.([0-9]{2})(?:\.([0-9]{2}))?$/;
const BETWEEN = /^(?:T|[ ,_]+)/;

/** Is the text a date, a clock time, or both? */
export function isTime(text) {
  return moment(text) !== null;
}

/** "2024-01-01 10:00" -> {date: ["ymd", 2024, 1, 1], clock: [10, 0, null], zone: 0}; null if it is none. */
export function moment(text) {
  if (text.length > LONGEST || !MAY_BE_TIME.test(text)) {
    return null;
  }
  const [date, rest] = dateIn(text);
  if (date === null) {
    return withClock(null, text);
  }
  if (rest === "") {
    return { date, clock: null, zone: 0 };
  }
  const gap = BETWEEN.exec(rest);
  return gap ? withClock(date, rest.slice(gap[0].length)) : null;
}

/** "10.30", as clocks are written in Indonesian; null if it is none. */
export function dotted(text) {
  const found = DOTTED.exec(text);
  if (!found) {
    return null;
  }
  const [hours, minutes, seconds] = found.slice(1).map((part) => Number(part ?? 0));
  if (hours > 23 || minutes > 59 || seconds > 59) {
    return null;
  }
  return { date: null, clock: [hours, minutes, found[3] === undefined ? null : seconds], zone: 0 };
}

function withClock(date, text) {
  const short = MINUTES.exec(text);
  if (short) {
    const seconds = Number(`${short[2]}.${short[3]}`);
    return seconds < 60 ? { date, clock: [0, Number(short[1]), seconds], zone: 0 } : null;
  }
  const found = CLOCK.exec(text);
  if (!found) {
    return null;
  }
  let hours = Number(found[1]);
  const minutes = Number(found[2]);
  const seconds = found[3] === undefined ? null : Number(`${found[3]}.${found[4] ?? 0}`);
  if (minutes > 59 || (seconds ?? 0) >= 61) {
    return null;
  }
  if (found[5]) {
    hours = (hours % 12) + (/[Pp]/.test(found[5]) ? 12 : 0);
  }
  return { date, clock: [hours, minutes, seconds], zone: zoneOf(found[6]) };
}

/** "+07:00" -> 25200 s; others stand for what the clocks around show. */
function zoneOf(text) {
  if (!text || !/^[+-]/.test(text)) {
    return 0;
  }
  const seconds = 3600 * Number(text.slice(1, 3)) + 60 * Number(text.slice(-2));
  return text[0] === "-" ? -seconds : seconds;
}

/** [date, the rest of the text]; [null, text] if it does not begin with one. */
function dateIn(text) {
  const [date, length] = anyDate(text);
  if (date === null) {
    return [null, text];
  }
  const [form, , b, c] = date;
  const isDay = b >= 1 && b <= 12 && c >= 1 && c <= 31;
  const isOther = form === "?" && c >= 1 && c <= 12 && b >= 1 && b <= 31;
  return isDay || isOther ? [date, text.slice(length)] : [null, text];
}

function anyDate(text) {
  const first = YEAR_FIRST.exec(text);
  if (first) {
    return [["ymd", Number(first[1]), Number(first[3]), Number(first[4])], first[0].length];
  }
  const last = YEAR_LAST.exec(text) ?? SHORT_YEAR.exec(text);
  if (last) {
    return [["?", yearOf(last[4]), Number(last[3]), Number(last[1])], last[0].length];
  }
  const named = MONTH_NAMED.exec(text);
  if (named && monthOf(named[2])) {
    return [["dmy", yearOf(named[3]), monthOf(named[2]), Number(named[1])], named[0].length];
  }
  const month_first = MONTH_FIRST.exec(text);
  if (month_first && monthOf(month_first[1])) {
    const [whole, month, day, year] = month_first;
    return [["dmy", Number(year), monthOf(month), Number(day)], whole.length];
  }
  return [null, 0];
}

function yearOf(text) {
  const year = Number(text);
  if (text.length > 2) {
    return year;
  }
  return year + (year < 70 ? 2000 : 1900);
}

function monthOf(text) {
  return MONTHS.get(text.slice(0, 3).toLowerCase());
}

// --- a column of moments -> seconds ------------------------------------------------------------------------

/**
 * Moments (null: a gap) -> {seconds, assumed}, null if they are not of one kind. assumed: a Set of "day" (it
 * stands first in a date) and "midnight" (it was passed).
 */
export function secondsOf(moments) {
  const known = moments.filter((one) => one !== null);
  const hasDate = new Set(known.map(({ date }) => date !== null));
  const assumed = new Set();
  if (hasDate.size !== 1) {
    return null;
  }
  if (hasDate.has(false)) {
    return { seconds: clockSeconds(moments, assumed), assumed };
  }
  const dates = known.map(({ date }) => date);
  const isMonthFirst = monthComesFirst(dates, assumed);
  if (isMonthFirst === null) {
    return null;
  }
  const seconds = moments.map((one) => one && secondsOnDay(one, isMonthFirst));
  return seconds.some((value) => value !== null && Number.isNaN(value)) ? null : { seconds, assumed };
}

/** NaN: there is no such month. */
function secondsOnDay({ date, clock, zone }, isMonthFirst) {
  const [form, year, b, c] = date;
  const [month, day] = form === "?" && isMonthFirst ? [c, b] : [b, c];
  if (month < 1 || month > 12) {
    return NaN;
  }
  return DAY * days(year, month, day) + ofClock(clock ?? [0, 0, 0]) - zone;
}

function ofClock([hours, minutes, seconds]) {
  return 3600 * hours + 60 * minutes + (seconds ?? 0);
}

/** Clock times alone: they go on after midnight, and count minutes where they are no hours. */
function clockSeconds(moments, assumed) {
  const clocks = moments.filter(Boolean).map(({ clock }) => clock);
  const isShort = clocks.every(([, , seconds]) => seconds === null);
  const scale = isShort && clocks.some(([hours]) => hours > 23) ? 1 / 60 : 1;
  let added = 0;
  let before = -Infinity;
  return moments.map((one) => {
    if (one === null) {
      return null;
    }
    const now = ofClock(one.clock) * scale;
    if (now < before - HALF_DAY) {
      added += DAY;
      assumed.add("midnight");
    }
    before = now;
    return now + added;
  });
}

/** Is 01/02/2026 the second of January? Only if some date can be nothing else; null: they contradict. */
function monthComesFirst(dates, assumed) {
  const open = dates.filter(([form]) => form === "?");
  if (open.length === 0) {
    return false;
  }
  const asDay = open.every(([, , b]) => b <= 12);
  const asMonth = open.every(([, , , c]) => c <= 12);
  if (!asDay && !asMonth) {
    return null;
  }
  if (asDay && asMonth) {
    assumed.add("day");
  }
  return !asDay;
}

/** Days since 1970-01-01 (Howard Hinnant, days_from_civil). */
export function days(civil_year, month, day) {
  const year = month <= 2 ? civil_year - 1 : civil_year;
  const era = Math.floor(year / 400);
  const of_era = year - 400 * era;
  const of_year = Math.floor((153 * (month + (month > 2 ? -3 : 9)) + 2) / 5) + day - 1;
  const leap = Math.floor(of_era / 4) - Math.floor(of_era / 100);
  return 146097 * era + 365 * of_era + leap + of_year - 719468;
}
