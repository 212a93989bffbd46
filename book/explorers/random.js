// Repeatable noise, and a model's made-up truth with noisy measurements (twin of kalman_lib/simulate.py; the numbers
// are others than NumPy's: the tests hand the same noise to both).
import { cholesky } from "./linalg.js";

/** A generator with a seed (a whole number): uniform() in [0, 1), normal(), whole(n) in 0..n-1. */
export function generator(seed) {
  let a = seed ^ 0x9e3779b9, b = 0x243f6a88, c = 0xb7e15162, count = 1, kept = null;
  const bits = () => {                                  // Chris Doty-Humphrey's sfc32
    const sum = (a + b | 0) + count++ | 0;
    a = b ^ b >>> 9;
    b = c + (c << 3) | 0;
    c = (c << 21 | c >>> 11) + sum | 0;
    return sum >>> 0;
  };
  const uniform = () => bits() / 4294967296;
  const normal = () => {                                // Marsaglia's polar method: two at a time
    if (kept !== null) {
      const value = kept;
      kept = null;
      return value;
    }
    for (;;) {
      const p = 2 * uniform() - 1, q = 2 * uniform() - 1, s = p * p + q * q;
      if (s > 0 && s < 1) {
        const scale = Math.sqrt(-2 * Math.log(s) / s);
        kept = q * scale;
        return p * scale;
      }
    }
  };
  for (let i = 0; i < 15; i++) bits();
  return { uniform, normal, whole: n => Math.floor(n * uniform()) };
}

/** Run the model for a number of steps: {T, x (T n) the truth, z (T m), u (T l) or null}; x0 null: drawn from x0, P0. */
export function simulate(model, steps, rng, u = null, x0 = null) {
  const { n, m, l } = model, x = new Float64Array(steps * n), z = new Float64Array(steps * m);
  const state = Float64Array.from(x0 ?? model.x0), next = new Float64Array(n), z_pred = new Float64Array(m);
  const F = new Float64Array(n * n), H = new Float64Array(m * n), LQ = cholesky(model.Q, n);
  if (x0 === null) add(state, cholesky(model.P0, n), n, rng);
  for (let k = 0; k < steps; k++) {
    const R = model.R.length > m * m ? model.R.subarray(k * m * m, (k + 1) * m * m) : model.R;
    model.transition(state, u ? u.subarray(k * l, (k + 1) * l) : null, next, F);
    state.set(next);
    add(state, LQ, n, rng);
    model.measure(state, z_pred, H);
    add(z_pred, cholesky(R, m), m, rng);
    x.set(state, k * n);
    z.set(z_pred, k * m);
  }
  return { T: steps, x, z, u };
}

/** x += L times standard normal noise. */
function add(x, L, n, rng) {
  const noise = Array.from({ length: n }, rng.normal);
  for (let i = 0; i < n; i++) for (let j = 0; j <= i; j++) x[i] += L[i * n + j] * noise[j];
}
