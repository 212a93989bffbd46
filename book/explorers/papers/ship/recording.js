// The data of chapter 4: the synthetic towing run, or what the reader pasted or opened.
import { broughtTable, chosenColumns, hasBrought } from "../../own/data.js";
import { seriesOf } from "../../files/series.js";
import { namesSpeed } from "../../files/units.js";
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { generator } from "../../numerics/random.js";
import { SPEED_UNITS, fit, sampling, towing_run } from "./model.js";
import { RECORDING } from "./words.js";

const FASTEST = 1e6; // m/s, the range of Params
const BROUGHT = ["text", "file", "sheet", "sign", "missing", "time", "value", "time_unit", "speed_unit"];

/** Has the reader brought data? */
export const isOwn = hasBrought;

/**
 * {t, z, u, truth or null, theta: the fit, note}: the data that is shown; memo keeps it while nothing about
 * it changes.
 */
export function load(s, memo) {
  const names = isOwn(s) ? BROUGHT : ["seed", "sigma"];
  const key = [isOwn(s), ...names.map((name) => s[name])];
  const isSame = memo.key?.length === key.length && memo.key.every((value, i) => value === key[i]);
  if (!isSame) {
    const data = isOwn(s) ? recording(broughtTable(s), s) : synthetic(s);
    data.u = new Float64Array(data.z.length).fill(1);
    data.theta = fit(data.z);
    if (!data.theta) {
      throw new InputError(RECORDING.no_fit);
    }
    Object.assign(memo, { key, data });
  }
  return memo.data;
}

function synthetic({ seed, sigma }) {
  const { t, x, z } = towing_run(generator(seed), sigma);
  const note = {
    id: `Data sintetis, benih acak ${seed}.`,
    en: `Synthetic data, random seed ${seed}.`,
  };
  return { t, z, truth: x, note };
}

/** The column of a table that is a speed by its name, or the one that is measured. */
export function speedOf(table) {
  const others = [...table.columns.keys()].filter((name) => name !== table.time);
  const named = others.find((name) => namesSpeed(table.heads.get(name)));
  return named ?? table.value;
}

/** The unit of a speed: the one that the reader chose, or that its header names. */
function speedUnit(s, table, name) {
  if (s.speed_unit !== "auto") {
    return { unit: s.speed_unit, assumed: [] };
  }
  const unit = table.units[name];
  if (unit && Object.hasOwn(SPEED_UNITS, unit)) {
    return { unit, assumed: [] };
  }
  return { unit: "m/s", assumed: [inBoth(RECORDING.assumed, { name })] };
}

/** Two columns of a table in the units that the reader chose: {t, z, truth: null, note}. */
function recording(table, s) {
  const { time, value } = chosenColumns(s, table, speedOf(table));
  if (table.columns.size < 2) {
    throw new InputError(RECORDING.one_column);
  }
  if (time === null) {
    throw new InputError(RECORDING.no_time);
  }
  if (time === value) {
    throw new InputError(RECORDING.same);
  }
  const unit = s.time_unit === "auto" ? null : s.time_unit;
  const series = seriesOf(table, { time, value, unit });
  const speed = speedUnit(s, table, value);
  const z = series.z.map((one) => one * SPEED_UNITS[speed.unit]);
  const sampled = sampling(series.t);
  checkSpeeds(z, series.lines);
  const gaps = z.filter(Number.isNaN).length;
  const missing = gaps > 0 ? [inBoth(RECORDING.gaps, { gaps: String(gaps) })] : [];
  const taken = inBoth(RECORDING.taken, { time, value, unit: speed.unit });
  const notes = oneText([
    table.note,
    taken,
    ...series.notes.map(ended),
    ...speed.assumed,
    sampled,
    ...missing,
  ]);
  return { t: series.t, z, truth: null, note: notes };
}

/** A note as a sentence of its own. */
function ended({ en, id }) {
  const sentence = (text = "") => `${text.slice(0, 1).toUpperCase()}${text.slice(1)}.`;
  return { en: sentence(en), id: sentence(id) };
}

function oneText(sentences) {
  const inLanguage = (language) => sentences.map((one) => one[language]).join(" ");
  return { en: inLanguage("en"), id: inLanguage("id") };
}

/** InputError: a speed beyond all sense. */
function checkSpeeds(z, lines) {
  const far = z.findIndex((value) => Math.abs(value) > FASTEST);
  if (far >= 0) {
    const place = { line: String(lines[far]), z: z[far], most: FASTEST };
    throw new InputError(inBoth(RECORDING.too_fast, place));
  }
}
