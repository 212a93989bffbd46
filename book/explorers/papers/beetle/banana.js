// The first view of chapter 5: one record of distances, and all the beetles that would have left it. The
// reader drags the true beetle along v cos(theta) = AWAY, so the record stays as it is.
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";
import { generator } from "../../numerics/random.js";
import { bearing_model, model } from "./model.js";
import { questionOfOthers } from "./questions.js";
import { SECONDS } from "./walk.js";
import { paintBeetle, paintSink } from "./scene.js";
import { BANANA, LABELS } from "./words.js";

export const AWAY = 2; // cm/s, what the distance shows of every one of these beetles
const MOST = 0.9; // rad, the largest direction
const PLANE = { xlim: [-1.05, 1.05], ylim: [1.2, 3.9] }; // rad, cm/s
const ABOVE = { xlim: [-56, 56], ylim: [-5, 57] }; // cm
const PALE = 0.45; // opacity
const FAINT = 0.15;
const RECORD_AT = -51; // cm, where the record stands beside the picture
const TYPICAL = 3; // with this noise the view starts with a record as most are
const ANYTHING = 1e6; // cm^2/s^2, the variance of s for who knows nothing

const speedAt = (theta) => AWAY / Math.cos(theta); // cm/s
const inRange = (theta) => Math.min(Math.max(theta, -MOST), MOST);
const rounded = (theta) => Math.round(100 * theta) / 100;

// --- numbers -----------------------------------------------------------------------------------------------

function compute(s, memo) {
  const T = Math.round(SECONDS / s.dt);
  const v = speedAt(s.theta);
  const walk = recordOf(s, T, v);
  const start = s.bearing ? bearing_model(s) : model(s);
  const { n, m } = start;
  memo[m] = kalmanFilter(start, s.bearing ? walk.both : walk.z, null, { into: memo[m] });
  const { x, P } = memo[m];
  const at = (i, j) => P[(T - 1) * n * n + i * n + j];
  const filter = {
    d: x[(T - 1) * n],
    theta: x[(T - 1) * n + 1],
    v: x[(T - 1) * n + 2],
    P: [at(1, 1), at(1, 2), at(2, 2)],
    sigma: [Math.sqrt(at(0, 0)), Math.sqrt(at(1, 1)), Math.sqrt(at(2, 2))],
  };
  return { T, v, ...walk, filter, fits: fitOf(s, walk.z, T), inside: isInside(s.theta, v, filter) };
}

/** The record: the noise depends on the seed alone, whatever the direction is. */
function recordOf(s, T, v) {
  const rng = generator(s.seed + TYPICAL);
  const noise = Float64Array.from({ length: 2 * T }, () => rng.normal());
  const t = Float64Array.from({ length: T }, (_, k) => (k + 1) * s.dt);
  const true_d = t.map((time) => s.d0 + time * AWAY);
  const z = true_d.map((d, k) => d + Math.sqrt(s.R) * noise[k]);
  const along = t.map((time) => time * v * Math.sin(s.theta));
  const beta = along.map((l, k) => Math.atan2(l, true_d[k]) + Math.sqrt(s.R_bearing) * noise[T + k]);
  const both = Float64Array.from({ length: 2 * T }, (_, i) => (i % 2 ? beta : z)[i >> 1]);
  return { t, true_d, z, beta, both, along: along[T - 1] };
}

/** What the record alone says of s = v cos(theta): {s, sigma}. */
function fitOf(s, z, T) {
  const line = linearModel({
    F: [
      [1, s.dt],
      [0, 1],
    ],
    H: [[1, 0]],
    Q: [
      [0, 0],
      [0, 0],
    ],
    R: s.R,
    x0: [s.d0, 0],
    P0: [
      [s.sigma_d ** 2, 0],
      [0, ANYTHING],
    ],
  });
  const { x, P } = kalmanFilter(line, z);
  return { s: x[2 * T - 1], sigma: Math.sqrt(P[4 * T - 1]) };
}

/** Does the filter's ellipse (two standard deviations) hold the true beetle? */
function isInside(theta, v, filter) {
  const [aa, ab, bb] = filter.P;
  const a = theta - filter.theta;
  const b = v - filter.v;
  return (bb * a * a - 2 * ab * a * b + aa * b * b) / (aa * bb - ab * ab) <= 4;
}

// --- figures -----------------------------------------------------------------------------------------------

function drawAbove(r, s) {
  const end = s.d0 + SECONDS * AWAY;
  const place = { along: r.along, distance: end };
  return {
    ...ABOVE,
    layers: [
      { look: "quiet", paint: paintSink },
      { look: "quiet", level: 0, label: LABELS.edge },
      { look: "quiet", level: end },
      { look: "band", label: "θ ± 2σ_θ", paint: paintFan(r, s, end) },
      { look: "truth", x: [0, r.along], y: [s.d0, end] },
      { look: "measurement", x: r.z.map(() => RECORD_AT), y: r.z, label: BANANA.record },
      s.bearing && { look: "measurement", paint: paintSight(place) },
      { look: "truth", label: LABELS.beetle, paint: paintBeetle(place, { ...s, v: r.v, moment: SECONDS }) },
    ],
  };
}

