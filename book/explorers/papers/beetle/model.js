// Chapter 5: a beetle walks away from a sink, the extended Kalman filter. Twin of
// kalman_lib/papers/beetle.py.
import { kalmanFilter } from "../../numerics/filters.js";
import { nonlinearModel } from "../../numerics/models.js";
import { simulate as simulateModel } from "../../numerics/random.js";

/** The measurement variances that the source prints, cm^2. */
export const PRINTED_R = [0.001, 0.05, 0.08, 0.1];

/** State [d cm, theta rad, v cm/s], measured: d. */
export function model(p) {
  const { dt } = p;
  return nonlinearModel({
    f([d, theta, v], u, out) {
      out[0] = d + dt * v * Math.cos(theta);
      out[1] = theta;
      out[2] = v;
    },
    F([, theta, v], u, out) {
      out.set([1, -dt * v * Math.sin(theta), dt * Math.cos(theta)], 0);
      out.set([0, 1, 0], 3);
      out.set([0, 0, 1], 6);
    },
    h([d], out) {
      out[0] = d;
    },
    H(x, out) {
      out.set([1, 0, 0]);
    },
    Q: diagonal([0, p.Q_theta, p.Q_v]),
    R: p.R,
    x0: [p.d0, p.theta0, p.v0],
    P0: diagonal([p.sigma_d ** 2, p.sigma_theta ** 2, p.sigma_v ** 2]),
  });
}

/**
 * A second sensor: state [d, theta, v, l], measured: d and the bearing atan2(l, d) of the beetle from the
 * edge, rad.
 */
export function bearing_model(p) {
  const { dt } = p;
  return nonlinearModel({
    m: 2,
    f([d, theta, v, l], u, out) {
      out[0] = d + dt * v * Math.cos(theta);
      out[1] = theta;
      out[2] = v;
      out[3] = l + dt * v * Math.sin(theta);
    },
    F([, theta, v], u, out) {
      out.set([1, -dt * v * Math.sin(theta), dt * Math.cos(theta), 0], 0);
      out.set([0, 1, 0, 0], 4);
      out.set([0, 0, 1, 0], 8);
      out.set([0, dt * v * Math.cos(theta), dt * Math.sin(theta), 1], 12);
    },
    h([d, , , l], out) {
      out[0] = d;
      out[1] = Math.atan2(l, d);
    },
    H([d, , , l], out) {
      const square = d ** 2 + l ** 2;
      out.set([1, 0, 0, 0], 0);
      out.set([-l / square, 0, 0, d / square], 4);
    },
    Q: diagonal([0, p.Q_theta, p.Q_v, 0]),
    R: diagonal([p.R, p.R_bearing]),
    x0: [p.d0, p.theta0, p.v0, 0],
    P0: diagonal([p.sigma_d ** 2, p.sigma_theta ** 2, p.sigma_v ** 2, p.sigma_d ** 2]),
  });
}

/** A matrix with these numbers on its diagonal, as rows. */
function diagonal(numbers) {
  return numbers.map((number, i) => numbers.map((_, j) => (i === j ? number : 0)));
}

/** A walk with the true direction and speed, from d0, and its noisy distances (and bearings). */
export function simulate(p, rng, steps = 40, bearing = false) {
  const true_noise = { ...p, R: p.R_true };
  if (bearing) {
    return simulateModel(bearing_model(true_noise), steps, rng, null, [p.d0, p.theta, p.v, 0]);
  }
  return simulateModel(model(true_noise), steps, rng, null, [p.d0, p.theta, p.v]);
}

export function run(p, { z }) {
  return kalmanFilter(model(p), z);
}

/** Standard deviation of s = v cos(theta) to first order, for x (T n), P (T n n): (T). */
export function away_sigma(x, P, n = 3) {
  return Float64Array.from({ length: x.length / n }, (_, k) => {
    const theta = x[k * n + 1];
    const v = x[k * n + 2];
    const by_theta = -v * Math.sin(theta); // ds / dtheta
    const by_v = Math.cos(theta); // ds / dv
    const at = (i, j) => P[k * n * n + i * n + j];
    const of_both = by_theta * by_v * (at(1, 2) + at(2, 1));
    return Math.sqrt(by_theta ** 2 * at(1, 1) + of_both + by_v ** 2 * at(2, 2));
  });
}

export const twins = { away_sigma: (p, data, result) => away_sigma(result.x, result.P) };
