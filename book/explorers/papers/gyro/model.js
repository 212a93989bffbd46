// Chapter 3: an angle from a gyroscope and an angle sensor. Twin of kalman_lib/papers/gyro.py.
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";

/** The paper's four figures: [sigma_w rad/s, sigma_v rad]. */
export const CASES = { 4: [10, 10], 5: [10, 1], 6: [1, 10], 7: [1, 1] };

/** x = x + T u + w, z = x + v; Q = sigma_w^2 T^2, R = sigma_v^2; the first angle is known. */
export function model(p) {
  return linearModel({ F: 1, B: p.T, H: 1, Q: (p.sigma_w * p.T) ** 2, R: p.sigma_v ** 2, x0: 0, P0: 0 });
}

/** The whole number of steps nearest to the duration; a half goes to the even one, as in Python. */
export function steps(p) {
  const exact = p.duration / p.T;
  const low = Math.floor(exact);
  return exact - low === 0.5 ? low + (low % 2) : Math.round(exact);
}

/** A synthetic turn at the constant rate u. The noise of a step does not depend on how many there are. */
export function simulate(p, rng) {
  const T = steps(p);
  const x = new Float64Array(T);
  const z = new Float64Array(T);
  let angle = 0;
  for (let k = 0; k < T; k++) {
    angle += p.T * (p.u + p.sigma_w * rng.normal());
    x[k] = angle;
    z[k] = angle + p.sigma_v * rng.normal();
  }
  return { T, x, z, u: new Float64Array(T).fill(p.u) };
}

export function run(p, { z, u }, into = null) {
  return kalmanFilter(model(p), z, u, { into });
}

/** Largest |x_true - z| and |x_true - x|, rad. */
export function maxima(flight, result) {
  let of_z = 0;
  let of_x = 0;
  for (let k = 0; k < flight.T; k++) {
    of_z = Math.max(of_z, Math.abs(flight.x[k] - flight.z[k]));
    of_x = Math.max(of_x, Math.abs(flight.x[k] - result.x[k]));
  }
  return [of_z, of_x];
}

/** The gain K at which the filter settles and the standard deviation sqrt(K R) of its error, rad. */
export function steady(p) {
  const q = ((p.sigma_w * p.T) / p.sigma_v) ** 2; // Q / R
  const K = 2 / (1 + Math.sqrt(1 + 4 / q));
  return [K, Math.sqrt(K) * p.sigma_v];
}

/** Standard deviation (rad) of the settled error if the gain is K, whatever the filter believes. */
export function error_with_gain(p, K) {
  const Q = (p.sigma_w * p.T) ** 2;
  const R = p.sigma_v ** 2;
  return Math.sqrt(((1 - K) ** 2 * Q + K ** 2 * R) / (1 - (1 - K) ** 2));
}

/**
 * [RMSE (rad), mean NEES] to be expected of a filter that believes sigma_w and sigma_v while p is true; needs
 * no data. P is what the filter believes, V the true variance of its error.
 */
export function expected(p, sigma_w, sigma_v) {
  const Q = (p.sigma_w * p.T) ** 2;
  const R = p.sigma_v ** 2;
  const Q_told = (sigma_w * p.T) ** 2;
  const R_told = sigma_v ** 2;
  const T = steps(p);
  let P = 0;
  let V = 0;
  let squares = 0;
  let nees = 0;
  for (let k = 0; k < T; k++) {
    const P_pred = P + Q_told;
    const K = P_pred / (P_pred + R_told);
    const I_K = R_told / (P_pred + R_told); // 1 - K, no digit lost
    P = K * R_told;
    V = I_K * I_K * (V + Q) + K * K * R;
    squares += V;
    nees += V / P;
  }
  return [Math.sqrt(squares / T), nees / T];
}

export const twins = {
  steady: (p) => steady(p),
  maxima: (p, data, result) => maxima(data, result),
  expected: (p) => expected(p, p.sigma_w, p.sigma_v),
  error_with_gain: (p, data, result) => error_with_gain(p, result.K[0]), // Python gets the same K
};
