// What the explorer of chapter 7 shows: a filter that the reader builds, and how it judges itself.
import { rmse } from "../../numerics/metrics.js";
import { controls } from "./controls.js";
import { load } from "./data.js";
import { evaluate, mostLikely } from "./estimate.js";
import { band, column, plots } from "./figures.js";
import { countKnown, isUnlikely } from "./judge.js";
import { PATTERN, hasBias, modelOf } from "./model.js";
import { question } from "./questions.js";
import { verdict } from "./verdict.js";
import { FACTS, NAME, OUTCOME } from "./words.js";

const TABLE_ROWS = 500;
const LEAST_SHOWN = 0.001; // a smaller probability is not told in digits
const MOST_MARKS = 200; // of measurements that were left out

function compute(s, memo) {
  const data = load(s, memo);
  const about = [s.gate, data];
  const isKnown = memo.about?.every((value, i) => value === about[i]);
  const r = { data, memo, about };
  return fill(r, s, isKnown ? memo.found : null);
}

/** Everything that is shown, with the most likely noise as soon as it is found. */
function fill(r, s, found) {
  const { data } = r;
  Object.assign(r, { found }, evaluate(s, data, found));
  const { T, m, gated } = r.result;
  r.T = T;
  r.unlikely = found !== null && isUnlikely(r.result, found.result, Object.keys(found.values).length);
  r.z = column(data.z, m, 0);
  r.first = band(r, 0);
  r.average = s.average ? movingAverage(r.z, s.window) : null;
  const left = Array.from(r.z.keys()).filter((k) => gated[k * m]);
  r.left = left.slice(0, MOST_MARKS).map((k) => [data.t[k], r.z[k]]);
  r.lefts = gated.reduce((sum, value) => sum + value, 0);
  return r;
}

/** The most likely noise takes a while. */
function* refine(r, s) {
  if (r.found) {
    return;
  }
  const found = yield* mostLikely(s, r.data);
  Object.assign(r.memo, { found, about: r.about });
  fill(r, s, found);
}

/** Mean of the last `window` values, fewer at the start; gaps left out. */
function movingAverage(z, window) {
  return z.map((_, k) => {
    const recent = z.subarray(Math.max(0, k - window + 1), k + 1).filter((value) => !Number.isNaN(value));
    return recent.reduce((sum, value) => sum + value, 0) / recent.length;
  });
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const sentences = verdict(r, s, t);
  if (r.lefts > 0) {
    const values = { count: String(r.lefts), all: String(countKnown(r.data.z)) };
    sentences.push(t.say(OUTCOME.left, values));
  }
  if (r.found && r.found.rows < r.T && s.likely) {
    sentences.push(t.say(OUTCOME.cut, { rows: String(r.found.rows) }));
  }
  if (r.data.held) {
    sentences.push(t.say(r.data.held));
  }
  if (r.data.truth || s.group === "data") {
    sentences.push(t.say(r.data.note)); // made-up data is always called so
  }
  return sentences.filter(Boolean).join(" ");
}

function facts(r, s, t) {
  const { judged, found, p } = r;
  const [low, high] = judged.bounds.map((bound) => t.decimal(bound, 3));
  const rows = [
    [t.say(FACTS.nis), t.decimal(judged.nis), t.say(FACTS.between, { low, high })],
    [
      t.say(FACTS.inside),
      t.say(FACTS.percent, { share: 100 * judged.inside }),
      t.say(FACTS.percent, { share: 95 }),
    ],
    ...judged.white.map(({ p: probability }, i) => [
      t.say(judged.white.length > 1 ? FACTS.white_of : FACTS.white, { i: String(i + 1) }),
      probability < LEAST_SHOWN ? t.say(FACTS.tiny) : t.decimal(probability, 2),
      t.say(FACTS.above),
    ]),
  ];
  for (const [name, value] of Object.entries(found?.values ?? {})) {
    const likely = found.none.includes(name) ? 0 : value;
    rows.push([{ q: "q", R: "R", R2: "R_2" }[name], t.decimal(p[name]), t.say(FACTS.likely, { likely })]);
  }
  rows.push(...aboutBias(r, t), ...againstTruth(r, t));
  return { head: [t.say(FACTS.test), t.say(FACTS.here), t.say(FACTS.wanted)], rows };
}

