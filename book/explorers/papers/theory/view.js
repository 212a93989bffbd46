// What the explorer of chapter 1 shows: its controls, figures, sentences and equations.
import { drag, plane } from "./figures.js";
import { question } from "./questions.js";
import { LAST, START, UPDATE, compute, given, kindOf, stepOf, zName } from "./steps.js";
import { strip } from "./strip.js";
import { CONTROLS, GAIN, NAME, ORIGINS, PLANE, TEXTS, TITLES } from "./words.js";

const PRINTED_Z = 2.2; // m: the measurement of the worked example

function outcome(r, s, t) {
  const { k, kind, result, beliefs } = r;
  const at = Math.ceil(r.moment);
  const { x, P } = beliefs[at];
  const before = beliefs[Math.max(at - 1, 0)];
  const K = result.K[2 * k - 2]; // of the position
  const title = titleOf(r.moment, t);
  const text = t.say(TEXTS[kind], {
    x: x[0],
    v: x[1],
    sx: Math.sqrt(P[0]),
    sv: Math.sqrt(P[2]),
    dt: s.dt,
    before: Math.sqrt(before.P[0]),
    K,
    y: result.y[k - 1],
    percent: t.decimal(100 * K, 2),
    origin: t.say(originOf(k, s), { seed: String(s.seed) }),
  });
  return `${title} ${text}`;
}

/** The name of a moment, with the number that its slider shows. */
function titleOf(moment, t) {
  const numbers = { moment: Math.ceil(moment), of: LAST, k: stepOf(moment) };
  const words = Object.entries(numbers).map(([name, value]) => [name, String(value)]);
  return t.say(TITLES[kindOf(moment)], Object.fromEntries(words));
}

/** Where the measurement of step k comes from. */
function originOf(k, s) {
  const isChosen = k === 1 ? s.z !== PRINTED_Z : s[zName(k)] !== null;
  if (isChosen) {
    return ORIGINS.yours;
  }
  return k === 1 ? ORIGINS.source : ORIGINS.synthetic;
}

// --- the equations with their numbers ----------------------------------------------------------------------

function equations(r, s, t) {
  const write = writerFor(t);
  if (r.kind === START) {
    return startEquations(r, s, write);
  }
  return r.kind === UPDATE ? updateEquations(r, write) : predictionEquations(r, s, write);
}

/** How numbers, vectors and matrices are written: for lines as element/equations.js wants them. */
function writerFor(t) {
  const number = (value) => t.unbroken(value, 4);
  const matrix = (rows) => ({ matrix: rows.map((row) => Array.from(row, number)) });
  return {
    number,
    signed: (value) => (value < 0 ? `( ${number(value)} )` : number(value)),
    row: (x) => matrix([x]),
    column: (x) => matrix(Array.from(x, (value) => [value])),
    square: ([a, b, c, d]) =>
      matrix([
        [a, b],
        [c, d],
      ]),
    covariance: ([aa, ab, bb]) =>
      matrix([
        [aa, ab],
        [ab, bb],
      ]),
  };
}

function startEquations({ beliefs, model }, s, { number, row, column, square, covariance }) {
  const [start] = beliefs;
  return [
    ["x_0 =", column(start.x), "P_0 =", covariance(start.P)],
    ["F =", square(model.F), "B =", column(model.B)],
    ["H =", row(model.H), "Q =", square(model.Q)],
    [`R = ${number(model.R[0])}`, `u = ${number(s.u)}`],
  ];
}

function predictionEquations({ k, beliefs, model }, s, { signed, column, square, covariance }) {
  const { F, B, Q } = model;
  const before = beliefs[2 * k - 2];
  const predicted = beliefs[2 * k - 1];
  const F_transposed = [F[0], F[2], F[1], F[3]];
  return [
    ["x_pred = F x + B u"],
    ["=", square(F), column(before.x), "+", column(B), signed(s.u)],
    ["=", column(predicted.x)],
    ["P_pred = F P F^T + Q"],
    ["=", square(F), covariance(before.P), square(F_transposed), "+", square(Q)],
    ["=", covariance(predicted.P)],
  ];
}

