// The Rauch-Tung-Striebel smoother: twin of rts_smooth in kalman_lib/filters.py.
import { addTo, multiply, multiplyTransposed, row, solve, symmetric, transpose } from "./linalg.js";

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

/**
 * P + G (P of the step after it, smoothed - its P_pred) G', written without a difference of covariances:
 * A P A' + G (P of the step after it, smoothed + Q) G' with A = I - G F.
 */
function smoothCovariance(result, P, k, n, { A, B, C }, G_k) {
  const nn = n * n;
  const P_k = row(P, k, nn);
  multiply(G_k, row(result.F, k + 1, nn), n, n, n, A);
  for (let i = 0; i < nn; i++) {
    const one = i % (n + 1) === 0 ? 1 : 0; // on the diagonal
    A[i] = one - A[i];
  }
  multiply(A, P_k, n, n, n, B);
  multiplyTransposed(B, A, n, n, n, C);
  A.set(row(P, k + 1, nn));
  addTo(A, result.Q);
  multiply(G_k, A, n, n, n, B);
  multiplyTransposed(B, G_k, n, n, n, P_k);
  addTo(P_k, C);
  symmetric(P_k, n);
}
