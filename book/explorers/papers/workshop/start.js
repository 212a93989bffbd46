// x0 and P0 as a reader types them: where the filter starts, if it is not the first measurement.
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { cholesky, multiplyTransposed } from "../../numerics/linalg.js";
import { readMatrix } from "./matrices.js";
import { START } from "./mistakes.js";

const MOST = 1e15;
const ROUNDING = 1e-9; // of a correlation

/** {x0 (n), P0 (n n)} of a state with n entries; null: the reader left it empty. */
export function readStart({ first_x, first_P }, n) {
  return {
    x0: isEmpty(first_x) ? null : readState(first_x, n),
    P0: isEmpty(first_P) ? null : readP0(first_P, n),
  };
}

function isEmpty(text) {
  return !text?.trim();
}

/** A row or a column, or a number a line. */
function readState(text, n) {
  const values = rowsOf("x₀", text).flat();
  if (values.length !== n) {
    throw wrong(START.count, { name: "x₀", has: String(values.length), n: String(n) });
  }
  return Float64Array.from(values);
}

/** The variances as a row or a column, or the whole matrix. */
function readP0(text, n) {
  const rows = rowsOf("P₀", text);
  const width = rows[0].length;
  const isWhole = rows.length === n && width === n;
  const isList = (rows.length === 1 || width === 1) && rows.length * width === n;
  if (!isWhole && !isList) {
    throw wrong(START.shape, { name: "P₀", n: String(n) });
  }
  const P0 = new Float64Array(n * n);
  rows.flat().forEach((value, i) => {
    P0[isWhole ? i : i * (n + 1)] = value;
  });
  checkCovariance(P0, n);
  return P0;
}

function rowsOf(name, text) {
  const rows = readMatrix(name, text);
  if (rows.flat().some((value) => Math.abs(value) > MOST)) {
    throw wrong(START.large, { name, most: MOST });
  }
  return rows;
}

/** As checks/covariances.py does: in units of the standard deviations, so that mixed units do no harm. */
function checkCovariance(P0, n) {
  const sigma = Array.from({ length: n }, (_, i) => Math.sqrt(Math.abs(P0[i * n + i])) || 1);
  const C = P0.map((value, at) => value / sigma[Math.floor(at / n)] / sigma[at % n]);
  for (let i = 0; i < n; i++) {
    if (C[i * n + i] < 0) {
      throw wrong(START.negative, { name: "P₀" });
    }
    for (let j = 0; j < i; j++) {
      if (Math.abs(C[i * n + j] - C[j * n + i]) > ROUNDING) {
        throw wrong(START.symmetric, { name: "P₀", i: String(j + 1), j: String(i + 1) });
      }
    }
  }
  const L = cholesky(C, n);
  const again = multiplyTransposed(L, L, n, n, n, new Float64Array(n * n));
  if (again.some((value, at) => !(Math.abs(value - C[at]) <= ROUNDING * n))) {
    throw wrong(START.correlation, { name: "P₀" });
  }
}

function wrong(words, values) {
  return new InputError(inBoth(words, values));
}