/** The directions that the filter believes in, from where the beetle started. */
function paintFan({ filter }, s, end) {
  const steep = 1.4; // rad
  const reach = (theta) => (end - s.d0) * Math.tan(Math.min(Math.max(theta, -steep), steep));
  return (ctx, X, Y) => {
    ctx.beginPath();
    ctx.moveTo(X(0), Y(s.d0));
    ctx.lineTo(X(reach(filter.theta - 2 * filter.sigma[1])), Y(end));
    ctx.lineTo(X(reach(filter.theta + 2 * filter.sigma[1])), Y(end));
    ctx.fill();
  };
}

/** What the second sensor sees from the start at the edge. */
function paintSight({ along, distance }) {
  return (ctx, X, Y) => {
    ctx.setLineDash([2, 4]);
    ctx.beginPath();
    ctx.moveTo(X(0), Y(0));
    ctx.lineTo(X(along), Y(distance));
    ctx.stroke();
  };
}

function drawPlane(r, s) {
  return {
    ...PLANE,
    layers: [
      {
        look: "measurement",
        label: BANANA.fits,
        paint: paintBanana(PLANE.xlim, r.fits, s.bearing ? FAINT : PALE),
      },
      s.bearing && { look: "measurement", paint: paintBanana(seenDirections(r), r.fits, PALE) },
      { look: "truth", mark: [s.theta, r.v], label: LABELS.beetle },
      { look: "estimate", ellipse: { x: [r.filter.theta, r.filter.v], P: r.filter.P }, label: BANANA.filter },
    ],
  };
}

/** With the second sensor only a piece of the banana is left. */
function seenDirections({ filter }) {
  return [filter.theta - 2 * filter.sigma[1], filter.theta + 2 * filter.sigma[1]];
}

/** Every direction and speed whose v cos(theta) agrees with the record (two standard deviations). */
function paintBanana([low, high], { s, sigma }, alpha) {
  const theta = Float64Array.from({ length: 81 }, (_, i) => low + (i * (high - low)) / 80);
  return (ctx, X, Y) => {
    ctx.beginPath();
    for (const angle of theta) {
      ctx.lineTo(X(angle), Y((s + 2 * sigma) / Math.cos(angle)));
    }
    for (const angle of theta.slice().reverse()) {
      ctx.lineTo(X(angle), Y((s - 2 * sigma) / Math.cos(angle)));
    }
    ctx.globalAlpha = alpha;
    ctx.fill();
    ctx.globalAlpha = 1;
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const found = {
    theta0: r.filter.theta,
    a: 2 * r.filter.sigma[1],
    v0: r.filter.v,
    b: 2 * r.filter.sigma[2],
  };
  return [
    t.say(BANANA.truth, { theta: s.theta, v: r.v }),
    t.say(s.bearing ? BANANA.with_both : BANANA.alone, found),
    t.say(r.inside ? BANANA.inside : BANANA.outside),
  ].join(" ");
}

function numbers(r, s, t) {
  const columns = [
    ["t (s)", r.t],
    ["d_true (cm)", r.true_d],
    ["z (cm)", r.z],
    ...(s.bearing ? [["β (rad)", r.beta]] : []),
  ];
  const rows = Array.from(r.t, (_, k) => [
    String(k + 1),
    ...columns.map(([, values]) => t.decimal(values[k], 4)),
  ]);
  return { head: ["k", ...columns.map(([name]) => name)], rows };
}

// --- the view ----------------------------------------------------------------------------------------------

export const banana = {
  name: BANANA.name,
  noise: true,
  start: { theta: 0.2, theta0: 0.3, v0: 2.1, sigma_theta: 0.3, R: 1, R_true: 1, dt: 1 },
  controls: [
    { name: "theta", symbol: "θ", min: -MOST, max: MOST, step: 0.01 },
    { kind: "check", name: "bearing", default: false, ...BANANA.bearing },
    { name: "theta0", symbol: "θ_0", min: -MOST, max: MOST, step: 0.01 },
  ],
  compute,
  plots: [
    {
      ...BANANA.above,
      xlabel: "l (cm)",
      height: 170,
      equal: true,
      half: true,
      draw: drawAbove,
      drag: (l) => ({ theta: rounded(inRange(Math.atan(l / (SECONDS * AWAY)))) }),
    },
    {
      ...BANANA.plane,
      xlabel: "θ (rad)",
      height: 170,
      half: true,
      draw: drawPlane,
      drag: (theta) => ({ theta: rounded(inRange(theta)) }),
    },
  ],
  outcome,
  numbers,
  question: (r, s, t, random) => questionOfOthers(AWAY, t, random),
};
