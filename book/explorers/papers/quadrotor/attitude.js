// The attitude filter: the paper's, for each axis a small Kalman filter with state [angle, s], and the
// adaptive one (vectors.js). s is the error of the gyroscope's rate u, x the angle; P00, P01 and P11 are the
// elements of P.
import { DEG, euler_rates, heading, tilt, wrap } from "./model.js";
import { samplesAtRest, samplesAtStart } from "./rest.js";
import { is_dynamic, measured } from "./sensors.js";
import { mean, median_step, spread } from "./statistics.js";
import { filterVectors, stateOf } from "./vectors.js";

const R_LEAST = 1e-12; // rad2
const SERIES = ["angles", "z", "u", "s", "y", "P", "R"];

const METHOD = {
  kept: false, // is s a bias, or noise of one step?
  R_min: [(3 * DEG) ** 2, (3 * DEG) ** 2, (15 * DEG) ** 2],
  without: [], // corrections that are left out
  m: 1, // R is m times as large while the craft is dynamic
  window: 1, // s
  threshold: 4,
  q_bias: 1e-9,
};

/** The three methods; what the numbers mean is told at the Python twin, class Method. */
export const METHODS = {
  literal: {
    ...METHOD,
    q: DEG ** 2,
    R_min: [0, 0, 0],
    m: 0.16,
    without: ["formulas", "Euler rates", "wrapping", "estimated tilt", "rest variance"],
  },
  paper: { ...METHOD, q: 30 * DEG ** 2 },
  adaptive: { ...METHOD, q: (0.1 * DEG) ** 2, kept: true },
};

/**
 * Filter a recording {t (T), gyr, acc, mag (3 T), rest_s} by a method: {angles, z, u, s, y, P, R (3 T),
 * dynamic (T)}. NaN: a silent sensor. memo keeps the arrays, and what only depends on the sensors, for the
 * next call.
 */
export function attitude(recording, how, memo = {}) {
  prepare(recording, how, memo);
  return how.kept ? byVectors(recording, how, memo) : byAngles(recording, how, memo);
}

/** The adaptive method; z and u, which it does not use itself, are added. */
function byVectors(recording, how, memo) {
  const { gyr, acc, mag } = recording;
  const rates = new Float64Array(3);
  const u = new Float64Array(3);
  const store = (k, f, y) => {
    const { angles, P, steep } = stateOf(f);
    if (k > 0) {
      for (let i = 0; i < 3; i++) {
        const at = 3 * k + i;
        rates[i] = (gyr[at] + gyr[at - 3]) / 2 - f.at_rest[i] - memo.s[at - 3];
      }
      euler_rates(rates, memo.angles[3 * k - 3], memo.angles[3 * k - 2], u);
    }
    const [x_acc, y_acc, z_acc] = acc.subarray(3 * k, 3 * k + 3);
    const [x_mag, y_mag, z_mag] = mag.subarray(3 * k, 3 * k + 3);
    memo.z.set([...tilt(x_acc, y_acc, z_acc), heading(x_mag, y_mag, z_mag, angles[0], angles[1])], 3 * k);
    memo.angles.set(angles, 3 * k);
    memo.u.set(u, 3 * k);
    memo.s.set(f.s, 3 * k);
    for (let i = 0; i < 3; i++) {
      memo.y[3 * k + i] = steep[i] * y[i];
      memo.P[3 * k + i] = P[i];
      memo.R[3 * k + i] = steep[i] ** 2 * f.R[i];
    }
  };
  filterVectors(recording, memo.rest, memo.step, how, store);
  return memo;
}

/** The paper's method. */
function byAngles(recording, how, memo) {
  const { t, gyr, mag } = recording;
  const T = t.length;
  const f = startFilter(recording, how, memo);
  memo.z.set(memo.given);
  memo.y.fill(NaN);
  storeStart(f, memo);
  for (let k = 1; k < T; k++) {
    const dt = t[k] - t[k - 1];
    readGyroscope(f, gyr, k, dt);
    predictAngles(f, dt);
    if (f.estimates_tilt) {
      memo.z[3 * k + 2] = heading(mag[3 * k], mag[3 * k + 1], mag[3 * k + 2], f.x[0], f.x[1]);
    }
    const factor = memo.dynamic[k] ? how.m : 1;
    for (let i = 0; i < 3; i++) {
      updateAngle(f, memo, i, 3 * k + i, factor);
    }
    if (f.wraps) {
      f.x[0] = wrap(f.x[0]);
      f.x[2] = wrap(f.x[2]);
    }
    store(f, memo, k);
  }
  return memo;
}

// --- before the first step ---------------------------------------------------------------------------------

