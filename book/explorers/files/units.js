// The words of a header: which unit, and is it a time, the number of a row, a measurement? Twin of
// kalman_lib/data/units.py.
import { BLANK, behindLast, strip } from "./blanks.js";

const LONGEST = 200; // letters of a header that are looked at
const LONGEST_UNIT = 20;

/** Unit as it is called here -> [seconds, other spellings]. */
export const TIME_UNITS = {
  s: [1, "sec secs second seconds detik dtk"],
  ms: [1e-3, "msec millis millisecond milliseconds milidetik mdetik"],
  us: [1e-6, "µs μs usec micros microsecond microseconds mikrodetik"],
  ns: [1e-9, "nsec nanos nanosecond nanoseconds nanodetik"],
  min: [60, "mins minute minutes menit mnt"],
  h: [3600, "hr hrs hour hours jam"],
  d: [86400, "day days hari"],
};
/** The same of speeds, in m/s. */
export const SPEED_UNITS = {
  "m/s": [1, "mps m/sec m/detik ms-1 m.s-1"],
  "cm/s": [0.01, "cm/sec cm/detik"],
  "km/h": [1 / 3.6, "kmh kph kmph km/jam km/hr km/hour"],
  kn: [1852 / 3600, "kt kts knot knots"],
};
const OTHER_UNITS =
  "m cm mm km mph m/s2 m/s/s g °C C ℃ degC Celsius °F F K % %RH RH Pa hPa kPa mbar bar atm ppm ppb V mV " +
  "Volt Volts A mA W mW kW Wh kWh Ah mAh N kN kg lx lux dB Hz L l ml mL m3 L/s L/min m3/s m3/h deg ° rad " +
  "deg/s °/s dps rad/s rad/sec deg/sec T uT µT μT G mG µg/m3 ug/m3 mg/L pH rpm TS RN";
export const CURRENCIES = ["Rp", "IDR", "US$", "USD", "EUR", "$", "€", "£"];
export const AGGREGATES = setOf("avg smp min max std tot mean inst"); // a line of some loggers

const UNITS = new Set([...Object.keys(TIME_UNITS), ...Object.keys(SPEED_UNITS), ...OTHER_UNITS.split(" ")]);
const LONG_UNITS = new Set([...UNITS].filter(({ length }) => length > 2).map((unit) => unit.toLowerCase()));
const SPELLINGS = new Map();
for (const table of [TIME_UNITS, SPEED_UNITS]) {
  for (const [unit, [, spellings]] of Object.entries(table)) {
    [unit, ...spellings.split(" ")].forEach((word) => SPELLINGS.set(word.toLowerCase(), unit));
  }
}
const LONG_TIME_WORDS = new Set(
  [...SPELLINGS]
    .filter(([word, unit]) => Object.hasOwn(TIME_UNITS, unit) && word.length > 3)
    .map(([word]) => word),
);
const SHORT_TIME_WORDS = ["s", "ms", "us", "ns"];

const TIME_WORDS = setOf(
  "t time times timestamp waktu tanggal tgl date datetime jam pukul epoch unix utc elapsed lap year tahun " +
    "bulan month",
);
export const CLOCK_WORDS = setOf("pukul jam waktu time");
const ROW_WORDS = setOf("no nomor nr num number index indeks idx id row baris record rec urut # n k");
const SPEED_WORDS = setOf("v speed velocity kecepatan laju kec");
export const VALUE_WORDS = setOf(
  "v speed velocity kecepatan laju kec suhu temp temperature temperatur z y value nilai measurement " +
    "measured terukur pengukuran data reading level tinggi height jarak distance posisi position tekanan " +
    "pressure humidity rh kelembapan kelembaban debit flow gaya force voltage tegangan volume berat massa t",
);
const SIDE_WORDS = setOf(
  "lat latitude lintang lon long lng longitude bujur flag status quality battery baterai sat satellites " +
    "accuracy run channel kanal x",
);
const ALL_BLANKS = new RegExp(`[${BLANK}_]+`);

function setOf(text) {
  return new Set(text.split(" "));
}

