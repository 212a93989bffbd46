// The filter over the data, with the noise that the reader set or the one that is most likely.
import { climb } from "./fit.js";
import { logLikelihood } from "./filter.js";
import { judge } from "./judge.js";
import { PATTERN, median, modelOf, run } from "./model.js";

export const GATE = 0.999;
const FIT_ROWS = 1000; // so many tell the noise well enough
const ROUNDS = 4; // of a fit, each without what the gate left out in the one before
const SHARE = 0.01; // of Q and R, where the search begins

/** The Params of the filter: those of the reader, where its data starts it, and what was found. */
export function paramsFor(s, data, found) {
  return { ...s, x0: data.x0, P0: data.P0, ...(s.likely ? found?.values : null) };
}

/** Everything that depends on the noise. */
export function evaluate(s, data, found) {
  const p = paramsFor(s, data, found);
  const result = run(p, data, s.gate ? GATE : 0);
  return { p, result, judged: judge(result) };
}

/** Which noises are sought: q, R and, with two sensors, R2. */
function soughtNames({ pattern }, m) {
  const noises = m > 1 ? ["R", "R2"] : ["R"];
  return pattern === PATTERN.CONSTANT ? noises : ["q", ...noises];
}

/**
 * The most likely noise of the data: {values, none, result, judged}, where none names what may as well be
 * zero. With a gate, what it leaves out does not count. A generator: it yields at every likelihood.
 */
export function* mostLikely(s, data) {
  const cut = firstRows(data);
  const names = soughtNames(s, data.m);
  let { z } = cut;
  let v = startOf(s, cut, names);
  let found = null;
  for (let round = 0; round < ROUNDS; round++) {
    const height = (w) => logLikelihood(modelOf(asParams(s, data, names, w), cut), z, cut.u);
    found = yield* climb(height, v);
    const p = asParams(s, data, names, found.v);
    const gated = s.gate ? run(p, cut, GATE).gated : [];
    const next = cut.z.map((value, i) => (gated[i] ? NaN : value));
    if (sameGaps(next, z)) {
      break;
    }
    z = next;
    v = found.v;
  }
  const values = Object.fromEntries(names.map((name, i) => [name, Math.exp(found.v[i])]));
  const none = names.filter((_, i) => found.none[i]);
  return { values, none, rows: z.length / data.m, ...evaluate({ ...s, likely: true }, data, { values }) };
}

function asParams(s, { x0, P0 }, names, v) {
  return { ...s, x0, P0, ...Object.fromEntries(names.map((name, i) => [name, Math.exp(v[i])])) };
}

function firstRows(data) {
  const rows = Math.min(data.t.length, FIT_ROWS);
  const first = (values, size) => values && values.subarray(0, rows * size);
  return { ...data, z: first(data.z, data.m), u: first(data.u, 1), dt: first(data.dt, 1) };
}

function sameGaps(a, b) {
  return a.every((value, i) => Number.isNaN(value) === Number.isNaN(b[i]));
}

/** Logarithms where the search begins: R from differences of neighbours, q from a small share of it. */
function startOf(s, { z, m, dt }, names) {
  const typical = dt ? median(dt) : s.dt;
  const variances = Array.from({ length: m }, (_, i) => varianceOfSteps(z, m, i));
  const order = { [PATTERN.VELOCITY]: 3, [PATTERN.ACCELERATION]: 5 }[s.pattern] ?? 1;
  const power = s.pattern === PATTERN.OWN ? 0 : order;
  const starts = { q: (SHARE * variances[0]) / typical ** power, R: variances[0], R2: variances[1] };
  return names.map((name) => Math.log(starts[name]));
}

/** Half the mean square of the differences of neighbours; 1 where nothing changes. */
function varianceOfSteps(z, m, i) {
  let sum = 0;
  let count = 0;
  for (let k = i + m; k < z.length; k += m) {
    const step = z[k] - z[k - m];
    if (!Number.isNaN(step)) {
      sum += step * step;
      count++;
    }
  }
  return sum > 0 ? sum / count / 2 : 1;
}
