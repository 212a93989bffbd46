// What the explorer of chapter 4 shows: the fit of AR(2), its poles, and the filter with the fitted model.
import { ownControls } from "../../own/data.js";
import { TIME_UNITS } from "../../files/units.js";
import { mean, nis, rmse } from "../../numerics/metrics.js";
import { rtsSmooth } from "../../numerics/smoother.js";
import { bias, drawBias, LEAST, noiseAt } from "./bias.js";
import { SPEED_UNITS, expected_fit, poles, run } from "./model.js";
import { circle, marks, polesText } from "./plane.js";
import { question } from "./questions.js";
import { isOwn, load, speedOf } from "./recording.js";
import { BIAS, CONTROLS, FACTS, LABELS, NAME, OUTCOME, POLES, SPEED } from "./words.js";

const TABLE_ROWS = 500;

/** Fit the data, filter it with what was found, and if wanted smooth it. */
function compute(s, memo) {
  const data = load(s, memo);
  const { z, truth, theta } = data;
  const [c, a1, a2] = theta;
  const p = { ...s, c, a1, a2, Q_copy: s.Q };
  const startsAtFirst = truth ? s.first : s.firstOwn;
  if (startsAtFirst) {
    p.x0 = z.find(Number.isFinite);
    p.P0 = s.R;
  }
  memo.result = run(p, data, memo.result);
  const result = memo.result;
  const shown = s.smooth ? rtsSmooth(result) : result;
  const x = z.map((_, k) => shown.x[2 * k]);
  const root = z.map((_, k) => Math.sqrt(shown.P[4 * k]));
  return {
    T: z.length,
    data,
    p,
    result,
    x,
    root,
    low: x.map((value, k) => value - 2 * root[k]),
    high: x.map((value, k) => value + 2 * root[k]),
    poles: poles(a1, a2),
    nis: mean(nis(result.y, result.S)),
    rmse: truth && [rmse(truth, z)[0], rmse(truth, x)[0]],
    ...(truth && withoutNoise(s, memo)),
  };
}

/**
 * Only for the synthetic run: {curve, still, average}, the bias over the noise, the fit without noise and on
 * average.
 */
function withoutNoise(s, memo) {
  const curve = bias(s, memo);
  memo.without ??= expected_fit(curve.x, 0);
  return { curve, still: memo.without, average: expected_fit(curve.x, s.sigma) };
}

// --- figures -----------------------------------------------------------------------------------------------

function drawSpeed({ data, x, low, high, T }, s) {
  const { t, z, truth } = data;
  return {
    xlim: [t[0], t[T - 1]],
    layers: [
      { look: "band", x: t, low, high, label: "±2√P" },
      { look: "measurement", x: t, y: z, label: "z" },
      truth && { look: "truth", x: t, y: truth, label: "x_true" },
      { look: "estimate", x: t, y: x, label: s.smooth ? "x_s" : "x" },
    ],
  };
}

