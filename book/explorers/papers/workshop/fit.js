// Maximum likelihood of positive numbers: the smallest twin of Python's tuning.fit. It looks from several
// starts with the simplex of Nelder and Mead (1965), over logarithms, and climbs the rest by Newton's steps.
// All are generators, which yield at every likelihood: the page stays alive meanwhile.
import { solve } from "../../numerics/linalg.js";

const REACH = Math.log(1e12); // a number is sought from start / 1e12 to start * 1e12
const FAR = Math.log(100); // the other starts
const TRIED = 2; // so many of the likeliest starts
const NEAR = 1e-3; // the simplex has found the top
const LONGEST_SEARCH = 300; // likelihoods
const H_SLOPE = 1e-3; // steps of the differences
const H_CURVE = 1e-2;
const FLAT = 1e-6; // a difference of log-likelihood that no data can tell from none

/**
 * The logarithms v at which height(v) is largest, seen from start (k): {v, top, none}, where none says for
 * which of them zero is no less likely.
 */
export function* climb(height, start) {
  const bounded = (v) => (v.every((value, i) => Math.abs(value - start[i]) <= REACH) ? height(v) : -Infinity);
  const starts = yield* likeliest(bounded, start);
  let best = { top: -Infinity, v: start };
  for (const from of starts) {
    const found = yield* simplex(bounded, from);
    best = found.top > best.top ? found : best;
  }
  best = yield* newton(bounded, best);
  const none = [];
  for (let i = 0; i < start.length; i++) {
    const lower = best.v.with(i, start[i] - REACH);
    none.push(height(lower) >= best.top - FLAT);
    yield;
  }
  return { ...best, none };
}

/** The start and those around it in which one number is far larger or smaller: the likeliest of them. */
function* likeliest(height, start) {
  const around = [start];
  for (let i = 0; i < start.length; i++) {
    around.push(start.with(i, start[i] + FAR), start.with(i, start[i] - FAR));
  }
  const heights = new Map();
  for (const v of around) {
    heights.set(v, finite(height(v)));
    yield;
  }
  return around.sort((a, b) => heights.get(b) - heights.get(a)).slice(0, TRIED);
}

function finite(value) {
  return Number.isFinite(value) ? value : -Infinity;
}

/** The simplex of Nelder and Mead: {v, top}. */
function* simplex(height, from) {
  const k = from.length;
  const corners = [];
  for (let i = 0; i <= k; i++) {
    const v = i < k ? from.with(i, from[i] + 1) : from;
    corners.push({ v, top: finite(height(v)) });
    yield;
  }
  const at = (middle, worst, factor) => {
    const v = middle.map((value, i) => value + factor * (worst.v[i] - value));
    return { v, top: finite(height(v)) };
  };
  for (let tries = 0; tries < LONGEST_SEARCH; tries++) {
    corners.sort((a, b) => b.top - a.top);
    const worst = corners[k];
    if (widthOf(corners) < NEAR) {
      break;
    }
    const middle = from.map((_, i) => corners.slice(0, k).reduce((sum, { v }) => sum + v[i], 0) / k);
    const mirrored = at(middle, worst, -1);
    yield;
    corners[k] = moved(mirrored, corners, (factor) => at(middle, worst, factor));
    yield;
    if (corners[k] === worst) {
      shrink(corners, height);
    }
  }
  return corners[0];
}

/** What takes the place of the worst corner: farther, the mirrored one, nearer, or the worst itself. */
function moved(mirrored, corners, at) {
  const worst = corners.at(-1);
  if (mirrored.top > corners[0].top) {
    const farther = at(-2);
    return farther.top > mirrored.top ? farther : mirrored;
  }
  if (mirrored.top > corners.at(-2).top) {
    return mirrored;
  }
  const nearer = at(mirrored.top > worst.top ? -0.5 : 0.5);
  return nearer.top > Math.max(worst.top, mirrored.top) ? nearer : worst;
}

/** All corners half the way to the best. */
function shrink(corners, height) {
  const [best] = corners;
  for (let i = 1; i < corners.length; i++) {
    const v = corners[i].v.map((value, j) => (value + best.v[j]) / 2);
    corners[i] = { v, top: finite(height(v)) };
  }
}

function widthOf(corners) {
  const [best] = corners;
  return Math.max(...corners.map(({ v }) => Math.max(...v.map((value, i) => Math.abs(value - best.v[i])))));
}

/** Newton's steps to the very top, as long as they lead upwards. */
function* newton(height, best) {
  let here = best;
  for (let tries = 0; tries < 6; tries++) {
    const { slope, curvature } = yield* derivatives(height, here);
    const k = slope.length;
    const step = Float64Array.from(slope);
    if (!solve(curvature, step, k, 1)) {
      return here;
    }
    const v = here.v.map((value, i) => value + step[i]);
    const top = finite(height(v));
    yield;
    if (!(top >= here.top - 1e-12 * Math.abs(here.top))) {
      return here;
    }
    here = { v, top };
    if (step.every((value) => Math.abs(value) < 1e-8)) {
      return here;
    }
  }
  return here;
}

/** The slope (k) of the height, and minus its second derivatives (k, k), by central differences. */
function* derivatives(height, { v, top }) {
  const k = v.length;
  const moved = (...moves) => height(moves.reduce((w, [i, h]) => w.with(i, w[i] + h), v));
  const slope = new Float64Array(k);
  const curvature = new Float64Array(k * k);
  for (let i = 0; i < k; i++) {
    slope[i] = (moved([i, H_SLOPE]) - moved([i, -H_SLOPE])) / (2 * H_SLOPE);
    yield;
    const fall = 2 * top - moved([i, H_CURVE]) - moved([i, -H_CURVE]);
    curvature[i * k + i] = fall / H_CURVE ** 2;
    yield;
    for (let j = 0; j < i; j++) {
      const corner = (a, b) => moved([i, a * H_CURVE], [j, b * H_CURVE]);
      const bent = corner(1, 1) - corner(1, -1) - corner(-1, 1) + corner(-1, -1);
      curvature[i * k + j] = -bent / (4 * H_CURVE ** 2);
      curvature[j * k + i] = curvature[i * k + j];
      yield;
    }
  }
  return { slope, curvature };
}
