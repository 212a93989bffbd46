// A SYNTHETIC flight along the paper's route, and what the three sensors say on it.
import { DEG, FIELD, GRAVITY, REST, wrap } from "./model.js";
import { coloured, routeOf } from "./route.js";
import { measured } from "./sensors.js";

const DRAG = 0.35; // 1/s: how much of its speed the air takes from the craft
const SWAY_SECONDS = 0.5; // in which the swaying changes
const MOTOR_SECONDS = 2; // in which the disturbance by the motors changes
const SWAY = [1, 1, 0.5]; // north, east, down

/**
 * The thrust is acceleration - gravity + drag, and its direction gives roll and pitch. {T, t, x (6 T), z (3
 * T), u = gyr, acc, mag, truth (3 T), rest_s}. Noise is white, but for a swaying of the craft and a magnetic
 * disturbance by its motors.
 */
export function simulate(p, rng) {
  const { dt } = p;
  const route = routeOf(dt);
  const { t, aloft } = route;
  const T = t.length;
  const sway = coloured(rng, T, dt, SWAY_SECONDS);
  const disturbance = coloured(rng, T, dt, MOTOR_SECONDS);
  const bias = [0, 1, 2].map(() => p.bias * rng.normal()); // deg/s
  const velocity = velocityOf(route);
  const force = specificForce(velocity, sway, aloft, p);
  const truth = anglesOf(force, velocity, route.yaw);
  const rates = gradient(truth, dt);
  const field = new Float64Array(3 * T);
  for (let k = 0; k < T; k++) {
    field.set(FIELD, 3 * k);
  }
  const acc = to_body(force, truth);
  const mag = to_body(field, truth);
  const gyr = body_rates(rates, truth);
  const x = new Float64Array(6 * T);
  for (let k = 0; k < T; k++) {
    for (let i = 0; i < 3; i++) {
      const at = 3 * k + i;
      gyr[at] += DEG * (bias[i] + p.sigma_gyr * rng.normal());
      acc[at] += p.sigma_acc * rng.normal();
      mag[at] += aloft[k] * disturbance[at] + p.sigma_mag * rng.normal();
      truth[at] = wrap(truth[at]);
      x[2 * at] = truth[at];
      x[2 * at + 1] = rates[at];
    }
  }
  const flight = { T, t, x, u: gyr, gyr, acc, mag, truth, rest_s: REST };
  return withMeasurements(flight);
}

/** z only when somebody asks for it: the explorer does not. */
function withMeasurements(flight) {
  const get = () => measured(flight.acc, flight.mag, 0, ["estimated tilt"]).z;
  return Object.defineProperty(flight, "z", { get, enumerable: true });
}

/** Velocity (3 T), m/s north, east, down: the craft keeps its height. */
function velocityOf({ yaw, speed }) {
  const velocity = new Float64Array(3 * yaw.length);
  for (let k = 0; k < yaw.length; k++) {
    velocity[3 * k] = speed[k] * Math.cos(yaw[k]);
    velocity[3 * k + 1] = speed[k] * Math.sin(yaw[k]);
  }
  return velocity;
}

/** Acceleration without gravity (3 T), m/s2: that of the route, and the swaying. */
function specificForce(velocity, sway, aloft, p) {
  const force = gradient(velocity, p.dt);
  for (let k = 0; k < aloft.length; k++) {
    for (let i = 0; i < 3; i++) {
      force[3 * k + i] += p.sway * SWAY[i] * aloft[k] * sway[3 * k + i];
    }
    force[3 * k + 2] -= GRAVITY;
  }
  return force;
}

/** Roll, pitch, yaw (3 T): the thrust must push where the craft accelerates, and against the drag. */
function anglesOf(force, velocity, yaw) {
  const angles = new Float64Array(force.length);
  for (let k = 0; k < yaw.length; k++) {
    const at = 3 * k;
    const north = -force[at] - DRAG * velocity[at];
    const east = -force[at + 1] - DRAG * velocity[at + 1];
    const down = -force[at + 2];
    const sine = Math.sin(yaw[k]);
    const cosine = Math.cos(yaw[k]);
    const ahead = north * cosine + east * sine;
    const right = east * cosine - north * sine;
    angles[at] = -Math.atan2(right, Math.sqrt(ahead ** 2 + down ** 2));
    angles[at + 1] = Math.atan2(ahead, down);
    angles[at + 2] = yaw[k];
  }
  return angles;
}

/** Derivatives of three series by time: differences of the neighbours, at the ends of the nearest two. */
function gradient(values, dt) {
  const out = new Float64Array(values.length);
  const last = values.length - 3;
  for (let at = 0; at < values.length; at++) {
    const low = Math.max(at - 3, at % 3);
    const high = Math.min(at + 3, last + (at % 3));
    out[at] = (values[high] - values[low]) / ((dt * (high - low)) / 3);
  }
  return out;
}

/** The body's rates (3 T), as a gyroscope measures them, from those of roll, pitch and yaw. */
function body_rates(rates, angles) {
  const out = new Float64Array(rates.length);
  for (let at = 0; at < rates.length; at += 3) {
    const [roll_rate, pitch_rate, yaw_rate] = [rates[at], rates[at + 1], rates[at + 2]];
    const sin_r = Math.sin(angles[at]);
    const cos_r = Math.cos(angles[at]);
    const cos_p = Math.cos(angles[at + 1]);
    out[at] = roll_rate - yaw_rate * Math.sin(angles[at + 1]);
    out[at + 1] = pitch_rate * cos_r + yaw_rate * sin_r * cos_p;
    out[at + 2] = yaw_rate * cos_r * cos_p - pitch_rate * sin_r;
  }
  return out;
}

/** Vectors (3 T), north-east-down, seen in the body's axes: turned by yaw, pitch, roll. */
function to_body(v, angles) {
  const out = new Float64Array(v.length);
  for (let at = 0; at < v.length; at += 3) {
    const [roll, pitch, yaw] = [angles[at], angles[at + 1], angles[at + 2]];
    const [north, east, down] = [v[at], v[at + 1], v[at + 2]];
    const ahead = north * Math.cos(yaw) + east * Math.sin(yaw);
    const right = east * Math.cos(yaw) - north * Math.sin(yaw);
    const below = ahead * Math.sin(pitch) + down * Math.cos(pitch);
    out[at] = ahead * Math.cos(pitch) - down * Math.sin(pitch);
    out[at + 1] = right * Math.cos(roll) + below * Math.sin(roll);
    out[at + 2] = below * Math.cos(roll) - right * Math.sin(roll);
  }
  return out;
}
