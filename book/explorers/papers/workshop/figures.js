// The figures of the workshop: the estimate, its innovations, their autocorrelation, and the other states.
import { PATTERN } from "./model.js";
import { LABELS, PLOTS } from "./words.js";

const SURE = 1.96;
const BEGINNING = 0.25; // the share of the steps in which the band of a rate may be wider than the figure

/** Entry i of every step, of an array with so many a step. */
export function column(values, size, i) {
  return Float64Array.from({ length: values.length / size }, (_, k) => values[k * size + i]);
}

/** The estimate of state i and its band: {x, low, high}. */
export function band({ result: { x, P, n } }, i) {
  const middle = column(x, n, i);
  const root = column(P, n * n, i * n + i).map(Math.sqrt);
  const low = middle.map((value, k) => value - 2 * root[k]);
  const high = middle.map((value, k) => value + 2 * root[k]);
  return { x: middle, root, low, high };
}

/** Limits that hold these values, the vague beginning aside. */
function limitsOf(...lists) {
  let low = Infinity;
  let high = -Infinity;
  for (const values of lists) {
    for (const value of values) {
      low = value < low ? value : low;
      high = value > high ? value : high;
    }
  }
  const room = 0.06 * (high - low) || 1;
  return [low - room, high + room];
}

function drawEstimate(r, s) {
  const { data, first, average } = r;
  const { t } = data;
  const isSecondSensor = data.m > 1 && s.second === 2 && s.pattern !== PATTERN.OWN;
  return {
    ylim: limitsOf(r.z, first.x.subarray(r.result.n)),
    layers: [
      { look: "band", x: t, low: first.low, high: first.high, label: "±2√P" },
      isSecondSensor && { look: "smooth", x: t, y: column(data.z, 2, 1), label: "z_2" },
      { look: "measurement", x: t, y: r.z, label: "z" },
      data.truth && { look: "truth", x: t, y: column(data.truth, data.states, 0), label: "x_true" },
      average && { look: "rival", x: t, y: average, label: LABELS.average },
      { look: "estimate", x: t, y: first.x, label: "x" },
      r.left.length > 0 && { look: "rival", sign: "×", mark: r.left[0], label: LABELS.left },
      ...r.left.slice(1).map((mark) => ({ look: "rival", sign: "×", mark })),
    ],
  };
}

/** The second state: a rate, or what is second in a model of the reader's own. */
function drawRate(r) {
  const { data, result } = r;
  const { x, low, high } = band(r, 1);
  const settled = x.subarray(result.n);
  const truth = data.truth && column(data.truth, data.states, 1);
  const later = (values) => values.subarray(Math.floor(BEGINNING * values.length));
  return {
    ylim: limitsOf(settled, later(low), later(high), truth ?? []),
    layers: [
      { look: "band", x: data.t, low, high, label: "±2√P" },
      truth && { look: "truth", x: data.t, y: truth, label: "x_true" },
      { look: "estimate", x: data.t, y: x, label: "x_2" },
    ],
  };
}

/** Innovations in standard deviations: 95 % of them lie between the lines. */
function drawInnovations({ data, judged }) {
  const dots = judged.e.map((values, i) => ({
    look: i === 0 ? "measurement" : "smooth",
    x: data.t,
    y: values,
    label: judged.e.length > 1 ? `y_${i + 1}/√S` : "y/√S",
  }));
  const flat = new Float64Array(data.t.length);
  const low = flat.map(() => -SURE);
  const high = flat.map(() => SURE);
  return { layers: [{ look: "band", x: data.t, low, high, label: LABELS.inside }, ...dots] };
}

/** The correlation of innovations some steps apart: white ones stay between the lines. */
function drawCorrelation({ judged }) {
  const { correlation, band: limit } = judged.white[0];
  const lags = Float64Array.from({ length: correlation.length + 1 }, (_, i) => i);
  const x = [];
  const y = [];
  correlation.forEach((value, i) => {
    x.push(i + 1, i + 1, i + 1);
    y.push(0, value, NaN);
  });
  const reach = Math.max(0.5, ...correlation.map((value) => 1.1 * Math.abs(value) || 0));
  return {
    xlim: [0, correlation.length + 0.5],
    ylim: [-reach, reach],
    layers: [
      {
        look: "band",
        x: lags,
        low: lags.map(() => -limit),
        high: lags.map(() => limit),
        label: LABELS.inside,
      },
      { look: "estimate", x: Float64Array.from(x), y: Float64Array.from(y), label: "r" },
    ],
  };
}

const below = { half: true, after: true, height: 170 };

export const plots = [
  { ...PLOTS.estimate, xlabel: "t", height: 240, draw: drawEstimate },
  { ...PLOTS.innovations, ...below, xlabel: "t", draw: drawInnovations },
  { ...PLOTS.correlation, ...below, xlabel: "k", draw: drawCorrelation },
  { ...PLOTS.rate, ...below, xlabel: "t", draw: drawRate, visible: (s) => s.pattern >= PATTERN.VELOCITY },
];
