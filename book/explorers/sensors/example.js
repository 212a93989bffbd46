// A synthetic recording of a phone, for whoever has no sensors: it lies on a table, is turned onto its
// right side and back, lifted by its top edge, shaken sideways, and turned round on the table.
import { generator } from "../numerics/random.js";
import { recorder } from "./recording.js";

const DEG = Math.PI / 180; // rad
const SECONDS = 30;
const RATE = 60; // readings a second
const MOVING = 1.5; // s from one position to the other
const MOVES = {
  roll: { degrees: 90, from: 6, back: 9 },
  pitch: { degrees: 60, from: 12, back: 15 },
  turn: { degrees: 90, from: 22, back: 26 },
};
const SHAKEN = { from: 18, until: 20, times: 3, size: 5 }; // s, s, a second, m/s2
const BIAS = [0.3, -0.4, 0.2]; // degrees a second
const NOISE = { gyr: 0.5, acc: 0.1, heading: 3 }; // degrees a second, m/s2, degrees
const GRAVITY = 9.81; // m/s2
const NORTH = 30; // degrees: where its top edge points at first
const SEED = 3;

/** A motion (recording.js) that is called synthetic; the same one every time. */
export function exampleMotion() {
  const rng = generator(SEED);
  const noisy = (value, sigma) => Math.round(10 * (value + sigma * rng.normal())) / 10; // as browsers round
  const made = recorder();
  for (let k = 0; k <= SECONDS * RATE; k++) {
    const time = k / RATE;
    const rates = [rateOf("pitch", time), rateOf("roll", time), -rateOf("turn", time)];
    made.add({
      t: 1000 * time,
      gyr: rates.map((rate, i) => noisy(rate + BIAS[i], NOISE.gyr)),
      acc: forceAt(time).map((value) => noisy(value, NOISE.acc)),
      heading: noisy(NORTH + angleOf("turn", time), NOISE.heading),
      mag: [NaN, NaN, NaN],
    });
  }
  return { ...made.motion(false), synthetic: true };
}

/** What the accelerometer feels, m/s2; no two of the moves overlap. */
function forceAt(time) {
  const roll = DEG * angleOf("roll", time);
  const pitch = DEG * angleOf("pitch", time);
  const { from, until, times, size } = SHAKEN;
  const isShaken = time >= from && time < until;
  const push = isShaken ? size * Math.sin(2 * Math.PI * times * (time - from)) : 0;
  const up = [-Math.sin(roll), Math.sin(pitch), Math.cos(roll) * Math.cos(pitch)];
  return [GRAVITY * up[0] + push, GRAVITY * up[1], GRAVITY * up[2]];
}

function angleOf(move, time) {
  const { degrees, from, back } = MOVES[move];
  const there = (start) => {
    const share = shareOf(time, start);
    return share * share * (3 - 2 * share);
  };
  return degrees * (there(from) - there(back));
}

/** The rate of the angle, degrees a second. */
function rateOf(move, time) {
  const { degrees, from, back } = MOVES[move];
  const slope = (start) => {
    const share = shareOf(time, start);
    return (6 * share * (1 - share)) / MOVING;
  };
  return degrees * (slope(from) - slope(back));
}

/** How much of a move that begins at start is done. */
function shareOf(time, start) {
  return Math.min(Math.max((time - start) / MOVING, 0), 1);
}
