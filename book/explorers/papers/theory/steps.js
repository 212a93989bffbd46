// The moments of five steps: 0 the start, 1 the prediction of step 1, 2 its update, 3, 4, ...; between two
// whole numbers the belief is on its way.
import { generator } from "../../numerics/random.js";
import { model, run, simulate } from "./model.js";

export const COUNT = 5;
export const LAST = 2 * COUNT;
export const START = 0; // the kinds of a moment
export const PREDICTION = 1;
export const UPDATE = 2;
const LIMIT_STEP = 2; // m, m/s: the axes end at whole ones
const FARTHEST = 50; // m: the range of a measured position

/** The step to which a moment belongs; the start belongs to the first one. */
export function stepOf(moment) {
  return Math.max(1, Math.ceil(moment / 2 - 1e-9));
}

export function kindOf(moment) {
  if (moment === 0) {
    return START;
  }
  return Math.ceil(moment) % 2 === 1 ? PREDICTION : UPDATE;
}

/** The name of the control with the measurement of step k. */
export function zName(k) {
  return k === 1 ? "z" : `z${k}`;
}

/** Measurements (5) nobody chose: synthetic, with one digit, from the drive after the own start. */
export function given(s) {
  const { z } = simulate(s, generator(s.seed), COUNT);
  return Array.from(z, (value) => Math.min(Math.max(Math.round(10 * value) / 10, -FARTHEST), FARTHEST));
}

/** All beliefs {x: [p, v], P: [P_11, P_12, P_22]}, one a moment, and the one that is shown. */
export function compute(s) {
  const made = given(s);
  const z = Float64Array.from(made, (value, i) => s[zName(i + 1)] ?? value);
  const u = new Float64Array(COUNT).fill(s.u);
  const result = run(s, { z, u });
  const m = model(s);
  const beliefs = [beliefAt(m.x0, m.P0, 0)];
  for (let k = 0; k < COUNT; k++) {
    beliefs.push(beliefAt(result.x_pred, result.P_pred, k), beliefAt(result.x, result.P, k));
  }
  const moment = Math.min(Math.max(s.moment, 0), LAST);
  return {
    moment,
    k: stepOf(moment),
    kind: kindOf(moment),
    z,
    result,
    model: m,
    beliefs,
    now: beliefBetween(beliefs, moment),
    limits: limits(beliefs, z),
  };
}

/** The belief of step k of arrays x (T 2), P (T 4). */
function beliefAt(x, P, k) {
  return {
    x: [x[2 * k], x[2 * k + 1]],
    P: [P[4 * k], P[4 * k + 1], P[4 * k + 3]],
  };
}

/** The belief at a moment that may be on its way. */
function beliefBetween(beliefs, moment) {
  const before = beliefs[Math.floor(moment)];
  const after = beliefs[Math.ceil(moment)];
  const share = moment - Math.floor(moment);
  const mix = (a, b) => a.map((value, i) => value + share * (b[i] - value));
  return { x: mix(before.x, after.x), P: mix(before.P, after.P) };
}

/** What holds every belief and measurement, so that the axes rest while things move. */
function limits(beliefs, z) {
  return { x: span(beliefs, 0, Array.from(z)), v: span(beliefs, 1, []) };
}

/**
 * [low, high] of state i in whole steps: 2.5 standard deviations around a belief, 0.5 around a measurement.
 */
function span(beliefs, i, measured) {
  const ends = measured.flatMap((value) => [value - 0.5, value + 0.5]);
  for (const { x, P } of beliefs) {
    const reach = 2.5 * Math.sqrt(P[2 * i]);
    ends.push(x[i] - reach, x[i] + reach);
  }
  const low = Math.floor(Math.min(...ends) / LIMIT_STEP);
  const high = Math.ceil(Math.max(...ends) / LIMIT_STEP);
  return [LIMIT_STEP * low, LIMIT_STEP * high];
}
