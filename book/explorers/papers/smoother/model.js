// Chapter 2: the scalar filter of a spreadsheet. Twin of kalman_lib/papers/smoother.py.
import { InputError } from "../../language/input.js";
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";
import { simulate as simulateModel } from "../../numerics/random.js";

/** The 16 measurements of the paper's form. */
export const MEASURED = Float64Array.from([
  -0.39, -0.49, -0.48, -0.3, -0.25, -0.31, -0.33, -0.48, -0.41, -0.44, -0.38, -0.36, -0.42, -0.44, -0.51,
  -0.28,
]);

/** A random walk that is measured directly: x = x + w, z = x + v. */
export function model(p) {
  return linearModel({ F: 1, H: 1, Q: p.Q, R: p.R, x0: p.x0, P0: p.P0 });
}

export function simulate(p, rng, steps = 200) {
  return simulateModel(model(p), steps, rng);
}

export function run(p, { z }, into = null) {
  return kalmanFilter(model(p), z, null, { into });
}

/** The smoother of Rauch, Tung and Striebel for the random walk: x (T) and P (T). */
export function smoothed(result, Q) {
  const x = result.x.slice();
  const P = result.P.slice();
  for (let k = x.length - 2; k >= 0; k--) {
    const G = P[k] / (P[k] + Q);
    x[k] += G * (x[k + 1] - x[k]);
    P[k] = G * (Q + G * P[k + 1]);
  }
  return { x, P };
}

// --- synthetic look-alikes of the paper's three recordings, whose data was never published -----------------

/** The truth at sample k, how many there are, the noise, and the settings of the paper. */
export const LOOK_ALIKES = {
  silkworm_room: { steps: 288, sigma: 0.3, R: 1e-3, window: 3, truth: silkworm_room },
  cutting_force: { steps: 200, sigma: 1.5, R: 1e-3, window: 5, truth: cutting_force },
  tank_level: { steps: 240, sigma: 0.4, R: 7.7e-4, window: 2, truth: tank_level },
};

/**
 * Temperature over a day, with a heater that goes on and off every two hours; a sample every five minutes.
 */
function silkworm_room(k) {
  const hours = k / 12;
  const heater = Math.sign(Math.sin((2 * Math.PI * hours) / 4));
  return 26 + 1.5 * Math.sin((2 * Math.PI * (hours - 9)) / 24) + 0.35 * heater;
}

/** The force grows until the blade is in, and falls while it cuts through. */
function cutting_force(k) {
  const share = k / 199; // of the way
  const cut = Math.min(Math.max((share - 0.6) / 0.3, 0), 1);
  return 40 * Math.min(share / 0.55, 1) ** 1.5 * (1 - cut ** 2);
}

/** A level that stands still, then falls and rises evenly. */
function tank_level(k) {
  const periods = Math.max(k - 60, 0) / 60;
  return 50 - 4 * (1 - Math.abs(1 - (periods % 2)));
}

/** A look-alike with its noise: {truth (T), z (T)}. */
export function look_alike(name, rng) {
  const { steps, sigma, truth: at } = LOOK_ALIKES[name];
  const truth = new Float64Array(steps).map((_, k) => at(k));
  return { truth, z: truth.map((value) => value + sigma * rng.normal()) };
}

// --- the gain, and what it is worth in samples of a moving average -----------------------------------------

/** The gain K that the filter settles at, for q = Q / R. */
export function steady_gain(q) {
  const root = Math.sqrt(q);
  return (2 * root) / (root + Math.sqrt(q + 4));
}

/** The moving average that suppresses white noise as much as the steady gain K. */
export function equal_window(K) {
  return 2 / K - 1;
}

// --- the filter's rivals -----------------------------------------------------------------------------------

/** Mean of the last `window` values of z, fewer at the start; gaps left out. */
export function moving_average(z, window) {
  return z.map((_, k) => {
    let total = 0;
    let count = 0;
    for (let i = Math.max(0, k - window + 1); i <= k; i++) {
      if (!Number.isNaN(z[i])) {
        total += z[i];
        count++;
      }
    }
    return count > 0 ? total / count : NaN;
  });
}

/** Exponential smoothing x = x + K (z - x), starting at the first known value of z; a gap keeps x. */
export function exponential(z, K) {
  const x = z.slice();
  for (let k = 1; k < x.length; k++) {
    const before = x[k - 1];
    if (!Number.isNaN(before)) {
      x[k] = Number.isNaN(z[k]) ? before : before + K * (z[k] - before);
    }
  }
  return x;
}

// --- smoothness and lag: the two sides of every filter -----------------------------------------------------

/** Standard deviation of the step from value to value: the smaller, the smoother. */
export function roughness(x) {
  return deviation(differences(x));
}

