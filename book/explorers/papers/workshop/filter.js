// The Kalman filter in roots, P = L L', with matrices of every step, a gate and gaps: twin of kalman_lib's
// filters.py and roots.py. The sensors of a model here have noises that are independent of each other.
import { cholesky, multiply, multiplyTransposed } from "../../numerics/linalg.js";
import { chi2Quantile } from "../../numerics/metrics.js";

/** A matrix of step k, where M holds one, or one for every step. */
export function at(M, k, size) {
  return M.length > size ? M.subarray(k * size, (k + 1) * size) : M;
}

/** Room for one step of a model. */
function room({ n, m }) {
  const of = (size) => new Float64Array(size);
  return {
    x: of(n),
    x_pred: of(n),
    L: of(n * n),
    L_pred: of(n * n),
    columns: of(2 * n * n), // [F L, root of Q], one column a row
    FL: of(n * n),
    v: of(2 * n), // a reflection
    y: of(m),
    S: of(m * m),
    K: of(n * m),
    HL: of(m * n),
    h: of(n),
    a: of(n),
    A: of(n * n),
    k: of(n),
    LA: of(n * n),
    change: of(n), // of x, by the sensors so far
  };
}

/** columns (2n, n), one column a row: L (n, n), lower triangular, with L L' = their sum of squares. */
function rotated(rows, n, v, L) {
  const p = 2 * n;
  for (let j = 0; j < n; j++) {
    largestFirst(rows, n, p, j);
    const lead = rows[j * n + j];
    if (lead === 0) {
      continue;
    }
    let square = 0;
    for (let i = j; i < p; i++) {
      v[i] = rows[i * n + j] / lead;
      square += v[i] * v[i];
    }
    v[j] += Math.sqrt(square);
    reflect(rows, n, p, j, v);
  }
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < n; j++) {
      L[i * n + j] = j <= i ? rows[j * n + i] : 0;
    }
  }
}

/** The row, from j on, with the largest entry in column j comes to the place j. */
function largestFirst(rows, n, p, j) {
  let first = j;
  for (let i = j + 1; i < p; i++) {
    if (Math.abs(rows[i * n + j]) > Math.abs(rows[first * n + j])) {
      first = i;
    }
  }
  for (let l = 0; first !== j && l < n; l++) {
    const kept = rows[j * n + l];
    rows[j * n + l] = rows[first * n + l];
    rows[first * n + l] = kept;
  }
}

/** Householder's reflection along v of the rows from j on. */
function reflect(rows, n, p, j, v) {
  let square = 0;
  for (let i = j; i < p; i++) {
    square += v[i] * v[i];
  }
  for (let l = j; l < n; l++) {
    let along = 0;
    for (let i = j; i < p; i++) {
      along += v[i] * rows[i * n + l];
    }
    const factor = (2 * along) / square;
    for (let i = j; i < p; i++) {
      rows[i * n + l] -= factor * v[i];
    }
  }
  for (let i = j + 1; i < p; i++) {
    rows[i * n + j] = 0;
  }
}

/** x_pred = F x + B u, and the root of P_pred = F P F' + Q. */
function predict(model, k, u, root_Q, s) {
  const { n } = model;
  const F = at(model.F, k, n * n);
  multiply(F, s.x, n, n, 1, s.x_pred);
  if (u) {
    const B = at(model.B, k, n);
    for (let i = 0; i < n; i++) {
      s.x_pred[i] += B[i] * u[k];
    }
  }
  multiply(F, s.L, n, n, n, s.FL);
  for (let j = 0; j < n; j++) {
    for (let i = 0; i < n; i++) {
      s.columns[j * n + i] = s.FL[i * n + j];
      s.columns[(n + j) * n + i] = root_Q[i * n + j];
    }
  }
  rotated(s.columns, n, s.v, s.L_pred);
}

/** y = z - H x_pred and S = H P_pred H' + R. A sensor outside the gate is silent: its y is NaN. */
function innovation(model, z, k, limit, s) {
  const { n, m, H, R } = model;
  multiply(H, s.L_pred, m, n, n, s.HL);
  multiplyTransposed(s.HL, s.HL, m, n, m, s.S);
  let gated = 0; // one bit a sensor
  for (let i = 0; i < m; i++) {
    s.S[i * m + i] += R[i];
    let z_pred = 0;
    for (let j = 0; j < n; j++) {
      z_pred += H[i * n + j] * s.x_pred[j];
    }
    s.y[i] = z[k * m + i] - z_pred;
    if (s.y[i] * s.y[i] > limit * s.S[i * m + i]) {
      s.y[i] = NaN;
      gated |= 1 << i;
    }
  }
  return gated;
}

