// The reader's own phone in the view "tilt": as gyroscope, accelerometer and filter see it, with a level
// and a compass.
import { sensorControl } from "../../own/phone.js";
import { exampleMotion } from "../../sensors/example.js";
import { size } from "./figures.js";
import { AXES } from "./model.js";
import { drawGhosts, drawInstruments } from "./scene.js";
import { anglesOf, frameOf, opinions } from "./vertical.js";
import { CONTROLS, PHONE, SHOWN, TILT } from "./words.js";

const DRAWN = 400; // readings: about one for a pixel
const SHOWN_LIVE = 20; // s
const ROWS = 30; // in the table
export const PUSH = 13.5; // s: the moment that is drawn of the synthetic run

export const hasPhone = (s) => Boolean(s.motion);
const isRecorded = (s) => hasPhone(s) && !s.motion.live;

/** All opinions of the reader's motion, and the moment that is drawn: {motion, seen, T, k, lines}. */
export function follow(s, memo) {
  const { motion } = s;
  memo.seen ??= {};
  const how = { R: s.R_acc, sigma_gyr: s.sigma_gyr, compass: s.compass };
  const seen = opinions(motion, how, memo.seen);
  const { T, t } = motion;
  const reached = t.findLastIndex((time) => time <= s.when + 1e-9); // 0.1 + 0.2 is a little more than 0.3
  const r = { motion, seen, T, k: motion.live ? T - 1 : Math.max(reached, 0) };
  return { ...r, lines: linesOf(r, s) };
}

/** The end of the recording, s. */
export function lastTime({ T, t }) {
  return Number(t[T - 1].toFixed(1));
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

/** What the plot shows of the angle, degrees: {t, gyro, acc, filter}; of the yaw acc is the compass. */
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
  };
}

/** A heading between -180 and 180 degrees. */
function aroundZero(heading) {
  return heading - 360 * Math.floor((heading + 180) / 360);
}

export function drawAngle({ lines, motion, T, k }, s) {
  const { t, gyro, acc, filter } = lines;
  const end = motion.live ? t[0] + SHOWN_LIVE : Math.max(1, motion.t[T - 1]);
  return {
    xlim: [t[0], end],
    layers: [
      { look: "measurement", x: t, y: acc, label: s.shown === "yaw" ? PHONE.compass : TILT.acc },
      { look: "prediction", x: t, y: gyro, label: TILT.gyro },
      { look: "estimate", x: t, y: filter, label: TILT.filter },
      { look: "quiet", at: motion.t[k] },
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

export function outcome(r, s, t) {
  const { motion, k, seen } = r;
  const now = { when: t.decimal(Number(motion.t[k].toFixed(1)), 4) };
  for (const [name, frame] of Object.entries(framesAt(r, k))) {
    const [roll, pitch] = anglesOf(frame).map((angle) => size(Number(angle.toFixed(1)), t));
    now[`${name}_roll`] = roll;
    now[`${name}_pitch`] = pitch;
  }
  const sentences = [t.say(PHONE.now, now), t.say(PHONE.gain, { R: s.R_acc, K: seen.K[k] })];
  if (motion.heading.every(Number.isNaN) || !s.compass) {
    sentences.push(t.say(PHONE.no_compass));
  }
  if (motion.synthetic) {
    sentences.push(t.say(PHONE.synthetic));
  }
  return sentences.join(" ");
}

export function numbers(r, s, t) {
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

// --- what the view has for it ------------------------------------------------------------------------------

const AS_ONE_SEES_IT = { height: 150, half: true, equal: true, bare: true, visible: hasPhone };
const NOTHING = { xlim: [0, 1], ylim: [0, 1], layers: [] };

/** A figure of a phone draws nothing while there is none. */
function ifPhone(draw) {
  return (r, s, t) => (hasPhone(s) ? draw(r, s, t) : NOTHING);
}

export const ghosts = { ...PHONE.ghosts, ...AS_ONE_SEES_IT, draw: ifPhone(drawGhosts(framesAt)) };
export const instruments = {
  ...PHONE.instruments,
  ...AS_ONE_SEES_IT,
  after: true,
  draw: ifPhone(drawInstruments(framesAt)),
};

export const controls = [
  {
    kind: "select",
    name: "shown",
    default: "roll",
    ...CONTROLS.shown,
    options: AXES.map((axis) => [axis, SHOWN[axis]]),
    visible: hasPhone,
  },
  { kind: "check", name: "compass", default: true, ...PHONE.use_compass, visible: hasPhone },
  {
    kind: "buttons",
    items: [{ play: "when", seconds: (s) => lastTime(s.motion), ...PHONE.play }],
    visible: isRecorded,
  },
  sensorControl({
    name: "motion",
    example: exampleMotion,
    also: (motion) => ({ when: motion ? lastTime(motion) : PUSH }),
  }),
];
