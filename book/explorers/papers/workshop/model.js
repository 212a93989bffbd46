// Chapter 7: the workshop, in which a filter is built from a pattern of motion and its sensors. Twin of
// kalman_lib/papers/workshop.py.
import { simulate as simulateModel } from "../../numerics/random.js";
import { at, filterSeries } from "./filter.js";

export const PATTERN = { CONSTANT: 1, RANDOM_WALK: 2, VELOCITY: 3, ACCELERATION: 4, OWN: 5 };
export const SECOND = { NONE: 1, ITSELF: 2, RATE: 3, SECOND_RATE: 4, DRIVES: 5 };
const ORDER = [NaN, 1, 1, 2, 3]; // states without the bias, by pattern

/** Something that swings and dies away, seen by one sensor: until the reader types other matrices. */
export const OWN_F = [
  [0.99, 0.1],
  [-0.1, 0.99],
];
export const OWN_H = [[1, 0]];

export const STEPS = 100;
const PERIOD = 50; // steps of the wave that a known input makes in made-up data

/**
 * The filter that was built. State: the quantity and its rates, as many as the pattern has, then the bias if
 * there is one. dt (T) s: the steps before each measurement, where they are uneven; F and H are those of the
 * pattern OWN, whose F belongs to a step, whatever it takes. x0 (n) and P0 (n n): where the filter starts, if
 * p does not say it.
 */
export function model(p, dt = null, F = OWN_F, H = OWN_H, x0 = null, P0 = null) {
  const noise = [p.R, p.R2];
  const made = p.pattern === PATTERN.OWN ? ownModel(p, noise, F, H) : patternModel(p, noise, dt);
  made.x0.set(x0 ?? made.x0);
  made.P0.set(P0 ?? made.P0);
  return made;
}

/** The filter that the workshop builds over its data. */
export function modelOf(p, { dt, F, H, start }) {
  return model(p, dt, F, H, start?.x0, start?.P0);
}

function patternModel(p, noise, dt) {
  const steps = dt ?? [p.dt];
  const n = statesOf(p);
  const each = (make, size) => {
    const all = new Float64Array(steps.length * size);
    steps.forEach((step, k) => make(p, step, n, all.subarray(k * size, (k + 1) * size)));
    return all;
  };
  const H_rows = sensors(p);
  const typical = median(steps);
  const P0 = rates(p).map((order) => p.P0 / typical ** (2 * order));
  return complete({
    n,
    F: each(transition, n * n),
    Q: each(processNoise, n * n),
    B: hasInput(p) ? each(drive, n) : null,
    H: H_rows,
    R: noise.slice(0, H_rows.length),
    x0: p.x0,
    P0,
  });
}

function ownModel(p, noise, F, H) {
  const n = F.length;
  const Q = new Float64Array(n * n);
  for (let i = 0; i < n; i++) {
    Q[i * n + i] = p.q;
  }
  const P0 = new Array(n).fill(p.P0);
  const R = noise.slice(0, H.length);
  return complete({ n, F: Float64Array.from(F.flat()), Q, B: null, H, R, x0: p.x0, P0 });
}

/** What the rooms of numerics/ ask of a model, too. R: one variance a sensor; P0: one a state. */
function complete({ n, F, Q, B, H, R, x0, P0 }) {
  const m = H.length;
  const made = { n, m, l: B ? 1 : 0, F, Q, B, H: Float64Array.from(H.flat()) };
  made.R = Float64Array.from(R);
  made.x0 = new Float64Array(n);
  made.x0[0] = x0;
  made.P0 = new Float64Array(n * n);
  P0.forEach((variance, i) => {
    made.P0[i * n + i] = variance;
  });
  return made;
}

/**
 * A (rows), Bc and the diagonal of Qc per second of a pattern: each state is the rate of the one before, the
 * noise and a known input are the rate of the last.
 */
export function continuous(p) {
  const order = ORDER[p.pattern];
  const n = order + hasBias(p);
  const A = Array.from({ length: n }, (_, i) => {
    const isChain = i < order - 1;
    const isDriven = i === order - 1 && p.second === SECOND.DRIVES;
    return Array.from({ length: n }, (_, j) => {
      const entry = j === i + 1 && isDriven ? -1 : Number(j === i + 1);
      return isChain || isDriven ? entry : 0;
    });
  });
  const last = (value) => Array.from({ length: n }, (_, i) => (i === order - 1 ? value : 0));
  return { order, A, Bc: last(1), Qc: last(p.pattern === PATTERN.CONSTANT ? 0 : p.q) };
}

/** F of a step: each state is the rate of the one before; a biased input is too high by the bias. */
function transition(p, dt, n, F) {
  const order = ORDER[p.pattern];
  for (let i = 0; i < order; i++) {
    for (let j = i; j < order; j++) {
      F[i * n + j] = dt ** (j - i) / factorial(j - i);
    }
    if (hasBias(p) && p.second === SECOND.DRIVES) {
      F[i * n + order] = -(dt ** (order - i)) / factorial(order - i);
    }
  }
  if (hasBias(p)) {
    F[n * n - 1] = 1;
  }
}