/** x, K and L after the measurement, one sensor after the other; what their densities add to ln L. */
function update(model, s) {
  const { n, m, H, R } = model;
  let density = 0;
  s.nis = 0;
  s.L.set(s.L_pred);
  s.K.fill(0);
  s.change.fill(0);
  for (let i = 0; i < m; i++) {
    if (Number.isNaN(s.y[i])) {
      continue;
    }
    const sigma = Math.sqrt(R[i]);
    let y = s.y[i];
    for (let j = 0; j < n; j++) {
      s.h[j] = H[i * n + j] / sigma;
      y -= H[i * n + j] * s.change[j]; // what the sensors before have told
    }
    y /= sigma;
    const S = oneSensor(s, n);
    s.nis += (y * y) / S;
    density -= (Math.log(2 * Math.PI * S * R[i]) + (y * y) / S) / 2;
    for (let j = 0; j < n; j++) {
      s.change[j] += s.k[j] * y;
    }
    addToGain(s, n, m, i, sigma);
  }
  correct(s, n, m);
  return density;
}

/** x = x_pred + K y, with what was heard. */
function correct(s, n, m) {
  for (let i = 0; i < n; i++) {
    s.x[i] = s.x_pred[i];
    for (let j = 0; j < m; j++) {
      if (!Number.isNaN(s.y[j])) {
        s.x[i] += s.K[i * m + j] * s.y[j];
      }
    }
  }
}

/** A sensor h of noise variance 1: its gain k and S, and L becomes the root after it (Carlson, 1973). */
function oneSensor(s, n) {
  const { L, h, a, A, k, LA } = s;
  for (let j = 0; j < n; j++) {
    a[j] = 0;
    for (let i = 0; i < n; i++) {
      a[j] += L[i * n + j] * h[i];
    }
  }
  let S = 1;
  A.fill(0);
  for (let j = 0; j < n; j++) {
    const before = S;
    S += a[j] * a[j];
    const shrink = Math.sqrt(before / S);
    A[j * n + j] = shrink;
    for (let i = 0; i < j; i++) {
      A[i * n + j] = -a[i] * (a[j] / before) * shrink;
    }
  }
  multiply(L, a, n, n, 1, k);
  for (let j = 0; j < n; j++) {
    k[j] /= S;
  }
  multiply(L, A, n, n, n, LA);
  L.set(LA);
  return S;
}

/** K of all sensors so far: this one corrects what those before it have told. */
function addToGain(s, n, m, i, sigma) {
  for (let j = 0; j < m; j++) {
    let told = 0;
    for (let l = 0; l < n; l++) {
      told += s.h[l] * s.K[l * m + j];
    }
    for (let l = 0; l < n; l++) {
      s.K[l * m + j] -= s.k[l] * told;
    }
  }
  for (let l = 0; l < n; l++) {
    s.K[l * m + i] += s.k[l] / sigma;
  }
}

/** The roots of Q: one, or one for every step. */
function rootsOf({ Q, n }) {
  const size = n * n;
  const roots = new Float64Array(Q.length);
  for (let from = 0; from < Q.length; from += size) {
    roots.set(cholesky(Q.subarray(from, from + size), n), from);
  }
  return roots;
}

/** The value of y^2 / S above which a sensor is left out. */
export function gateLimit(gate) {
  return gate ? chi2Quantile(gate, 1) : Infinity;
}

/** Run over z (T m), u (T) or null; see(k, gated, s) may look at every step. The log-likelihood. */
function over(model, z, u, limit, see) {
  const s = room(model);
  const roots = rootsOf(model);
  const size = model.n * model.n;
  s.x.set(model.x0);
  s.L.set(cholesky(model.P0, model.n));
  let total = 0;
  for (let k = 0; k * model.m < z.length; k++) {
    predict(model, k, u, at(roots, k, size), s);
    const gated = innovation(model, z, k, limit, s);
    total += update(model, s);
    see?.(k, gated, s);
  }
  return total;
}

/** ln of the density of all measurements: twin of tuning.log_likelihood. */
export function logLikelihood(model, z, u = null) {
  return over(model, z, u, Infinity);
}

/** Filter a whole series: as numerics/filters.js, with gated (T m), 1 where the gate closed, and nis (T). */
export function filterSeries(model, z, u = null, gate = 0) {
  const { n, m } = model;
  const T = z.length / m;
  const of = (size) => new Float64Array(T * size);
  const { Q, R, H } = model;
  const result = { T, n, m, Q, R, H, gated: new Uint8Array(T * m), nis: of(1) };
  const sizes = { x_pred: n, P_pred: n * n, x: n, P: n * n, y: m, S: m * m, K: n * m, F: n * n };
  for (const [name, size] of Object.entries(sizes)) {
    result[name] = of(size);
  }
  const square = new Float64Array(n * n);
  const squareOf = (L) => multiplyTransposed(L, L, n, n, n, square);
  result.log_likelihood = over(model, z, u, gateLimit(gate), (k, gated, s) => {
    for (const name of ["x_pred", "x", "y", "S", "K"]) {
      result[name].set(s[name], k * sizes[name]);
    }
    result.nis[k] = s.nis;
    result.P_pred.set(squareOf(s.L_pred), k * n * n);
    result.P.set(squareOf(s.L), k * n * n);
    result.F.set(at(model.F, k, n * n), k * n * n);
    for (let i = 0; i < m; i++) {
      result.gated[k * m + i] = (gated >> i) & 1;
    }
  });
  return result;
}
