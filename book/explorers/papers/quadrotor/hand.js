// One axis in the hand: a synthetic quadrotor is tilted and put back, then pushed sideways. Twin of
// kalman_lib/papers/quadrotor/hand.py; here in degrees.
import { kalmanFilter } from "../../numerics/filters.js";
import { linearModel } from "../../numerics/models.js";
import { DEG, GRAVITY } from "./model.js";
import { gentle } from "./route.js";

export const SECONDS = 20;
const TILTS = [3, 9]; // s: begins to tilt, begins to come back
const MOVING = 2; // s for each of the two
export const PUSHED = [13, 14]; // s
export const HAND_STEP = 0.1; // s
const P_START = 1; // deg2: level to within a degree

/** {T, x, z, u (T)} in degrees and degrees a second, in steps of dt seconds. */
export function hold(rng, { held, push, bias, sigma_gyr, sigma_acc }, dt = HAND_STEP) {
  const T = Math.round(SECONDS / dt);
  const [gyr_noise, y_noise, z_noise] = [0, 1, 2].map(() => Float64Array.from({ length: T }, rng.normal));
  const x = Float64Array.from({ length: T }, (_, k) => rollAt(dt * (k + 1), held));
  const z = new Float64Array(T);
  const u = new Float64Array(T);
  for (let k = 0; k < T; k++) {
    const time = dt * (k + 1);
    const sideways = time >= PUSHED[0] && time < PUSHED[1] ? push : 0;
    const sine = Math.sin(DEG * x[k]);
    const cosine = Math.cos(DEG * x[k]);
    const acc_y = -GRAVITY * sine - sideways * cosine + sigma_acc * y_noise[k];
    const acc_z = -GRAVITY * cosine + sideways * sine + sigma_acc * z_noise[k];
    z[k] = Math.atan2(-acc_y, -acc_z) / DEG;
    u[k] = (x[k] - (k > 0 ? x[k - 1] : 0)) / dt + bias + sigma_gyr * gyr_noise[k];
  }
  return { T, x, z, u };
}

function rollAt(time, held) {
  return held * (gentle((time - TILTS[0]) / MOVING) - gentle((time - TILTS[1]) / MOVING));
}

/** The smallest filter of the chapter: the state is the angle, the gyroscope moves it. */
export function one_angle({ sigma_gyr, R_acc }, dt = HAND_STEP) {
  return linearModel({
    F: [[1]],
    B: [[dt]],
    H: [[1]],
    Q: [[(sigma_gyr * dt) ** 2]],
    R: [[R_acc]],
    x0: [0],
    P0: [[P_START]],
  });
}

export function filterHeld(p, { z, u }, memo) {
  return kalmanFilter(one_angle(p), z, u, memo);
}

/** The gyroscope alone: its rates added up. */
export function addUp(u, dt = HAND_STEP) {
  let angle = 0;
  return u.map((rate) => {
    angle += dt * rate;
    return angle;
  });
}
