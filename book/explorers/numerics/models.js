// What a filter has to know about the world: twin of kalman_lib/models.py. Matrices row by row in
// Float64Arrays.
import { matrix, multiply } from "./linalg.js";

/** y = z - z_pred, the residual of a measurement that is no angle. */
function subtract(z, z_pred, y) {
  for (let i = 0; i < y.length; i++) {
    y[i] = z[i] - z_pred[i];
  }
}

/**
 * x = F x + B u + w, z = H x + v. F, H, Q, R, P0, B are numbers, lists or lists of rows; x0 a number or a
 * list. R may also hold one matrix per step, one after the other.
 */
export function linearModel({ F, H, Q, R, x0, P0, B = null, residual = subtract }) {
  const model = { F: matrix(F), H: matrix(H), residual, linear: true, ...noise({ Q, R, x0, P0 }) };
  const n = model.x0.length;
  const m = model.H.length / n;
  model.B = B === null ? null : matrix(B);
  const l = model.B ? model.B.length / n : 0;
  Object.assign(model, { n, m, l });
  model.transition = (x, u, x_next, F_out) => {
    multiply(model.F, x, n, n, 1, x_next);
    if (u) {
      addInput(model.B, u, n, l, x_next);
    }
    F_out.set(model.F);
  };
  model.measure = (x, z_pred, H_out) => {
    multiply(model.H, x, m, n, 1, z_pred);
    H_out.set(model.H);
  };
  return model;
}

/** x += B u. */
function addInput(B, u, n, l, x) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < l; j++) {
      x[i] += B[i * l + j] * u[j];
    }
  }
}

/**
 * x = f(x, u) + w, z = h(x) + v: the model of the extended filter. The functions write into their last
 * argument: f(x, u, out n), F(x, u, out n n), h(x, out m), H(x, out m n); l is the length of u.
 */
export function nonlinearModel({ f, F, h, H, Q, R, x0, P0, m = 1, l = 0, residual = subtract }) {
  const model = { m, l, residual, linear: false, ...noise({ Q, R, x0, P0 }) };
  model.n = model.x0.length;
  model.transition = (x, u, x_next, F_out) => {
    f(x, u, x_next);
    F(x, u, F_out);
  };
  model.measure = (x, z_pred, H_out) => {
    h(x, z_pred);
    H(x, H_out);
  };
  return model;
}

function noise({ Q, R, x0, P0 }) {
  return { Q: matrix(Q), R: matrix(R), x0: matrix(x0), P0: matrix(P0) };
}

/** Does the model have an R for every step? */
export function hasNoiseOfSteps({ R, m }) {
  return R.length > m * m;
}

/** R (m, m) of step k. */
export function noiseAt(model, k) {
  const size = model.m * model.m;
  return hasNoiseOfSteps(model) ? model.R.subarray(k * size, (k + 1) * size) : model.R;
}
