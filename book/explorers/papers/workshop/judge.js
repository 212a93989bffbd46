// What the innovations say about a filter: are they as large as it states, are they white, and if not, why?
import { chi2Bounds, chi2Cdf, chi2Quantile, mean } from "../../numerics/metrics.js";
import { median } from "./model.js";

const SURE = 0.99; // of the bounds outside which a test fails
const LAGS = 10;
const FAR = 4; // standard deviations: one in 16 000 of a normal variable lies beyond
const HALF = 0.6745; // half of a normal variable lies within so many
const LEAST_USUAL = 0.3; // of sensors that count in steps: half of their innovations say little
const MANY = 0.004; // the share of them that is no chance
const FEW = 2; // nor is more than so many
const MOST = 0.2; // the share of them that are no outliers any more; one disturbs some that follow it

/**
 * {nis, bounds, dof, inside, far, e: one array a sensor, white: [{correlation, band, p}], fits}: the result
 * of a filter, judged by its innovations after the first n steps, in which it settles.
 */
export function judge(result) {
  const { T, n, m, y, S } = result;
  const e = Array.from({ length: m }, () => new Float64Array(T).fill(NaN));
  let total = 0;
  for (let k = n; k < T; k++) {
    total += result.nis[k];
    for (let i = 0; i < m; i++) {
      e[i][k] = y[k * m + i] / Math.sqrt(S[k * m * m + i * m + i]);
    }
  }
  const known = e.flatMap((values) => [...values.filter((value) => !Number.isNaN(value))]);
  const dof = known.length;
  const share = (limit) => known.filter((value) => Math.abs(value) < limit).length / dof;
  const white = e.map((values) => whiteness(values.subarray(n)));
  const nis = total / dof;
  const bounds = dof > 0 ? chi2Bounds(1, dof, SURE) : [NaN, NaN];
  const isWhite = white.every(({ p }) => !(p < 1 - SURE));
  const usual = Math.max(median(known.map(Math.abs)) / HALF, LEAST_USUAL); // whatever the filter says of it
  const far = known.filter((value) => Math.abs(value) >= FAR * usual).length;
  return {
    nis,
    bounds,
    dof,
    e,
    white,
    isWhite,
    inside: share(1.96),
    far: far > FEW && far > MANY * dof && far <= MOST * dof ? far : 0,
    fits: nis > bounds[0] && nis < bounds[1] && isWhite,
  };
}

/** How many of the values are there: a gap is NaN. */
export function countKnown(values) {
  return values.filter((value) => !Number.isNaN(value)).length;
}

/** Is a filter surely less likely than the one with the most likely noise, of so many kinds? */
export function isUnlikely(result, best, kinds) {
  const drop = 2 * (best.log_likelihood - result.log_likelihood);
  return countKnown(result.y) === countKnown(best.y) && drop > chi2Quantile(SURE, kinds);
}

/** Autocorrelation of y (T), and p of the test of Ljung and Box (1978): twin of tuning.whiteness. */
export function whiteness(y) {
  const lags = Math.min(LAGS, Math.max(Math.floor(y.length / 5), 1));
  const middle = mean(y);
  const e = y.map((value) => (Number.isNaN(value) ? 0 : value - middle));
  const seen = y.map((value) => Number(!Number.isNaN(value)));
  const N = dot(seen, seen, 0);
  const square = dot(e, e, 0);
  const correlation = new Float64Array(lags);
  let sum = 0;
  let tested = 0;
  for (let lag = 1; lag <= lags; lag++) {
    const pairs = dot(seen, seen, lag);
    correlation[lag - 1] = pairs > 0 ? dot(e, e, lag) / square : NaN;
    sum += pairs > 0 ? correlation[lag - 1] ** 2 / pairs : 0;
    tested += Number(pairs > 0);
  }
  const p = 1 - chi2Cdf(N * (N + 2) * sum, tested);
  return { correlation, band: 1.959963984540054 / Math.sqrt(N), p };
}

/** The sum of a[k + lag] b[k]. */
function dot(a, b, lag) {
  let sum = 0;
  for (let k = lag; k < a.length; k++) {
    sum += a[k] * b[k - lag];
  }
  return sum;
}
