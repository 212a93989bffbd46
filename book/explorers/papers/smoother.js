// Chapter 2: the scalar filter of a spreadsheet. Twin of kalman_lib/papers/smoother.py.
import { kalmanFilter, linearModel } from "../filters.js";
import { simulate as simulateModel } from "../random.js";

/** A random walk that is measured directly: x = x + w, z = x + v. */
export function model(p) {
  return linearModel({ F: 1, H: 1, Q: p.Q, R: p.R, x0: p.x0, P0: p.P0 });
}

export function simulate(p, rng, steps = 200) {
  return simulateModel(model(p), steps, rng);
}

export function run(p, { z }) {
  return kalmanFilter(model(p), z);
}

/** Mean of the last `window` values of z, fewer at the start; gaps left out. */
export function movingAverage(z, window) {
  return z.map((_, k) => {
    let total = 0, count = 0;
    for (let i = Math.max(0, k - window + 1); i <= k; i++) if (z[i] === z[i]) { total += z[i]; count++; }
    return count ? total / count : NaN;
  });
}

export const twins = {
  moving_average: (p, data) => movingAverage(data.z, p.window),
};
