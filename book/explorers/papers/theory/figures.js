// The two figures: beliefs as ellipses in the plane of position and velocity, and as bell curves of the
// position alone.
import { PREDICTION, START, UPDATE, zName } from "./steps.js";

const BELL_POINTS = 121;

/** The beliefs that are shown at this moment: [look, label, belief]; the last one may be on its way. */
function shownBeliefs({ kind, k, beliefs, now }) {
  if (kind === START) {
    return [["estimate", "x_0", beliefs[0]]];
  }
  if (kind === PREDICTION) {
    const before = beliefs[2 * k - 2];
    return [
      ["estimate", `x_${k - 1}`, before],
      ["prediction", "x_pred", now],
    ];
  }
  const predicted = beliefs[2 * k - 1];
  return [
    ["prediction", "x_pred", predicted],
    ["estimate", `x_${k}`, now],
  ];
}

/** Ellipses; while a measurement is blended in, the strip z +- 2 sqrt(R) that it allows. */
export function plane(r) {
  const ellipses = shownBeliefs(r).map(([look, label, belief]) => ({ look, label, ellipse: belief }));
  const strip = r.kind === UPDATE ? measuredStrip(r) : [];
  return { xlim: r.limits.x, ylim: r.limits.v, layers: [...strip, ...ellipses] };
}

function measuredStrip(r) {
  const z = r.z[r.k - 1];
  const reach = 2 * Math.sqrt(r.model.R[0]);
  const bottom = r.limits.v[0];
  const paint = (ctx, X, Y) => {
    ctx.globalAlpha = 0.14;
    ctx.fillRect(X(z - reach), 0, X(z + reach) - X(z - reach), Y(bottom));
    ctx.globalAlpha = 1;
  };
  return [
    { look: "measurement", paint },
    { look: "measurement", at: z, label: "z ± 2√R" },
  ];
}

const TALLEST = 0.95; // share of the height that a bell may fill
const LOWEST = 0.12; // below this share the axis closes in again

/** Bell curves of the position; the axis of their height rests while a slider moves, in powers of 2. */
export function bells(r) {
  const R = r.model.R[0];
  const curves = shownBeliefs(r).map(([look, label, { x, P }]) =>
    bellLayer(look, label, x[0], P[0], r.limits.x),
  );
  if (r.kind === UPDATE) {
    curves.splice(1, 0, bellLayer("measurement", "z", r.z[r.k - 1], R, r.limits.x));
  }
  const narrowest = Math.min(r.kind === UPDATE ? R : Infinity, ...variancesOfStep(r));
  return {
    xlim: r.limits.x,
    ylim: [0, restingTop(r.rest, 1 / Math.sqrt(2 * Math.PI * narrowest))],
    layers: curves,
  };
}

/** The old top of the axis, if the highest peak fits; kept in rest. */
function restingTop(rest, peak) {
  if (!(peak <= TALLEST * rest.top && peak >= LOWEST * rest.top)) {
    rest.top = 2 ** Math.ceil(Math.log2(1.05 * peak));
  }
  return rest.top;
}

/** Variances of the position before and after this half of the step. */
function variancesOfStep({ kind, k, beliefs }) {
  const after = kind === UPDATE ? 2 * k : 2 * k - 1;
  const ends = kind === START ? [0] : [after - 1, after];
  return ends.map((moment) => beliefs[moment].P[0]);
}

function bellLayer(look, label, mean, variance, limits) {
  const { x, y } = bell(mean, variance, limits);
  if (look !== "measurement") {
    return { look, label, x, y };
  }
  const paint = (ctx, X, Y) => {
    ctx.setLineDash([2, 3]); // its dots are dots elsewhere; here it is a curve of dots
    ctx.lineWidth = 2.4;
    ctx.beginPath();
    x.forEach((value, i) => ctx.lineTo(X(value), Y(y[i])));
    ctx.stroke();
  };
  return { look, label, paint };
}

/** The bell curve of a mean and a variance over the limits. */
function bell(mean, variance, [low, high]) {
  const sigma = Math.sqrt(variance);
  const from = Math.max(low, mean - 5 * sigma);
  const to = Math.min(high, mean + 5 * sigma);
  const x = new Float64Array(BELL_POINTS);
  const y = new Float64Array(BELL_POINTS);
  for (let i = 0; i < BELL_POINTS; i++) {
    x[i] = from + ((to - from) * i) / (BELL_POINTS - 1);
    y[i] = Math.exp(-((x[i] - mean) ** 2) / (2 * variance)) / (sigma * Math.sqrt(2 * Math.PI));
  }
  return { x, y };
}

/** The pointer takes the measurement of this step along. */
export function drag(x, y, s, r) {
  return r.kind === UPDATE ? { [zName(r.k)]: x } : null;
}
