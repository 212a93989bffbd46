// Numbers that stand for "not measured": -999, 8888, -127, ... Twin of kalman_lib/data/missing.py.
import { BLANK } from "./blanks.js";
import { wordsOf } from "./units.js";

const BOTH = [999, 9999, 99999, 999.9, 9999.9, 8888];
const OF_THERMOMETERS = [-127, 85]; // DS18B20: not connected, not yet measured
const CODES = [...BOTH, ...BOTH.map((code) => -code), -99, -99.9, ...OF_THERMOMETERS];
const THERMOMETERS = new Set("suhu temp temperature temperatur ds t °c c".split(" "));
const CELSIUS = ["°c", "c", "degc"];
const FAR = 2; // spans of the other values, and this share of the code, lie between
const SHARE = 0.1;
const LOOKED_AT = 200; // letters
const EXPLAINED = new RegExp(
  `^[${BLANK}]*([+-]?[0-9]{2,6}(?:[.,][0-9])?)[${BLANK}]{0,9}[:=]?[${BLANK}]{0,9}(\\D{3,80})`,
);
const MEANINGS = /tidak|tak |hilang|kosong|missing|no data|not |invalid|error|rusak|absent/i;

/** The codes that lines around a table explain: "8888: data tidak terukur". */
export function codesIn(texts) {
  const found = [];
  for (const text of texts) {
    const match = EXPLAINED.exec(text.slice(0, LOOKED_AT));
    if (match && MEANINGS.test(match[2])) {
      found.push(Number(match[1].replace(",", ".")));
    }
  }
  return found;
}

/** {sure, doubtful}: codes that stand for a gap in a column, and those that only may. */
export function suspects(name, unit, values, explained) {
  const there = new Set(values);
  const sure = [...new Set(explained)].filter((code) => there.has(code)).sort((a, b) => a - b);
  const doubtful = [];
  const isCode = new Set([...CODES, ...sure]);
  const rest = values.filter((value) => Number.isFinite(value) && !isCode.has(value));
  if (rest.length === 0) {
    const others = CODES.filter((code) => !OF_THERMOMETERS.includes(code) && !sure.includes(code));
    return { sure, doubtful: others.filter((code) => there.has(code)) }; // there is nothing to judge them by
  }
  const low = rest.reduce((a, b) => Math.min(a, b));
  const high = rest.reduce((a, b) => Math.max(a, b));
  for (const code of CODES) {
    const away = Math.max(low - code, code - high);
    const isFar = away > FAR * (high - low) && away > SHARE * Math.abs(code);
    if (isFar && there.has(code) && !sure.includes(code)) {
      (isDoubtful(code, name, unit) ? doubtful : sure).push(code);
    }
  }
  return { sure, doubtful };
}

/** A thermometer's code is one only where temperatures may stand. */
function isDoubtful(code, name, unit) {
  if (!OF_THERMOMETERS.includes(code) || !/\p{L}/u.test(name)) {
    return false;
  }
  return !wordsOf(name).some((word) => THERMOMETERS.has(word)) && !CELSIUS.includes(unit.toLowerCase());
}

/** Put gaps where codes stand -> {columns, codes: Map of code -> how often, notes}. */
export function withoutCodes(columns, { units, heads, time }, chosen, explained) {
  const counts = new Map();
  const doubts = new Map();
  const cleaned = new Map();
  for (const [name, values] of columns) {
    if (name === time) {
      cleaned.set(name, values);
      continue;
    }
    const found = chosen
      ? { sure: chosen, doubtful: [] }
      : suspects(heads.get(name), units[name] ?? "", values, explained);
    found.sure.forEach((code) => add(counts, code, values));
    found.doubtful.forEach((code) => add(doubts, code, values));
    const isCode = new Set(found.sure);
    cleaned.set(name, isCode.size > 0 ? values.map((value) => (isCode.has(value) ? NaN : value)) : values);
  }
  const notes = [...(counts.size > 0 ? [taken(counts)] : []), ...(doubts.size > 0 ? [doubted(doubts)] : [])];
  return { columns: cleaned, codes: new Map([...counts, ...doubts]), notes };
}

function add(counts, code, values) {
  const count = values.filter((value) => value === code).length;
  if (count > 0) {
    counts.set(code, (counts.get(code) ?? 0) + count);
  }
}

/** The note on codes that were taken as gaps. */
function taken(counts) {
  const shown = listed(counts);
  return { en: `taken as missing: ${shown}`, id: `dianggap kosong: ${shown.replaceAll(".", ",")}` };
}

/** The note on codes that may be gaps. */
function doubted(counts) {
  const shown = listed(counts);
  return {
    en: `${shown} may stand for missing, but was kept`,
    id: `${shown.replaceAll(".", ",")} mungkin berarti kosong, tetapi tetap dipakai`,
  };
}

function listed(counts) {
  return Array.from(counts, ([code, count]) => `${code} (${count}x)`).join(", ");
}
