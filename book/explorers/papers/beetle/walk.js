// A walk of 20 s and what the filter makes of it, over time: from the initial guess (k = 0) to the last step
// (k = T).
import { kalmanFilter } from "../../numerics/filters.js";
import { mean, nis, rmse } from "../../numerics/metrics.js";
import { generator } from "../../numerics/random.js";
import { away_sigma, bearing_model, model, simulate } from "./model.js";

export const SECONDS = 20;

export function compute(s, memo) {
  const T = Math.round(SECONDS / s.dt);
  const start = s.bearing ? bearing_model(s) : model(s);
  const { n, m } = start;
  const walk = simulate(s, generator(s.seed), T, s.bearing);
  memo.result = kalmanFilter(start, walk.z, null, { into: memo.result });
  const { result } = memo;
  const x = joined(start.x0, result.x);
  const P = joined(start.P0, result.P);
  const over = (value) => Float64Array.from({ length: T + 1 }, (_, k) => value(k));
  const d = course(x, P, n, 0);
  const theta = course(x, P, n, 1);
  const v = course(x, P, n, 2);
  const sigma_s = away_sigma(x, P, n);
  const s_away = {
    x: over((k) => v.x[k] * Math.cos(theta.x[k])),
    sigma: sigma_s,
    share: sigma_s.map((sigma) => sigma / sigma_s[0]),
  };
  const true_d = over((k) => s.d0 + k * s.dt * s.v * Math.cos(s.theta)); // Q is 0: direction and speed stay
  const z_d = over((k) => (k === 0 ? NaN : walk.z[(k - 1) * m]));
  const numbers = { T, n, m, walk, result, x, P, d, theta, v, true_d, z_d };
  return {
    ...numbers,
    s: s_away,
    k: Math.min(Math.floor(s.moment / s.dt + 1e-9), T), // the step that the top view shows
    t: over((k) => k * s.dt),
    of_z: true_d.map((value, k) => value - z_d[k]),
    of_x: true_d.map((value, k) => value - d.x[k]),
    band: d.sigma.map((sigma) => 2 * sigma),
    minus: d.sigma.map((sigma) => -2 * sigma),
    rmse: rmse(true_d.subarray(1), d.x.subarray(1))[0],
    nis: mean(nis(result.y, result.S, m)),
  };
}

function joined(first, rest) {
  const all = new Float64Array(first.length + rest.length);
  all.set(first);
  all.set(rest, first.length);
  return all;
}

/**
 * State i over time: {x, sigma, low, high, share}, its estimate, the band of two sigmas, and sigma over its
 * start.
 */
function course(x, P, n, i) {
  const value = Float64Array.from({ length: x.length / n }, (_, k) => x[k * n + i]);
  const sigma = value.map((_, k) => Math.sqrt(Math.max(P[(k * n + i) * n + i], 0)));
  return {
    x: value,
    sigma,
    low: value.map((estimate, k) => estimate - 2 * sigma[k]),
    high: value.map((estimate, k) => estimate + 2 * sigma[k]),
    share: sigma.map((deviation) => deviation / sigma[0]),
  };
}
