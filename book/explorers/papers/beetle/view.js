// What the explorer of chapter 5 shows: the beetle from above, and what the filter knows of it over time.
import { chi2Bounds } from "../../numerics/metrics.js";
import { PRINTED_R } from "./model.js";
import { question } from "./questions.js";
import { scene } from "./scene.js";
import { SECONDS, compute } from "./walk.js";
import { CONTROLS, DIRECTION, ERRORS, FACTS, NAME, OUTCOME, SCENE, SHARES, SPEED } from "./words.js";

// --- figures -----------------------------------------------------------------------------------------------

const WHOLE_WALK = [0, SECONDS]; // s

function drawShares(r) {
  const most = Math.max(1.1, ...r.s.share, ...r.theta.share, ...r.v.share);
  return {
    xlim: WHOLE_WALK,
    ylim: [0, most],
    layers: [
      { look: "quiet", at: r.t[r.k] },
      { look: "estimate", x: r.t, y: r.theta.share, label: "σ_θ" },
      { look: "prediction", x: r.t, y: r.v.share, label: "σ_v" },
      { look: "rival", x: r.t, y: r.s.share, label: "σ_s" },
    ],
  };
}

function drawErrors(r, s) {
  const most = Math.max(3.5 * Math.sqrt(s.R_true), ...r.of_x.map(Math.abs));
  return {
    xlim: WHOLE_WALK,
    ylim: [-most, most],
    layers: [
      { look: "band", x: r.t, low: r.minus, high: r.band, label: "±2√P" },
      { look: "quiet", at: r.t[r.k] },
      { look: "measurement", x: r.t, y: r.of_z, label: "d_true − z" },
      { look: "estimate", x: r.t, y: r.of_x, label: "d_true − d" },
    ],
  };
}

/** A state over time with its band, the truth, and the moment that the top view shows. */
function drawCourse(r, { x, low, high }, truth) {
  return {
    xlim: WHOLE_WALK,
    layers: [
      { look: "band", x: r.t, low, high, label: "±2√P" },
      { look: "quiet", at: r.t[r.k] },
      { look: "truth", level: truth, label: "x_true" },
      { look: "estimate", x: r.t, y: x, label: "x" },
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const left = ({ share }) => t.decimal(100 * share[r.k]);
  return [
    t.say(OUTCOME.left, { t: r.t[r.k], theta: left(r.theta), v: left(r.v), s: left(r.s) }),
    t.say(s.bearing ? OUTCOME.seen : OUTCOME.blind),
    t.say(OUTCOME.rmse, { rmse: r.rmse, sensor: Math.sqrt(s.R_true) }),
    t.say(verdictOn(r), { nis: r.nis }),
    t.say(OUTCOME.origin, { seed: String(s.seed) }),
  ].join(" ");
}

/** Do the innovations fit the R that the filter believes in? */
function verdictOn({ nis, m, T }) {
  const [low, high] = chi2Bounds(m, T);
  if (nis > high) {
    return OUTCOME.high;
  }
  return nis < low ? OUTCOME.low : OUTCOME.fits;
}

function facts(r, s, t) {
  const { k } = r;
  const row = (name, truth, { x, sigma }) => [
    name,
    ...[truth, x[k], 2 * sigma[k]].map((value) => t.decimal(value)),
  ];
  return {
    head: [t.say(FACTS.after, { t: r.t[k] }), t.say(FACTS.truth), t.say(FACTS.filter), "±2σ"],
    rows: [
      row("d (cm)", r.true_d[k], r.d),
      row("s (cm/s)", s.v * Math.cos(s.theta), r.s),
      row("θ (rad)", s.theta, r.theta),
      row("v (cm/s)", s.v, r.v),
    ],
  };
}

function numbers(r, s, t) {
  const columns = [
    ["t (s)", r.t],
    ["d_true (cm)", r.true_d],
    ["z (cm)", r.z_d],
    ["d (cm)", r.d.x],
    ["σ_d (cm)", r.d.sigma],
    ["θ (rad)", r.theta.x],
    ["σ_θ (rad)", r.theta.sigma],
    ["v (cm/s)", r.v.x],
    ["σ_v (cm/s)", r.v.sigma],
    ["s (cm/s)", r.s.x],
    ["σ_s (cm/s)", r.s.sigma],
  ];
  const rows = Array.from(r.t, (_, k) => [
    String(k),
    ...columns.map(([, values]) => t.decimal(values[k], 4)),
  ]);
  return { head: ["k", ...columns.map(([name]) => name)], rows };
}

// --- the view ----------------------------------------------------------------------------------------------

function printedR(R) {
  return { id: String(R).replace(".", ","), en: String(R), set: { R }, pressed: (s) => s.R === R };
}

const controls = [
  { kind: "buttons", items: [{ ...CONTROLS.play, play: "moment", seconds: 10 }] },
  {
    name: "moment",
    symbol: "t",
    ...CONTROLS.moment,
    unit: "s",
    min: 0,
    max: SECONDS,
    step: 0.05,
    log: false,
    default: SECONDS,
  },
  { kind: "buttons", ...CONTROLS.printed_R, items: PRINTED_R.map(printedR) },
  { name: "R", symbol: "R" },
  { name: "dt", symbol: "Δt" },
  { name: "theta", symbol: "θ" },
  { name: "theta0", symbol: "θ_0" },
  { name: "v", symbol: "v" },
  { name: "v0", symbol: "v_0" },
  { name: "sigma_theta", symbol: "σ_θ" },
  { kind: "check", name: "bearing", default: false, ...CONTROLS.bearing },
  { name: "R_bearing", symbol: "R_β", visible: (s) => s.bearing },
];

export const walk = {
  name: NAME,
  noise: true,
  controls,
  compute,
  plots: [
    { ...SCENE, xlabel: "l (cm)", height: 240, equal: true, draw: scene },
    { ...SHARES, xlabel: "t (s)", height: 150, draw: drawShares },
    { ...ERRORS, xlabel: "t (s)", height: 170, after: true, draw: drawErrors },
    {
      ...DIRECTION,
      xlabel: "t (s)",
      height: 150,
      half: true,
      after: true,
      draw: (r, s) => drawCourse(r, r.theta, s.theta),
    },
    {
      ...SPEED,
      xlabel: "t (s)",
      height: 150,
      half: true,
      after: true,
      draw: (r, s) => drawCourse(r, r.v, s.v),
    },
  ],
  outcome,
  facts,
  numbers,
  question,
};