function share(set, list) {
  return list.some((word) => set.has(word));
}

/** "m / s²" -> "m/s2", "detik" -> "s", "km/jam" -> "km/h"; others as they are. */
export function canonical(text) {
  const plain = text.replaceAll("²", "2").replaceAll("³", "3").replaceAll("^", "").replaceAll(" ", "");
  return SPELLINGS.get(plain.toLowerCase()) ?? plain;
}

/** Is it a unit that we know? */
export function isUnit(text) {
  if (text.length > LONGEST_UNIT || text === "") {
    return false;
  }
  const unit = canonical(text);
  return UNITS.has(text) || UNITS.has(unit) || LONG_UNITS.has(unit.toLowerCase());
}

/** The words of a header in small letters, without brackets and what stands in them. */
export function wordsOf(header) {
  const [name] = withoutBrackets(header.slice(0, LONGEST));
  return name.toLowerCase().match(/[\p{L}\p{Nl}\p{No}]+|#/gu) ?? [];
}

/** The unit that a header names, "" if it names none. */
export function unitOf(header) {
  const [name, brackets] = withoutBrackets(header.slice(0, LONGEST));
  for (const inside of brackets) {
    const isShort = inside.length > 0 && inside.length <= 4;
    const isSigned = inside.length <= 10 && !/[ :]/.test(inside) && /[/°%²^]/.test(inside);
    if (isUnit(inside) || isShort || isSigned) {
      return canonical(inside);
    }
  }
  const after_comma = strip(behindLast(name, ","));
  if (name.includes(",") && isUnit(after_comma)) {
    return canonical(after_comma);
  }
  return unitInWords(name);
}

/** "speed_kmh", "time_ms", "seconds_elapsed", "Suhu °C": the unit is a word of the name. */
function unitInWords(name) {
  const words = strip(name).split(ALL_BLANKS);
  const isTime = share(TIME_WORDS, wordsOf(name));
  const last = words.at(-1);
  const isBehind = words.length > 1;
  if (isBehind && last.toLowerCase() === "ms" && !isTime) {
    return share(SPEED_WORDS, wordsOf(name)) ? "m/s" : "ms";
  }
  if (isBehind && last.length > 1 && isUnit(last)) {
    return canonical(last);
  }
  if (isBehind && last.toLowerCase() === "s" && isTime) {
    return "s";
  }
  const isUnitOfTime = (word) => {
    return LONG_TIME_WORDS.has(word.toLowerCase()) || (!isBehind && SHORT_TIME_WORDS.includes(word));
  };
  return canonical(words.find(isUnitOfTime) ?? "");
}

/** "Temp (°C) [1]" -> ["Temp ", ["°C", "1"]]. */
function withoutBrackets(header) {
  let outside = "";
  const inside = [];
  let isInside = false;
  for (const sign of header) {
    if (sign === "(" || sign === "[") {
      inside.push("");
      isInside = true;
    } else if (sign === ")" || sign === "]") {
      isInside = false;
    } else if (isInside) {
      inside.push(inside.pop() + sign);
    } else {
      outside += sign;
    }
  }
  return [outside, inside.map((text) => strip(text))];
}

// --- what a column is --------------------------------------------------------------------------------------

/** Does the name, or the unit, say that it is a time? */
export function namesTime(header, unit) {
  return unit ? Object.hasOwn(TIME_UNITS, unit) : share(TIME_WORDS, wordsOf(header));
}

/** Does the name say that it counts the rows? */
export function namesRow(header) {
  const words = wordsOf(header);
  return words.length > 0 && words.length <= 2 && words.every((word) => ROW_WORDS.has(word));
}

/** Does it speak of a speed? */
export function namesSpeed(header) {
  return namesMeasurement(header, SPEED_WORDS);
}

export function namesMeasurement(header, words = VALUE_WORDS) {
  return share(words, wordsOf(header));
}

/** A place, a state or a number of the logger: no measurement anybody filters first. */
export function namesSide(header) {
  return share(SIDE_WORDS, wordsOf(header));
}
