// The Kalman filter and the Rauch-Tung-Striebel smoother, as in kalman_lib/models.py and kalman_lib/filters.py.
// Everything is a Float64Array, step after step: x (T n), P (T n n), z (T m), and so on.
import { matrix, multiply, multiplyTransposed, solve, symmetric } from "./linalg.js";

const subtract = (z, z_pred, y) => { for (let i = 0; i < y.length; i++) y[i] = z[i] - z_pred[i]; };

/**
 * x = F x + B u + w, z = H x + v. F, H, Q, R, P0, B are numbers, lists or lists of rows; x0 a number or a list.
 * R may also hold one matrix per step, one after the other.
 */
export function linearModel({ F, H, Q, R, x0, P0, B = null, residual = subtract }) {
  const model = { F: matrix(F), H: matrix(H), Q: matrix(Q), R: matrix(R), x0: matrix(x0), P0: matrix(P0),
                  B: B === null ? null : matrix(B), residual, linear: true };
  const n = model.n = model.x0.length, m = model.m = model.H.length / n, l = model.l = model.B ? model.B.length / n : 0;
  model.transition = (x, u, x_next, F) => {
    multiply(model.F, x, n, n, 1, x_next);
    if (u) for (let i = 0; i < n; i++) for (let j = 0; j < l; j++) x_next[i] += model.B[i * l + j] * u[j];
    F.set(model.F);
  };
  model.measure = (x, z_pred, H) => {
    multiply(model.H, x, m, n, 1, z_pred);
    H.set(model.H);
  };
  return model;
}

/**
 * x = f(x, u) + w, z = h(x) + v: the model of the extended filter. The functions write into their last argument:
 * f(x, u, out n), F(x, u, out n n), h(x, out m), H(x, out m n); l is the length of u.
 */
export function nonlinearModel({ f, F, h, H, Q, R, x0, P0, m = 1, l = 0, residual = subtract }) {
  const model = { Q: matrix(Q), R: matrix(R), x0: matrix(x0), P0: matrix(P0), m, l, residual, linear: false };
  model.n = model.x0.length;
  model.transition = (x, u, x_next, matrixF) => { f(x, u, x_next); F(x, u, matrixF); };
  model.measure = (x, z_pred, matrixH) => { h(x, z_pred); H(x, matrixH); };
  return model;
}

/** Room for one step: what `predict` and `update` write into. */
export function room(model) {
  const { n, m } = model, of = size => new Float64Array(size);
  return { x_pred: of(n), P_pred: of(n * n), F: of(n * n), x: of(n), P: of(n * n), y: of(m), S: of(m * m), K: of(n * m),
           z_pred: of(m), H: of(m * n), HP: of(m * n), I_KH: of(n * n), A: of(n * n), B: of(n * n), C: of(n * m), D: of(m * m) };
}

/** One step ahead without a measurement: x_pred, P_pred and F of the step go into s (see `room`). */
export function predict(model, x, P, u, s) {
  const { n } = model;
  model.transition(x, u, s.x_pred, s.F);
  multiplyTransposed(multiply(s.F, P, n, n, n, s.A), s.F, n, n, n, s.P_pred);       // F P F'
  for (let i = 0; i < n * n; i++) s.P_pred[i] += model.Q[i];
  symmetric(s.P_pred, n);
}

/** y, S and what else only depends on the prediction: y (m), H P_pred (m, n), S (m, m) go into s. */
function innovation(model, z, R, s) {
  const { n, m } = model;
  model.measure(s.x_pred, s.z_pred, s.H);
  model.residual(z, s.z_pred, s.y);
  multiply(s.H, s.P_pred, m, n, n, s.HP);
  multiplyTransposed(s.HP, s.H, m, n, m, s.S);
  for (let i = 0; i < m * m; i++) s.S[i] += R[i];
}

/** Blend s.x_pred and s.P_pred with the measurement z (m): x, P (Joseph's form), y, S, K go into s. */
export function update(model, z, R, s) {
  const { n, m } = model;
  innovation(model, z, R, s);
  s.D.set(s.S);
  solve(s.D, s.HP, m, n);                                                           // K' = S^-1 H P_pred
  for (let i = 0; i < n; i++) for (let j = 0; j < m; j++) s.K[i * m + j] = s.HP[j * n + i];
  correct(s, n, m);
  multiply(s.K, s.H, n, m, n, s.I_KH);
  for (let i = 0; i < n * n; i++) s.I_KH[i] = (i % (n + 1) === 0 ? 1 : 0) - s.I_KH[i];
  multiplyTransposed(multiply(s.I_KH, s.P_pred, n, n, n, s.A), s.I_KH, n, n, n, s.P);
  multiplyTransposed(multiply(s.K, R, n, m, m, s.C), s.K, n, m, n, s.B);
  for (let i = 0; i < n * n; i++) s.P[i] += s.B[i];                                 // (I - K H) P_pred (I - K H)' + K R K'
  symmetric(s.P, n);
}

