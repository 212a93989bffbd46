// The figure of the steps: beliefs as ellipses in the plane of position and velocity.
import { PREDICTION, START, UPDATE, zName } from "./steps.js";

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

/** The pointer takes the measurement of this step along. */
export function drag(x, y, s, r) {
  return r.kind === UPDATE ? { [zName(r.k)]: x } : null;
}
