// How good is an estimate, and does the filter know how good it is? Twin of kalman_lib/metrics.py.
import { solve } from "./linalg.js";

/** Root mean square error over time of x (T n) against x_true (T n): Float64Array (n). */
export function rmse(x_true, x, n = 1) {
  const sum = new Float64Array(n), T = x.length / n;
  for (let i = 0; i < x.length; i++) sum[i % n] += (x_true[i] - x[i]) ** 2;
  return sum.map(value => Math.sqrt(value / T));
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

function quadratic(e, P, n) {
  const T = e.length / n, out = new Float64Array(T), A = new Float64Array(n * n), b = new Float64Array(n);
  for (let k = 0; k < T; k++) {
    A.set(P.subarray(k * n * n, (k + 1) * n * n));
    b.set(e.subarray(k * n, (k + 1) * n));
    solve(A, b, n, 1);
    for (let i = 0; i < n; i++) out[k] += e[k * n + i] * b[i];
  }
  return out;
}

/** Mean of an array without its NaN. */
export function mean(values) {
  let sum = 0, count = 0;
  for (const value of values) if (value === value) { sum += value; count++; }
  return sum / count;
}

const kept = new Map();

/** [low, high] between which the mean of `runs` independent NEES or NIS values lies with that probability. */
export function chi2Bounds(dof, runs = 1, probability = 0.95) {
  const key = `${dof} ${runs} ${probability}`;
  if (!kept.has(key)) {
    const tail = (1 - probability) / 2;
    kept.set(key, [tail, 1 - tail].map(p => chi2Quantile(p, dof * runs) / runs));
  }
  return kept.get(key);
}

/** The value below which a chi-square variable with dof degrees of freedom lies with probability p. */
export function chi2Quantile(p, dof) {
  if (!(p > 0 && p < 1 && dof > 0)) throw new Error(`p = ${p} and dof = ${dof}: expected 0 < p < 1 and dof > 0`);
  let low = 0, high = dof + 10 * Math.sqrt(2 * dof);
  while (chi2Cdf(high, dof) < p) high *= 2;
  while (high - low > 1e-13 * high) {
    const middle = (low + high) / 2;
    if (chi2Cdf(middle, dof) < p) low = middle; else high = middle;
  }
  return (low + high) / 2;
}

/** Probability that a chi-square variable stays below value: series below the mean, continued fraction above it. */
export function chi2Cdf(value, dof) {
  const a = dof / 2, x = value / 2;
  if (x <= 0) return 0;
  const front = Math.exp(a * Math.log(x) - x - logGamma(a));
  if (x < a + 1) {
    let term = 1 / a, total = term;
    for (let k = a + 1; term > 1e-17 * total; k++) total += term *= x / k;
    return front * total;
  }
  let b = x + 1 - a, c = 1e300, d = 1 / b, fraction = d;
  for (let i = 1; i < 100000; i++) {
    b += 2;
    d = 1 / (b + i * (a - i) * d);
    c = b + i * (a - i) / c;
    fraction *= c * d;
    if (Math.abs(c * d - 1) < 1e-15) break;
  }
  return 1 - front * fraction;
}

/** Logarithm of the gamma function for a > 0: Stirling's series, from 10 on exact to rounding. */
export function logGamma(a) {
  let shift = 0;
  while (a < 10) shift -= Math.log(a++);
  const b = 1 / (a * a);
  const series = (1 / 12 - b * (1 / 360 - b * (1 / 1260 - b * (1 / 1680 - b * (1 / 1188 - b * (691 / 360360 - b / 156)))))) / a;
  return shift + (a - 0.5) * Math.log(a) - a + Math.log(2 * Math.PI) / 2 + series;
}
