// What accelerometer and magnetometer measure, and when the craft is dynamic.
import { heading, printed_tilt, tilt } from "./model.js";
import { direction, mean, median_step, totalVariance, whole } from "./statistics.js";

/** The measured angles z (3 T), and the mean angles at rest, where the filter starts; rest: so many steps. */
export function measured(acc, mag, rest, without) {
  const z = new Float64Array(acc.length);
  const tiltOf = without.includes("formulas") ? printed_tilt : tilt;
  for (let at = 0; at < z.length; at += 3) {
    const [roll, pitch] = tiltOf(acc[at], acc[at + 1], acc[at + 2]);
    z[at] = roll;
    z[at + 1] = pitch;
  }
  const roll_at_rest = direction(z, 0, rest);
  const pitch_at_rest = direction(z, 1, rest);
  const is_estimated = !without.includes("estimated tilt"); // then the filter turns the magnetometer back
  for (let at = 0; at < z.length; at += 3) {
    const roll = is_estimated ? roll_at_rest : z[at];
    const pitch = is_estimated ? pitch_at_rest : z[at + 1];
    z[at + 2] = heading(mag[at], mag[at + 1], mag[at + 2], roll, pitch);
  }
  return { z, start: [roll_at_rest, pitch_at_rest, direction(z, 2, rest)] };
}

/**
 * Where (T) the variance of the magnetometer over the last window (s) exceeds the threshold times that at
 * rest.
 */
export function is_dynamic(t, mag, rest, window, threshold, step = median_step(t)) {
  const T = t.length;
  const dynamic = new Uint8Array(T);
  const length = Math.min(T, Math.max(2, whole(window / step))); // steps
  const sums = slidingSums([0, 1, 2].map((i) => mean(mag, i, rest || T)));
  const variances = new Float64Array(T);
  let known_at_rest = 0;
  for (let k = 0; k < T; k++) {
    const is_known = sums.take(mag, k, 1);
    if (is_known && k < (rest || T)) {
      known_at_rest++;
    }
    if (k >= length) {
      sums.take(mag, k - length, -1);
    }
    variances[k] = sums.variance();
  }
  // without a rest the quietest window serves
  const quiet =
    rest > 0
      ? totalVariance(mag, rest)
      : variances.subarray(length - 1).reduce((least, value) => Math.min(least, value));
  for (let k = 0; k < T; k++) {
    dynamic[k] = variances[k] > threshold * quiet;
  }
  return known_at_rest > 0 ? dynamic : dynamic.fill(0);
}

/**
 * The variance of vectors that come (sign 1) and go (sign -1); differences from the middle lose no digits.
 */
function slidingSums(middle) {
  const sum = new Float64Array(3);
  const squares = new Float64Array(3);
  let count = 0;
  const take = (vectors, k, sign) => {
    const [x, y, z] = [vectors[3 * k], vectors[3 * k + 1], vectors[3 * k + 2]];
    if (Number.isNaN(x + y + z)) {
      return false;
    }
    count += sign;
    for (let i = 0; i < 3; i++) {
      const value = vectors[3 * k + i] - middle[i];
      sum[i] += sign * value;
      squares[i] += sign * value * value;
    }
    return true;
  };
  const variance = () => {
    const n = Math.max(count, 1);
    const mean_square = (squares[0] + squares[1] + squares[2]) / n;
    const square_mean = (sum[0] ** 2 + sum[1] ** 2 + sum[2] ** 2) / (n * n);
    return mean_square - square_mean;
  };
  return { take, variance };
}
