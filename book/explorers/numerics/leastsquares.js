// Least squares, as NumPy's lstsq: for the fit of chapter 4.

const SWEEPS = 40; // more than any of our matrices needs
const ORTHOGONAL = 1e-15; // cosine of the angle between two columns
const EPSILON = 2.22e-16; // of a double

/**
 * The x for which the sum of squares of A x - b is least, A given as its columns (which are used up); null:
 * not unique. Turns the columns against each other until they are orthogonal (one-sided Jacobi): no digit is
 * lost in a product A' A.
 */
export function leastSquares(columns, b) {
  const n = columns.length;
  const V = columns.map((_, i) => unit(n, i));
  orthogonalise(columns, V);
  const squares = columns.map((column) => dot(column, column));
  const least = EPSILON * Math.max(b.length, n) * Math.sqrt(Math.max(...squares));
  if (!squares.every((square) => Math.sqrt(square) > least)) {
    return null;
  }
  const x = new Float64Array(n);
  columns.forEach((column, i) => {
    const share = dot(column, b) / squares[i];
    for (let j = 0; j < n; j++) {
      x[j] += share * V[i][j];
    }
  });
  return x;
}

/** Turn every pair of columns until all are orthogonal; V goes along. */
function orthogonalise(columns, V) {
  let turned = true;
  for (let sweep = 0; turned && sweep < SWEEPS; sweep++) {
    turned = false;
    for (let i = 0; i < columns.length; i++) {
      for (let j = i + 1; j < columns.length; j++) {
        turned = turnPair(columns, V, i, j) || turned;
      }
    }
  }
}

/** Turn columns i and j so that they are orthogonal; false: they were. */
function turnPair(columns, V, i, j) {
  const pp = dot(columns[i], columns[i]);
  const qq = dot(columns[j], columns[j]);
  const pq = dot(columns[i], columns[j]);
  if (!(Math.abs(pq) > ORTHOGONAL * Math.sqrt(pp * qq))) {
    return false;
  }
  const half = (qq - pp) / (2 * pq);
  const sign = half < 0 ? -1 : 1;
  const tangent = sign / (Math.abs(half) + Math.hypot(1, half));
  const cosine = 1 / Math.hypot(1, tangent);
  turn(columns[i], columns[j], cosine, cosine * tangent);
  turn(V[i], V[j], cosine, cosine * tangent);
  return true;
}

function turn(p, q, cosine, sine) {
  for (let k = 0; k < p.length; k++) {
    const before = p[k];
    p[k] = cosine * before - sine * q[k];
    q[k] = sine * before + cosine * q[k];
  }
}

function dot(p, q) {
  let sum = 0;
  for (let k = 0; k < p.length; k++) {
    sum += p[k] * q[k];
  }
  return sum;
}

/** Column i of the unit matrix. */
function unit(n, i) {
  const column = new Float64Array(n);
  column[i] = 1;
  return column;
}
