// What the explorer of chapter 7 shows: a filter that the reader builds, and how it judges itself.
import { mean, nis } from "../../numerics/metrics.js";
import { load, patternFor, startingNoise } from "./data.js";
import { PATTERN, SECOND, model, run } from "./model.js";
import { question } from "./questions.js";
import { CONTROLS, LABELS, NAME, OUTCOME, PATTERNS, PLOTS, SECONDS } from "./words.js";

const TABLE_ROWS = 500;

function compute(s, memo) {
  const data = load(s, memo);
  const result = run(s, data);
  const { n, m, T } = result;
  const x = column(result.x, n, 0);
  const root = column(result.P, n * n, 0).map(Math.sqrt);
  return {
    data,
    model: model(s, data.dt),
    result,
    T,
    z: column(data.z, m, 0),
    truth: data.truth && column(data.truth, n, 0),
    x,
    root,
    low: x.map((value, k) => value - 2 * root[k]),
    high: x.map((value, k) => value + 2 * root[k]),
    nis: mean(nis(result.y, result.S, m)) / m,
  };
}

/** Entry i of every step, of an array with so many a step. */
export function column(values, size, i) {
  return Float64Array.from({ length: values.length / size }, (_, k) => values[k * size + i]);
}

function drawEstimate({ data, z, truth, x, low, high }) {
  return {
    layers: [
      { look: "band", x: data.t, low, high, label: "±2√P" },
      { look: "measurement", x: data.t, y: z, label: "z" },
      truth && { look: "truth", x: data.t, y: truth, label: "x_true" },
      { look: "estimate", x: data.t, y: x, label: LABELS.x },
    ],
    ylim: undefined,
  };
}

function outcome(r, s, t) {
  return [t.say(OUTCOME.nis, { nis: r.nis }), t.say(r.data.note)].join(" ");
}

function numbers(r, s, t) {
  const columns = { "t (s)": r.data.t, z: r.z, x: r.x, "√P": r.root };
  const skip = Math.max(1, Math.ceil(r.T / TABLE_ROWS));
  const rows = [];
  for (let k = 0; k < r.T; k += skip) {
    const values = Object.values(columns).map((values_of_all) => t.decimal(values_of_all[k], 5));
    rows.push([String(k + 1), ...values]);
  }
  return { head: ["k", ...Object.keys(columns)], rows };
}

const controls = [
  {
    kind: "select",
    name: "pattern",
    ...CONTROLS.pattern,
    options: Object.values(PATTERN).map((pattern) => [pattern, PATTERNS[pattern]]),
    also: (pattern) => startingNoise(pattern),
  },
  {
    kind: "select",
    name: "second",
    ...CONTROLS.second,
    options: Object.values(SECOND).map((second) => [second, SECONDS[second]]),
    also(second, s) {
      const pattern = patternFor(second, s.pattern);
      return pattern === s.pattern ? {} : { pattern, ...startingNoise(pattern) };
    },
    visible: (s) => s.pattern !== PATTERN.OWN,
  },
  { name: "Qc", symbol: "Q_c", min: 1e-9, max: 1e6, visible: (s) => s.pattern !== PATTERN.CONSTANT },
  { name: "R", symbol: "R", min: 1e-6, max: 1e6 },
];

export const builder = {
  name: NAME,
  controls,
  noise: true,
  compute,
  plots: [{ ...PLOTS.estimate, xlabel: "t (s)", height: 240, draw: drawEstimate }],
  outcome,
  numbers,
  question,
};
