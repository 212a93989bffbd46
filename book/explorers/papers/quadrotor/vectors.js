// The adaptive method: one filter for all three angles, which compares vectors. Twin of
// kalman_lib/papers/quadrotor/vectors.py, where everything is told.
import { multiply, multiplyTransposed } from "../../numerics/linalg.js";
import { isFullWith, meanOf, moveBlock, noiseOf, startAgain, startBlock, turnBlock } from "./blocks.js";
import { DEG, heading, STEEPEST, tilt } from "./model.js";
import { anglesOf, matrixOf, product, quaternionOf, turnBy, unit } from "./quaternion.js";
import { START } from "./rest.js";
import { mean, totalVariance } from "./statistics.js";

const TILT = { seconds: 1, least: (0.7 * DEG) ** 2, usual: (3 * DEG) ** 2, lasting: (3 * DEG) ** 2 };
const YAW = { seconds: 5, least: (1.5 * DEG) ** 2, usual: (5 * DEG) ** 2, lasting: (5 * DEG) ** 2 };
const UNSURE = [(10 * DEG) ** 2, (10 * DEG) ** 2, (20 * DEG) ** 2];
const USUAL_BIAS = DEG ** 2;
const SCALE = 0.01;
const LEARNS = 60; // s
const PAUSE = 0.3; // s
const NO_INNOVATION = [NaN, NaN, NaN];

/** Filter {t, gyr, acc, mag}; rest: so many samples at rest; store(k, f, y) is called after every step. */
export function filterVectors(recording, rest, step, how, store) {
  const f = startFilter(recording, rest, step, how);
  if (rest > 0) {
    takeAttitude(f, recording, 0, rest);
  } else {
    startBackwards(f, recording, 0);
  }
  store(0, f, [0, 0, 0]);
  run(f, recording, startBackwards, store);
}

/** q, s, P (6, 6) of [e, s], R (3): see the Python twin. */
function startFilter({ t, gyr }, rest, step, how) {
  const f = { how, s: [0, 0, 0], at_rest: [0, 0, 0], P: new Float64Array(36), R: [0, 0, 0] };
  let variance = USUAL_BIAS;
  if (rest > 0 && !how.without.includes("rest mean")) {
    f.at_rest = [0, 1, 2].map((i) => mean(gyr, i, rest));
    variance = totalVariance(gyr, rest) / 3 / (t[rest - 1] - t[0]);
  }
  for (let i = 3; i < 6; i++) {
    f.P[7 * i] = variance;
  }
  f.longest = Math.max(PAUSE, 5 * step);
  f.F = new Float64Array(36);
  f.FP = new Float64Array(36);
  return f;
}

/** Take the attitude from the sensors: from the means of their vectors at the samples from..to-1. */
function takeAttitude(f, { t, gyr, acc, mag }, from, to) {
  setAttitude(f, [1, 0, 0, 0]);
  const sums = [startBlock(TILT, 0), startBlock(YAW, 0)];
  for (let k = from; k < to; k++) {
    if (k > from) {
      const h = t[k] - t[k - 1];
      if (h > f.longest) {
        break;
      }
      turn(f, between(gyr, k), h);
    }
    isFullWith(sums[0], multiplied(f.C, acc, k), 0);
    isFullWith(sums[1], multiplied(f.C, mag, k), 0);
  }
  const [force, field] = sums.map(meanOf); // NaN where a sensor is silent
  const [roll, pitch] = tilt(...force).map(known);
  setAttitude(f, quaternionOf(roll, pitch, known(heading(...field, roll, pitch))));
  f.R = [TILT.usual, TILT.usual, YAW.usual];
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 6; j++) {
      f.P[6 * i + j] = 0;
      f.P[6 * j + i] = 0;
    }
    f.P[7 * i] = UNSURE[i];
  }
  f.tilt = startBlock(TILT, 2);
  f.yaw = startBlock(YAW, 1);
  f.turned = [0, 0, 0];
}

const known = (angle) => (Number.isNaN(angle) ? 0 : angle);

