// Repeatable noise, and a model's made-up truth with noisy measurements (twin of kalman_lib/simulate.py; the
// numbers are others than NumPy's: the tests hand the same noise to both).
import { cholesky } from "./linalg.js";
import { noiseAt } from "./models.js";

/** A generator with a seed (a whole number): uniform() in [0, 1), normal(), whole(n) in 0..n-1. */
export function generator(seed) {
  const bits = bitsOf(seed);
  const uniform = () => bits() / 4294967296; // 2^32
  let kept = null;
  const normal = () => {
    if (kept !== null) {
      const value = kept;
      kept = null;
      return value;
    }
    const [first, second] = normalPair(uniform);
    kept = second;
    return first;
  };
  return { uniform, normal, whole: (n) => Math.floor(n * uniform()) };
}

/** Chris Doty-Humphrey's sfc32: a function that gives 32 random bits at each call. */
function bitsOf(seed) {
  let a = seed ^ 0x9e3779b9;
  let b = 0x243f6a88;
  let c = 0xb7e15162;
  let count = 1;
  const bits = () => {
    const sum = (((a + b) | 0) + count) | 0;
    count++;
    a = b ^ (b >>> 9);
    b = (c + (c << 3)) | 0;
    c = (((c << 21) | (c >>> 11)) + sum) | 0;
    return sum >>> 0;
  };
  for (let i = 0; i < 15; i++) {
    bits(); // until nothing of the seed shows
  }
  return bits;
}

/** Marsaglia's polar method: two normal numbers at a time. */
function normalPair(uniform) {
  for (;;) {
    const p = 2 * uniform() - 1;
    const q = 2 * uniform() - 1;
    const square = p * p + q * q;
    if (square > 0 && square < 1) {
      const scale = Math.sqrt((-2 * Math.log(square)) / square);
      return [p * scale, q * scale];
    }
  }
}

/**
 * Run the model for some steps: {T, x (T n) the truth, z (T m), u (T l) or null}; x0 null: drawn from x0, P0.
 */
export function simulate(model, steps, rng, u = null, x0 = null) {
  const { n, m, l } = model;
  const x = new Float64Array(steps * n);
  const z = new Float64Array(steps * m);
  const state = Float64Array.from(x0 ?? model.x0);
  const next = new Float64Array(n);
  const z_pred = new Float64Array(m);
  const F = new Float64Array(n * n);
  const H = new Float64Array(m * n);
  const root_Q = cholesky(model.Q, n);
  if (x0 === null) {
    addNoise(state, cholesky(model.P0, n), n, rng);
  }
  for (let k = 0; k < steps; k++) {
    const u_k = u ? u.subarray(k * l, (k + 1) * l) : null;
    model.transition(state, u_k, next, F);
    state.set(next);
    addNoise(state, root_Q, n, rng);
    model.measure(state, z_pred, H);
    addNoise(z_pred, cholesky(noiseAt(model, k), m), m, rng);
    x.set(state, k * n);
    z.set(z_pred, k * m);
  }
  return { T: steps, x, z, u };
}

/** x += L times standard normal noise. */
function addNoise(x, L, n, rng) {
  const noise = Array.from({ length: n }, rng.normal);
  for (let i = 0; i < n; i++) {
    for (let j = 0; j <= i; j++) {
      x[i] += L[i * n + j] * noise[j];
    }
  }
}
