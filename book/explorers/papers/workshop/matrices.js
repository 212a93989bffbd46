// F and H as a reader types them: rows below each other or between semicolons, or as in Python.
import { InputError, number } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { MATRICES } from "./mistakes.js";

const MOST_STATES = 6;
const MOST_SENSORS = 2;

export const START_F = "0.99 0.1\n-0.1 0.99";
export const START_H = "1 0";

/** {F, H} as lists of rows; an InputError says what is wrong with them. */
export function readMatrices(text_F, text_H) {
  const F = readMatrix("F", text_F);
  const H = readMatrix("H", text_H);
  const n = F.length;
  if (F[0].length !== n) {
    throw wrong(MATRICES.square, { n, m: F[0].length });
  }
  if (n > MOST_STATES) {
    throw wrong(MATRICES.large, { n, most: MOST_STATES });
  }
  if (H[0].length !== n) {
    throw wrong(MATRICES.columns, { n, m: H[0].length });
  }
  if (H.length > MOST_SENSORS) {
    throw wrong(MATRICES.sensors, { m: H.length, most: MOST_SENSORS });
  }
  return { F, H };
}

/** The rows of a matrix; InputError: it is none. */
export function readMatrix(name, text) {
  const isPython = text.includes("[");
  const plain = isPython ? text.replace(/\]\s*,/g, "\n").replace(/[[\],]/g, " ") : text;
  const lines = plain.split(/[\n;]/).map((line) => line.trim());
  const rows = lines.filter(Boolean).map((line) => line.split(/,?\s+/).map((cell) => entry(name, cell)));
  if (rows.length === 0) {
    throw wrong(MATRICES.empty, { name });
  }
  const odd = rows.findIndex((row) => row.length !== rows[0].length);
  if (odd > 0) {
    throw wrong(MATRICES.ragged, { name, row: odd + 1, has: rows[odd].length, first: rows[0].length });
  }
  return rows;
}

function entry(name, cell) {
  try {
    return number(cell);
  } catch {
    throw wrong(MATRICES.no_number, { name, cell: cell.slice(0, 20) });
  }
}

function wrong(words, values) {
  const texts = Object.entries(values).map(([name, value]) => [name, String(value)]);
  return new InputError(inBoth(words, Object.fromEntries(texts)));
}
