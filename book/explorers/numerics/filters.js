// The Kalman filter and the Rauch-Tung-Striebel smoother: twin of kalman_lib/filters.py.
// Everything is a Float64Array, step after step: x (T n), P (T n n), z (T m), and so on.
import { addTo, multiply, multiplyTransposed, solve, symmetric, transpose } from "./linalg.js";
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

/** Blend s.x_pred and s.P_pred with the measurement z (m): x, P (Joseph's form), y, S, K go into s. */
export function update(model, z, R, s) {
  const { n, m } = model;
  innovation(model, z, R, s);
  s.S_used.set(s.S);
  solve(s.S_used, s.HP, m, n); // K' = S^-1 H P_pred
  transpose(s.HP, m, n, s.K);
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

/** x = x_pred + K y. */
function correct(s, n, m) {
  for (let i = 0; i < n; i++) {
    let sum = s.x_pred[i];
    for (let j = 0; j < m; j++) {
      sum += s.K[i * m + j] * s.y[j];
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
 * Filter a whole series: z (T m), NaN where a measurement is missing; u (T l) or null. options: adaptR(k, y,
 * HPH, R, out), see `adapted`; into: a result to be filled again, if it has the right size. Once the gain of
 * a constant model has stopped changing, only x is computed.
 */
export function kalmanFilter(model, z, u = null, options = {}) {
  const { m, l } = model;
  const { adaptR, into } = options;
  const T = z.length / m;
  const result = fits(into, model, T) ? into : emptyResult(model, T);
  const isConstant = model.linear && !hasNoiseOfSteps(model) && !adaptR;
  const s = room(model);
  const x = Float64Array.from(model.x0);
  const P = Float64Array.from(model.P0);
  let settled = false;
  for (let k = 0; k < T; k++) {
    let R = noiseAt(model, k);
    const z_k = row(z, k, m);
    const u_k = u ? row(u, k, l) : null;
    if (z_k.some(Number.isNaN)) {
      predict(model, x, P, u_k, s);
      missed(model, z_k, R, s);
      settled = false;
    } else if (settled) {
      settledStep(model, x, u_k, z_k, s);
    } else {
      predict(model, x, P, u_k, s);
      R = adaptR ? adapted(adaptR, k, model, z_k, R, s) : R;
      update(model, z_k, R, s);
      settled = isConstant && same(s.P, P);
    }
    x.set(s.x);
    P.set(s.P);
    store(result, k, s, R);
  }
  return result;
}

/** Can T steps of the model be stored in this result? */
function fits(into, model, T) {
  return into && into.T === T && into.n === model.n && into.m === model.m;
}

/** What belongs to step k of an array that holds `size` numbers for every step. */
function row(array, k, size) {
  return array.subarray(k * size, (k + 1) * size);
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

/** Run back over a result, so that every estimate knows the later measurements: {x (T n), P (T n n), G}. */
export function rtsSmooth(result) {
  const { T, n } = result;
  const nn = n * n;
  const x = Float64Array.from(result.x);
  const P = Float64Array.from(result.P);
  const G = new Float64Array(Math.max(T - 1, 0) * nn);
  const step = {
    A: new Float64Array(nn),
    B: new Float64Array(nn),
    C: new Float64Array(nn),
    e: new Float64Array(n),
  };
  for (let k = T - 2; k >= 0; k--) {
    const G_k = row(G, k, nn);
    smootherGain(result, k, n, step, G_k);
    smoothState(result, x, k, n, step, G_k);
    smoothCovariance(result, P, k, n, step, G_k);
  }
  return { x, P, G };
}

/** G = P F' P_pred^-1 of step k, with F and P_pred of the step after it. */
function smootherGain(result, k, n, { A, B }, G_k) {
  const nn = n * n;
  A.set(row(result.P_pred, k + 1, nn));
  multiply(row(result.F, k + 1, nn), row(result.P, k, nn), n, n, n, B);
  if (!solve(A, B, n, n)) {
    B.fill(0); // a state known exactly
  }
  transpose(B, n, n, G_k);
}

/** x += G (x of the step after it, smoothed - its x_pred). */
function smoothState(result, x, k, n, { e, C }, G_k) {
  for (let i = 0; i < n; i++) {
    e[i] = x[(k + 1) * n + i] - result.x_pred[(k + 1) * n + i];
  }
  multiply(G_k, e, n, n, 1, C);
  for (let i = 0; i < n; i++) {
    x[k * n + i] += C[i];
  }
}

/** P += G (P of the step after it, smoothed - its P_pred) G'. */
function smoothCovariance(result, P, k, n, { A, B, C }, G_k) {
  const nn = n * n;
  for (let i = 0; i < nn; i++) {
    A[i] = P[(k + 1) * nn + i] - result.P_pred[(k + 1) * nn + i];
  }
  multiply(G_k, A, n, n, n, B);
  multiplyTransposed(B, G_k, n, n, n, C);
  const P_k = row(P, k, nn);
  addTo(P_k, C);
  symmetric(P_k, n);
}
