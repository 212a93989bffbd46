// Where the flight leads, smoothly, and noise that changes slowly.
import { DEG, REST } from "./model.js";

/** The paper's route: seconds straight on, after a turn (degrees). */
const ROUTE = [
  [30, 0],
  [20, -65],
  [15, -115],
  [20, -80],
  [15, -100],
];
const TURN_RATE = 25; // deg/s
const CRUISE = 2; // m/s
const IN_A_TURN = 0.5; // m/s
const CLIMB = 2; // s from the ground to the height of the flight
const LANDED = 4; // s at the end
const YAW_SECONDS = 0.3; // in which a turn begins
const SPEED_SECONDS = 0.8; // in which the craft speeds up

/** Times t, yaw (rad), speed (m/s), and how much the craft is aloft (0 to 1). */
export function routeOf(dt) {
  const corners = cornersOf();
  const end = corners.at(-1).time;
  const t = new Float64Array(Math.floor(end / dt + 1e-6) + 1).map((_, k) => k * dt);
  const aloft = t.map((now) => gentle((now - REST) / CLIMB));
  const yaw = smooth(follow(t, corners, "yaw"), bell(dt, YAW_SECONDS, 1));
  const speed = smooth(follow(t, corners, "speed"), bell(dt, SPEED_SECONDS, 1));
  return {
    t,
    yaw: yaw.map((value) => value * DEG),
    speed: speed.map((value, k) => value * aloft[k]),
    aloft,
  };
}

/** [{time s, yaw degrees, speed m/s}, ...] between which the craft goes evenly; it faces south at first. */
function cornersOf() {
  let time = REST + CLIMB;
  let yaw = 180;
  const corners = [
    { time: 0, yaw, speed: 0 },
    { time, yaw, speed: 0 },
  ];
  for (const [seconds, turn] of ROUTE) {
    if (turn !== 0) {
      corners.push({ time, yaw, speed: IN_A_TURN });
      time += Math.abs(turn) / TURN_RATE;
      yaw += turn;
      corners.push({ time, yaw, speed: IN_A_TURN });
    }
    corners.push({ time, yaw, speed: CRUISE });
    time += seconds;
    corners.push({ time, yaw, speed: CRUISE });
  }
  corners.push({ time, yaw, speed: 0 }, { time: time + LANDED, yaw, speed: 0 });
  return corners;
}

/** The yaw or the speed at the times t, straight between the corners. */
function follow(t, corners, name) {
  let next = 1;
  return t.map((now) => {
    while (next < corners.length - 1 && corners[next].time < now) {
      next++;
    }
    const a = corners[next - 1];
    const b = corners[next];
    if (b.time <= a.time) {
      return b[name];
    }
    return a[name] + ((b[name] - a[name]) * (now - a.time)) / (b.time - a.time);
  });
}

/** From 0 to 1 while `part` does so, without a jerk at either end. */
export function gentle(part) {
  const inside = Math.min(1, Math.max(0, part));
  return inside ** 2 * (3 - 2 * inside);
}

/** A bell of the width tau, both in s, scaled so that the sum of its values to this power is 1. */
function bell(dt, tau, power) {
  const n = Math.floor((4 * tau) / dt + 1e-9);
  const values = new Float64Array(2 * n + 1).map((_, i) => Math.exp(-0.5 * (((i - n) * dt) / tau) ** 2));
  const sum = values.reduce((total, value) => total + value ** power, 0) ** (1 / power);
  return values.map((value) => value / sum);
}

/** Sums of neighbours with these weights; shorter than the values by the weights, but for one. */
function convolve(values, weights) {
  return new Float64Array(values.length - weights.length + 1).map((_, k) => {
    let sum = 0;
    for (let j = 0; j < weights.length; j++) {
      sum += weights[j] * values[k + j];
    }
    return sum;
  });
}

/** As long as the values: beyond their ends the first and the last one go on. */
function smooth(values, weights) {
  const half = Math.floor(weights.length / 2);
  const last = values.length - 1;
  const longer = new Float64Array(values.length + 2 * half).map((_, k) => {
    return values[Math.min(Math.max(k - half, 0), last)];
  });
  return convolve(longer, weights);
}

/**
 * Three random signals (3 T) of standard deviation 1 that change within tau (s): drawn every tau / 10,
 * straight between.
 */
export function coloured(rng, T, dt, tau) {
  const weights = bell(0.1, 1, 2);
  const out = new Float64Array(3 * T);
  for (let i = 0; i < 3; i++) {
    const drawn = Math.ceil((10 * T * dt) / tau) + 1 + weights.length;
    const values = convolve(new Float64Array(drawn).map(rng.normal), weights);
    for (let k = 0; k < T; k++) {
      const place = (10 * k * dt) / tau;
      const j = Math.floor(place);
      out[3 * k + i] = values[j] + (place - j) * (values[j + 1] - values[j]);
    }
  }
  return out;
}
