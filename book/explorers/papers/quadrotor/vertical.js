// A phone in the hand, turned any way: where up and where north lie in its own axes (x right, y to the top
// edge, z out of the screen). Both are filters of the chapter with the state [x, y, z]: the gyroscope turns
// it,
//   F = exp(-[turn] x),  Q = (sigma T)^2 I,
// and the accelerometer (up) or the compass (north) measures it, H = I, R = r I. As F only turns, P stays p
// I, and one gain K = p / (p + r) serves all three. Unlike roll, pitch and yaw it fails in no attitude.
import { DEG, tilt } from "./model.js";

const COMPASS = (10 * DEG) ** 2; // rad2: the variance of a compass in the hand
const STEEPEST = 0.2; // a top edge that points up further than this knows no heading

/**
 * What gyroscope alone, accelerometer alone and filter say: {T, up: {gyro, acc, filter}, north: {gyro,
 * filter} (3 T), K (T)}. R degrees squared, sigma_gyr degrees a second; compass: is it in use?
 */
export function opinions({ T, t, gyr, acc, heading }, { R, sigma_gyr, compass }) {
  const series = () => new Float64Array(3 * T);
  const up = { gyro: series(), acc: series(), filter: series() };
  const north = { gyro: series(), filter: series() };
  const K = new Float64Array(T);
  const r = R * DEG ** 2;
  let p = r;
  let p_north = COMPASS;
  for (let k = 0; k < T; k++) {
    const z = unit(acc.subarray(3 * k, 3 * k + 3));
    up.acc.set(z, 3 * k);
    if (k === 0) {
      const first = compass && northOf(z, heading[0]);
      [up.gyro, up.filter].forEach((one) => one.set(z));
      [north.gyro, north.filter].forEach((one) => one.set(first || northOf(z, 0) || [0, 1, 0]));
      continue;
    }
    const step = t[k] - t[k - 1];
    const turn = turnOf(gyr, k, step);
    for (const one of [up.gyro, up.filter, north.gyro, north.filter]) {
      one.set(turned(one.subarray(3 * k - 3, 3 * k), turn), 3 * k);
    }
    const q = (sigma_gyr * DEG * step) ** 2;
    K[k] = (p + q) / (p + q + r);
    p = K[k] * r;
    blend(up.filter, k, K[k], z);
    const pointer = compass && northOf(unit(up.filter.subarray(3 * k, 3 * k + 3)), heading[k]);
    p_north += q;
    if (pointer) {
      const gain = p_north / (p_north + COMPASS);
      p_north = gain * COMPASS;
      blend(north.filter, k, gain, pointer);
    }
  }
  return { T, up, north, K };
}

/** x = x + K (z - x) at step k. */
function blend(x, k, K, z) {
  for (let i = 0; i < 3; i++) {
    x[3 * k + i] += K * (z[i] - x[3 * k + i]);
  }
}

// --- vectors of three --------------------------------------------------------------------------------------

export function cross([a, b, c], [x, y, z]) {
  return [b * z - c * y, c * x - a * z, a * y - b * x];
}

export function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function unit(v) {
  const size = Math.hypot(v[0], v[1], v[2]) || 1;
  return [v[0] / size, v[1] / size, v[2] / size];
}

/** The turn (3) rad during a step, by the mean of the readings before and after it. */
function turnOf(gyr, k, step) {
  return [0, 1, 2].map((i) => (DEG * step * (gyr[3 * k + i] + gyr[3 * k + i - 3])) / 2);
}

/** A direction that stays in the world, in the axes of a body that has turned (Rodrigues). */
function turned(v, turn) {
  const angle = Math.hypot(...turn);
  if (angle === 0) {
    return v;
  }
  const axis = turn.map((part) => part / angle);
  const across = cross(axis, v);
  const along = dot(axis, v) * (1 - Math.cos(angle));
  return [0, 1, 2].map((i) => v[i] * Math.cos(angle) - across[i] * Math.sin(angle) + axis[i] * along);
}

/** North in the body's axes where the top edge has this heading (degrees); null: it has none. */
function northOf(up, heading) {
  const ahead = [0, 1, 2].map((i) => (i === 1 ? 1 : 0) - up[1] * up[i]); // the level part of y
  if (Number.isNaN(heading) || Math.hypot(...ahead) < STEEPEST) {
    return null;
  }
  const forward = unit(ahead);
  const right = cross(forward, up);
  const [sine, cosine] = [Math.sin(heading * DEG), Math.cos(heading * DEG)];
  return forward.map((part, i) => cosine * part - sine * right[i]);
}

// --- attitudes ---------------------------------------------------------------------------------------------

/** East, north and up as unit vectors in the body's axes, from an up and a north of any length. */
export function frameOf(up, north) {
  const u = unit(up);
  const n = unit([0, 1, 2].map((i) => north[i] - dot(north, u) * u[i]));
  return [cross(n, u), n, u];
}

/** [roll, pitch, yaw] of the chapter, degrees; yaw is the heading of the top edge. */
export function anglesOf([east, north, up]) {
  const [roll, pitch] = tilt(up[1], up[0], -up[2]); // the body of the chapter: forward, right, down
  return [roll, pitch, Math.atan2(east[1], north[1])].map((angle) => angle / DEG);
}
