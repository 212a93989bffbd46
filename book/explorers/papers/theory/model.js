// Chapter 1: a car on a line whose position is measured. Twin of kalman_lib/papers/theory.py.
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";
import { simulate as simulateModel } from "../../numerics/random.js";

/** State [position m, velocity m/s], input the acceleration m/s2, measured: the position m. */
export function model(p) {
  return linearModel({
    F: [
      [1, p.dt],
      [0, 1],
    ],
    B: [[0], [p.dt]],
    H: [[1, 0]],
    Q: [
      [p.Q, 0],
      [0, p.Q],
    ],
    R: p.R,
    x0: [p.position, p.velocity],
    P0: [
      [p.P_position, 0],
      [0, p.P_velocity],
    ],
  });
}

/** A drive with the constant input p.u. */
export function simulate(p, rng, steps = 10) {
  const u = new Float64Array(steps).fill(p.u);
  return simulateModel(model(p), steps, rng, u);
}

export function run(p, { z, u }) {
  return kalmanFilter(model(p), z, u);
}

/**
 * Two measurements of one length, a and b with their variances, become one: {x, P, K}; x = a + K (b - a).
 */
export function fuse(a, var_a, b, var_b) {
  const K = var_a / (var_a + var_b);
  return { x: a + K * (b - a), P: K * var_b, K };
}
