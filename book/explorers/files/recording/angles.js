// Roll, pitch and yaw as a device reports them. Between two moments they go through quaternions, as angles
// jump at +-180 degrees. Twin of kalman_lib/data/angles.py.
import { interpolated } from "./lines.js";
import { median } from "./notes.js";

const DEG = Math.PI / 180;

/** Roll, pitch, yaw (3 n) rad at times (n) -> at t (T): (3 T). */
export function interpolateAngles(t, times, angles) {
  const q = new Float64Array(4 * times.length);
  times.forEach((_, k) => q.set(sameSide(quaternion(angles.subarray(3 * k, 3 * k + 3)), q, k), 4 * k));
  const between = interpolated(t, times, q, 4);
  const found = new Float64Array(3 * t.length);
  t.forEach((_, k) => found.set(anglesOf(between.subarray(4 * k, 4 * k + 4)), 3 * k));
  return found;
}

/** q and -q are one attitude: the one that is nearer to the one before. */
function sameSide(one, all, k) {
  let product = 0;
  for (let i = 0; k > 0 && i < 4; i++) {
    product += one[i] * all[4 * k - 4 + i];
  }
  return product < 0 ? one.map((value) => -value) : one;
}

/** Roll, pitch, yaw rad -> a unit quaternion, w first, body to north-east-down. */
function quaternion([roll, pitch, yaw]) {
  const [cr, cp, cy] = [roll, pitch, yaw].map((angle) => Math.cos(angle / 2));
  const [sr, sp, sy] = [roll, pitch, yaw].map((angle) => Math.sin(angle / 2));
  return [
    cr * cp * cy + sr * sp * sy,
    sr * cp * cy - cr * sp * sy,
    cr * sp * cy + sr * cp * sy,
    cr * cp * sy - sr * sp * cy,
  ];
}

/** The inverse of it, of any length. */
function anglesOf(q) {
  const size = Math.hypot(...q);
  const [w, x, y, z] = q.map((part) => part / size);
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(clipped(2 * (w * y - z * x))),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

export function clipped(cosine) {
  return Math.min(Math.max(cosine, -1), 1);
}

/** The median angle, degrees, between the vertical that angles (3 T) claim and that of acc (3 T). */
export function tiltAgainst(angles, acc) {
  const tilts = new Float64Array(acc.length / 3);
  for (let k = 0; k < tilts.length; k++) {
    const [roll, pitch] = angles.subarray(3 * k, 3 * k + 2);
    const up = [Math.sin(pitch), -Math.sin(roll) * Math.cos(pitch), -Math.cos(roll) * Math.cos(pitch)];
    const force = acc.subarray(3 * k, 3 * k + 3);
    const along = up[0] * force[0] + up[1] * force[1] + up[2] * force[2];
    tilts[k] = Math.acos(clipped(along / Math.hypot(...force)));
  }
  return median(tilts) / DEG;
}
