// Small matrices, row by row in a Float64Array: P[i * n + j]. Twin of what the Python rooms take from NumPy.
// The results go into an array that the caller hands over, so that a filter of thousands of steps allocates nothing.

/** A fresh Float64Array of a number, a list or a list of rows. */
export function matrix(value) {
  return Float64Array.from(typeof value === "number" ? [value] : Array.from(value).flat());
}

/** out = A B with A (n, k) and B (k, m). */
export function multiply(A, B, n, k, m, out) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < m; j++) {
      let sum = 0;
      for (let l = 0; l < k; l++) sum += A[i * k + l] * B[l * m + j];
      out[i * m + j] = sum;
    }
  }
  return out;
}

/** out = A B' with A (n, k) and B (m, k). */
export function multiplyTransposed(A, B, n, k, m, out) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < m; j++) {
      let sum = 0;
      for (let l = 0; l < k; l++) sum += A[i * k + l] * B[j * k + l];
      out[i * m + j] = sum;
    }
  }
  return out;
}

/** Make P (n, n) exactly symmetric, in place: (P + P') / 2. */
export function symmetric(P, n) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < i; j++) P[i * n + j] = P[j * n + i] = (P[i * n + j] + P[j * n + i]) / 2;
  }
  return P;
}

/**
 * Solve A X = B by elimination with row exchanges: A (n, n), B (n, m); B becomes X, A is used up.
 * false: A is singular, B is then worthless.
 */
export function solve(A, B, n, m) {
  for (let column = 0; column < n; column++) {
    let pivot = column;
    for (let i = column + 1; i < n; i++) if (Math.abs(A[i * n + column]) > Math.abs(A[pivot * n + column])) pivot = i;
    if (!(Math.abs(A[pivot * n + column]) > 0)) return false;
    if (pivot !== column) {
      swap(A, n, pivot, column);
      swap(B, m, pivot, column);
    }
    for (let i = column + 1; i < n; i++) {
      const factor = A[i * n + column] / A[column * n + column];
      if (factor === 0) continue;
      for (let j = column; j < n; j++) A[i * n + j] -= factor * A[column * n + j];
      for (let j = 0; j < m; j++) B[i * m + j] -= factor * B[column * m + j];
    }
  }
  for (let i = n - 1; i >= 0; i--) {
    for (let j = 0; j < m; j++) {
      let sum = B[i * m + j];
      for (let l = i + 1; l < n; l++) sum -= A[i * n + l] * B[l * m + j];
      B[i * m + j] = sum / A[i * n + i];
    }
  }
  return true;
}

function swap(A, width, i, j) {
  for (let l = 0; l < width; l++) [A[i * width + l], A[j * width + l]] = [A[j * width + l], A[i * width + l]];
}

/**
 * The x for which the sum of squares of A x - b is least, A given as its columns (which are used up); null: not unique.
 * Turns the columns against each other until they are orthogonal (one-sided Jacobi): no digit is lost in a product A' A.
 */
export function leastSquares(columns, b) {
  const n = columns.length, V = columns.map((_, i) => Float64Array.from(columns, (_, j) => Number(i === j)));
  const dot = (p, q) => { let sum = 0; for (let k = 0; k < p.length; k++) sum += p[k] * q[k]; return sum; };
  const turn = (p, q, c, s) => { for (let k = 0; k < p.length; k++) [p[k], q[k]] = [c * p[k] - s * q[k], s * p[k] + c * q[k]]; };
  for (let sweep = 0, turned = true; turned && sweep < 40; sweep++) {
    turned = false;
    for (let i = 0; i < n; i++) {
      for (let j = i + 1; j < n; j++) {
        const pp = dot(columns[i], columns[i]), qq = dot(columns[j], columns[j]), pq = dot(columns[i], columns[j]);
        if (!(Math.abs(pq) > 1e-15 * Math.sqrt(pp * qq))) continue;
        const half = (qq - pp) / (2 * pq), tangent = (half < 0 ? -1 : 1) / (Math.abs(half) + Math.hypot(1, half)), c = 1 / Math.hypot(1, tangent);
        for (const of of [columns, V]) turn(of[i], of[j], c, c * tangent);
        turned = true;
      }
    }
  }
  const squares = columns.map(column => dot(column, column)), most = Math.max(...squares);
  if (!squares.every(square => Math.sqrt(square) > 2.22e-16 * Math.max(b.length, n) * Math.sqrt(most))) return null;
  const x = new Float64Array(n);
  columns.forEach((column, i) => { const share = dot(column, b) / squares[i]; for (let j = 0; j < n; j++) x[j] += share * V[i][j]; });
  return x;
}

/** Lower triangle L (n, n) with L L' = P, for a covariance that may be singular (a column without variance is 0). */
export function cholesky(P, n) {
  const L = new Float64Array(n * n);
  for (let j = 0; j < n; j++) {
    let rest = P[j * n + j];
    for (let l = 0; l < j; l++) rest -= L[j * n + l] ** 2;
    if (!(rest > 1e-15 * P[j * n + j])) continue;
    L[j * n + j] = Math.sqrt(rest);
    for (let i = j + 1; i < n; i++) {
      let sum = P[i * n + j];
      for (let l = 0; l < j; l++) sum -= L[i * n + l] * L[j * n + l];
      L[i * n + j] = sum / L[j * n + j];
    }
  }
  return L;
}

/** Half-axes and tilt of the ellipse of one standard deviation of [[a, b], [b, d]]: {major, minor, angle}. */
export function ellipse(a, b, d) {
  const middle = (a + d) / 2, reach = Math.hypot((a - d) / 2, b);
  return {
    major: Math.sqrt(Math.max(middle + reach, 0)), minor: Math.sqrt(Math.max(middle - reach, 0)),
    angle: Math.atan2(2 * b, a - d) / 2,
  };
}
