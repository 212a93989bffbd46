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
const TOO_WIDE = 3; // times what is needed: then the axes close in again

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
export function compute(s, memo = {}) {
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
    limits: restingLimits(memo, beliefs, z, moment),
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

/**
 * Axes {x, v} that hold every belief and measurement. They rest while a slider moves, until what is shown at
 * this moment would leave them, or get lost in them; memo keeps them.
 */
function restingLimits(memo, beliefs, z, moment) {
  const shown = beliefs.slice(Math.max(Math.ceil(moment) - 1, 0), Math.ceil(moment) + 1);
  const measured = kindOf(moment) === UPDATE ? [z[stepOf(moment) - 1]] : [];
  memo.x = rested(memo.x, span(beliefs, 0, Array.from(z)), ends(shown, 0, measured, 2));
  memo.v = rested(memo.v, span(beliefs, 1, []), ends(shown, 1, [], 2));
  return { x: memo.x, v: memo.v };
}

/** The old limits, if they hold all ends and are not far too wide; else the wanted ones. */
function rested(old, wanted, mustHold) {
  if (!old) {
    return wanted;
  }
  const holds = Math.min(...mustHold) >= old[0] && Math.max(...mustHold) <= old[1];
  return holds && old[1] - old[0] <= TOO_WIDE * (wanted[1] - wanted[0]) ? old : wanted;
}

/** [low, high] of state i in whole steps, 2.5 standard deviations around every belief. */
function span(beliefs, i, measured) {
  const all = ends(beliefs, i, measured, 2.5);
  const low = Math.floor(Math.min(...all) / LIMIT_STEP);
  const high = Math.ceil(Math.max(...all) / LIMIT_STEP);
  return [LIMIT_STEP * low, LIMIT_STEP * high];
}

/** Where beliefs end, so many standard deviations from their centres, and measurements, 0.5 m from them. */
function ends(beliefs, i, measured, sigmas) {
  const found = measured.flatMap((value) => [value - 0.5, value + 0.5]);
  for (const { x, P } of beliefs) {
    const reach = sigmas * Math.sqrt(P[2 * i]);
    found.push(x[i] - reach, x[i] + reach);
  }
  return found;
}
