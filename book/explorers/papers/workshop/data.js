// The data of the workshop: made up by the pattern that was chosen, or what the reader brought.
import { generator } from "../../numerics/random.js";
import { PATTERN, SECOND, STEPS, simulate } from "./model.js";
import { NOTES } from "./words.js";

/** The noise in made-up data, by pattern; that of the sensors is the same for all. */
const TRUE_QC = [NaN, 0.01, 1, 0.01, 1e-5, 0.1];
const TRUE_R = 9;
const TRUE_R2 = 1;

/**
 * {t (T), dt (T) or null, z (T m), u (T) or null, truth (T n) or null, note}: the data that is shown; memo
 * keeps it while nothing about it changes.
 */
export function load(s, memo) {
  const key = [s.seed, s.pattern, s.second, s.bias, s.dt];
  if (!memo.key?.every((value, i) => value === key[i])) {
    memo.data = madeUp(s);
    memo.key = key;
  }
  return memo.data;
}

function madeUp(s) {
  const truth = { ...s, Qc: TRUE_QC[s.pattern], R: TRUE_R, R2: TRUE_R2, x0: 0, P0: 1 };
  const { z, x, u } = simulate(truth, generator(s.seed));
  const dt = s.pattern === PATTERN.OWN ? 1 : s.dt;
  return {
    t: Float64Array.from({ length: STEPS }, (_, k) => (k + 1) * dt),
    dt: null,
    z,
    u,
    truth: x,
    note: NOTES.made_up,
  };
}

/** The noise that a pattern starts with. */
export function startingNoise(pattern) {
  return { Qc: TRUE_QC[pattern] };
}

/** A second column about a rate needs a pattern that has it. */
export function patternFor(second, pattern) {
  const needed = { [SECOND.RATE]: PATTERN.VELOCITY, [SECOND.SECOND_RATE]: PATTERN.ACCELERATION };
  return Math.max(pattern, needed[second] ?? 0);
}
