// Chapter 4: the speed of a model ship, AR(2). Twin of kalman_lib/papers/ship.py.
import { kalmanFilter, linearModel } from "../filters.js";
import { simulate as simulateModel } from "../random.js";

/** State [speed now, speed one sample before] in m/s; the constant c enters through the input u = 1. */
export function model(p) {
  return linearModel({ F: [[p.a1, p.a2], [1, 0]], B: [[p.c], [0]], H: [[1, 0]], Q: [[p.Q, 0], [0, p.Q_copy]], R: p.R,
                       x0: [p.x0, p.x0], P0: [[p.P0, 0], [0, p.P0]] });
}

/** An AR(2) speed with known coefficients, and its measurements. */
export function simulate(p, rng, steps = 600) {
  return simulateModel(model(p), steps, rng, new Float64Array(steps).fill(1));
}

export function run(p, { z, u }) {
  return kalmanFilter(model(p), z, u);
}
