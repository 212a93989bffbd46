// Many runs at once: how large the errors really are, beside what the filter believes of them.
import { generator } from "../../numerics/random.js";
import { run, simulate } from "./model.js";

const RUNS = 500;
const AT_ONCE = 20000; // steps of all runs between two breaths
const OVER_TIME = ["t", "error", "measured", "low", "high", "root", "band_low", "band_high"];
const OF_RUNS = ["e2", "y2", "best2"]; // sums of squares: errors, innovations, errors of the optimum
const SHOWN_OF_RUNS = ["spread", "minus", "nees", "nis"];

/** One run, filtered as the reader believes and as would be best; memo keeps the arrays. */
export function compute(s, memo) {
  const believed = beliefOf(s);
  const flight = simulate(s, generator(s.seed));
  const { T } = flight;
  memo.filter = run(believed, flight, memo.filter);
  const { filter } = memo;
  if (s.other) {
    memo.optimum = run(s, flight, memo.optimum); // never into the arrays of the filter
  }
  const optimum = s.other ? memo.optimum : filter;
  if (memo.t?.length !== T) {
    for (const name of [...OVER_TIME, ...OF_RUNS, ...SHOWN_OF_RUNS]) {
      memo[name] = new Float64Array(T);
    }
  }
  fillOverTime(s, flight, filter, memo);
  for (const name of OF_RUNS) {
    memo[name].fill(0);
  }
  const { e2, y2 } = memo;
  const best2 = s.other ? memo.best2 : e2; // the filter is the optimum
  const runs = { e2, y2, best2, count: 0 };
  const overTime = Object.fromEntries(OVER_TIME.map((name) => [name, memo[name]]));
  return { T, flight, filter, optimum, believed, memo, ...overTime, runs };
}

/** The parameters as the filter has them. */
function beliefOf(s) {
  if (!s.other) {
    return s;
  }
  return { ...s, sigma_w: s.believed_w ?? s.sigma_w, sigma_v: s.believed_v ?? s.sigma_v };
}

function fillOverTime(s, flight, filter, memo) {
  for (let k = 0; k < flight.T; k++) {
    const root = Math.sqrt(filter.P[k]);
    memo.t[k] = s.T * (k + 1);
    memo.error[k] = flight.x[k] - filter.x[k];
    memo.measured[k] = flight.x[k] - flight.z[k];
    memo.root[k] = root;
    memo.low[k] = filter.x[k] - 2 * root;
    memo.high[k] = filter.x[k] + 2 * root;
    memo.band_low[k] = -2 * root;
    memo.band_high[k] = 2 * root;
  }
}

/** Add up the squares of RUNS runs, some at a time; yields in between. */
export function* manyRuns(r, s) {
  const rows = Math.max(1, Math.floor(AT_ONCE / r.T));
  const { runs } = r;
  while (runs.count < RUNS) {
    const until = Math.min(runs.count + rows, RUNS);
    const noise = normalNumbers(r.memo, s.seed, until * 2 * r.T);
    for (let run_number = runs.count; run_number < until; run_number++) {
      addRun(r, s, noise, 2 * r.T * run_number);
    }
    runs.count = until;
    yield;
  }
}

/**
 * One run of the error alone, which needs no angle: e_pred = e + w, y = e_pred + v, e = e_pred - K y. Adds up
 * e^2 of the filter as it is and of the one that knows both sigmas, and y^2. noise: two numbers a step, from
 * `from` on.
 */
function addRun({ T, filter, optimum, runs }, s, noise, from) {
  const sigma_angle = s.sigma_w * s.T; // rad
  let e = 0;
  let best = 0;
  for (let k = 0; k < T; k++) {
    const w = sigma_angle * noise[from + 2 * k];
    const v = s.sigma_v * noise[from + 2 * k + 1];
    const y = e + w + v;
    e += w - filter.K[k] * y;
    runs.e2[k] += e * e;
    runs.y2[k] += y * y;
    if (filter !== optimum) {
      best += w - optimum.K[k] * (best + w + v);
      runs.best2[k] += best * best;
    }
  }
}

/** Standard normal numbers, the same ones while the seed stays, as many as asked for. */
function normalNumbers(memo, seed, count) {
  if (memo.seed !== seed) {
    Object.assign(memo, { seed, rng: generator(seed + 1000), filled: 0 });
  }
  if (!memo.noise || memo.noise.length < count) {
    const wider = new Float32Array(count);
    if (memo.noise) {
      wider.set(memo.noise.subarray(0, memo.filled));
    }
    memo.noise = wider;
  }
  while (memo.filled < count) {
    memo.noise[memo.filled] = memo.rng.normal();
    memo.filled++;
  }
  return memo.noise;
}

/** Over the runs so far: RMSE of filter and optimum (rad), mean NEES and NIS. */
export function study({ T, runs, filter }) {
  let e2 = 0;
  let best2 = 0;
  let nees = 0;
  let nis = 0;
  for (let k = 0; k < T; k++) {
    e2 += runs.e2[k];
    best2 += runs.best2[k];
    nees += runs.e2[k] / filter.P[k];
    nis += runs.y2[k] / filter.S[k];
  }
  const all = runs.count * T;
  return { rmse: Math.sqrt(e2 / all), optimum: Math.sqrt(best2 / all), nees: nees / all, nis: nis / all };
}

/** +-2 times the standard deviation of the runs' errors at every time, and the means of NEES and NIS. */
export function spread({ T, runs, filter, memo }) {
  for (let k = 0; k < T; k++) {
    memo.spread[k] = 2 * Math.sqrt(runs.e2[k] / runs.count);
    memo.minus[k] = -memo.spread[k];
    memo.nees[k] = runs.e2[k] / runs.count / filter.P[k];
    memo.nis[k] = runs.y2[k] / runs.count / filter.S[k];
  }
  return memo;
}
