// Chapter 4: the speed of a model ship, AR(2). Twin of kalman_lib/papers/ship.py.
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { kalmanFilter } from "../../numerics/filters.js";
import { leastSquares } from "../../numerics/leastsquares.js";
import { solve } from "../../numerics/linalg.js";
import { linearModel } from "../../numerics/models.js";
import { simulate as simulateModel } from "../../numerics/random.js";

/** The towing run: seconds, and the speed at their end in m/s. */
const RECIPE = [
  [5, 0],
  [6, 1.5],
  [14, 1.5],
  [6, 0],
  [5, 0],
];
const DT = 0.1; // s
const EVERY_DIGIT = 15;

export const SPEED_UNITS = { "m/s": 1, "cm/s": 0.01, "km/h": 1 / 3.6, kn: 1852 / 3600 }; // in m/s

/** State [speed now, speed one sample before] in m/s; the constant c enters through the input u = 1. */
export function model(p) {
  return linearModel({
    F: [
      [p.a1, p.a2],
      [1, 0],
    ],
    B: [[p.c], [0]],
    H: [[1, 0]],
    Q: [
      [p.Q, 0],
      [0, p.Q_copy],
    ],
    R: p.R,
    x0: [p.x0, p.x0],
    P0: [
      [p.P0, 0],
      [0, p.P0],
    ],
  });
}

/** An AR(2) speed with known coefficients, and its measurements. */
export function simulate(p, rng, steps = 600) {
  const u = new Float64Array(steps).fill(1);
  return simulateModel(model(p), steps, rng, u);
}

export function run(p, { z, u }, into = null) {
  return kalmanFilter(model(p), z, u, { into });
}

/** The SYNTHETIC towing run of RECIPE with white noise of sigma (m/s): {t (T) in s, x (T), z (T)}. */
export function towing_run(rng, sigma = 0.1) {
  const x = [];
  let speed = 0;
  for (const [seconds, end] of RECIPE) {
    const steps = Math.round(seconds / DT);
    for (let i = 0; i < steps; i++) {
      const share = (1 - Math.cos((Math.PI * i * DT) / seconds)) / 2;
      x.push(speed + (end - speed) * share);
    }
    speed = end;
  }
  return {
    t: Float64Array.from(x, (_, k) => DT * k),
    x: Float64Array.from(x),
    z: Float64Array.from(x, (value) => value + sigma * rng.normal()),
  };
}

/**
 * [c, a1, a2] of z_k = c + a1 z_{k-1} + a2 z_{k-2} by least squares; rows with a gap are left out. null: they
 * are not unique.
 */
export function fit(z) {
  const rows = [];
  for (let k = 2; k < z.length; k++) {
    if (Number.isFinite(z[k] + z[k - 1] + z[k - 2])) {
      rows.push(k);
    }
  }
  const ones = new Float64Array(rows.length).fill(1);
  const before = Float64Array.from(rows, (k) => z[k - 1]);
  const older = Float64Array.from(rows, (k) => z[k - 2]);
  const now = Float64Array.from(rows, (k) => z[k]);
  return leastSquares([ones, before, older], now);
}

/**
 * What `fit` finds on average if white noise of sigma (m/s) is added to the speed x (T): errors in variables.
 */
export function expected_fit(x, sigma) {
  const A = new Float64Array(9);
  const b = new Float64Array(3);
  const T = x.length;
  for (let k = 2; k < T; k++) {
    const row = [1, x[k - 1], x[k - 2]];
    for (let i = 0; i < 3; i++) {
      for (let j = 0; j < 3; j++) {
        A[3 * i + j] += row[i] * row[j];
      }
      b[i] += row[i] * x[k];
    }
  }
  A[4] += (T - 2) * sigma ** 2; // noise adds to the squares; in the products it cancels
  A[8] += (T - 2) * sigma ** 2;
  return solve(A, b, 3, 1) ? b : null;
}

/** The two roots l of l^2 - a1 l - a2 = 0 as [real, imaginary]; stable inside the unit circle. */
export function poles(a1, a2) {
  const square = a1 ** 2 / 4 + a2;
  const root = Math.sqrt(Math.abs(square));
  if (square < 0) {
    return [
      [a1 / 2, root],
      [a1 / 2, -root],
    ];
  }
  return [
    [a1 / 2 + root, 0],
    [a1 / 2 - root, 0],
  ];
}

// --- the times of a recording ------------------------------------------------------------------------------

const SAMPLING = {
  short: {
    en: "The time column must hold at least five times and no gap.",
    id: "Kolom waktu harus berisi sedikitnya lima waktu tanpa sel kosong.",
  },
  backwards: {
    en: "The time does not increase at row {row} of the data ({now} s after {before} s).",
    id: "Waktu tidak bertambah di baris data ke-{row} ({now} s setelah {before} s).",
  },
  uneven: {
    en:
      "The samples are unevenly spaced ({low} to {high} s; " +
      "{odd} of {all} steps are not about the median {dt} s), " +
      "but AR(2) takes them as even: resample them first.",
    id:
      "Jarak antarsampel tidak seragam ({low} sampai {high} s; " +
      "{odd} dari {all} langkah tidak sekitar median {dt} s), " +
      "padahal AR(2) menganggapnya seragam: seragamkan dahulu.",
  },
  even: {
    en: "The samples are evenly spaced, {dt} s apart.",
    id: "Jarak antarsampel seragam, {dt} s.",
  },
};

/**
 * Are the times t (T) in s evenly spaced? {dt, uneven, en, id}: the median step in s, and the sentence that
 * tells it.
 */
export function sampling(t, tolerance = 0.05) {
  if (t.length < 5 || !t.every(Number.isFinite)) {
    throw new InputError(SAMPLING.short);
  }
  const steps = t.subarray(1).map((value, k) => value - t[k]);
  const row = steps.findIndex((step) => !(step > 0)) + 1;
  if (row > 0) {
    const place = { row: String(row + 1), now: t[row], before: t[row - 1] };
    throw new InputError(inBoth(SAMPLING.backwards, place, EVERY_DIGIT));
  }
  const sorted = steps.slice().sort();
  const dt = median(sorted);
  const odd = steps.filter((step) => Math.abs(step - dt) > tolerance * dt).length;
  const values = { low: sorted[0], high: sorted.at(-1), dt, odd: String(odd), all: String(steps.length) };
  const uneven = odd > 0;
  return { dt, uneven, ...inBoth(uneven ? SAMPLING.uneven : SAMPLING.even, values) };
}

function median(sorted) {
  const half = Math.floor(sorted.length / 2);
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

export const twins = {
  fit: (p, { z }) => fit(z) ?? [NaN],
  poles: (p) => poles(p.a1, p.a2).flat(),
};