/** Without a rest: filter the first minute after sample `from`, from its end to its beginning. */
function startBackwards(f, recording, from) {
  const back = backwards(recording, from);
  const negative = (values) => values.map((value) => -value);
  f.s = negative(f.s);
  f.at_rest = negative(f.at_rest);
  takeAttitude(f, back, 0, samplesWithin(back.t, 0, START));
  run(f, back, takeStart, () => {});
  f.s = negative(f.s);
  f.at_rest = negative(f.at_rest);
  for (let i = 0; i < 3; i++) {
    for (let j = 3; j < 6; j++) {
      f.P[6 * i + j] *= -1;
      f.P[6 * j + i] *= -1;
    }
  }
  startAgain(f.tilt);
  startAgain(f.yaw);
  f.turned = [0, 0, 0];
}

const takeStart = (f, recording, k) => takeAttitude(f, recording, k, samplesWithin(recording.t, k, START));

/** A minute after sample `from`, the last sample first; it turns the other way. */
function backwards({ t, gyr, acc, mag }, from) {
  const last = samplesWithin(t, from, LEARNS) - 1;
  const count = last - from + 1;
  const turned = (values, sign) =>
    Float64Array.from({ length: 3 * count }, (_, at) => {
      const k = last - Math.floor(at / 3);
      return sign * values[3 * k + (at % 3)];
    });
  return {
    t: Float64Array.from({ length: count }, (_, k) => t[last] - t[last - k]),
    gyr: turned(gyr, -1),
    acc: turned(acc, 1),
    mag: turned(mag, 1),
  };
}

/** The first sample that comes more than `seconds` after sample `from`. */
function samplesWithin(t, from, seconds) {
  let to = from;
  while (to < t.length && t[to] <= t[from] + seconds) {
    to++;
  }
  return to;
}

/** Step by step; afterPause(f, recording, k) starts again at sample k. */
function run(f, recording, afterPause, store) {
  const { t, gyr, acc, mag } = recording;
  for (let k = 1; k < t.length; k++) {
    const h = t[k] - t[k - 1];
    let y = NO_INNOVATION;
    if (h > f.longest) {
      afterPause(f, recording, k);
    } else {
      predict(f, between(gyr, k), h);
      const [roll, pitch] = updateTilt(f, multiplied(f.C, acc, k), h);
      y = [roll, pitch, updateYaw(f, mag, k, h)];
    }
    store(k, f, y);
  }
}

// --- one step ----------------------------------------------------------------------------------------------

function predict(f, rates, h) {
  const { C, F, FP, P, how } = f;
  const turned = multiplied(C, free(f, rates), 0);
  F.fill(0);
  for (let i = 0; i < 3; i++) {
    f.turned[i] += h * turned[i];
  }
  turn(f, rates, h);
  for (let i = 0; i < 6; i++) {
    F[7 * i] = 1;
  }
  for (let i = 0; i < 3; i++) {
    for (let j = 0; j < 3; j++) {
      F[6 * i + 3 + j] = -h * f.C[3 * i + j];
    }
  }
  multiplyTransposed(multiply(F, P, 6, 6, 6, FP), F, 6, 6, 6, P);
  for (let i = 0; i < 3; i++) {
    P[7 * i] += how.q * h;
    P[7 * (i + 3)] += how.q_bias * h;
  }
}

/** At the end of a block: roll and pitch by the mean acceleration -> y (2), else NaN. */
function updateTilt(f, force, h) {
  if (!isFullWith(f.tilt, force, h)) {
    return NO_INNOVATION;
  }
  for (let i = 0; i < 3; i++) {
    f.P[7 * i] += (SCALE * f.turned[i]) ** 2;
  }
  f.turned = [0, 0, 0];
  const [north, east, down] = meanOf(f.tilt);
  const [to_roll, to_pitch] = levelAxes(f);
  const right = to_pitch[0] * north + to_pitch[1] * east;
  const ahead = to_roll[0] * north + to_roll[1] * east;
  const y = [-Math.atan2(right, -down), Math.atan2(ahead, -down)];
  blend(f, f.tilt, y, [to_roll, to_pitch], 0);
  return y;
}

