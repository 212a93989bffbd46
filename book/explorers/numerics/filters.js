// The Kalman filter: twin of kalman_lib/filters.py. The smoother lies in smoother.js.
// Everything is a Float64Array, step after step: x (T n), P (T n n), z (T m), and so on.
import { addTo, multiply, multiplyTransposed, row, solve, symmetric, transpose } from "./linalg.js";
import { hasNoiseOfSteps, noiseAt } from "./models.js";

/** Room for one step: what `predict` and `update` write into. */
export function room({ n, m }) {
  const of = (size) => new Float64Array(size);
  return {
    x_pred: of(n),
    P_pred: of(n * n),
    F: of(n * n),
    z_pred: of(m),
    H: of(m * n),
    y: of(m),
    S: of(m * m),
    K: of(n * m),
    x: of(n),
    P: of(n * n),
    R: of(m * m),
    FP: of(n * n), // from here on: products on the way
    HP: of(m * n),
    HPH: of(m * m),
    S_used: of(m * m),
    I_KH: of(n * n),
    IP: of(n * n),
    KR: of(n * m),
    KRK: of(n * n),
  };
}

/** One step ahead without a measurement: x_pred, P_pred and F of the step go into s (see `room`). */
export function predict(model, x, P, u, s) {
  const { n } = model;
  model.transition(x, u, s.x_pred, s.F);
  multiply(s.F, P, n, n, n, s.FP);
  multiplyTransposed(s.FP, s.F, n, n, n, s.P_pred);
  addTo(s.P_pred, model.Q); // F P F' + Q
  symmetric(s.P_pred, n);
}

/** y = z - h(x_pred), H P_pred and S = H P_pred H' + R go into s: what only depends on the prediction. */
function innovation(model, z, R, s) {
  const { n, m } = model;
  model.measure(s.x_pred, s.z_pred, s.H);
  model.residual(z, s.z_pred, s.y);
  multiply(s.H, s.P_pred, m, n, n, s.HP);
  multiplyTransposed(s.HP, s.H, m, n, m, s.S);
  addTo(s.S, R);
}

/**
 * Blend s.x_pred and s.P_pred with the measurement z (m): x, P (Joseph's form), y, S, K go into s.
 * A sensor is silent where z is NaN: its y is NaN, its column of K is 0, and the others are used.
 */
export function update(model, z, R, s) {
  const { n, m } = model;
  innovation(model, z, R, s);
  gain(s, n, m);
  correct(s, n, m);
  multiply(s.K, s.H, n, m, n, s.I_KH);
  for (let i = 0; i < n * n; i++) {
    const one = i % (n + 1) === 0 ? 1 : 0; // on the diagonal
    s.I_KH[i] = one - s.I_KH[i];
  }
  multiply(s.I_KH, s.P_pred, n, n, n, s.IP);
  multiplyTransposed(s.IP, s.I_KH, n, n, n, s.P);
  multiply(s.K, R, n, m, m, s.KR);
  multiplyTransposed(s.KR, s.K, n, m, n, s.KRK);
  addTo(s.P, s.KRK); // (I - K H) P_pred (I - K H)' + K R K'
  symmetric(s.P, n);
}

/** K = P_pred H' S^-1. */
function gain(s, n, m) {
  if (s.y.some(Number.isNaN)) {
    gainOfHeard(s, n, m);
    return;
  }
  s.S_used.set(s.S);
  solve(s.S_used, s.HP, m, n); // K' = S^-1 H P_pred
  transpose(s.HP, m, n, s.K);
}

/** The same of the sensors that are heard; 0 for the others. */
function gainOfHeard(s, n, m) {
  const heard = [...s.y.keys()].filter((j) => !Number.isNaN(s.y[j]));
  const h = heard.length;
  heard.forEach((j, row_j) => {
    s.HP.copyWithin(row_j * n, j * n, (j + 1) * n);
    heard.forEach((i, column) => {
      s.S_used[row_j * h + column] = s.S[j * m + i];
    });
  });
  solve(s.S_used, s.HP, h, n);
  s.K.fill(0);
  heard.forEach((j, row_j) => {
    for (let i = 0; i < n; i++) {
      s.K[i * m + j] = s.HP[row_j * n + i];
    }
  });
}

