// Chapter 5: a beetle walks away from a sink, the extended Kalman filter. Twin of kalman_lib/papers/beetle.py.
import { kalmanFilter, nonlinearModel } from "../filters.js";
import { simulate as simulateModel } from "../random.js";

/** State [d cm, theta rad, v cm/s], measured: d. */
export function model(p) {
  const { dt } = p;
  return nonlinearModel({
    f(x, u, out) {
      out[0] = x[0] + dt * x[2] * Math.cos(x[1]);
      out[1] = x[1];
      out[2] = x[2];
    },
    F(x, u, out) {
      out.set([1, -dt * x[2] * Math.sin(x[1]), dt * Math.cos(x[1]), 0, 1, 0, 0, 0, 1]);
    },
    h(x, out) { out[0] = x[0]; },
    H(x, out) { out[0] = 1; out[1] = out[2] = 0; },
    Q: [[0, 0, 0], [0, p.Q_theta, 0], [0, 0, p.Q_v]], R: p.R, x0: [p.d0, p.theta0, p.v0],
    P0: [[p.sigma_d ** 2, 0, 0], [0, p.sigma_theta ** 2, 0], [0, 0, p.sigma_v ** 2]],
  });
}

/** A walk with the true direction and speed, from d0, and its noisy distances. */
export function simulate(p, rng, steps = 40) {
  return simulateModel(model({ ...p, R: p.R_true }), steps, rng, null, [p.d0, p.theta, p.v]);
}

export function run(p, { z }) {
  return kalmanFilter(model(p), z);
}
