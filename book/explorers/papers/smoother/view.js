// The first explorer of chapter 2: the paper's form, with data of the reader's own.
import { ownControls } from "../../own/data.js";
import { InputError } from "../../language/input.js";
import { inBoth } from "../../language/speaker.js";
import { rmse } from "../../numerics/metrics.js";
import { PAPER, isOwn, load, settingsFor } from "./data.js";
import { LOOK_ALIKES, R_from_steady, equal_window, exponential, lag, maximum_likelihood } from "./model.js";
import { moving_average, roughness, run, smoothed, steady_gain } from "./model.js";
import { question } from "./questions.js";
import {
  DEVIATION_PLOT,
  GAIN_PLOT,
  counted,
  drawDeviation,
  drawGain,
  formTable,
  labelOf,
  nameOf,
} from "./shared.js";
import { buttons } from "./take.js";
import { CONTROLS, FACTS, MEASUREMENTS, NAMES, OUTCOME, SOURCES, STRETCH } from "./words.js";

const LIKELIHOOD_POINTS = 5000; // so many values tell Q and R well enough
const LONGEST_QUOTE = 40; // letters of what was typed in a message
const LEAST_VARIANCE = 1e-12; // the range of Params
const LARGEST_VARIANCE = 1e6;
const LARGEST_P0 = 1e9;
const VAGUE = 1e6; // P0 / R, where nothing is known yet

function compute(s, memo) {
  const data = load(s, memo);
  const { z, truth } = data;
  const p = startsAtFirst(s) ? { ...s, ...startAt(z, s.R) } : s;
  memo.result = run(p, data, memo.result);
  const { result } = memo;
  if (memo.k?.length !== z.length) {
    memo.k = counted(z.length);
  }
  const K = steady_gain(s.Q / s.R);
  const smooth = smoothed(result, s.Q);
  const lines = { x: result.x, average: moving_average(z, s.window) };
  if (s.exponential) {
    lines.exponential = exponential(z, K);
  }
  if (s.rts) {
    lines.smooth = smooth.x;
  }
  const root = result.P.map(Math.sqrt);
  return { data, p, z, truth, result, smooth, K, lines, k: memo.k, root, lags: {} };
}

/** The lags, for which a long series takes a while. */
function* refine(r) {
  const reference = r.truth ?? r.smooth.x;
  for (const [name, line] of Object.entries(r.lines)) {
    r.lags[name] = lag(line, reference);
    yield;
  }
}

/** The look of every line, in the order in which they are drawn. */
const LOOKS = { average: "rival", smooth: "smooth", x: "estimate", exponential: "quiet" };

