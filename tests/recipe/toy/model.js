// The toy paper: a bottle on a scale, filled at a known rate. Twin of kalman_lib/papers/toy.py.
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";
import { simulate as simulateModel } from "../../numerics/random.js";

const STEPS = 60;

/** State: the mass (kg), a step a second; input: the flow (kg/s); measured: the mass. */
export function model(p) {
  return linearModel({
    F: [[1]],
    B: [[1]],
    H: [[1]],
    Q: [[p.sigma_flow ** 2]],
    R: p.sigma_scale ** 2,
    x0: [0],
    P0: [[0.01]],
  });
}

/** A synthetic minute at the tap. */
export function simulate(p, rng, steps = STEPS) {
  return simulateModel(model(p), steps, rng, new Float64Array(steps).fill(p.flow));
}

export function run(p, { z, u }) {
  return kalmanFilter(model(p), z, u);
}
