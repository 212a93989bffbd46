// Means and variances of one of three columns (roll, pitch, yaw; or x, y, z) over the first `count` steps;
// NaN is left out.
import { DEG, galat_of, wrap } from "./model.js";

/** Sum of value(number) over the known numbers of column i, and how many they are. */
function sumOf(values, i, count, value) {
  let sum = 0;
  let known = 0;
  for (let at = i; at < 3 * count; at += 3) {
    const number = values[at];
    if (!Number.isNaN(number)) {
      sum += value(number);
      known++;
    }
  }
  return { sum, known };
}

export function mean(values, i, count) {
  const { sum, known } = sumOf(values, i, count, (value) => value);
  return sum / known;
}

export function variance(values, i, count) {
  const middle = mean(values, i, count);
  const { sum, known } = sumOf(values, i, count, (value) => (value - middle) ** 2);
  return sum / known;
}

/** The variances of all three columns, added. */
export function totalVariance(values, count) {
  return variance(values, 0, count) + variance(values, 1, count) + variance(values, 2, count);
}

/** The mean direction, which +179 and -179 degrees have at 180; 0 where the sensor is silent. */
export function direction(angles, i, count) {
  const sines = sumOf(angles, i, count, Math.sin);
  const cosines = sumOf(angles, i, count, Math.cos);
  return Math.atan2(sines.sum, cosines.sum);
}

/** Variances (3) of the angles around their mean directions; 0 without any. */
export function spread(angles, count) {
  return [0, 1, 2].map((i) => {
    const middle = direction(angles, i, count);
    const { sum, known } = sumOf(angles, i, count, (angle) => wrap(angle - middle) ** 2);
    return known > 0 ? sum / known : 0;
  });
}

/** The median of the time steps, s. */
export function median_step(t) {
  const steps = t.subarray(1).map((value, k) => value - t[k]);
  const sorted = steps.sort();
  const half = Math.floor(sorted.length / 2);
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/** The nearest whole number; a half goes to the even one, as in Python. */
export function whole(value) {
  const low = Math.floor(value);
  return value - low === 0.5 ? low + (low % 2) : Math.round(value);
}

// --- measures of error -------------------------------------------------------------------------------------

/** Equation (25) for three columns, percent. */
export function galat(reference, estimate) {
  const T = reference.length / 3;
  return [0, 1, 2].map((i) => galat_of(mean(reference, i, T), mean(estimate, i, T)));
}

/** Root mean square over time of the wrapped errors (3), degrees. */
export function rmse_deg(truth, angles) {
  const errors = angles.map((angle, at) => wrap(angle - truth[at]));
  return [0, 1, 2].map((i) => {
    const { sum, known } = sumOf(errors, i, errors.length / 3, (error) => error * error);
    return Math.sqrt(sum / known) / DEG;
  });
}
