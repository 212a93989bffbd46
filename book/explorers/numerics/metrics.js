// How good is an estimate, and does the filter know how good it is? Twin of kalman_lib/metrics.py.
import { solve } from "./linalg.js";

/** Root mean square error over time of x (T n) against x_true (T n): Float64Array (n). */
export function rmse(x_true, x, n = 1) {
  const squares = new Float64Array(n);
  const T = x.length / n;
  for (let i = 0; i < x.length; i++) {
    squares[i % n] += (x_true[i] - x[i]) ** 2;
  }
  return squares.map((sum) => Math.sqrt(sum / T));
}

/** (x_true - x)' P^-1 (x_true - x) of every step: (T). */
export function nees(x_true, x, P, n = 1) {
  const e = x.map((value, i) => x_true[i] - value);
  return quadratic(e, P, n);
}

/** y' S^-1 y of every step: (T), NaN where the measurement is missing. */
export function nis(y, S, m = 1) {
  return quadratic(y, S, m);
}

/** e' P^-1 e of every step, for e (T n) and P (T n n). */
function quadratic(e, P, n) {
  const T = e.length / n;
  const out = new Float64Array(T);
  const P_k = new Float64Array(n * n);
  const solved = new Float64Array(n);
  for (let k = 0; k < T; k++) {
    P_k.set(P.subarray(k * n * n, (k + 1) * n * n));
    solved.set(e.subarray(k * n, (k + 1) * n));
    solve(P_k, solved, n, 1);
    for (let i = 0; i < n; i++) {
      out[k] += e[k * n + i] * solved[i];
    }
  }
  return out;
}

/** Mean of an array without its NaN. */
export function mean(values) {
  let sum = 0;
  let count = 0;
  for (const value of values) {
    if (!Number.isNaN(value)) {
      sum += value;
      count++;
    }
  }
  return sum / count;
}

const known_bounds = new Map(); // the figures ask for the same ones again and again

/** [low, high] between which the mean of `runs` independent NEES or NIS values lies with that probability. */
export function chi2Bounds(dof, runs = 1, probability = 0.95) {
  const key = `${dof} ${runs} ${probability}`;
  if (!known_bounds.has(key)) {
    const tail = (1 - probability) / 2;
    const low = chi2Quantile(tail, dof * runs) / runs;
    const high = chi2Quantile(1 - tail, dof * runs) / runs;
    known_bounds.set(key, [low, high]);
  }
  return known_bounds.get(key);
}

/** The value below which a chi-square variable with dof degrees of freedom lies with probability p. */
export function chi2Quantile(p, dof) {
  if (!(p > 0 && p < 1 && dof > 0)) {
    throw new Error(`p = ${p} and dof = ${dof}: expected 0 < p < 1 and dof > 0`);
  }
  let low = 0;
  let high = dof + 10 * Math.sqrt(2 * dof);
  while (chi2Cdf(high, dof) < p) {
    high *= 2;
  }
  while (high - low > 1e-13 * high) {
    const middle = (low + high) / 2;
    if (chi2Cdf(middle, dof) < p) {
      low = middle;
    } else {
      high = middle;
    }
  }
  return (low + high) / 2;
}

/** Probability that a chi-square variable stays below value. */
export function chi2Cdf(value, dof) {
  const a = dof / 2;
  const x = value / 2;
  if (x <= 0) {
    return 0;
  }
  const front = Math.exp(a * Math.log(x) - x - logGamma(a));
  return x < a + 1 ? front * gammaSeries(a, x) : 1 - front * gammaFraction(a, x);
}

/** The lower incomplete gamma function without its factor, by its series: quick below the mean. */
function gammaSeries(a, x) {
  let term = 1 / a;
  let total = term;
  for (let k = a + 1; term > 1e-17 * total; k++) {
    term *= x / k;
    total += term;
  }
  return total;
}

/** The upper one, by its continued fraction (Lentz's method): quick above the mean. */
function gammaFraction(a, x) {
  let b = x + 1 - a;
  let c = 1e300;
  let d = 1 / b;
  let fraction = d;
  for (let i = 1; i < 100000; i++) {
    b += 2;
    d = 1 / (b + i * (a - i) * d);
    c = b + (i * (a - i)) / c;
    fraction *= c * d;
    if (Math.abs(c * d - 1) < 1e-15) {
      break;
    }
  }
  return fraction;
}

// Stirling's series of log Gamma(a): sum of STIRLING[i] / a^(2 i + 1)
const STIRLING = [1 / 12, -1 / 360, 1 / 1260, -1 / 1680, 1 / 1188, -691 / 360360, 1 / 156];

/** Logarithm of the gamma function for a > 0: Stirling's series, from 10 on exact to rounding. */
export function logGamma(a) {
  let shift = 0;
  while (a < 10) {
    shift -= Math.log(a); // Gamma(a) = Gamma(a + 1) / a
    a++;
  }
  const series = STIRLING.reduceRight((sum, coefficient) => sum / (a * a) + coefficient, 0) / a;
  return shift + (a - 0.5) * Math.log(a) - a + Math.log(2 * Math.PI) / 2 + series;
}