function drawPoles(r) {
  const still = r.still ? poles(r.still[1], r.still[2]) : [];
  const sizes = [...r.poles, ...still].map(([real, imaginary]) => Math.hypot(real, imaginary));
  const reach = 1.1 * Math.max(1, ...sizes);
  return {
    xlim: [-reach, reach],
    ylim: [-reach, reach],
    layers: [
      ...circle(),
      ...marks(r.poles, "estimate", LABELS.fitted, "o"),
      ...marks(still, "truth", LABELS.still, "+"),
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const { c, a1, a2 } = r.p;
  const sentences = [t.say(OUTCOME.result, { c, a1, a2, poles: polesText(r.poles, t) })];
  if (r.still && s.sigma > 0) {
    const still = polesText(poles(r.still[1], r.still[2]), t);
    sentences.push(t.say(OUTCOME.still, { still }));
  }
  if (r.poles.some(([real, imaginary]) => Math.hypot(real, imaginary) > 1)) {
    sentences.push(t.say(OUTCOME.unstable));
  }
  if (r.rmse) {
    const [z, x] = r.rmse;
    sentences.push(t.say(OUTCOME.rmse, { z, x }));
  }
  sentences.push(t.say(OUTCOME.nis, { nis: r.nis }), t.say(r.data.note));
  return sentences.join(" ");
}

function facts(r, s, t) {
  const columns = [[FACTS.fit, r.data.theta]];
  if (r.still) {
    columns.push([FACTS.average, r.average], [FACTS.still, r.still]);
  }
  const thetas = columns.map(([, theta]) => theta);
  const row = (name, i) => [name, ...thetas.map((theta) => t.decimal(theta[i], 4))];
  const found_poles = thetas.map(([, a1, a2]) => polesText(poles(a1, a2), t));
  return {
    head: ["AR(2)", ...columns.map(([words]) => t.say(words))],
    rows: [row("c (m/s)", 0), row("a_1", 1), row("a_2", 2), [t.say(FACTS.poles), ...found_poles]],
  };
}

function numbers(r, s, t) {
  const { data, result } = r;
  const columns = [
    ["t (s)", (k) => data.t[k]],
    ["z (m/s)", (k) => data.z[k]],
    ["x_pred (m/s)", (k) => result.x_pred[2 * k]],
    ["y (m/s)", (k) => result.y[k]],
    ["S (m²/s²)", (k) => result.S[k]],
    ["K_1", (k) => result.K[2 * k]],
    [s.smooth ? "x_s (m/s)" : "x (m/s)", (k) => r.x[k]],
    ["√P (m/s)", (k) => r.root[k]],
  ];
  if (data.truth) {
    columns.splice(1, 0, ["x_true (m/s)", (k) => data.truth[k]]);
  }
  const skip = Math.max(1, Math.ceil(r.T / TABLE_ROWS));
  const rows = [];
  for (let k = 0; k < r.T; k += skip) {
    rows.push([String(k + 1), ...columns.map(([, valueAt]) => t.decimal(valueAt(k), 4))]);
  }
  return { head: ["k", ...columns.map(([name]) => name)], rows };
}

// --- the view ----------------------------------------------------------------------------------------------

const isSynthetic = (s) => !isOwn(s);
const SPEED_NAMES = { "km/h": CONTROLS.km_h, kn: CONTROLS.knots };
const time_units = Object.keys(TIME_UNITS).map((unit) => [unit, unit]);
const speed_units = Object.keys(SPEED_UNITS).map((unit) => [unit, SPEED_NAMES[unit] ?? unit]);
const new_noise = { ...CONTROLS.noise, set: (s) => ({ seed: s.seed + 1 }) };
const back = { ...CONTROLS.back, set: { text: null, file: null } };

const controls = [
  { name: "sigma", symbol: "σ", log: true, low: LEAST, visible: isSynthetic },
  { name: "Q", symbol: "Q" },
  { name: "R", symbol: "R" },
  { kind: "buttons", items: [new_noise], visible: isSynthetic },
  { kind: "check", name: "smooth", default: false, ...CONTROLS.smooth },
  { kind: "check", name: "first", default: false, ...CONTROLS.first, visible: isSynthetic },
  { kind: "check", name: "firstOwn", default: true, ...CONTROLS.first, visible: isOwn },
  ...ownControls({ words: CONTROLS, time: true, value: speedOf, rows: 4 }),
  select("time_unit", time_units),
  select("speed_unit", speed_units),
  { kind: "buttons", items: [back], visible: isOwn },
];

/** A choice for who brought data. */
function select(name, options) {
  const all = [["auto", CONTROLS.from_header], ...options];
  return { kind: "select", name, default: "auto", ...CONTROLS[name], options: all, visible: isOwn };
}

export const view = {
  name: NAME,
  controls,
  compute,
  plots: [
    { ...SPEED, xlabel: "t (s)", height: 240, draw: drawSpeed },
    { ...POLES, xlabel: "Re λ", height: 230, half: true, after: true, equal: true, draw: drawPoles },
    {
      ...BIAS,
      xlabel: "σ (m/s)",
      height: 230,
      half: true,
      after: true,
      xlog: true,
      visible: isSynthetic,
      drag: (x) => ({ sigma: noiseAt(x) }),
      draw: drawBias,
    },
  ],
  outcome,
  facts,
  numbers,
  question,
};
