// Small matrices, row by row in a Float64Array: P[i * n + j]. Twin of what the Python rooms take from NumPy.
// The results go into an array that the caller hands over, so that a filter of thousands of steps allocates
// nothing.

/** A fresh Float64Array of a number, a list or a list of rows. */
export function matrix(value) {
  const rows = typeof value === "number" ? [value] : Array.from(value);
  return Float64Array.from(rows.flat());
}

/** out = A B with A (n, k) and B (k, m). */
export function multiply(A, B, n, k, m, out) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < m; j++) {
      let sum = 0;
      for (let l = 0; l < k; l++) {
        sum += A[i * k + l] * B[l * m + j];
      }
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
      for (let l = 0; l < k; l++) {
        sum += A[i * k + l] * B[j * k + l];
      }
      out[i * m + j] = sum;
    }
  }
  return out;
}

/** out = A' with A (n, m). */
export function transpose(A, n, m, out) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < m; j++) {
      out[j * n + i] = A[i * m + j];
    }
  }
  return out;
}

/** a += b, element by element. */
export function addTo(a, b) {
  for (let i = 0; i < a.length; i++) {
    a[i] += b[i];
  }
  return a;
}

/** Make P (n, n) exactly symmetric, in place: (P + P') / 2. */
export function symmetric(P, n) {
  for (let i = 0; i < n; i++) {
    for (let j = 0; j < i; j++) {
      const mean = (P[i * n + j] + P[j * n + i]) / 2;
      P[i * n + j] = mean;
      P[j * n + i] = mean;
    }
  }
  return P;
}

/**
 * Solve A X = B by elimination with row exchanges: A (n, n), B (n, m); B becomes X, A is used up.
 * false: A is singular, B is then worthless.
 */
export function solve(A, B, n, m) {
  for (let column = 0; column < n; column++) {
    const pivot = largestBelow(A, n, column);
    if (!(Math.abs(A[pivot * n + column]) > 0)) {
      return false;
    }
    if (pivot !== column) {
      swapRows(A, n, pivot, column);
      swapRows(B, m, pivot, column);
    }
    eliminateBelow(A, B, n, m, column);
  }
  substituteBack(A, B, n, m);
  return true;
}

/** The row, from the diagonal downwards, that holds the largest number of this column. */
function largestBelow(A, n, column) {
  let pivot = column;
  for (let i = column + 1; i < n; i++) {
    if (Math.abs(A[i * n + column]) > Math.abs(A[pivot * n + column])) {
      pivot = i;
    }
  }
  return pivot;
}

function swapRows(A, width, i, j) {
  for (let l = 0; l < width; l++) {
    const kept = A[i * width + l];
    A[i * width + l] = A[j * width + l];
    A[j * width + l] = kept;
  }
}

/** Subtract the row of the diagonal from those below it, so that only zeros stay below. */
function eliminateBelow(A, B, n, m, column) {
  for (let i = column + 1; i < n; i++) {
    const factor = A[i * n + column] / A[column * n + column];
    if (factor === 0) {
      continue;
    }
    for (let j = column; j < n; j++) {
      A[i * n + j] -= factor * A[column * n + j];
    }
    for (let j = 0; j < m; j++) {
      B[i * m + j] -= factor * B[column * m + j];
    }
  }
}

/** A is an upper triangle: from the last row upwards each unknown follows from those below it. */
function substituteBack(A, B, n, m) {
  for (let i = n - 1; i >= 0; i--) {
    for (let j = 0; j < m; j++) {
      let sum = B[i * m + j];
      for (let l = i + 1; l < n; l++) {
        sum -= A[i * n + l] * B[l * m + j];
      }
      B[i * m + j] = sum / A[i * n + i];
    }
  }
}

/**
 * Lower triangle L (n, n) with L L' = P, for a covariance that may be singular (a column without variance is
 * 0).
 */
export function cholesky(P, n) {
  const L = new Float64Array(n * n);
  for (let j = 0; j < n; j++) {
    let rest = P[j * n + j];
    for (let l = 0; l < j; l++) {
      rest -= L[j * n + l] ** 2;
    }
    if (!(rest > 1e-15 * P[j * n + j])) {
      continue;
    }
    L[j * n + j] = Math.sqrt(rest);
    for (let i = j + 1; i < n; i++) {
      let sum = P[i * n + j];
      for (let l = 0; l < j; l++) {
        sum -= L[i * n + l] * L[j * n + l];
      }
      L[i * n + j] = sum / L[j * n + j];
    }
  }
  return L;
}

/** What belongs to step k of an array that holds `size` numbers for every step. */
export function row(array, k, size) {
  return array.subarray(k * size, (k + 1) * size);
}