function drawMeasurements(r, s) {
  const names = Object.keys(LOOKS).filter((name) => r.lines[name]);
  const lines = names.map((name) => ({
    look: LOOKS[name],
    x: r.k,
    y: r.lines[name],
    label: labelOf(name, s),
  }));
  return {
    layers: [
      { look: "measurement", x: r.k, y: r.z, label: "z" },
      r.truth && { look: "truth", x: r.k, y: r.truth, label: "x_true" },
      ...lines,
      ...(s.stretch ?? []).map((at) => ({ look: "quiet", at })),
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const measure = (line) => (r.truth ? rmse(r.truth, line)[0] : roughness(line));
  const measures = { z: measure(r.z), x: measure(r.lines.x), average: measure(r.lines.average) };
  const sentences = [
    t.say(OUTCOME.shown, { n: String(r.z.length), what: t.say(r.data.note) }),
    ...(startsAtFirst(s) ? [t.say(OUTCOME.first, { x0: r.p.x0 })] : []),
    t.say(OUTCOME.gain, { K: r.K, window: equal_window(r.K) }),
    t.say(r.truth ? OUTCOME.rmse : OUTCOME.rough, measures),
  ];
  const isLikely = s.likely?.[0] === s.Q && s.likely[1] === s.R;
  if (isLikely && r.z.length > LIKELIHOOD_POINTS) {
    sentences.push(t.say(OUTCOME.cut, { n: String(LIKELIHOOD_POINTS) }));
  }
  return sentences.join(" ");
}

function facts(r, s, t) {
  const behind = r.truth ? FACTS.behind_truth : FACTS.behind_smooth;
  const head = [t.say(FACTS.method), t.say(FACTS.rough), t.say(behind)];
  const rows = Object.entries(r.lines).map(([name, line]) => {
    const words = name === "average" ? `${nameOf(name, t)} (${s.window})` : nameOf(name, t);
    const values = [roughness(line), r.lags[name] ?? NaN];
    if (r.truth) {
      values.push(rmse(r.truth, line)[0]);
    }
    return [words, ...values.map((value) => t.decimal(value))];
  });
  return { head: r.truth ? [...head, "RMSE"] : head, rows };
}

// --- controls ----------------------------------------------------------------------------------------------

/** The most likely Q and R; the likelihood starts at the first value, before which nothing is known. */
function mostLikely(s, r) {
  const [Q, R] = maximum_likelihood(r.z.subarray(0, LIKELIHOOD_POINTS)).map(asSetting);
  return { Q, R, ...startAt(r.z, R), likely: [Q, R] };
}

/** The first value starts the filter, and counts once: nothing is known before it. */
function startAt(z, R) {
  const first = z.find((value) => !Number.isNaN(value));
  return { x0: first, P0: Math.min(VAGUE * R, LARGEST_P0) };
}

function startsAtFirst(s) {
  return isOwn(s) && s.first;
}

/** A variance that was found, as the fields can hold it. */
function asSetting(variance) {
  return Number(Math.min(Math.max(variance, LEAST_VARIANCE), LARGEST_VARIANCE).toPrecision(6));
}

/** "5-16": R as the variance of these values, in which nothing but noise should move. */
function stretchOf(text, s, r) {
  const found = /^\s*(\d+)\s*[-–—\u2212\s]\s*(\d+)\s*$/.exec(text);
  if (!found) {
    throw new InputError(inBoth(STRETCH.unclear, { text: text.trim().slice(0, LONGEST_QUOTE) }));
  }
  const stretch = [Number(found[1]), Number(found[2])];
  const values = r.z.subarray(stretch[0] - 1, stretch[1]);
  if (values.filter((value) => !Number.isNaN(value)).length < 2) {
    throw new InputError(STRETCH.too_short);
  }
  return { R: asSetting(R_from_steady(values)), stretch };
}

const newNoise = { ...CONTROLS.noise, set: (s) => ({ seed: s.seed + 1 }) };

const controls = [
  {
    kind: "select",
    name: "source",
    default: "paper",
    ...CONTROLS.source,
    options: Object.entries(SOURCES),
    also: settingsFor,
  },
  ...ownControls({ words: CONTROLS, visible: isOwn, also: { source: "own" } }),
  {
    kind: "entry",
    ...CONTROLS.stretch,
    inputMode: "text",
    button: CONTROLS.take_R,
    enter: stretchOf,
  },
  { name: "Q", symbol: "Q" },
  { name: "R", symbol: "R" },
  { kind: "check", name: "first", default: true, ...CONTROLS.first, visible: isOwn },
  { name: "P0", symbol: "P_0", visible: (s) => !startsAtFirst(s) },
  { name: "x0", symbol: "x_0", field: true, visible: (s) => !startsAtFirst(s) },
  { name: "window", symbol: "n", max: 50 },
  { kind: "check", name: "exponential", default: false, ...CONTROLS.exponential },
  { kind: "check", name: "rts", default: false, ...CONTROLS.rts },
  { kind: "buttons", visible: (s) => s.source in LOOK_ALIKES, items: [newNoise] },
  { kind: "buttons", items: [{ ...CONTROLS.likely, set: mostLikely }, ...buttons] },
];

export const form = {
  name: NAMES.form,
  start: { ...PAPER, likely: null, stretch: null },
  controls,
  compute,
  refine,
  plots: [
    { ...MEASUREMENTS, xlabel: "k", height: 230, draw: drawMeasurements },
    { ...GAIN_PLOT, draw: drawGain },
    { ...DEVIATION_PLOT, draw: drawDeviation },
  ],
  outcome,
  facts,
  numbers: formTable,
  question,
};
