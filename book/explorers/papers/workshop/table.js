// The table that a reader pasted or dropped: which of its columns are the time and the measurements.
import { readBrought } from "../../files/table.js";
import { InputError } from "../../language/input.js";
import { NOTES, WRONG } from "./words.js";

const TIME = /^(t|time|waktu|detik|seconds?|s|ms|menit|minutes?|jam|hours?|hari|days?|tahun|years?|k|no)\b/i;
const LEAST_ROWS = 10;

/** Has the reader brought data, or recorded it? */
export function isOwn(s) {
  return Boolean(s.motion || s.file || s.text?.trim());
}

let last = { key: [], table: null }; // what was read last: the choice of columns needs it, too

/** {columns: Map, time: name or undefined, value: name, note}. */
export function tableFrom({ motion, text, file, sign }) {
  if (motion) {
    return recorded(motion);
  }
  const key = [text, file, sign];
  if (!key.every((value, i) => value === last.key[i])) {
    last = { key, table: null };
    const read = readBrought({ text, file }, sign === "auto" ? null : sign);
    last.table = { ...read, ...choice(read.columns) };
  }
  if (!last.table) {
    throw new InputError(WRONG.unread);
  }
  const [first] = last.table.columns.values();
  if (first.length < LEAST_ROWS) {
    throw new InputError(WRONG.short);
  }
  return last.table;
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
    recordings.set(motion, { columns, time: "t", value: "acc x", value2: "acc y", note: NOTES.recorded });
  }
  const table = recordings.get(motion);
  if (motion.T < LEAST_ROWS) {
    throw new InputError(WRONG.short);
  }
  return table;
}

/** Which columns are taken at first: a time, by its name or because it only grows, and the next two. */
function choice(columns) {
  const names = [...columns.keys()];
  const grows = (values) => values.every((value, k) => k === 0 || value > values[k - 1]);
  const named =
    names.find((name) => TIME.test(name)) ?? (grows(columns.get(names[0])) ? names[0] : undefined);
  const time = names.length > 1 ? named : undefined;
  const others = names.filter((name) => name !== time);
  return { time, value: others[0], value2: others[1] };
}

/** What changes with new data: the columns; data that cannot be read says so when it is used. */
export function chosenColumns(s) {
  try {
    const { time, value, value2 } = tableFrom(s);
    return { time: time ?? "", value, value2: value2 ?? "" };
  } catch {
    return {};
  }
}

/** The columns to choose from. */
export function columnNames({ motion }) {
  const table = motion ? recordings.get(motion) : last.table;
  return [...(table?.columns.keys() ?? [])];
}
