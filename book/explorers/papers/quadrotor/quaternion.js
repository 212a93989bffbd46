// Attitudes as quaternions [w, x, y, z] of length 1: turns of the body's axes into north-east-down.

/** First the turn q, then p. */
export function product([pw, px, py, pz], [qw, qx, qy, qz]) {
  return [
    pw * qw - px * qx - py * qy - pz * qz,
    pw * qx + px * qw + py * qz - pz * qy,
    pw * qy - px * qz + py * qw + pz * qx,
    pw * qz + px * qy - py * qx + pz * qw,
  ];
}

/** The turn about the axis (x, y, z), by its length in rad. */
export function turnBy(x, y, z) {
  const half = Math.sqrt(x * x + y * y + z * z) / 2;
  const share = half > 0 ? Math.sin(half) / (2 * half) : 0.5;
  return [Math.cos(half), share * x, share * y, share * z];
}

/** The same turn with length 1 again: rounding adds up. */
export function unit([w, x, y, z]) {
  const length = Math.sqrt(w * w + x * x + y * y + z * z);
  return [w / length, x / length, y / length, z / length];
}

/** The rotation matrix (3, 3), row by row: its columns are the body's axes. */
export function matrixOf([w, x, y, z]) {
  return [
    1 - 2 * (y * y + z * z),
    2 * (x * y - w * z),
    2 * (x * z + w * y),
    2 * (x * y + w * z),
    1 - 2 * (x * x + z * z),
    2 * (y * z - w * x),
    2 * (x * z - w * y),
    2 * (y * z + w * x),
    1 - 2 * (x * x + y * y),
  ];
}

/** [roll, pitch, yaw]. */
export function anglesOf([w, x, y, z]) {
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x)))),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

/** The inverse of anglesOf: turned by yaw first, then pitch, then roll. */
export function quaternionOf(roll, pitch, yaw) {
  const level = product(turnBy(0, 0, yaw), turnBy(0, pitch, 0));
  return product(level, turnBy(roll, 0, 0));
}
