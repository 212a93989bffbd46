// The view that begins chapter 2: the reader draws a path, and the filter and a moving average run after it.
import { rmse } from "../../numerics/metrics.js";
import { generator } from "../../numerics/random.js";
import { equal_window, lag, moving_average, run, steady_gain } from "./model.js";
import { PATHS, path_of } from "./paths.js";
import { counted, numbers } from "./shared.js";
import { DRAW, DRAWN, NAMES, PATH_NAMES } from "./words.js";

const SIGMA = 0.8; // of the dots
const YLIM = [0, 10];
const LONGEST_WINDOW = 40;
const LONGEST_LAG = 30; // steps that are tried

/** What the filter believes; it knows nothing before the first dot. */
export function settings({ q }) {
  return { Q: q * SIGMA ** 2, R: SIGMA ** 2, x0: 5, P0: 1000 };
}

function compute(s, memo) {
  const truth = s.path ?? path_of(s.shape === "own" ? "mixed" : s.shape);
  if (memo.seed !== s.seed) {
    const rng = generator(s.seed);
    memo.noise = truth.map(() => SIGMA * rng.normal());
    memo.seed = s.seed;
  }
  const z = truth.map((value, k) => value + memo.noise[k]);
  const result = run(settings(s), { z });
  const lines = s.average ? { average: moving_average(z, s.window) } : {};
  return { truth, z, result, lines, k: counted(z.length), K: steady_gain(s.q) };
}

// --- the figure --------------------------------------------------------------------------------------------

function draw(r, s) {
  const { average } = r.lines;
  return {
    xlim: [1, r.k.length],
    ylim: YLIM,
    layers: [
      { look: "measurement", x: r.k, y: r.z, label: "z" },
      { look: "truth", x: r.k, y: r.truth, label: DRAW.path_label },
      average && { look: "rival", x: r.k, y: average, label: `MA(${s.window})` },
      { look: "estimate", x: r.k, y: r.result.x, label: DRAW.filter_label },
    ],
  };
}

/** The path goes through the pointer, and straight from where the hand was a moment ago. */
function drag(x, y, s, { truth }, hand) {
  const at = Math.min(Math.max(Math.round(x), 1), truth.length) - 1;
  const height = Math.min(Math.max(y, YLIM[0]), YLIM[1]);
  const from = hand.at ?? at;
  const before = hand.height ?? height;
  const path = Float64Array.from(s.path ?? truth);
  const way = Math.abs(at - from);
  for (let i = 0; i <= way; i++) {
    const share = way === 0 ? 1 : i / way;
    const k = from + Math.sign(at - from) * i;
    path[k] = before + share * (height - before);
  }
  Object.assign(hand, { at, height });
  return { path, shape: "own" };
}

// --- words and numbers -------------------------------------------------------------------------------------

/** How far a line is from the path, and how many steps it runs behind; none where the path never moves. */
export function scored(line, truth) {
  return { far: rmse(truth, line)[0], late: Math.max(lag(line, truth, LONGEST_LAG), 0) };
}

function outcome(r, s, t) {
  const filter = scored(r.result.x, r.truth);
  const values = { far: filter.far, late: t.decimal(filter.late, 2), percent: t.decimal(100 * r.K, 2) };
  const flat = Number.isNaN(filter.late);
  const sentences = [t.say(flat ? DRAWN.filter_flat : DRAWN.filter, values)];
  if (r.lines.average) {
    const average = scored(r.lines.average, r.truth);
    const rival = { far: average.far, late: t.decimal(average.late, 2), n: String(s.window) };
    sentences.push(t.say(flat ? DRAWN.average_flat : DRAWN.average, rival));
  }
  return sentences.join(" ");
}

/** The moving average that suppresses the noise as much as the filter. */
function sameSmoothness({ q }) {
  const n = Math.round(equal_window(steady_gain(q)));
  return { window: Math.min(Math.max(n, 1), LONGEST_WINDOW), average: true };
}

const shapes = [...Object.keys(PATHS), "own"].map((name) => [name, PATH_NAMES[name]]);

export const drawing = {
  name: NAMES.draw,
  start: { path: null, window: 12 },
  controls: [
    {
      name: "q",
      symbol: "Q/R",
      ...DRAW.trust,
      unit: "",
      min: 1e-4,
      max: 10,
      step: 0.1,
      log: true,
      default: 0.1,
    },
    { kind: "check", name: "average", default: true, ...DRAW.average },
    { name: "window", symbol: "n", ...DRAW.window, max: LONGEST_WINDOW, visible: (s) => s.average },
    {
      kind: "select",
      name: "shape",
      default: "mixed",
      ...DRAW.shape,
      options: shapes,
      also: () => ({ path: null }),
    },
    { kind: "buttons", items: [{ ...DRAW.same, set: sameSmoothness }] },
  ],
  noise: true,
  compute,
  plots: [{ ...DRAW.plot, xlabel: "k", height: 230, drag, draw }],
  outcome,
  numbers,
};