function differences(x) {
  return x.subarray(1).map((value, k) => value - x[k]);
}

/** Standard deviation without the NaN. */
function deviation(values) {
  const known = values.filter((value) => !Number.isNaN(value));
  const mean = known.reduce((sum, value) => sum + value, 0) / known.length;
  const squares = known.reduce((sum, value) => sum + (value - mean) ** 2, 0);
  return Math.sqrt(squares / known.length);
}

/**
 * How many samples x runs behind the reference: the shift with the smallest squared difference, refined by a
 * parabola.
 */
export function lag(x, reference, longest = 50) {
  if (x.length < 8 || !(deviation(reference) > 0)) {
    return NaN;
  }
  const most = Math.min(longest, Math.floor(x.length / 2));
  const cost = [];
  for (let shift = -1; shift <= most; shift++) {
    cost.push(shiftCost(x, reference, shift, most));
  }
  const best = cost.indexOf(Math.min(...cost)); // the shift is one less
  if (best <= 0 || best === cost.length - 1) {
    return best - 1;
  }
  const left = cost[best - 1];
  const middle = cost[best];
  const right = cost[best + 1];
  return best - 1 + (left - right) / (2 * (left - 2 * middle + right));
}

/** Mean squared difference of x and the reference, shifted; gaps left out. */
function shiftCost(x, reference, shift, most) {
  let sum = 0;
  let count = 0;
  for (let k = most; k < x.length - 1; k++) {
    const square = (x[k] - reference[k - shift]) ** 2;
    if (!Number.isNaN(square)) {
      sum += square;
      count++;
    }
  }
  return sum / count;
}

// --- where Q and R come from -------------------------------------------------------------------------------

/** Log-likelihood of z for Q and R; the first known value only starts the filter (x = z, P = R). */
/** The variance R of the measurement noise, from a stretch of z (T) in which the truth stays as it is. */
export function R_from_steady(z) {
  const known = z.filter((value) => !Number.isNaN(value));
  const mean = known.reduce((sum, value) => sum + value, 0) / known.length;
  return known.reduce((sum, value) => sum + (value - mean) ** 2, 0) / (known.length - 1);
}

export function log_likelihood(z, Q, R) {
  const first = z.findIndex((value) => !Number.isNaN(value));
  let x = z[first];
  let P = R;
  let S = NaN;
  let log = 0; // of 2 pi S; S settles, and a logarithm takes long
  let total = 0;
  for (let k = first + 1; k < z.length; k++) {
    P += Q;
    if (Number.isNaN(z[k])) {
      continue;
    }
    if (S !== P + R) {
      S = P + R;
      log = Math.log(2 * Math.PI * S);
    }
    const y = z[k] - x;
    const K = P / S;
    total -= (log + (y * y) / S) / 2;
    x += K * y;
    P = K * R;
  }
  return total;
}

/** The pair [Q, R] that makes z most likely: a search on a log grid that closes in. */
export function maximum_likelihood(z, decades = 8, points = 41, rounds = 8) {
  const steps = differences(z.filter((value) => !Number.isNaN(value)));
  const scale = steps.length > 1 ? deviation(steps) ** 2 : 0;
  const largest = Math.max(0, ...steps.map(Math.abs));
  if (!(scale > 1e-24 * largest ** 2) || scale === 0) {
    throw new InputError({
      en: "Q and R need at least three values that do not all change by the same amount.",
      id: "Q dan R memerlukan sedikitnya tiga nilai yang perubahannya tidak selalu sama.",
    });
  }
  let centre = [Math.log10(scale), Math.log10(scale)];
  let width = decades;
  for (let round = 0; round < rounds; round++) {
    centre = mostLikelyOnGrid(z, centre, width, points);
    width /= 8;
  }
  return centre.map((power) => 10 ** power);
}

/** The best pair [log10 Q, log10 R] of a grid around the centre. */
function mostLikelyOnGrid(z, centre, width, points) {
  const place = (i, middle) => middle - width + (2 * width * i) / (points - 1);
  let best = -Infinity;
  let found = centre;
  for (let i = 0; i < points; i++) {
    const log_Q = place(i, centre[0]);
    for (let j = 0; j < points; j++) {
      const log_R = place(j, centre[1]);
      const L = log_likelihood(z, 10 ** log_Q, 10 ** log_R);
      if (L > best) {
        best = L;
        found = [log_Q, log_R];
      }
    }
  }
  return found;
}

export const twins = {
  moving_average: (p, data) => moving_average(data.z, p.window),
  exponential: (p, data, result) => exponential(data.z, result.K[0]),
  equal_window: (p, data, result) => equal_window(result.K[0] || NaN),
  roughness: (p, data, result) => roughness(result.x),
  log_likelihood: (p, data) => log_likelihood(data.z, p.Q, p.R),
};
