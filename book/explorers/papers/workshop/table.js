// The table of the reader's own: pasted, opened, or recorded with the sensors of the phone.
import { broughtTable, chosenColumns, hasBrought, knownTable } from "../../own/data.js";
import { seriesOf } from "../../files/series.js";
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { WRONG } from "./mistakes.js";
import { median } from "./model.js";
import { NOTES } from "./words.js";

const LEAST_ROWS = 10;
const LONG = [
  ["d", 86400, 40000], // [unit, seconds, from this step on]
  ["h", 3600, 1000],
];

/** Has the reader brought data, or recorded it? */
export function isOwn(s) {
  return Boolean(s.motion) || hasBrought(s);
}

const recordings = new WeakMap(); // {motion: its table}

/** A recording of the phone's sensors as a table; an acceleration is taken at first. */
function recorded(motion) {
  if (!recordings.has(motion)) {
    const { T, t, gyr, acc } = motion;
    const along = (values, i) => Float64Array.from({ length: T }, (_, k) => values[3 * k + i]);
    const columns = new Map([["t", t.slice(0, T)]]);
    for (const [name, values] of Object.entries({ acc, gyr })) {
      ["x", "y", "z"].forEach((axis, i) => columns.set(`${name} ${axis}`, along(values, i)));
    }
    const lines = Array.from({ length: T }, (_, k) => k + 1);
    const about = { time: "t", value: "acc x", units: { t: "s" }, lines, note: NOTES.recorded };
    recordings.set(motion, { columns, ...about });
  }
  return recordings.get(motion);
}

/** The table, null if there is none that can be read. */
function tableOf(s) {
  return s.motion ? recorded(s.motion) : knownTable(s);
}

/** The columns that the reader may choose from. */
export function columnNames(s) {
  return [...(tableOf(s)?.columns.keys() ?? [])];
}

/** Does the data come with its times? */
export function isTimed(s) {
  const table = isOwn(s) ? tableOf(s) : null;
  return table !== null && (Boolean(s.motion) || chosenColumns(s, table).time !== null);
}

/** {time, value, other, input}: the names of the columns that are used, one to three; InputError: too few. */
function namesOf(s, table, used) {
  const { time, value } = s.motion ? { time: "t", value: s.axis || table.value } : chosenColumns(s, table);
  const others = [...table.columns.keys()].filter((name) => name !== time && name !== value);
  const other = table.columns.has(s.value2) ? s.value2 : others[0];
  const input = table.columns.has(s.value3) ? s.value3 : others.find((name) => name !== other);
  if (used > 1 && !other) {
    throw new InputError(WRONG.no_second);
  }
  if (used > 2 && !input) {
    throw new InputError(WRONG.no_third);
  }
  return { time, value, other, input };
}

/**
 * {t (T) or null, first (T), second (T), third (T), note}: the columns that are used, one to three, where
 * rows without a time are left out and equal times averaged; null: it is not used.
 */
export function columnsFrom(s, used) {
  const table = s.motion ? recorded(s.motion) : broughtTable(s);
  const names = namesOf(s, table, used);
  const { time, value } = names;
  const about = { ...table, time };
  const series = (name) => seriesOf(about, { time, value: name, unit: "s" }); // in whatever unit it is
  const { t, z, notes } = series(value);
  const second = used > 1 ? series(names.other).z : null;
  const third = used > 2 ? series(names.input).z : null;
  if (z.length < LEAST_ROWS) {
    throw new InputError(WRONG.short);
  }
  const [unit, scaled] = inLongUnits(t, table.units[time]);
  const isSaid = !unit || time.endsWith(`(${unit})`);
  const words = { ...names, time: time ?? "k", unit: isSaid ? "" : ` (${unit})` };
  const taken = inBoth([NOTES.taken, NOTES.taken_two, NOTES.taken_three][used - 1], words);
  return { t: scaled, first: z, second, third, note: joined([...notes.map(ended), taken, table.note]) };
}

/** Times in seconds with long steps are told in hours or days: then no number is tiny. */
function inLongUnits(t, unit) {
  if (t === null || unit !== "s") {
    return [unit, t];
  }
  const step = median(t.subarray(1).map((value, k) => value - t[k]));
  const found = LONG.find(([, , from]) => step >= from);
  return found ? [found[0], t.map((value) => value / found[1])] : [unit, t];
}

/** A note as a sentence of its own. */
function ended(note) {
  const sentence = (text) => `${text.slice(0, 1).toUpperCase()}${text.slice(1)}.`;
  return { id: sentence(note.id ?? ""), en: sentence(note.en ?? "") };
}

function joined(notes) {
  const inLanguage = (language) => notes.map((note) => note[language]).join(" ");
  return { id: inLanguage("id"), en: inLanguage("en") };
}