/** At the end of a block: yaw by the mean field -> y, else NaN. */
function updateYaw(f, mag, k, h) {
  if (!isFullWith(f.yaw, multiplied(f.C, mag, k), h)) {
    return NaN;
  }
  const [north, east] = meanOf(f.yaw);
  const y = -Math.atan2(east, north);
  blend(f, f.yaw, [y], [[0, 0, 1]], 2);
  return y;
}

/** The update by the innovations y of turns about some axes; the first is that of angle `first`. */
function blend(f, block, y, axes, first) {
  const moved = new Float64Array(6);
  axes.forEach((axis, i) => {
    const P_H = Array.from({ length: 6 }, (_, row) => dot(axis, f.P, 6 * row));
    const P = dot(axis, P_H);
    f.R[first + i] = noiseOf(block, i, y[i], P);
    const rest = y[i] - dot(axis, moved);
    const S = P + f.R[first + i];
    for (let row = 0; row < 6; row++) {
      moved[row] += (P_H[row] / S) * rest;
      for (let column = 0; column < 6; column++) {
        f.P[6 * row + column] -= (P_H[row] / S) * P_H[column];
      }
    }
  });
  axes.forEach((axis, i) => moveBlock(block, i, dot(axis, moved)));
  turnBlock(f.tilt, moved);
  turnBlock(f.yaw, moved);
  setAttitude(f, product(turnBy(moved[0], moved[1], moved[2]), f.q));
  f.s = f.s.map((value, i) => value + moved[3 + i]);
  startAgain(block);
}

// --- the attitude ------------------------------------------------------------------------------------------

/** Turn by the gyroscope's rates, less their error. */
function turn(f, rates, h) {
  const [x, y, z] = free(f, rates);
  setAttitude(f, product(f.q, turnBy(h * x, h * y, h * z)));
}

const free = ({ at_rest, s }, rates) => rates.map((rate, i) => rate - at_rest[i] - s[i]);

/** The gyroscope's rates in the middle of the step that ends at sample k. */
const between = (gyr, k) => [0, 1, 2].map((i) => (gyr[3 * k + i] + gyr[3 * k + i - 3]) / 2);

function setAttitude(f, q) {
  f.q = unit(q);
  f.C = matrixOf(f.q);
}

/** Axes of roll, pitch and yaw of a level craft that looks the same way, in north-east-down. */
function levelAxes(f) {
  const yaw = anglesOf(f.q)[2];
  const [sin, cos] = [Math.sin(yaw), Math.cos(yaw)];
  return [
    [cos, sin, 0],
    [-sin, cos, 0],
    [0, 0, 1],
  ];
}

/** The angles of the filter, their variances P, and how much more roll there is in a turn. */
export function stateOf(f) {
  const angles = anglesOf(f.q);
  const pitch = Math.max(-STEEPEST, Math.min(STEEPEST, angles[1]));
  const steep = [1 / Math.cos(pitch), 1, 1];
  const axes = levelAxes(f);
  axes[2] = axes[2].map((value, i) => value + Math.tan(pitch) * axes[0][i]);
  const P = axes.map((axis, i) => {
    const P_axis = [0, 1, 2].map((row) => dot(axis, f.P, 6 * row));
    return steep[i] ** 2 * dot(axis, P_axis);
  });
  return { angles, P, steep };
}

/** The matrix C (3, 3) times vector k of a series. */
function multiplied(C, vectors, k) {
  return [0, 1, 2].map(
    (i) => C[3 * i] * vectors[3 * k] + C[3 * i + 1] * vectors[3 * k + 1] + C[3 * i + 2] * vectors[3 * k + 2],
  );
}

function dot([x, y, z], vector, at = 0) {
  return x * vector[at] + y * vector[at + 1] + z * vector[at + 2];
}
