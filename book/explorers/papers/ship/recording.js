// The data of chapter 4: the synthetic towing run, or what the reader pasted or opened.
import { readBrought } from "../../files/table.js";
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { generator } from "../../numerics/random.js";
import { SPEED_UNITS, TIME_UNITS, fit, sampling, towing_run } from "./model.js";
import { RECORDING } from "./words.js";

const FASTEST = 1e6; // m/s, the range of Params
const SIGNS = { comma: ",", point: "." };

/** Has the reader brought data? */
export function isOwn(s) {
  return Boolean(s.file || s.text?.trim());
}

/**
 * {t, z, u, truth or null, theta: the fit, note}: the data that is shown; memo keeps it while nothing about
 * it changes.
 */
export function load(s, memo) {
  const from = sourceOf(s, memo);
  const choices = [s.text, s.sign, s.time, s.speed, s.time_unit, s.speed_unit];
  const key = from === null ? [s.seed, s.sigma] : choices;
  const isSame = memo.from === from && memo.key?.every((value, i) => value === key[i]);
  if (!isSame) {
    const data = from === null ? synthetic(s) : brought(from, s);
    data.u = new Float64Array(data.z.length).fill(1);
    data.theta = fit(data.z);
    if (!data.theta) {
      throw new InputError(RECORDING.no_fit);
    }
    Object.assign(memo, { from, key, data });
  }
  return memo.data;
}

/** null: synthetic; "text" or the file: what the reader put in last counts. */
function sourceOf(s, memo) {
  const hasText = Boolean(s.text?.trim());
  if (s.text !== memo.text && hasText) {
    memo.last = "text";
  }
  if (s.file !== memo.file && s.file) {
    memo.last = "file";
  }
  memo.text = s.text;
  memo.file = s.file;
  if (!isOwn(s)) {
    return null;
  }
  const isFile = s.file && (memo.last === "file" || !hasText);
  return isFile ? s.file : "text";
}

function synthetic({ seed, sigma }) {
  const { t, x, z } = towing_run(generator(seed), sigma);
  const note = {
    id: `Data sintetis, benih acak ${seed}.`,
    en: `Synthetic data, random seed ${seed}.`,
  };
  return { t, z, truth: x, note };
}

function brought(from, s) {
  return recording(tableFrom(from, s), s);
}

let last = { key: [], table: null }; // what was read last: the choice of columns needs it before it is used

function tableFrom(from, { text, sign }) {
  const key = [from, from === "text" ? text : null, sign];
  if (!key.every((value, i) => value === last.key[i])) {
    const source = from === "text" ? { text } : { file: from };
    last = { key, table: readBrought(source, SIGNS[sign] ?? null) }; // null: find out
  }
  return last.table;
}

/** The columns that the reader may choose from. */
export function columnNames(s) {
  const hasRead = last.key[0] === s.file || (last.key[0] === "text" && last.key[1] === s.text);
  return isOwn(s) && hasRead ? [...last.table.columns.keys()] : [];
}

/** Two columns of a table in the units that the reader chose: {t, z, truth: null, note}. */
function recording({ columns, lines, note }, s) {
  if (columns.size < 2) {
    throw new InputError(RECORDING.one_column);
  }
  if (s.time === s.speed) {
    throw new InputError(RECORDING.same);
  }
  const all = [...columns.values()];
  const time = all[s.time] ?? all[0];
  const speed = all[s.speed] ?? all[1];
  const t = time.map((value) => value * TIME_UNITS[s.time_unit]);
  const z = speed.map((value) => value * SPEED_UNITS[s.speed_unit]);
  const sampled = sampling(t);
  const far = z.findIndex((value) => Math.abs(value) > FASTEST);
  if (far >= 0) {
    const place = { line: String(lines[far]), z: z[far], most: FASTEST };
    throw new InputError(inBoth(RECORDING.too_fast, place));
  }
  const gaps = z.filter(Number.isNaN).length;
  const missing = gaps > 0 ? inBoth(RECORDING.gaps, { gaps: String(gaps) }) : { id: "", en: "" };
  const sentences = { id: [note.id, sampled.id, missing.id], en: [note.en, sampled.en, missing.en] };
  const joined = {
    id: sentences.id.filter(Boolean).join(" "),
    en: sentences.en.filter(Boolean).join(" "),
  };
  return { t, z, truth: null, note: joined };
}