/** x = x_pred + K y. */
function correct(s, n, m) {
  for (let i = 0; i < n; i++) {
    let sum = s.x_pred[i];
    for (let j = 0; j < m; j++) sum += s.K[i * m + j] * s.y[j];
    s.x[i] = sum;
  }
}

/** Empty arrays for T steps of the model: a FilterResult that `kalmanFilter` fills. */
export function emptyResult(model, T) {
  const { n, m } = model, of = size => new Float64Array(T * size);
  return { T, n, m, x_pred: of(n), P_pred: of(n * n), x: of(n), P: of(n * n), y: of(m), S: of(m * m), K: of(n * m),
           F: of(n * n), R: of(m * m) };
}

/**
 * Filter a whole series: z (T m), NaN where a measurement is missing; u (T l) or null.
 * options: adaptR(k, y, HPH, R, out) writes the R (m m) of step k into out; into: a result of the same T and model size
 * to be filled again. Once the gain of a constant model has stopped changing, only x is computed.
 */
export function kalmanFilter(model, z, u = null, { adaptR = null, into = null } = {}) {
  const { n, m, l } = model, T = z.length / m, s = room(model), mm = m * m;
  const r = into && into.T === T && into.n === n && into.m === m ? into : emptyResult(model, T);
  const varying = model.R.length > mm, constant = model.linear && !varying && !adaptR;
  const x = Float64Array.from(model.x0), P = Float64Array.from(model.P0), HPH = new Float64Array(mm), own_R = new Float64Array(mm);
  let settled = false;
  for (let k = 0; k < T; k++) {
    let R = varying ? model.R.subarray(k * mm, (k + 1) * mm) : model.R;
    const z_k = z.subarray(k * m, (k + 1) * m), u_k = u ? u.subarray(k * l, (k + 1) * l) : null;
    const missing = z_k.some(Number.isNaN);
    if (settled && !missing) {                      // P, S and K are those of the step before
      model.transition(x, u_k, s.x_pred, s.F);
      model.measure(s.x_pred, s.z_pred, s.H);
      model.residual(z_k, s.z_pred, s.y);
      correct(s, n, m);
    } else {
      predict(model, x, P, u_k, s);
      if (missing) {
        innovation(model, z_k, R, s);
        s.x.set(s.x_pred);
        s.P.set(s.P_pred);
        s.y.fill(NaN);
        s.K.fill(0);
        settled = false;
      } else {
        if (adaptR) {
          innovation(model, z_k, R, s);
          for (let i = 0; i < mm; i++) HPH[i] = s.S[i] - R[i];
          adaptR(k, s.y, HPH, R, own_R);
          R = own_R;
        }
        update(model, z_k, R, s);
        settled = constant && same(s.P, P);
      }
    }
    x.set(s.x);
    P.set(s.P);
    r.x_pred.set(s.x_pred, k * n);
    r.P_pred.set(s.P_pred, k * n * n);
    r.x.set(s.x, k * n);
    r.P.set(s.P, k * n * n);
    r.y.set(s.y, k * m);
    r.S.set(s.S, k * mm);
    r.K.set(s.K, k * n * m);
    r.F.set(s.F, k * n * n);
    r.R.set(R, k * mm);
  }
  return r;
}

/** Has P stopped changing, up to rounding? */
function same(P, before) {
  for (let i = 0; i < P.length; i++) if (Math.abs(P[i] - before[i]) > 4e-16 * Math.abs(P[i])) return false;
  return true;
}

/** Run back over a result, so that every estimate knows the later measurements: {x (T n), P (T n n), G}. */
export function rtsSmooth(result) {
  const { T, n } = result, nn = n * n;
  const x = Float64Array.from(result.x), P = Float64Array.from(result.P), G = new Float64Array(Math.max(T - 1, 0) * nn);
  const A = new Float64Array(nn), B = new Float64Array(nn), C = new Float64Array(nn), step = new Float64Array(n);
  for (let k = T - 2; k >= 0; k--) {
    const at = (array, j, size) => array.subarray(j * size, (j + 1) * size);
    A.set(at(result.P_pred, k + 1, nn));
    multiply(at(result.F, k + 1, nn), at(result.P, k, nn), n, n, n, B);
    if (!solve(A, B, n, n)) B.fill(0);                                              // a state known exactly
    const G_k = at(G, k, nn);
    for (let i = 0; i < n; i++) for (let j = 0; j < n; j++) G_k[i * n + j] = B[j * n + i];  // G = P F' P_pred^-1
    for (let i = 0; i < n; i++) step[i] = x[(k + 1) * n + i] - result.x_pred[(k + 1) * n + i];
    multiply(G_k, step, n, n, 1, C);
    for (let i = 0; i < n; i++) x[k * n + i] += C[i];
    for (let i = 0; i < nn; i++) A[i] = P[(k + 1) * nn + i] - result.P_pred[(k + 1) * nn + i];
    multiplyTransposed(multiply(G_k, A, n, n, n, B), G_k, n, n, n, C);
    for (let i = 0; i < nn; i++) P[k * nn + i] += C[i];
    symmetric(at(P, k, nn), n);
  }
  return { x, P, G };
}
