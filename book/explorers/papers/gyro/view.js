// The first explorer of chapter 3: the paper's simulation, filtered.
import { chi2Bounds, rmse } from "../../numerics/metrics.js";
import { CASES, error_with_gain, maxima, steady } from "./model.js";
import { question } from "./questions.js";
import { compute, manyRuns, spread, study } from "./runs.js";
import { ANGLE, CONSISTENCY, CONTROLS, ERROR, FACTS, GAIN, LABELS, NAMES, OUTCOME } from "./words.js";

const DEGREE = Math.PI / 180; // rad
const TABLE_ROWS = 500;

// --- figures -----------------------------------------------------------------------------------------------

/** From the start to the last step, s. */
function timeSpan(r) {
  return [0, r.t[r.T - 1]];
}

function drawAngle(r) {
  return {
    xlim: timeSpan(r),
    layers: [
      { look: "band", x: r.t, low: r.low, high: r.high, label: "±2√P" },
      { look: "measurement", x: r.t, y: r.flight.z, label: "z" },
      { look: "truth", x: r.t, y: r.flight.x, label: "x_true" },
      { look: "estimate", x: r.t, y: r.filter.x, label: "x" },
    ],
  };
}

function drawError(r) {
  const { spread: high, minus: low } = spread(r);
  const { count } = r.runs;
  const of_runs = { id: `±2σ dari ${count} percobaan`, en: `±2σ of ${count} experiments` };
  return {
    xlim: timeSpan(r),
    layers: [
      { look: "band", x: r.t, low: r.band_low, high: r.band_high, label: "±2√P" },
      { look: "measurement", x: r.t, y: r.measured, label: "x_true − z" },
      { look: "estimate", x: r.t, y: r.error, label: "x_true − x" },
      { look: "rival", x: r.t, y: high, label: of_runs },
      { look: "rival", x: r.t, y: low },
    ],
  };
}

function drawGain(r) {
  const [steady_K] = steady(r.believed);
  return {
    xlim: timeSpan(r),
    layers: [
      { look: "quiet", level: 0 },
      { look: "quiet", level: steady_K, label: LABELS.steady },
      { look: "estimate", x: r.t, y: r.filter.K, label: "K" },
    ],
  };
}

function drawConsistency(r) {
  const { nees, nis } = spread(r);
  const [low, high] = chi2Bounds(1, r.runs.count);
  const ends = timeSpan(r);
  return {
    xlim: ends,
    ylim: aroundOne(nees, nis),
    layers: [
      { look: "band", x: ends, low: [low, low], high: [high, high], label: LABELS.chi_square },
      { look: "estimate", x: r.t, y: nees, label: "NEES" },
      { look: "rival", x: r.t, y: nis, label: "NIS" },
    ],
  };
}

/** From a half to two, or whole decades if the values leave that range. */
function aroundOne(nees, nis) {
  let least = 0.5;
  let most = 2;
  for (let k = 0; k < nees.length; k++) {
    least = Math.min(least, nees[k], nis[k]);
    most = Math.max(most, nees[k], nis[k]);
  }
  if (least === 0.5 && most === 2) {
    return [least, most];
  }
  return [10 ** Math.floor(Math.log10(least)), 10 ** Math.ceil(Math.log10(most))];
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const [z, x] = maxima(r.flight, r.filter);
  const all = study(r);
  const [sensor] = rmse(r.flight.x, r.flight.z);
  const [filter] = rmse(r.flight.x, r.filter.x);
  const of_runs = { runs: r.runs.count, all: all.rmse, best: all.optimum, nees: all.nees, nis: all.nis };
  return [
    t.say(OUTCOME.run, { z, x, sensor, rmse: filter }),
    t.say(verdictOn(r, s, all.nees), of_runs),
    t.say(OUTCOME.seed, { seed: String(s.seed) }),
  ].join(" ");
}

/** Does the filter know how large its errors are? */
function verdictOn({ believed }, s, nees) {
  if (believed.sigma_w === s.sigma_w && believed.sigma_v === s.sigma_v) {
    return OUTCOME.honest;
  }
  if (nees > 1.1) {
    return OUTCOME.sure;
  }
  return nees < 0.9 ? OUTCOME.doubtful : OUTCOME.between;
}

