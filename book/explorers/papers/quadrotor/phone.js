// The view "phone": a phone in the hand, live or synthetic, as gyroscope, accelerometer and filter see it.
import { generator } from "../../numerics/random.js";
import { rmse } from "../../numerics/metrics.js";
import { sensorControl } from "../../sensors/control.js";
import { size } from "./figures.js";
import { AXES } from "./model.js";
import { drawGhosts, drawInstruments } from "./scene.js";
import { SECONDS, shaken } from "./shaken.js";
import { anglesOf, frameOf, opinions } from "./vertical.js";
import { PHONE, SHOWN, TILT, TILT_CONTROLS, CONTROLS } from "./words.js";

const DRAWN = 400; // readings: about one for a pixel
const SHOWN_LIVE = 20; // s
const ROWS = 30; // in the table

/** The reader's motion, or a synthetic one; all opinions of it, and the moment that is drawn. */
function compute(s, memo) {
  const motion = s.motion ?? synthetic(s.seed, memo);
  const seen = opinions(motion, { R: s.R_acc, sigma_gyr: s.sigma_gyr, compass: s.compass });
  const { T, t } = motion;
  const reached = t.findLastIndex((time) => time <= s.when + 1e-9); // 0.1 + 0.2 is a little more than 0.3
  const k = motion.live ? T - 1 : Math.max(reached, 0);
  const r = { motion, seen, T, k };
  return { ...r, lines: linesOf(r, s) };
}

function synthetic(seed, memo) {
  if (memo.seed !== seed) {
    Object.assign(memo, { seed, motion: shaken(generator(seed)) });
  }
  return memo.motion;
}

/** The attitudes at step k: {gyro, acc, filter}, as frameOf gives them. The accelerometer knows no north. */
function framesAt({ seen: { up, north } }, k) {
  const at = (series) => series.subarray(3 * k, 3 * k + 3);
  return {
    gyro: frameOf(at(up.gyro), at(north.gyro)),
    acc: frameOf(at(up.acc), at(north.filter)),
    filter: frameOf(at(up.filter), at(north.filter)),
  };
}

/** What the plot shows of the chosen angle: {t, gyro, acc, filter, truth (or null)}, degrees. */
function linesOf(r, s) {
  const { motion, T } = r;
  const from = motion.live ? motion.t.findIndex((time) => time >= motion.t[T - 1] - SHOWN_LIVE) : 0;
  const skip = Math.max(1, Math.floor((T - from) / DRAWN));
  const steps = Array.from({ length: Math.ceil((T - from) / skip) }, (_, j) => from + j * skip);
  const i = AXES.indexOf(s.shown);
  const frames = steps.map((k) => framesAt(r, k));
  const of = (name) => Float64Array.from(frames, (frame) => anglesOf(frame[name])[i]);
  const compass = () => Float64Array.from(steps, (k) => aroundZero(motion.heading[k]));
  return {
    t: Float64Array.from(steps, (k) => motion.t[k]),
    gyro: of("gyro"),
    acc: s.shown === "yaw" ? compass() : of("acc"),
    filter: of("filter"),
    truth: motion.truth ? Float64Array.from(steps, (k) => anglesOf(motion.truth[k])[i]) : null,
  };
}

/** A heading between -180 and 180 degrees. */
function aroundZero(heading) {
  return heading - 360 * Math.floor((heading + 180) / 360);
}

function drawAngle({ lines, motion, k }, s) {
  const { t, gyro, acc, filter, truth } = lines;
  const from = motion.live ? t[0] : 0;
  return {
    xlim: [from, Math.max(from + 1, motion.live ? from + SHOWN_LIVE : motion.t[motion.T - 1])],
    layers: [
      { look: "measurement", x: t, y: acc, label: s.shown === "yaw" ? PHONE.compass : TILT.acc },
      { look: "prediction", x: t, y: gyro, label: TILT.gyro },
      { look: "estimate", x: t, y: filter, label: TILT.filter },
      truth && { look: "truth", x: t, y: truth, label: "x_true" },
      { look: "quiet", at: motion.t[k] },
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const { motion, k, seen } = r;
  const frames = framesAt(r, k);
  const angles = Object.entries(frames).map(([name, frame]) => [name, anglesOf(frame)]);
  const now = { when: t.decimal(Number(motion.t[k].toFixed(1))) };
  for (const [name, [roll, pitch]] of angles) {
    now[`${name}_roll`] = size(Number(roll.toFixed(1)), t);
    now[`${name}_pitch`] = size(Number(pitch.toFixed(1)), t);
  }
  const sentences = [t.say(PHONE.now, now), t.say(PHONE.gain, { R: s.R_acc, K: seen.K[k] })];
  if (motion.heading.every(Number.isNaN) || !s.compass) {
    sentences.push(t.say(PHONE.no_compass));
  }
  if (motion.truth) {
    const off = (name) => size(rmse(r.lines.truth, r.lines[name])[0], t);
    const values = { gyro: off("gyro"), acc: off("acc"), filter: off("filter"), angle: s.shown };
    sentences.push(t.say(PHONE.synthetic, values));
  }
  return sentences.join(" ");
}

function numbers(r, s, t) {
  const { motion, seen, T } = r;
  const rows = [];
  for (let k = 0; k < T; k += Math.max(1, Math.floor(T / ROWS))) {
    const { gyro, acc, filter } = framesAt(r, k);
    const rolls = [gyro, acc, filter].map((frame) => anglesOf(frame)[0]);
    const values = [motion.t[k], ...rolls, ...anglesOf(filter).slice(1), seen.K[k]];
    rows.push(values.map((value) => t.decimal(value)));
  }
  const names = [TILT.gyro, TILT.acc].map((words) => `roll, ${t.say(words)} (°)`);
  return { head: ["t (s)", ...names, "roll, x (°)", "pitch, x (°)", "yaw, x (°)", "K"], rows };
}

// --- the view ----------------------------------------------------------------------------------------------

const isStill = (s) => !s.motion?.live;

const controls = [
  sensorControl({ name: "motion" }),
  {
    kind: "select",
    name: "shown",
    default: "roll",
    ...CONTROLS.shown,
    options: AXES.map((axis) => [axis, SHOWN[axis]]),
  },
  {
    ...TILT_CONTROLS.R_acc,
    name: "R_acc",
    symbol: "R",
    unit: "°²",
    log: true,
    min: 0.01,
    max: 1e4,
    step: 0.1,
    default: 10,
  },
  {
    ...TILT_CONTROLS.when,
    name: "when",
    symbol: "t",
    unit: "s",
    min: 0,
    max: SECONDS,
    step: 0.1,
    default: 11.4,
    end: (s, r) => (r ? Number(r.motion.t[r.T - 1].toFixed(1)) : SECONDS),
    visible: isStill,
  },
  { kind: "buttons", items: [{ play: "when", seconds: SECONDS, ...PHONE.play }], visible: isStill },
  { kind: "check", name: "compass", default: true, ...PHONE.use_compass },
];

export const phone = {
  name: PHONE.name,
  noise: true,
  start: { sigma_gyr: 1 },
  controls,
  compute,
  plots: [
    { ...PHONE.ghosts, height: 150, half: true, equal: true, bare: true, draw: drawGhosts(framesAt) },
    {
      ...PHONE.instruments,
      height: 150,
      half: true,
      equal: true,
      bare: true,
      after: true,
      draw: drawInstruments(framesAt),
    },
    { ...PHONE.angle, xlabel: "t (s)", height: 200, half: true, draw: drawAngle },
  ],
  outcome,
  numbers,
};