function updateEquations({ k, z, beliefs, result, model }, { number, signed, column, square, covariance }) {
  const predicted = beliefs[2 * k - 1];
  const updated = beliefs[2 * k];
  const K = result.K.subarray(2 * k - 2, 2 * k);
  const y = result.y[k - 1];
  const S = result.S[k - 1];
  const R = model.R[0];
  const I_KH = [1 - K[0], 0, -K[1], 1];
  return [
    [`y = z \u2212 H x_pred = ${number(z[k - 1])} \u2212 ${signed(predicted.x[0])} = ${number(y)}`],
    [`S = H P_pred H^T + R = ${number(predicted.P[0])} + ${number(R)} = ${number(S)}`],
    ["K = P_pred H^T S^\u22121 =", column([predicted.P[0], predicted.P[1]]), `/ ${number(S)} =`, column(K)],
    ["x = x_pred + K y =", column(predicted.x), "+", column(K), `${signed(y)} =`, column(updated.x)],
    ["P = ( I \u2212 K H ) P_pred"],
    ["=", square(I_KH), covariance(predicted.P), "=", covariance(updated.P)],
  ];
}

// --- the numbers as a table --------------------------------------------------------------------------------

const HEAD = ["", "p (m)", "v (m/s)", "P_11 (m²)", "P_12 (m²/s)", "P_22 (m²/s²)"];
const UPDATE_HEAD = ["z (m)", "y (m)", "S (m²)", "K_1", "K_2 (1/s)"];

function numbers(r, s, t) {
  const rows = r.beliefs.map(({ x, P }, moment) => {
    const k = stepOf(moment);
    const title = titleOf(moment, t);
    const belief = [...x, ...P].map((value) => t.decimal(value, 4));
    return [title, ...belief, ...updateCells(r, k, kindOf(moment), t)];
  });
  return { head: [...HEAD, ...UPDATE_HEAD], rows };
}

function updateCells({ z, result }, k, kind, t) {
  if (kind !== UPDATE) {
    return UPDATE_HEAD.map(() => "");
  }
  const values = [z[k - 1], result.y[k - 1], result.S[k - 1], result.K[2 * k - 2], result.K[2 * k - 1]];
  return values.map((value) => t.decimal(value, 4));
}

// --- the controls ------------------------------------------------------------------------------------------

const isOwn = (s) => s.example === "own";

/** Whole moments forwards or backwards. */
function move(by) {
  return (s) => ({ moment: Math.min(Math.max(Math.round(s.moment) + by, 0), LAST) });
}

/** The slider with the measurement of step k. */
function measurement(k) {
  const isFirst = k === 1;
  const range = isFirst ? { min: -5, max: 10 } : { min: -50, max: 50 }; // m
  const synthetic = isFirst ? {} : { default: null, auto: (s) => given(s)[k - 1] };
  return {
    name: zName(k),
    symbol: `z_${k}`,
    ...CONTROLS.measured,
    unit: "m",
    ...range,
    step: 0.1,
    log: false,
    ...synthetic,
    visible: (s) => stepOf(s.moment) === k,
    disabled: (s) => kindOf(s.moment) !== UPDATE,
  };
}

const controls = [
  {
    kind: "buttons",
    items: [
      { ...CONTROLS.previous, set: move(-1), glide: 500, disabled: (s) => s.moment <= 0 },
      { ...CONTROLS.next, set: move(1), glide: 500, disabled: (s) => s.moment >= LAST },
    ],
  },
  { name: "moment", ...CONTROLS.moment, unit: "", min: 0, max: LAST, step: 1, log: false, default: 2 },
  ...[1, 2, 3, 4, 5].map(measurement),
  { name: "Q", symbol: "Q" },
  { name: "R", symbol: "R" },
  {
    kind: "select",
    name: "example",
    default: "worked",
    ...CONTROLS.example,
    options: [
      ["worked", CONTROLS.worked],
      ["own", CONTROLS.own],
    ],
  },
  { name: "dt", symbol: "Δt", visible: isOwn },
  { name: "u", symbol: "u", visible: isOwn },
  { name: "position", symbol: "p_0", visible: isOwn },
  { name: "velocity", symbol: "v_0", visible: isOwn },
  { name: "P_position", symbol: "P_11", visible: isOwn },
  { name: "P_velocity", symbol: "P_22", visible: isOwn },
];

export const steps = {
  name: NAME,
  start: { moment: 2 },
  controls,
  noise: true,
  compute,
  plots: [
    { ...PLANE, xlabel: "p (m)", height: 235, draw: plane, drag },
    { ...GAIN, height: 88, bare: true, fixed: true, draw: strip },
  ],
  outcome,
  equations,
  numbers,
  question,
};
