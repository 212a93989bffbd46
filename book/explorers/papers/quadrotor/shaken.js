// A synthetic phone in the hand: tilted, lifted, turned, and shaken sideways; for whoever has no sensors.
// In the shape of a recording of sensors/recording.js, and with its true attitude.
import { DEG, GRAVITY } from "./model.js";
import { gentle } from "./route.js";
import { cross, frameOf } from "./vertical.js";

export const SECONDS = 20;
const STEP = 0.02; // s
const MOVES = [
  { angle: "roll", degrees: 40, from: 2, back: 6 },
  { angle: "pitch", degrees: 35, from: 4, back: 9 },
  { angle: "yaw", degrees: 90, from: 14, back: 17 },
];
const MOVING = 1.5; // s for each of them
const SHAKEN = [11, 12.5]; // s
const SHAKES = 3; // a second
const SHAKE = 5; // m/s2
const NOISE = { gyr: 1, acc: 0.3, heading: 4 }; // degrees a second, m/s2, degrees
const BIAS = [0.4, -0.6, 0.5]; // degrees a second

/** {T, t, gyr, acc, heading, live: false, truth: [frame, ...]} */
export function shaken(rng) {
  const T = Math.round(SECONDS / STEP) + 1;
  const t = Float64Array.from({ length: T }, (_, k) => STEP * k);
  const truth = Array.from(t, trueFrame);
  const gyr = new Float64Array(3 * T);
  const acc = new Float64Array(3 * T);
  const heading = new Float64Array(T);
  for (let k = 0; k < T; k++) {
    const rate = rateBetween(truth[Math.max(k - 1, 0)], truth[Math.min(k + 1, T - 1)]);
    const [east, , up] = truth[k];
    const isShaken = t[k] >= SHAKEN[0] && t[k] < SHAKEN[1];
    const push = isShaken ? SHAKE * Math.sin(2 * Math.PI * SHAKES * (t[k] - SHAKEN[0])) : 0;
    for (let i = 0; i < 3; i++) {
      gyr[3 * k + i] = rate[i] + BIAS[i] + NOISE.gyr * rng.normal();
      acc[3 * k + i] = GRAVITY * up[i] + push * east[i] + NOISE.acc * rng.normal();
    }
    heading[k] = turnedBy("yaw", t[k]) + NOISE.heading * rng.normal();
  }
  return { T, t, gyr, acc, heading, live: false, truth };
}

/** How far an angle is turned at a time, degrees. */
function turnedBy(angle, time) {
  const { degrees, from, back } = MOVES.find((move) => move.angle === angle);
  return degrees * (gentle((time - from) / MOVING) - gentle((time - back) / MOVING));
}

/** East, north and up in the axes of the phone. */
function trueFrame(time) {
  const [roll, pitch, yaw] = ["roll", "pitch", "yaw"].map((angle) => DEG * turnedBy(angle, time));
  const [sr, cr, sp, cp] = [Math.sin(roll), Math.cos(roll), Math.sin(pitch), Math.cos(pitch)];
  const [sy, cy] = [Math.sin(yaw), Math.cos(yaw)];
  const up = [-sr * cp, sp, cr * cp];
  const north = [sr * sp * cy - cr * sy, cp * cy, -cr * sp * cy - sr * sy];
  return frameOf(up, north);
}

/** The rate, degrees a second, in the middle of two steps; half the sum of what each direction has turned. */
function rateBetween(before, after) {
  const turns = before.map((direction, i) => cross(after[i], direction));
  return [0, 1, 2].map((i) => (turns[0][i] + turns[1][i] + turns[2][i]) / 2 / (2 * STEP) / DEG);
}
