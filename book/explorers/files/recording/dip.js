// Is the angle between gravity and the magnetic field the same in every pose? It should be; if it is not, the
// axes of the magnetometer are not those of the accelerometer, or iron is nearby. Twin of
// kalman_lib/data/dip.py.
import { clipped } from "./angles.js";
import { turned } from "./axes.js";
import { say } from "./notes.js";

const DEG = Math.PI / 180;
const WINDOW = 0.5; // s
const SLOW = 0.5; // rad/s; faster than that a window says little
const QUIET = 1; // m/s2 by which the mean acceleration may differ from gravity
const GRAVITY = 9.81;
const LEAST = 8; // windows
const MOST = 20; // degrees by which the angle may change from pose to pose
const ORDERS = [
  [[0, 1, 2], 1],
  [[0, 2, 1], -1],
  [[1, 0, 2], -1],
  [[1, 2, 0], 1],
  [[2, 0, 1], 1],
  [[2, 1, 0], -1],
];
const SIGNS = [1, -1];
const ALL_SIGNS = SIGNS.flatMap((a) => SIGNS.flatMap((b) => SIGNS.map((c) => [a, b, c])));
/** The 24 right-handed ones: [[place, sign], ...] of each axis. */
const FRAMES = ORDERS.flatMap(([order, parity]) =>
  ALL_SIGNS.filter(([a, b, c]) => a * b * c === parity).map((signs) => order.map((j, i) => [j, signs[i]])),
);

/** A note where the angle changes, and whether other axes of the magnetometer would mend it. */
export function tellDip({ acc, mag, gyr }, rate, notes) {
  const { up, field } = poses({ acc, mag, gyr }, rate);
  if (up.length < 3 * LEAST) {
    return;
  }
  const [low, high] = rangeOf(up, field);
  if (high - low < MOST) {
    return;
  }
  const change = `${low.toFixed(0)} - ${high.toFixed(0)}`;
  const better = betterAxes(up, field);
  const [more_en, more_id] = better
    ? [
        ` With x, y, z of the magnetometer read as ${better} it would be.`,
        ` Dengan x, y, z magnetometer dibaca sebagai ${better} sudut itu sama.`,
      ]
    : ["", ""];
  say(
    notes,
    `The angle between gravity and the magnetic field is not the same in every pose (${change} degrees): ` +
      `the magnetometer has other axes, or iron is near, and the yaw is wrong.${more_en}`,
    `Sudut antara gravitasi dan medan magnet tidak sama pada setiap sikap alat (${change} derajat): ` +
      `sumbu magnetometernya lain atau ada besi di dekatnya, dan yaw keliru.${more_id}`,
  );
}

/** The directions of gravity and field (3 n) in quiet windows. */
function poses({ acc, mag, gyr }, rate) {
  const size = Math.max(2, Math.round(WINDOW * rate));
  const count = Math.floor(acc.length / 3 / size);
  const up = [];
  const field = [];
  for (let i = 0; i < count; i++) {
    const mean = (values, of) => meansIn(values, 3 * i * size, 3 * (i + 1) * size, of);
    const force = mean(acc, (value) => value);
    const magnetic = mean(mag, (value) => value);
    const g = Math.hypot(...force);
    const size_of_field = Math.hypot(...magnetic);
    const isSlow = Math.max(...mean(gyr, Math.abs)) < SLOW;
    if (Math.abs(g - GRAVITY) < QUIET && isSlow && size_of_field > 0) {
      up.push(...force.map((value) => value / g));
      field.push(...magnetic.map((value) => value / size_of_field));
    }
  }
  return { up, field };
}

function meansIn(values, from, to, of) {
  const sums = [0, 0, 0];
  for (let at = from; at < to; at++) {
    sums[at % 3] += of(values[at]);
  }
  return sums.map((sum) => (3 * sum) / (to - from));
}

/** The angles between them, degrees, without the outermost twentieths: [low, high]. */
function rangeOf(up, field) {
  const angles = new Float64Array(up.length / 3);
  for (let k = 0; k < angles.length; k++) {
    const at = 3 * k;
    const cosine = up[at] * field[at] + up[at + 1] * field[at + 1] + up[at + 2] * field[at + 2];
    angles[k] = Math.acos(clipped(cosine)) / DEG;
  }
  angles.sort();
  return [0.05, 0.95].map((share) => quantile(angles, share));
}

function quantile(sorted, share) {
  const place = share * (sorted.length - 1);
  const k = Math.floor(place);
  const next = sorted[Math.min(k + 1, sorted.length - 1)];
  return sorted[k] + (place - k) * (next - sorted[k]);
}

/** "y x -z": the axes with which the angle hardly changes, if only one choice does that; else "". */
function betterAxes(up, field) {
  const changes = FRAMES.map((frame) => {
    const [low, high] = rangeOf(up, turned(field, frame));
    return { frame, change: high - low };
  });
  const [best, second] = changes.sort((a, b) => a.change - b.change);
  if (best.change > MOST / 2 || second.change < 2 * best.change + MOST / 4) {
    return "";
  }
  return best.frame.map(([place, sign]) => (sign < 0 ? "-" : "") + "xyz"[place]).join(" ");
}
