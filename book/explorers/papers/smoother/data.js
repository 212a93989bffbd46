// Where the numbers of chapter 2 come from: the paper, three synthetic look-alikes, the Nile, or the reader.
import nile from "data/nile.csv";
import { broughtTable, chosenColumns, hasBrought } from "../../own/data.js";
import { generator } from "../../numerics/random.js";
import { LOOK_ALIKES, MEASURED, look_alike } from "./model.js";
import { MEASURED_NAME, NO_DATA_YET, SOURCES } from "./words.js";

/** The settings of the paper's form. */
export const PAPER = { Q: 1e-5, R: 1e-5, x0: 0, P0: 1, window: 3 };

/**
 * Those that suit the Nile: Durbin and Koopman's variances (their unit: 1e8 m3, squared); the first value
 * counts once, as nothing is known before it.
 */
const NILE = { Q: 1469, R: 15099, x0: 1120, P0: 1e9, window: 5 };

/** Is it shown? */
export function isOwn(s) {
  return s.source === "own" && hasBrought(s);
}

/** What else changes when the reader chooses a source: the settings that suit it; those for own data stay. */
export function settingsFor(source, s) {
  if (source === "own" && hasBrought(s)) {
    return {};
  }
  if (source === "nile") {
    return NILE;
  }
  if (source in LOOK_ALIKES) {
    const { R, window } = LOOK_ALIKES[source];
    return { ...PAPER, R, window };
  }
  return PAPER;
}

/**
 * {z, truth or null, names: columns to choose from, name: what was measured, note}; read again only when
 * something about it has changed.
 */
export function load(s, memo) {
  const key = [s.source, s.seed, s.text, s.file, s.sheet, s.sign, s.missing, s.value];
  if (!memo.key?.every((value, i) => value === key[i])) {
    memo.data = { truth: null, names: [], name: MEASURED_NAME, ...dataOf(s) };
    memo.key = key;
  }
  return memo.data;
}

function dataOf(s) {
  if (isOwn(s)) {
    return ownData(s);
  }
  if (s.source === "own") {
    return { z: MEASURED, note: NO_DATA_YET };
  }
  if (s.source in LOOK_ALIKES) {
    return { ...look_alike(s.source, generator(s.seed)), note: syntheticNote(SOURCES[s.source], s.seed) };
  }
  const { id, en } = SOURCES[s.source];
  const z = s.source === "nile" ? volumesOf(nile) : MEASURED;
  return { z, note: { id: `${id}.`, en: `${en}.` } };
}

/** The last column of the file that comes with the book. */
function volumesOf(text) {
  const [, ...lines] = text.trim().split("\n");
  return Float64Array.from(lines, (line) => Number(line.split(",").at(-1)));
}

function ownData(s) {
  const table = broughtTable(s);
  const { value } = chosenColumns(s, table);
  const z = table.columns.get(value);
  return { z, names: [...table.columns.keys()], name: { id: value, en: value }, note: table.note };
}

/** "... (synthetic)" -> "... (synthetic, random seed 2)." */
function syntheticNote({ id = "", en = "" }, seed) {
  return {
    id: id.replace(")", `, benih acak ${seed}).`),
    en: en.replace(")", `, random seed ${seed}).`),
  };
}