/** B of a step: a known input is the rate of the last state. */
function drive(p, dt, n, B) {
  const order = ORDER[p.pattern];
  for (let i = 0; i < order; i++) {
    B[i] = dt ** (order - i) / factorial(order - i);
  }
}

/** Q of a step: white noise is the rate of the last state. */
function processNoise(p, dt, n, Q) {
  const order = ORDER[p.pattern];
  if (p.pattern === PATTERN.CONSTANT) {
    return;
  }
  for (let i = 0; i < order; i++) {
    for (let j = 0; j < order; j++) {
      const a = order - 1 - i;
      const b = order - 1 - j;
      Q[i * n + j] = (p.q * dt ** (a + b + 1)) / (factorial(a) * factorial(b) * (a + b + 1));
    }
  }
}

function factorial(n) {
  return n < 2 ? 1 : n * factorial(n - 1);
}

/** How many states the filter has. */
export function statesOf(p, F = OWN_F) {
  return p.pattern === PATTERN.OWN ? F.length : ORDER[p.pattern] + hasBias(p);
}

/** Is the second column, or the third beside a second sensor, a known input? */
export function hasInput(p) {
  const isThird = Boolean(p.third) && p.second !== SECOND.NONE;
  return p.pattern !== PATTERN.OWN && (p.second === SECOND.DRIVES || isThird);
}

/** Is the bias of the second column a state? */
export function hasBias(p) {
  return Boolean(p.bias) && p.second !== SECOND.NONE && p.pattern !== PATTERN.OWN;
}

/**
 * Which state the second column is about: 0 the quantity, 1 its rate, ... One that the pattern does not have
 * stands for the highest that it has; an input is the rate of that one.
 */
export function seenRate(p) {
  const order = ORDER[p.pattern];
  return p.second === SECOND.DRIVES ? order : Math.min(p.second - SECOND.ITSELF, order - 1);
}

/** H as rows: the first column of the data is the quantity itself. */
export function sensors(p) {
  const order = ORDER[p.pattern];
  const row = (place) => Array.from({ length: order }, (_, i) => Number(i === place));
  const rows = [row(0)];
  if (p.second !== SECOND.NONE && p.second !== SECOND.DRIVES) {
    rows.push(row(seenRate(p)));
  }
  return hasBias(p) ? rows.map((values, i) => [...values, i]) : rows;
}

/** How often each state is divided by seconds: 0 for the quantity, 1 for its rate, ... */
export function rates(p) {
  const orders = Array.from({ length: ORDER[p.pattern] }, (_, i) => i);
  return hasBias(p) ? [...orders, seenRate(p)] : orders;
}

export function median(values) {
  const sorted = Float64Array.from(values).sort();
  const half = Math.floor(sorted.length / 2);
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/** Made-up data of the pattern. It starts at x0, which the filter hardly knows. */
export function simulate(p, rng, steps = STEPS, F = OWN_F, H = OWN_H) {
  const made = model(p, null, F, H);
  const x0 = Float64Array.from(made.x0);
  if (p.pattern === PATTERN.OWN) {
    x0.fill(3 * Math.sqrt(p.R));
  } else if (hasBias(p)) {
    x0[made.n - 1] = trueBias(p);
  }
  const bias = p.bias && p.second === SECOND.DRIVES ? trueBias(p) : 0;
  const wave = (_, k) => bias + heightOfWave(p) * Math.sin((2 * Math.PI * k) / PERIOD);
  const u = made.B ? Float64Array.from({ length: steps }, wave) : null;
  return simulateModel(withFunctions(made), steps, rng, u, x0);
}

/** The model as the room of random numbers takes it. */
function withFunctions(made) {
  const { n, m, H, R, B } = made;
  const R_matrix = new Float64Array(m * m);
  R.forEach((variance, i) => {
    R_matrix[i * m + i] = variance;
  });
  const product = (M, x, rows, out) => {
    for (let i = 0; i < rows; i++) {
      out[i] = 0;
      for (let j = 0; j < n; j++) {
        out[i] += M[i * n + j] * x[j];
      }
    }
  };
  return {
    ...made,
    R: R_matrix,
    transition(x, u, x_next) {
      product(at(made.F, 0, n * n), x, n, x_next);
      for (let i = 0; u && i < n; i++) {
        x_next[i] += B[i] * u[0];
      }
    },
    measure: (x, z_pred) => product(H, x, m, z_pred),
  };
}

/** Of a known input, so that the quantity swings by ten standard deviations of its sensor. */
function heightOfWave(p) {
  return (10 * Math.sqrt(p.R)) / ((PERIOD * p.dt) / (2 * Math.PI)) ** ORDER[p.pattern];
}

/** Of the second column in made-up data: a third of the wave, or what three sigma are. */
function trueBias(p) {
  return p.second === SECOND.DRIVES ? heightOfWave(p) / 3 : 3 * Math.sqrt(p.R2);
}

/** The filter over {z (T m), u (T) or null}, with uneven steps dt, own F and H, and a gate, if there are. */
export function run(p, data, gate = 0) {
  return filterSeries(modelOf(p, data), data.z, data.u, gate);
}