/** What the bias has become, and what it is in made-up data. */
function aboutBias(r, t) {
  const { n, T } = r.result;
  if (!hasBias(r.p)) {
    return [];
  }
  const { x, root } = band(r, n - 1);
  const bias = `${t.decimal(x[T - 1])} ± ${t.decimal(2 * root[T - 1], 2)}`;
  return [[t.say(FACTS.bias), bias, r.data.truth ? t.decimal(r.data.truth[T * n - 1]) : ""]];
}

/** For made-up data: how far the estimate is from the truth. */
function againstTruth({ data, first, result, average, z }, t) {
  if (!data.truth) {
    return [];
  }
  const truth = column(data.truth, data.states, 0);
  const known = Array.from(z.keys()).filter((k) => k >= result.n && !Number.isNaN(z[k]));
  const of = (values) => known.map((k) => values[k]);
  const far = (values) => t.decimal(rmse(of(truth), of(values))[0]);
  const rival = average ? t.say(FACTS.average, { far: far(average) }) : t.say(FACTS.sensor, { far: far(z) });
  return [[t.say(FACTS.rmse), far(first.x), rival]];
}

/** The matrices of the last step, which is told where steps are uneven, and where the filter starts. */
function equations(r, s, t) {
  const { n, m, F, H, Q, R } = r.result;
  const { x0, P0 } = modelOf(r.p, r.data);
  const last = F.length - n * n;
  const rows = (values, height, width) =>
    Array.from({ length: height }, (_, i) =>
      Array.from({ length: width }, (_, j) => t.unbroken(values[i * width + j], 3)),
    );
  const Q_last = Q.length > n * n ? Q.subarray(Q.length - n * n) : Q;
  const step = r.data.dt ? [[`Δt = ${t.decimal(r.data.dt.at(-1), 3)}  (k = ${r.T})`]] : [];
  return [
    ...step,
    ["F =", { matrix: rows(F.subarray(last), n, n) }, "Q =", { matrix: rows(Q_last, n, n) }],
    ["H =", { matrix: rows(H, m, n) }, "R =", { matrix: rows(diagonal(R), m, m) }],
    ["x_0 =", { matrix: rows(x0, n, 1) }, "P_0 =", { matrix: rows(P0, n, n) }],
  ];
}

/** The matrix with these variances. */
function diagonal(values) {
  const m = values.length;
  return Float64Array.from({ length: m * m }, (_, i) => (i % (m + 1) === 0 ? values[i % m] : 0));
}

function numbers(r, s, t) {
  const { result, data } = r;
  const { n, m } = result;
  const columns = {
    t: data.t,
    z: r.z,
    ...(m > 1 ? { z_2: column(data.z, m, 1) } : {}),
    ...(data.u ? { u: data.u } : {}),
    x: r.first.x,
    "√P": r.first.root,
    ...(s.pattern >= PATTERN.VELOCITY ? { x_2: column(result.x, n, 1) } : {}),
    y: column(result.y, m, 0),
    "√S": column(result.S, m * m, 0).map(Math.sqrt),
  };
  const skip = Math.max(1, Math.ceil(r.T / TABLE_ROWS));
  const rows = [];
  for (let k = 0; k < r.T; k += skip) {
    rows.push([String(k + 1), ...Object.values(columns).map((values) => t.decimal(values[k], 5))]);
  }
  return { head: ["k", ...Object.keys(columns)], rows };
}

export const builder = {
  name: NAME,
  start: { group: "noise" },
  controls,
  compute,
  refine,
  plots,
  outcome,
  facts,
  equations,
  numbers,
  question,
};
