// What both explorers of chapter 2 show: the gain, the standard deviation, and the numbers as a table.
import { DEVIATION, GAIN, LABELS, LINES, TEXT_HEAD } from "./words.js";

const TABLE_ROWS = 500;

/** 1, 2, ... T */
export function counted(T) {
  return new Float64Array(T).map((_, k) => k + 1);
}

/** r: {k, K: the steady gain, result}. */
export function drawGain(r) {
  return {
    layers: [
      { look: "quiet", level: 0 },
      { look: "quiet", level: r.K, label: LABELS.steady },
      { look: "estimate", x: r.k, y: r.result.K, label: "K" },
    ],
  };
}

/** r: {k, root}. */
export function drawDeviation(r) {
  return {
    layers: [
      { look: "quiet", level: 0 },
      { look: "estimate", x: r.k, y: r.root, label: "√P" },
    ],
  };
}

const below = { xlabel: "k", height: 120, half: true, after: true };
export const GAIN_PLOT = { ...GAIN, ...below };
export const DEVIATION_PLOT = { ...DEVIATION, ...below };

/** The label of a line in a figure, and its head in the table. */
export function labelOf(name, s) {
  const labels = { x: "x", average: `MA(${s.window})`, exponential: LABELS.exponential, smooth: "x_smooth" };
  return labels[name];
}

/** The name of a line in a text. */
export function nameOf(name, t) {
  return t.say(LINES[name]);
}

/** The lines beside the filter's own: [[name, numbers], ...]. */
export function rivals(r) {
  return Object.entries(r.lines ?? {}).filter(([name]) => name !== "x");
}

export function numbers(r, s, t) {
  const { x_pred, P_pred, y, K, x, P } = r.result;
  const columns = { z: r.z, x_pred, P_pred, y, K, x, P };
  return tableOf("k", columns, r, s, t);
}

/** The table of the paper's form, No / Measured / Filtered, and what stands behind it. */
export function formTable(r, s, t) {
  const { x_pred, P_pred, y, K, x, P } = r.result;
  const names = [TEXT_HEAD.measured, TEXT_HEAD.filtered].map((words) => t.say(words));
  const columns = { [names[0]]: r.z, [names[1]]: x, x_pred, P_pred, y, K, P };
  return tableOf("No", columns, r, s, t);
}

/** Numbers with six digits, for every step one row; the rivals come last. */
function tableOf(number_name, columns, r, s, t) {
  const others = rivals(r);
  const values = [...Object.values(columns), ...others.map(([, line]) => line)];
  const row = (k) => [String(k + 1), ...values.map((column) => t.decimal(column[k], 6))];
  const names = others.map(([name]) => t.say(labelOf(name, s)));
  return { head: [number_name, ...Object.keys(columns), ...names], rows: shortened(r.z.length, row) };
}

/** The beginning and the end of a long table, with a row of dots between them. */
function shortened(T, row) {
  const half = TABLE_ROWS / 2;
  const rows = [];
  for (let k = 0; k < T; k++) {
    if (T <= TABLE_ROWS || k < half || k >= T - half) {
      rows.push(row(k));
    } else if (k === half) {
      rows.push(row(k).map(() => "⋮"));
    }
  }
  return rows;
}