/** x = x_pred + K y, with what was heard. */
function correct(s, n, m) {
  for (let i = 0; i < n; i++) {
    let sum = s.x_pred[i];
    for (let j = 0; j < m; j++) {
      if (!Number.isNaN(s.y[j])) {
        sum += s.K[i * m + j] * s.y[j];
      }
    }
    s.x[i] = sum;
  }
}

/** The measurement does not arrive: the prediction is all there is. */
function missed(model, z, R, s) {
  innovation(model, z, R, s);
  s.x.set(s.x_pred);
  s.P.set(s.P_pred);
  s.y.fill(NaN);
  s.K.fill(0);
}

/** P, S and K are those of the step before, because a constant model has settled: only x is new. */
function settledStep(model, x, u, z, s) {
  model.transition(x, u, s.x_pred, s.F);
  model.measure(s.x_pred, s.z_pred, s.H);
  model.residual(z, s.z_pred, s.y);
  correct(s, model.n, model.m);
}

/** The R that adaptR makes of this innovation: adaptR(k, y, HPH, R, out) writes into out (m m). */
function adapted(adaptR, k, model, z, R, s) {
  innovation(model, z, R, s);
  for (let i = 0; i < R.length; i++) {
    s.HPH[i] = s.S[i] - R[i];
  }
  adaptR(k, s.y, s.HPH, R, s.R);
  return s.R;
}

/** Empty arrays for T steps of the model: a FilterResult that `kalmanFilter` fills. */
export function emptyResult(model, T) {
  const { n, m } = model;
  const of = (size) => new Float64Array(T * size);
  return {
    T,
    n,
    m,
    x_pred: of(n),
    P_pred: of(n * n),
    x: of(n),
    P: of(n * n),
    y: of(m),
    S: of(m * m),
    K: of(n * m),
    F: of(n * n),
    R: of(m * m),
  };
}

/** Write step k into the result. */
function store(result, k, s, R) {
  for (const name of ["x_pred", "P_pred", "x", "P", "y", "S", "K", "F"]) {
    result[name].set(s[name], k * s[name].length);
  }
  result.R.set(R, k * R.length);
}

/**
 * Filter a whole series: z (T m), NaN where a sensor is silent; u (T l) or null. options: adaptR(k, y,
 * HPH, R, out), see `adapted`; into: a result to be filled again, if it has the right size. Once the gain of
 * a constant model has stopped changing, only x is computed.
 */
export function kalmanFilter(model, z, u = null, options = {}) {
  const { m, l } = model;
  const { adaptR, into } = options;
  const T = z.length / m;
  const result = fits(into, model, T) ? into : emptyResult(model, T);
  result.Q = model.Q;
  const isConstant = model.linear && !hasNoiseOfSteps(model) && !adaptR;
  const s = room(model);
  const x = Float64Array.from(model.x0);
  const P = Float64Array.from(model.P0);
  let settled = false;
  for (let k = 0; k < T; k++) {
    let R = noiseAt(model, k);
    const z_k = row(z, k, m);
    const u_k = u ? row(u, k, l) : null;
    const isWhole = !z_k.some(Number.isNaN);
    if (settled && isWhole) {
      settledStep(model, x, u_k, z_k, s);
    } else {
      R = step(model, k, { x, P, u: u_k, z: z_k, R, adaptR }, s);
      settled = isConstant && isWhole && same(s.P, P);
    }
    x.set(s.x);
    P.set(s.P);
    store(result, k, s, R);
  }
  return result;
}

/** Predict, then update with what was heard; the R that was used. */
function step(model, k, { x, P, u, z, R, adaptR }, s) {
  predict(model, x, P, u, s);
  if (z.every(Number.isNaN)) {
    missed(model, z, R, s);
    return R;
  }
  const R_used = adaptR ? adapted(adaptR, k, model, z, R, s) : R;
  update(model, z, R_used, s);
  return R_used;
}

/** Can T steps of the model be stored in this result? */
function fits(into, model, T) {
  return into && into.T === T && into.n === model.n && into.m === model.m;
}

/** Has P stopped changing, up to rounding? */
function same(P, before) {
  for (let i = 0; i < P.length; i++) {
    if (Math.abs(P[i] - before[i]) > 4e-16 * Math.abs(P[i])) {
      return false;
    }
  }
  return true;
}
