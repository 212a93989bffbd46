// Does a recording begin at rest? Twin of kalman_lib/papers/quadrotor/rest.py.
import { mean, variance } from "./statistics.js";

export const START = 4; // s, from which the attitude is taken where there is no rest
const LEAST_AT_REST = 10; // samples
const WINDOW = 0.25; // s, in which noise averages out and a motion does not
const UNTURNED = 0.06; // rad/s by which the mean rates of windows may differ
const UNMOVED = 0.5; // m/s2, likewise

/** So many samples are at rest: those of the first rest_s seconds, or none where the sensors deny it. */
export function samplesAtRest({ t, gyr, acc, rest_s }) {
  const rest = rest_s > 0 ? samplesUntil(t, rest_s) : 0;
  if (rest < LEAST_AT_REST) {
    return 0;
  }
  const moves = spreads(t, gyr, rest, UNTURNED) || spreads(t, acc, rest, UNMOVED);
  return moves ? 0 : rest;
}

/** So many samples tell where the filter starts. */
export const samplesAtStart = (t, rest) => (rest > 0 ? rest : samplesUntil(t, START));

function samplesUntil(t, seconds) {
  let count = 0;
  while (count < t.length && t[count] - t[0] <= seconds) {
    count++;
  }
  return count;
}

/** Do the means of short windows differ by more than the noise explains? */
function spreads(t, vectors, rest, most) {
  const values = knownOf(vectors, rest);
  const count = values.length / 3;
  const windows = Math.max(2, Math.min(Math.trunc((t[rest - 1] - t[0]) / WINDOW), Math.floor(count / 5)));
  if (count < LEAST_AT_REST) {
    return false; // silent
  }
  return [0, 1, 2].some((i) => {
    const noise = trembleOf(values, i, count) / Math.sqrt(count / windows);
    return Math.sqrt(variance(meansOf(values, i, count, windows), 0, windows)) > most + 3 * noise;
  });
}

/** The first `rest` vectors without those of a silent sensor. */
function knownOf(vectors, rest) {
  const known = [];
  for (let at = 0; at < 3 * rest; at += 3) {
    if (!Number.isNaN(vectors[at] + vectors[at + 1] + vectors[at + 2])) {
      known.push(vectors[at], vectors[at + 1], vectors[at + 2]);
    }
  }
  return known;
}

/** The means of equal parts, as first columns; the first parts hold one more where they cannot be equal. */
function meansOf(values, i, count, windows) {
  const [size, more] = [Math.floor(count / windows), count % windows];
  const means = [];
  for (let part = 0, from = 0; part < windows; part++) {
    const length = size + (part < more ? 1 : 0);
    means.push(mean(values.slice(3 * from, 3 * (from + length)), i, length), 0, 0);
    from += length;
  }
  return means;
}

/** The noise of one sample, from neighbours. */
function trembleOf(values, i, count) {
  let sum = 0;
  for (let k = 1; k < count; k++) {
    sum += (values[3 * k + i] - values[3 * k - 3 + i]) ** 2;
  }
  return Math.sqrt(sum / (count - 1) / 2);
}
