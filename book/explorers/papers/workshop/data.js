// The data of the workshop: made up, or what the reader brought.
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { generator } from "../../numerics/random.js";
import { OWN_F, OWN_H, PATTERN, SECOND, STEPS, hasInput, median, simulate, statesOf } from "./model.js";
import { readMatrices } from "./matrices.js";
import { readStart } from "./start.js";
import { columnsFrom, isOwn } from "./table.js";
import { WRONG } from "./mistakes.js";
import { NOTES } from "./words.js";

// The noise in made-up data, by pattern; that of the sensors is the same for all
const TRUE_Q = [NaN, 0.01, 1, 0.01, 1e-5, 0.1];
const TRUE_R = 9;
const TRUE_R2 = 1;

const OUTLIERS = 0.05; // of the measurements
const OUTLIER = 20; // standard deviations at most, and half of them at least
const HOLE = [55, 75]; // the steps without a measurement

/** What the data depends on. */
const KEYS = [
  ...["seed", "pattern", "second", "bias", "third", "dt", "F", "H", "first_x", "first_P", "dirty", "hole"],
  ...[
    "motion",
    "text",
    "file",
    "sheet",
    "sign",
    "missing",
    "time",
    "value",
    "axis",
    "value2",
    "factor",
    "value3",
    "factor3",
  ],
];

/**
 * {t (T), dt (T) or null, z (T m), u (T) or null, truth (T states) or null, F, H, x0, P0, start, note}: the
 * data that is shown, and where its filter starts: by the data, or as the reader says (`start`); memo keeps
 * it while nothing about it changes.
 */
export function load(s, memo) {
  const key = KEYS.map((name) => s[name]);
  if (!memo.key?.every((value, i) => value === key[i])) {
    const matrices = s.pattern === PATTERN.OWN ? readMatrices(s.F, s.H) : { F: OWN_F, H: OWN_H };
    const data = isOwn(s) ? brought(s, matrices.H.length) : madeUp(s, matrices);
    const start = readStart(s, statesOf(s, matrices.F));
    memo.data = { ...data, ...matrices, ...startOf(s, data), start };
    memo.key = key;
    memo.fit = null;
  }
  return memo.data;
}

/** x0 is the first measurement, and P0 so large that it hardly counts: the square of what is seen. */
function startOf(s, { z, m }) {
  const first = z.filter((value, i) => i % m === 0 && !Number.isNaN(value));
  const low = first.reduce((a, b) => Math.min(a, b), Infinity);
  const high = first.reduce((a, b) => Math.max(a, b), -Infinity);
  if (s.pattern === PATTERN.OWN) {
    return { x0: 0, P0: 100 * Math.max(low ** 2, high ** 2) || 1 };
  }
  return { x0: first[0], P0: (high - low) ** 2 || first[0] ** 2 || 1 };
}

// --- made up -----------------------------------------------------------------------------------------------

/** A filter may have the wrong pattern: the data of a single quantity moves by the same one, always. */
function madeUp(s, { F, H }) {
  const isAlone = s.second === SECOND.NONE || (s.second === SECOND.ITSELF && !s.bias && !s.third);
  const isSingle = isAlone && s.pattern !== PATTERN.OWN;
  const pattern = isSingle ? PATTERN.VELOCITY : s.pattern;
  const truth = { ...s, pattern, q: TRUE_Q[pattern], R: TRUE_R, R2: TRUE_R2, x0: 0, P0: 1 };
  const { z, x, u } = simulate(truth, generator(s.seed), STEPS, F, H);
  const m = z.length / STEPS;
  if (s.dirty) {
    addOutliers(z, m, generator(s.seed + 1));
  }
  if (s.hole) {
    z.fill(NaN, HOLE[0] * m, HOLE[1] * m);
  }
  const dt = s.pattern === PATTERN.OWN ? 1 : s.dt;
  const t = Float64Array.from({ length: STEPS }, (_, k) => (k + 1) * dt);
  const note = isSingle ? NOTES.made_up : NOTES.made_up_so;
  return { t, dt: null, z, m, u, truth: x, states: x.length / STEPS, note };
}

function addOutliers(z, m, rng) {
  for (let i = 0; i < z.length; i += m) {
    const sign = rng.uniform() < 0.5 ? -1 : 1;
    const size = OUTLIER * Math.sqrt(TRUE_R) * (0.5 + rng.uniform() / 2);
    if (rng.uniform() < OUTLIERS) {
      z[i] += sign * size;
    }
  }
}

/** The noise that a pattern starts with. */
export function startingNoise(pattern) {
  return { q: TRUE_Q[pattern] };
}

/** A second column about a rate needs a pattern that has it. */
export function patternFor(second, pattern) {
  const needed = { [SECOND.RATE]: PATTERN.VELOCITY, [SECOND.SECOND_RATE]: PATTERN.ACCELERATION };
  return Math.max(pattern, needed[second] ?? 0);
}

// --- brought -----------------------------------------------------------------------------------------------

/** Does the filter use a second column? */
export function usesSecond(s, rows_of_H) {
  return s.pattern === PATTERN.OWN ? rows_of_H > 1 : s.second !== SECOND.NONE;
}

/** How many columns does the filter use? */
export function columnsUsed(s, rows_of_H) {
  const isThird = hasInput(s) && s.second !== SECOND.DRIVES;
  return 1 + Number(usesSecond(s, rows_of_H)) + Number(isThird);
}

function brought(s, rows_of_H) {
  const { t, first, second, third, note } = columnsFrom(s, columnsUsed(s, rows_of_H));
  const other = second?.map((value) => value * s.factor);
  const isSecond = s.pattern !== PATTERN.OWN && s.second === SECOND.DRIVES;
  const m = other && !isSecond ? 2 : 1;
  const z = new Float64Array(m * first.length);
  for (let k = 0; k < first.length; k++) {
    z[m * k] = first[k];
    if (m > 1) {
      z[m * k + 1] = other[k];
    }
  }
  const times = t === null ? evenTimes(s, first.length) : unevenTimes(t);
  const input = isSecond ? other : third?.map((value) => value * s.factor3);
  const { u, held } = input ? heldInput(input) : { u: null, held: null };
  return { ...times, z, m, u, truth: null, note, held };
}

/** A known input that was not written down is taken not to have changed: {u, held: a note on it or null}. */
function heldInput(input) {
  const start = input.findIndex((value) => !Number.isNaN(value));
  if (start < 0) {
    throw new InputError(WRONG.empty_input);
  }
  const u = Float64Array.from(input);
  let last = u[start];
  for (let k = 0; k < u.length; k++) {
    last = Number.isNaN(u[k]) ? last : u[k];
    u[k] = last;
  }
  const gaps = input.filter(Number.isNaN).length;
  return { u, held: gaps > 0 ? inBoth(NOTES.held, { gaps: String(gaps) }) : null };
}

/** {t, dt: null}: all steps are s.dt. */
function evenTimes(s, T) {
  const dt = s.pattern === PATTERN.OWN ? 1 : s.dt;
  return { t: Float64Array.from({ length: T }, (_, k) => k * dt), dt: null };
}

/** {t, dt}: the step before each row; the one before the first is as long as most. */
function unevenTimes(t) {
  const dt = t.map((value, k) => value - t[k - 1]);
  dt[0] = median(dt.subarray(1));
  return { t, dt };
}
