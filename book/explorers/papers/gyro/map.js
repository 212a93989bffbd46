// The second explorer of chapter 3: what a wrong sigma costs, as two maps over what the filter believes.
import { expected } from "./model.js";
import { mapQuestion } from "./questions.js";
import { compute, manyRuns, study } from "./runs.js";
import { CONTROLS, COST_HEAD, COST_MAP, LABELS, NAMES, NEES_MAP, VERDICT } from "./words.js";

const HALF = 15; // cells from the truth to the edge of a map
const LEVELS = { cost: [1.1, 1.3, 1.6, 2, 2.5, 3], nees: [0.03, 0.1, 0.3, 1, 3, 10, 30] };
const CELLS = Array.from({ length: 2 * HALF + 1 }, (_, k) => k - HALF);
const LEAST = 0.1; // a sigma is believed a tenth to ten times the true one
const MOST = 10;
const APART = 24; // pixels between two numbers on a map
const LEVEL_FONT = 12;

/** How many times the true sigma is believed in cell i = -HALF ... HALF. */
function factor(i) {
  return 10 ** (i / HALF);
}

// --- the numbers of the maps -------------------------------------------------------------------------------

/** One run with what the reader believes, and both maps. */
function compare(s, memo) {
  const believed_w = s.times_w * s.sigma_w;
  const believed_v = s.times_v * s.sigma_v;
  const one = compute({ ...s, other: true, believed_w, believed_v }, memo);
  return { ...one, ...mapsOf(s, memo), wrong: expected(s, believed_w, believed_v) };
}

/** The maps of these settings; memo keeps the last ones. */
function mapsOf(s, memo) {
  const key = [s.sigma_w, s.sigma_v, s.T, s.duration].join();
  if (memo.map?.key !== key) {
    memo.map = { key, ...costs(s) };
  }
  return memo.map;
}

/**
 * cost(i, j) = RMSE / optimum and nees(i, j) of factor(i) sigma_w and factor(j) sigma_v, and steps: how many
 * levels every cell has passed. The gain depends on i - j only, so that one row of filters is enough.
 */
function costs(s) {
  const rows = new Map();
  for (let difference = -2 * HALF; difference <= 2 * HALF; difference++) {
    rows.set(difference, expected(s, factor(difference) * s.sigma_w, s.sigma_v));
  }
  const [best] = rows.get(0);
  const cost = (i, j) => {
    const [rmse] = rows.get(i - j);
    return rmse / best;
  };
  const nees = (i, j) => {
    const [, nees_with_true_v] = rows.get(i - j);
    return nees_with_true_v / factor(j) ** 2;
  };
  return { best, cost, nees, steps: { cost: passed(cost, LEVELS.cost), nees: passed(nees, LEVELS.nees) } };
}

/** How many of the levels every cell has passed, row by row. */
function passed(value, levels) {
  return CELLS.map((j) => CELLS.map((i) => levels.filter((level) => value(i, j) >= level).length));
}

// --- drawing -----------------------------------------------------------------------------------------------

/** A map in steps, each with its number: how dark a cell is tells between which levels its value lies. */
function mapPlot(words, name, paths, where) {
  return {
    ...words,
    ...where,
    xlabel: "rad/s",
    height: 260,
    xlog: true,
    ylog: true,
    handles: (r, s) => [believed(s)],
    drag: (x, y, s) => ({ times_w: inRange(x / s.sigma_w), times_v: inRange(y / s.sigma_v) }),
    draw(r, s, t) {
      const sigma_w = (i) => s.sigma_w * factor(i);
      const sigma_v = (j) => s.sigma_v * factor(j);
      const paint = (ctx, X, Y, colours, size) => {
        const place = (i, j) => [X(sigma_w(i)), Y(sigma_v(j))];
        paintCells(ctx, r.steps[name], place);
        ctx.font = `600 ${LEVEL_FONT * size}px ${colours.font}`;
        paintLevels(ctx, LEVELS[name], paths(r), place, colours, t);
      };
      const ends = [-HALF - 0.5, HALF + 0.5];
      return {
        xlim: ends.map(sigma_w),
        ylim: ends.map(sigma_v),
        layers: [
          { look: "estimate", paint },
          { look: "measurement", mark: believed(s), label: LABELS.belief },
          { look: "truth", mark: [s.sigma_w, s.sigma_v], sign: "+", label: LABELS.truth }, // above the dot
        ],
      };
    },
  };
}

/** The place of what the filter believes. */
function believed(s) {
  return [s.times_w * s.sigma_w, s.times_v * s.sigma_v];
}

function inRange(times) {
  return Number(Math.min(Math.max(times, LEAST), MOST).toPrecision(3));
}

/**
 * Cells side by side that are equally dark are one rectangle; edges lie on whole pixels, or seams would show.
 */