/** Fill memo with what depends on sensors and method only; most of it stays while a slider moves. */
function prepare(recording, how, memo) {
  const { t, gyr, acc, mag, rest_s } = recording;
  const T = t.length;
  const { without } = how;
  const isSame =
    memo.rest_s === rest_s &&
    memo.gyr === gyr &&
    memo.acc === acc &&
    memo.mag === mag &&
    memo.without === without;
  if (!isSame) {
    const rest = samplesAtRest(recording);
    const { z, start } = measured(acc, mag, samplesAtStart(t, rest), without);
    const count = without.includes("rest variance") ? T : rest;
    const of_sensors = { given: z, start, step: median_step(t), spread: spread(z, count), dynamic_by: null };
    Object.assign(memo, { rest_s, gyr, acc, mag, without, rest, ...of_sensors });
    makeSeries(memo, T);
  }
  const dynamic_by = `${how.window} ${how.threshold}`;
  if (memo.dynamic_by !== dynamic_by) {
    memo.dynamic_by = dynamic_by;
    memo.dynamic = is_dynamic(t, mag, memo.rest, how.window, how.threshold, memo.step);
  }
}

function makeSeries(memo, T) {
  if (memo.angles?.length !== 3 * T) {
    for (const name of SERIES) {
      memo[name] = new Float64Array(3 * T);
    }
  }
}

/** The three filters as they start: one number per axis in every array. */
function startFilter({ gyr }, how, memo) {
  const { rest } = memo;
  const isMissing = (name) => how.without.includes(name);
  const R_rest = memo.spread.map((variance, i) => Math.max(variance, how.R_min[i], R_LEAST));
  const factor = memo.dynamic[0] ? how.m : 1;
  return {
    how,
    x: Float64Array.from(memo.start),
    s: new Float64Array(3),
    u: new Float64Array(3), // rates of roll, pitch, yaw
    gyr: new Float64Array(3), // rates of the body
    P00: Float64Array.from(R_rest, (R) => R * factor),
    P01: new Float64Array(3),
    P11: new Float64Array(3),
    R_rest,
    gyr_at_rest: [0, 1, 2].map((i) => (isMissing("rest mean") || rest === 0 ? 0 : mean(gyr, i, rest))),
    turns_rates: !isMissing("Euler rates"),
    looks_ahead: !isMissing("midpoint"),
    wraps: !isMissing("wrapping"),
    estimates_tilt: !isMissing("estimated tilt"),
  };
}

// --- one step ----------------------------------------------------------------------------------------------

/** u: the rates of the angles in the middle of step k. */
function readGyroscope(f, gyr, k, dt) {
  const { x, s, u } = f;
  for (let i = 0; i < 3; i++) {
    f.gyr[i] = (gyr[3 * k + i] + gyr[3 * k + i - 3]) / 2 - f.gyr_at_rest[i];
  }
  if (!f.turns_rates) {
    u.set(f.gyr);
    return;
  }
  euler_rates(f.gyr, x[0], x[1], u);
  if (f.looks_ahead) {
    const roll = x[0] + (dt / 2) * (u[0] - s[0]);
    const pitch = x[1] + (dt / 2) * (u[1] - s[1]);
    euler_rates(f.gyr, roll, pitch, u);
  }
}

/** angle += dt (u - s), and P = F P F' + Q with F = [[1, -dt], [0, 0]]. */
function predictAngles({ how, x, s, u, P00, P01, P11 }, dt) {
  const { q } = how;
  for (let i = 0; i < 3; i++) {
    x[i] += dt * (u[i] - s[i]);
    s[i] = 0;
    P00[i] += dt * (dt * P11[i] - 2 * P01[i]) + (q * dt * dt * dt) / 3;
    P01[i] = (-q * dt * dt) / 2;
    P11[i] = q * dt;
  }
}

/**
 * Blend axis i with its measured angle; at: its place in the series. factor: m, while the craft is dynamic.
 */
function updateAngle(f, series, i, at, factor) {
  const R = factor * f.R_rest[i];
  if (!Number.isNaN(series.given[at])) {
    const difference = series.z[at] - f.x[i];
    series.y[at] = f.wraps ? wrap(difference) : difference;
    blend(f, i, series.y[at], R);
  }
  series.R[at] = R;
  series.P[at] = f.P00[i];
}

/** The update of one axis. */
function blend({ x, s, P00, P01, P11 }, i, y, R) {
  const S = P00[i] + R;
  const K0 = P00[i] / S;
  const K1 = P01[i] / S;
  x[i] += K0 * y;
  s[i] += K1 * y;
  P00[i] = K0 * R;
  P11[i] -= K1 * P01[i];
  P01[i] = K1 * R;
}

// --- what is kept of it ------------------------------------------------------------------------------------

function storeStart({ x, P00 }, series) {
  for (let i = 0; i < 3; i++) {
    series.u[i] = 0;
    series.s[i] = 0;
    series.y[i] = 0;
    series.angles[i] = x[i];
    series.P[i] = P00[i];
    series.R[i] = P00[i];
  }
}

function store({ x, u, s }, series, k) {
  for (let i = 0; i < 3; i++) {
    series.angles[3 * k + i] = x[i];
    series.u[3 * k + i] = u[i];
    series.s[3 * k + i] = s[i];
  }
}