/** What comes of a wrong belief; while the filter believes the truth there is nothing to compare. */
function facts(r, s, t) {
  if (!s.other) {
    return { head: [], rows: [] };
  }
  const [K, sigma] = steady(r.believed);
  const [, best_sigma] = steady(s);
  const last = r.T - 1;
  const { e2, best2, count } = r.runs;
  const mean_root = (sums, k) => Math.sqrt(sums[k] / count);
  const row = (name, ...values) => [name, ...values.map((value) => t.decimal(value))];
  const error = t.say(FACTS.error, { runs: String(count) });
  return {
    head: ["", t.say(FACTS.first), t.say(FACTS.last), t.say(FACTS.steady)],
    rows: [
      row("K", r.filter.K[0], r.filter.K[last], K),
      row(t.say(FACTS.stated), r.root[0], r.root[last], sigma),
      row(error, mean_root(e2, 0), mean_root(e2, last), error_with_gain(s, K)),
      row(t.say(FACTS.optimum), mean_root(best2, 0), mean_root(best2, last), best_sigma),
    ],
  };
}

const HEAD = [
  "k",
  "t (s)",
  "x_true (rad)",
  "z (rad)",
  "x_pred (rad)",
  "P_pred (rad²)",
  "K",
  "x (rad)",
  "P (rad²)",
];

function numbers({ T, t: time, flight, filter }, s, t) {
  const { x_pred, P_pred, K, x, P } = filter;
  const columns = [time, flight.x, flight.z, x_pred, P_pred, K, x, P];
  const skip = Math.max(1, Math.ceil(T / TABLE_ROWS));
  const rows = [];
  for (let k = 0; k < T; k += skip) {
    rows.push([String(k + 1), ...columns.map((values) => t.decimal(values[k], 4))]);
  }
  return { head: HEAD, rows };
}

// --- controls ----------------------------------------------------------------------------------------------

/** A button that sets these values, and looks pressed while they are set. */
function settingButton(words, values) {
  const pressed = (s) => Object.entries(values).every(([name, value]) => s[name] === value);
  return { ...words, set: values, pressed };
}

function caseButton([figure, [sigma_w, sigma_v]]) {
  const words = { id: `Kasus ${figure}`, en: `Case ${figure}` };
  return settingButton(words, { duration: 20, T: 0.1, sigma_w, sigma_v });
}

/** A small gyroscope: 0.1 degrees a second, beside an angle sensor of one degree. */
const MEMS = {
  duration: 2,
  T: 0.01,
  sigma_w: Number((0.1 * DEGREE).toPrecision(3)),
  sigma_v: Number(DEGREE.toPrecision(3)),
};

/** The slider for a sigma as the filter believes it; it follows the true one until somebody moves it. */
function belief(name, symbol, unit, truth) {
  const range = { min: 1e-4, max: 100, step: 0.1, log: true, default: null };
  const auto = (s) => s[truth];
  const visible = (s) => s.other;
  return { ...range, name, symbol, unit, ...CONTROLS.believed, auto, visible };
}

const controls = [
  { kind: "buttons", items: [...Object.entries(CASES).map(caseButton), settingButton(CONTROLS.mems, MEMS)] },
  { name: "duration", symbol: "t" },
  { name: "T", symbol: "T" },
  { name: "sigma_w", symbol: "σ_w" },
  { name: "sigma_v", symbol: "σ_v" },
  { kind: "check", name: "other", default: false, ...CONTROLS.other },
  belief("believed_w", "σ_w", "rad/s", "sigma_w"),
  belief("believed_v", "σ_v", "rad", "sigma_v"),
];

export const flight = {
  name: NAMES.flight,
  noise: true,
  controls,
  compute,
  refine: manyRuns,
  plots: [
    { ...ANGLE, xlabel: "t (s)", height: 200, draw: drawAngle },
    { ...ERROR, xlabel: "t (s)", height: 200, draw: drawError },
    { ...GAIN, xlabel: "t (s)", height: 150, after: true, draw: drawGain },
    {
      ...CONSISTENCY,
      xlabel: "t (s)",
      height: 170,
      after: true,
      ylog: true,
      visible: (s) => s.other,
      draw: drawConsistency,
    },
  ],
  outcome,
  facts,
  numbers,
  question,
};