function paintCells(ctx, steps, place) {
  const edges = [-HALF, ...CELLS.map((i) => i + 1)];
  const lefts = edges.map((i) => Math.round(place(i - 0.5, 0)[0]));
  const bottoms = edges.map((j) => Math.round(place(0, j - 0.5)[1]));
  steps.forEach((row, j) => {
    let from = 0;
    for (let i = 0; i < row.length; i++) {
      if (row[i] !== row[i + 1]) {
        ctx.globalAlpha = 0.1 * row[i];
        ctx.fillRect(lefts[from], bottoms[j + 1], lefts[i + 1] - lefts[from], bottoms[j] - bottoms[j + 1]);
        from = i + 1;
      }
    }
  });
  ctx.globalAlpha = 1;
}

/** The levels as numbers along paths {value(i), at(i), from, to}, where the value crosses them. */
function paintLevels(ctx, levels, paths, place, colours, t) {
  ctx.fillStyle = colours.words;
  ctx.textAlign = "center";
  ctx.textBaseline = "middle";
  for (const { value, at, from, to } of paths) {
    let last = [-99, -99];
    for (const level of levels) {
      const i = crossing(value, level, from, to);
      const here = i === null ? last : place(...at(i));
      if (Math.hypot(here[0] - last[0], here[1] - last[1]) >= APART) {
        ctx.fillText(t.decimal(level), ...here);
        last = here;
      }
    }
  }
}

/** Where value(place) crosses the level between two whole places from..to, or null. */
function crossing(value, level, from, to) {
  for (let i = from; i < to; i++) {
    const a = Math.log(value(i) / level);
    const b = Math.log(value(i + 1) / level);
    if (a * b <= 0 && a !== b) {
      return i + a / (a - b);
    }
  }
  return null;
}

/** Over the valley of the cost, from the truth to both sides. */
function acrossValley(r) {
  const value = (i) => r.cost(i, -i);
  const at = (i) => [i, -i];
  return [
    { value, at, from: -HALF, to: 0 },
    { value, at, from: 0, to: HALF },
  ];
}

/** Along the NEES, beside the marks of truth and belief. */
function alongDiagonal(r) {
  const value = (i) => r.nees(i + 3, i - 3);
  return [{ value, at: (i) => [i + 3, i - 3], from: 3 - HALF, to: HALF - 3 }];
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const all = study(r);
  const [rmse, nees] = r.wrong;
  const of_map = {
    w: r.believed.sigma_w,
    v: r.believed.sigma_v,
    true_w: s.sigma_w,
    true_v: s.sigma_v,
    rmse,
    cost: rmse / r.best,
    best: r.best,
    nees,
    word: t.say(verdictOn(nees)),
  };
  const of_runs = { runs: String(r.runs.count), seed: String(s.seed), all: all.rmse, mean: all.nees };
  return `${t.say(VERDICT.map, of_map)} ${t.say(VERDICT.runs, of_runs)}`;
}

function verdictOn(nees) {
  if (nees > 1.1) {
    return VERDICT.sure;
  }
  return nees < 0.9 ? VERDICT.doubtful : VERDICT.honest;
}

/** Five by five places of both maps. */
function numbers(r, s, t) {
  const places = [-HALF, Math.round(-HALF / 2), 0, Math.round(HALF / 2), HALF];
  const pairs = places.flatMap((j) => places.map((i) => [i, j]));
  const rows = pairs.map(([i, j]) => [
    s.sigma_w * factor(i),
    s.sigma_v * factor(j),
    r.cost(i, j),
    r.nees(i, j),
  ]);
  return {
    head: ["σ_w (rad/s)", "σ_v (rad)", t.say(COST_HEAD), "NEES"],
    rows: rows.map((values) => values.map((value) => t.decimal(value))),
  };
}

// --- controls ----------------------------------------------------------------------------------------------

function beliefButton(words, times_w, times_v) {
  const pressed = (s) => s.times_w === times_w && s.times_v === times_v;
  return { ...words, set: { times_w, times_v }, pressed };
}

const never = () => false; // Python and a link may set these; the reader has enough to move

const times = { min: LEAST, max: MOST, step: 0.1, log: true, default: 1, unit: "" };

export const mismatch = {
  name: NAMES.mismatch,
  noise: true,
  controls: [
    {
      kind: "buttons",
      items: [
        beliefButton(CONTROLS.w_tenth, 0.1, 1),
        beliefButton(CONTROLS.w_ten, 10, 1),
        beliefButton(CONTROLS.v_tenth, 1, 0.1),
        beliefButton(CONTROLS.v_ten, 1, 10),
        beliefButton(CONTROLS.truth, 1, 1),
      ],
    },
    { ...times, name: "times_w", symbol: "c_w", ...CONTROLS.times_w },
    { ...times, name: "times_v", symbol: "c_v", ...CONTROLS.times_v },
    { name: "sigma_w", symbol: "σ_w" },
    { name: "sigma_v", symbol: "σ_v" },
    { name: "duration", symbol: "t", visible: never },
    { name: "T", symbol: "T", visible: never },
  ],
  compute: compare,
  refine: manyRuns,
  plots: [
    mapPlot(COST_MAP, "cost", acrossValley, {}),
    mapPlot(NEES_MAP, "nees", alongDiagonal, { after: true }),
  ],
  outcome,
  numbers,
  question: mapQuestion,
};
