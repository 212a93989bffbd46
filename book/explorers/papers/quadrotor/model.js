// Chapter 6: roll, pitch and yaw of a quadrotor from gyroscope, accelerometer and magnetometer. Twin of
// kalman_lib/papers/quadrotor/model.py. Series of three (roll, pitch, yaw; or x, y, z) lie step after
// step in a
// Float64Array (3 T). Angles in rad, rates in rad/s; earth north-east-down, body forward-right-down.
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";

export const AXES = ["roll", "pitch", "yaw"];
export const DEG = Math.PI / 180; // rad
export const GRAVITY = 9.81; // m/s2
export const FIELD = [38.13, 0, -23.79]; // uT: the earth's field in Yogyakarta, 2022; x is magnetic north
export const REST = 6; // s before take-off
export const STEEPEST = 85 * DEG;

/**
 * The paper's model: state [roll, its rate, pitch, its rate, yaw, its rate], measured: the angles, input: the
 * rates.
 */
export function model(p) {
  const { dt } = p;
  const q = p.q * DEG ** 2;
  const R_tilt = (p.sigma_acc / GRAVITY) ** 2;
  const R_yaw = p.sigma_mag ** 2 / (FIELD[0] ** 2 + FIELD[1] ** 2);
  const R = [R_tilt, R_tilt, R_yaw];
  const F = [
    [1, dt],
    [0, 0], // the rate is the input
  ];
  const Q = [
    [(q * dt ** 3) / 3, (q * dt ** 2) / 2],
    [(q * dt ** 2) / 2, q * dt],
  ];
  return linearModel({
    F: blocks([F, F, F]),
    B: blocks([
      [[0], [1]],
      [[0], [1]],
      [[0], [1]],
    ]),
    H: blocks([[[1, 0]], [[1, 0]], [[1, 0]]]),
    Q: blocks([Q, Q, Q]),
    R: blocks(R.map((variance) => [[variance]])),
    x0: [0, 0, 0, 0, Math.PI, 0],
    P0: blocks(
      R.map((variance) => [
        [variance, 0],
        [0, 0],
      ]),
    ),
    residual: wrapped_difference,
  });
}

/** A matrix with these matrices, all of one size, along its diagonal. */
function blocks(matrices) {
  const rows = [];
  matrices.forEach((block, at) => {
    for (const row of block) {
      rows.push(matrices.flatMap((_, i) => (i === at ? row : row.map(() => 0))));
    }
  });
  return rows;
}

export function run(p, { z, u }) {
  return kalmanFilter(model(p), z, u);
}

/** The same angle between -pi and pi. */
export function wrap(angle) {
  if (angle >= -Math.PI && angle < Math.PI) {
    return angle;
  }
  return angle - 2 * Math.PI * Math.floor((angle + Math.PI) / (2 * Math.PI));
}

/** y = z - z_pred, the short way round. */
function wrapped_difference(z, z_pred, y) {
  for (let i = 0; i < 3; i++) {
    y[i] = wrap(z[i] - z_pred[i]);
  }
}

// --- what each sensor says alone ---------------------------------------------------------------------------

/** [roll, pitch] of the accelerometer alone: right only without acceleration. */
export function tilt(x, y, z) {
  return [Math.atan2(-y, -z), Math.atan2(x, Math.sqrt(y * y + z * z))];
}

/** [roll, pitch] as equations (2) and (1) print them, both with the root of ax^2 + az^2. */
export function printed_tilt(x, y, z) {
  const root = Math.sqrt(x * x + z * z);
  return [Math.atan(-y / root), Math.atan(x / root)];
}

/** Yaw of the magnetometer, its vector turned back to the horizontal by roll and pitch. */
export function heading(x, y, z, roll, pitch) {
  const sin_r = Math.sin(roll);
  const cos_r = Math.cos(roll);
  const to_the_east = z * sin_r - y * cos_r;
  const to_the_north = x * Math.cos(pitch) + (y * sin_r + z * cos_r) * Math.sin(pitch);
  return Math.atan2(to_the_east, to_the_north);
}

/** Rates of roll, pitch and yaw from the body's rates gyr = (p, q, r); beyond 85 deg of pitch those at 85. */
export function euler_rates(gyr, roll, pitch, out = new Float64Array(3)) {
  const p = gyr[0];
  const q = gyr[1];
  const r = gyr[2];
  const limited = Math.max(-STEEPEST, Math.min(STEEPEST, pitch));
  const sin_r = Math.sin(roll);
  const cos_r = Math.cos(roll);
  const turn = q * sin_r + r * cos_r;
  out[0] = p + turn * Math.tan(limited);
  out[1] = q * cos_r - r * sin_r;
  out[2] = turn / Math.cos(limited);
  return out;
}

// --- measures of error -------------------------------------------------------------------------------------

/** Equation (25): |mean of reference - mean of estimate| / |mean of reference|, in percent. */
export function galat_of(reference, estimate) {
  return (100 * Math.abs(reference - estimate)) / Math.abs(reference);
}
