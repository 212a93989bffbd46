// The second explorer of chapter 2: one measurement at a time, typed or from a synthetic stream.
import { number } from "../../language/input.js";
import { generator } from "../../numerics/random.js";
import { look_alike, run, steady_gain } from "./model.js";
import { question } from "./questions.js";
import { counted, numbers } from "./shared.js";
import { ARRIVALS, ARRIVED, NAMES, ONLINE_CONTROLS } from "./words.js";

const STREAM = 288; // values: a day
const RECENT = 200; // so many are shown
const AXIS_STEP = 50; // the axis grows by so many

function compute(s, memo) {
  if (memo.seed !== s.seed) {
    memo.seed = s.seed;
    memo.stream = look_alike("silkworm_room", generator(s.seed)).z;
  }
  const z = Float64Array.of(...memo.stream.subarray(0, s.arrived), ...s.typed);
  const result = run(s, { z });
  const K = steady_gain(s.Q / s.R);
  return { z, result, K, recent: recentPart(z, result, K) };
}

/** The last values, as the figures show them. */
function recentPart(z, result, K) {
  const from = Math.max(0, z.length - RECENT);
  const recent = (values) => values.subarray(from);
  const root = result.P.map(Math.sqrt);
  return {
    k: recent(counted(z.length)),
    z: recent(z),
    result: { ...result, x: recent(result.x), K: recent(result.K) },
    root: recent(root),
    K,
    low: recent(result.x.map((x, k) => x - 2 * root[k])),
    high: recent(result.x.map((x, k) => x + 2 * root[k])),
  };
}

// --- figures -----------------------------------------------------------------------------------------------

/** Limits of the axis: it grows in steps, so that it rests while values arrive. */
function axisOf({ recent: { k } }) {
  const first = k.length > 0 ? k[0] - 1 : 0;
  const last = k.length > 0 ? k.at(-1) : 1;
  return [first, first + AXIS_STEP * Math.ceil((last - first) / AXIS_STEP)];
}

function drawArrivals(r) {
  const { k, z, result, low, high } = r.recent;
  return {
    xlim: axisOf(r),
    layers: [
      { look: "band", x: k, low, high, label: "±2√P" },
      { look: "measurement", x: k, y: z, label: "z" },
      { look: "estimate", x: k, y: result.x, label: "x" },
    ],
  };
}

// --- words and equations -----------------------------------------------------------------------------------

function outcome(r, s, t) {
  const k = r.z.length - 1;
  if (k < 0) {
    return t.say(ARRIVED.none);
  }
  const { x_pred, x, P, K } = r.result;
  const origin = s.typed.length > 0 ? ARRIVED.typed : ARRIVED.stream;
  const values = {
    k: String(k + 1),
    z: r.z[k],
    K: K[k],
    pred: x_pred[k],
    x: x[k],
    root: Math.sqrt(P[k]),
    origin: t.say(origin, { seed: String(s.seed) }),
  };
  return t.say(Number.isNaN(r.z[k]) ? ARRIVED.gap : ARRIVED.one, values, 5);
}

/** The step of the last measurement, with its numbers. */
function equations(r, s, t) {
  const k = r.z.length - 1;
  const write = (value) => t.unbroken(value, 5);
  if (k < 0) {
    return [[`x_0 = ${write(s.x0)}`], [`P_0 = ${write(s.P0)}`]];
  }
  const { result } = r;
  const P_before = k > 0 ? result.P[k - 1] : s.P0;
  const x_before = k > 0 ? `x_${k}` : "x_0";
  const x_pred = write(result.x_pred[k]);
  const P_pred = write(result.P_pred[k]);
  const K = write(result.K[k]);
  const x = write(result.x[k]);
  const P = write(result.P[k]);
  const prediction = [
    [`x_pred = ${x_before} = ${x_pred}`],
    [`P_pred = P + Q = ${write(P_before)} + ${write(s.Q)} = ${P_pred}`],
  ];
  if (Number.isNaN(result.y[k])) {
    return [...prediction, [`x = x_pred = ${x}`], [`P = P_pred = ${P}`]];
  }
  const y = result.y[k] < 0 ? `( ${write(result.y[k])} )` : write(result.y[k]);
  return [
    ...prediction,
    [`K = P_pred / ( P_pred + R ) = ${P_pred} / ( ${P_pred} + ${write(s.R)} ) = ${K}`],
    [`x = x_pred + K ( z − x_pred ) = ${x_pred} + ${K} · ${y} = ${x}`],
    [`P = ( 1 − K ) P_pred = ${P}`],
  ];
}

// --- controls ----------------------------------------------------------------------------------------------

const isEmpty = (s) => s.typed.length + s.arrived === 0;

/** Without the last measurement: the last typed one, or one of the stream. */
function dropLast(s) {
  return s.typed.length > 0 ? { typed: s.typed.slice(0, -1) } : { arrived: Math.max(s.arrived - 1, 0) };
}

const controls = [
  {
    kind: "entry",
    ...ONLINE_CONTROLS.entry,
    button: ONLINE_CONTROLS.add,
    enter: (text, s, r, t) => ({ typed: [...s.typed, number(text, t.language)] }),
  },
  {
    kind: "buttons",
    items: [
      { ...ONLINE_CONTROLS.missing, set: (s) => ({ typed: [...s.typed, NaN] }) },
      { ...ONLINE_CONTROLS.drop, set: dropLast, disabled: isEmpty },
      { ...ONLINE_CONTROLS.clear, set: { typed: [], arrived: 0 }, disabled: isEmpty },
      { ...ONLINE_CONTROLS.play, play: "arrived", seconds: 60 },
    ],
  },
  {
    name: "arrived",
    ...ONLINE_CONTROLS.arrived,
    unit: "",
    min: 0,
    max: STREAM,
    step: 1,
    log: false,
    default: 60,
  },
  { name: "Q", symbol: "Q" },
  { name: "R", symbol: "R" },
];

export const online = {
  name: NAMES.online,
  start: { Q: 1e-3, R: 0.09, P0: 1000, typed: [] },
  controls,
  noise: true,
  compute,
  plots: [{ ...ARRIVALS, xlabel: "k", height: 230, draw: drawArrivals }],
  outcome,
  equations,
  numbers,
  question,
};
