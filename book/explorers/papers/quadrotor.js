// Chapter 6: roll, pitch and yaw of a quadrotor from gyroscope, accelerometer and magnetometer. Twin of
// kalman_lib/papers/quadrotor.py, and its explorer. Series of three (roll, pitch, yaw; or x, y, z) lie step after step in a
// Float64Array (3 T). Angles in rad, rates in rad/s; earth north-east-down, body forward-right-down.
import { kalmanFilter, linearModel } from "../filters.js";
import { generator } from "../random.js";

const AXES = ["roll", "pitch", "yaw"], DEG = Math.PI / 180, GRAVITY = 9.81;
const FIELD = [38.13, 0.54, -23.79];                        // uT: the earth's field in Yogyakarta, 2022
const ROUTE = [[30, 0], [20, -65], [15, -115], [20, -80], [15, -100]];      // seconds straight on, after a turn (degrees)
const STEEPEST = 85 * DEG, REST = 6;

/** The paper's model: state [roll, its rate, pitch, its rate, yaw, its rate], measured: the angles, input: the rates. */
export function model(p) {
  const { dt } = p, q = p.q * DEG ** 2, tilt = (p.sigma_acc / GRAVITY) ** 2, R = [tilt, tilt, p.sigma_mag ** 2 / (FIELD[0] ** 2 + FIELD[1] ** 2)];
  const diagonal = (block, rows, columns, scale = () => 1) => Array.from({ length: 3 * rows }, (_, a) => Array.from({ length: 3 * columns }, (_, b) => {
    const i = Math.floor(a / rows);
    return Math.floor(b / columns) === i ? scale(i) * block[a % rows][b % columns] : 0;
  }));
  return linearModel({
    F: diagonal([[1, dt], [0, 0]], 2, 2), B: diagonal([[0], [1]], 2, 1), H: diagonal([[1, 0]], 1, 2),
    Q: diagonal([[dt ** 3 / 3, dt ** 2 / 2], [dt ** 2 / 2, dt]], 2, 2, () => q), R: diagonal([[1]], 1, 1, i => R[i]),
    x0: [0, 0, 0, 0, Math.PI, 0], P0: diagonal([[1, 0], [0, 0]], 2, 2, i => R[i]),
    residual(z, z_pred, y) { for (let i = 0; i < 3; i++) y[i] = wrap(z[i] - z_pred[i]); },
  });
}

export function run(p, { z, u }) {
  return kalmanFilter(model(p), z, u);
}

/** The same angle between -pi and pi. */
export function wrap(angle) {
  return angle >= -Math.PI && angle < Math.PI ? angle : angle - 2 * Math.PI * Math.floor((angle + Math.PI) / (2 * Math.PI));
}

// --- what each sensor says alone --------------------------------------------------------------------------------------

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
  const sin_r = Math.sin(roll), cos_r = Math.cos(roll);
  return Math.atan2(z * sin_r - y * cos_r, x * Math.cos(pitch) + (y * sin_r + z * cos_r) * Math.sin(pitch));
}

/** Rates of roll, pitch and yaw from the body's rates gyr = (p, q, r); beyond 85 deg of pitch those at 85. */
export function euler_rates(gyr, roll, pitch, out = new Float64Array(3)) {
  pitch = Math.max(-STEEPEST, Math.min(STEEPEST, pitch));
  const sin_r = Math.sin(roll), cos_r = Math.cos(roll), turn = gyr[1] * sin_r + gyr[2] * cos_r;
  out[1] = gyr[1] * cos_r - gyr[2] * sin_r;
  out[0] = gyr[0] + turn * Math.tan(pitch);
  out[2] = turn / Math.cos(pitch);
  return out;
}

// --- the filter -------------------------------------------------------------------------------------------------------

const METHOD = { kept: false, R_min: [(3 * DEG) ** 2, (3 * DEG) ** 2, (15 * DEG) ** 2], without: [], m: 1, window: 1, threshold: 4, gain: 30, largest: 1e4, q_bias: 1e-9 };

/** The three methods; what the numbers mean is told at the Python twin, class Method. */
export const METHODS = {
  literal: { ...METHOD, q: DEG ** 2, R_min: [0, 0, 0], m: 0.16, without: ["formulas", "Euler rates", "wrapping", "estimated tilt", "rest variance"] },
  paper: { ...METHOD, q: 30 * DEG ** 2 },
  adaptive: { ...METHOD, q: (0.1 * DEG) ** 2, kept: true, R_min: [0, 0, (15 * DEG) ** 2] },
};

/**
 * Filter a recording {t (T), gyr, acc, mag (3 T), rest_s} by a method: {angles, z, u, s, y, P, R (3 T), dynamic (T)}.
 * Each axis is a small Kalman filter with state [angle, s], s the error of the gyroscope's rate u. NaN: a silent sensor.
 * memo keeps the arrays, and what only depends on the sensors, for the next call.
 */
export function attitude({ t, gyr, acc, mag, rest_s }, how, memo = {}) {
  const T = t.length, { kept, q, without } = how, missing = name => without.includes(name);
  let rest = 0;
  while (rest < T && t[rest] - t[0] <= rest_s) rest++;
  if (memo.gyr !== gyr || memo.acc !== acc || memo.mag !== mag || memo.without !== without) {
    const { z, start } = measured(acc, mag, rest, how);
    Object.assign(memo, { gyr, acc, mag, without, dynamic_by: null, given: z, start, step: median_step(t), spread: spread(z, missing("rest variance") ? T : rest) });
    if (memo.angles?.length !== 3 * T) for (const name of ["angles", "z", "u", "s", "y", "P", "R"]) memo[name] = new Float64Array(3 * T);
  }
  const { given, angles, step } = memo, R_rest = memo.spread.map((variance, i) => Math.max(variance, how.R_min[i], 1e-12));
  const dynamic_by = [how.window, how.threshold].join();
  if (memo.dynamic_by !== dynamic_by) Object.assign(memo, { dynamic_by, dynamic: is_dynamic(t, mag, rest, how.window, how.threshold, step) });
  const { dynamic } = memo;
  const at_rest = [0, 1, 2].map(i => missing("rest mean") ? 0 : mean(gyr, i, rest)), largest = R_rest.map(R => how.largest * R);
  const P_s = kept ? (variance(gyr, 0, rest) + variance(gyr, 1, rest) + variance(gyr, 2, rest)) / 3 / rest_s : 0;
  const [plain, early, wrapping, own] = [missing("Euler rates"), missing("midpoint"), !missing("wrapping"), !missing("estimated tilt")];
  const x = Float64Array.from(memo.start), s = new Float64Array(3), u = new Float64Array(3), turn = new Float64Array(3);
  const P00 = new Float64Array(3), P01 = new Float64Array(3), P11 = new Float64Array(3).fill(P_s);
  const length = Math.max(1, whole(0.5 / step)), recent = new Float64Array(2 * length), seen = [0, 0];      // y^2 of the last 0.5 s
  memo.z.set(given);
  memo.y.fill(NaN);
  for (let i = 0; i < 3; i++) {
    memo.u[i] = memo.s[i] = memo.y[i] = 0;
    angles[i] = x[i];
    P00[i] = memo.P[i] = memo.R[i] = R_rest[i] * (dynamic[0] ? how.m : 1);
  }
  for (let k = 1, at = 3; k < T; k++, at += 3) {
    const dt = t[k] - t[k - 1], factor = dynamic[k] ? how.m : 1;
    for (let i = 0; i < 3; i++) turn[i] = (gyr[at + i] + gyr[at + i - 3]) / 2 - at_rest[i];     // the middle of the step
    if (plain) u.set(turn); else euler_rates(turn, x[0], x[1], u);
    if (!plain && !early) euler_rates(turn, x[0] + dt / 2 * (u[0] - s[0]), x[1] + dt / 2 * (u[1] - s[1]), u);
    for (let i = 0; i < 3; i++) {
      x[i] += dt * (u[i] - s[i]);
      P00[i] += dt * (dt * P11[i] - 2 * P01[i]);            // F P F' + Q
      if (kept) {
        P01[i] -= dt * P11[i];
        P00[i] += q * dt;
        P11[i] += how.q_bias * dt;
      } else {
        s[i] = 0;
        P00[i] += q * dt * dt * dt / 3;
        P01[i] = -q * dt * dt / 2;
        P11[i] = q * dt;
      }
    }
    if (own) memo.z[at + 2] = heading(mag[at], mag[at + 1], mag[at + 2], x[0], x[1]);
    for (let i = 0; i < 3; i++) {
      let R = factor * R_rest[i];
      if (given[at + i] === given[at + i]) {                // not NaN
        let y = memo.z[at + i] - x[i];
        if (wrapping) y = wrap(y);
        if (kept && i < 2) {
          recent[i * length + seen[i]++ % length] = y * y;
          let sum = 0;
          for (let j = i * length; j < (i + 1) * length; j++) sum += recent[j];
          R = how.gain * Math.min(Math.max(sum / Math.min(seen[i], length) - P00[i], R), factor * largest[i]);
        }
        const S = P00[i] + R, K0 = P00[i] / S, K1 = P01[i] / S;
        x[i] += K0 * y;
        s[i] += K1 * y;
        P00[i] = K0 * R;
        P11[i] -= K1 * P01[i];
        P01[i] = K1 * R;
        memo.y[at + i] = y;
      }
      memo.R[at + i] = R;
      memo.P[at + i] = P00[i];
    }
    if (wrapping) {
      x[0] = wrap(x[0]);
      x[2] = wrap(x[2]);
    }
    for (let i = 0; i < 3; i++) {
      angles[at + i] = x[i];
      memo.u[at + i] = u[i];
      memo.s[at + i] = s[i];
    }
  }
  return memo;
}

/** The measured angles z (3 T), and the mean angles at rest, where the filter starts. */
function measured(acc, mag, rest, { without }) {
  const z = new Float64Array(acc.length), alone = without.includes("formulas") ? printed_tilt : tilt;
  for (let at = 0; at < z.length; at += 3) [z[at], z[at + 1]] = alone(acc[at], acc[at + 1], acc[at + 2]);
  const start = [direction(z, 0, rest), direction(z, 1, rest)], own = !without.includes("estimated tilt");
  for (let at = 0; at < z.length; at += 3) z[at + 2] = heading(mag[at], mag[at + 1], mag[at + 2], own ? start[0] : z[at], own ? start[1] : z[at + 1]);
  return { z, start: [...start, direction(z, 2, rest)] };
}

/** Where (T) the variance of the magnetometer over the last window (s) exceeds the threshold times that at rest. */
export function is_dynamic(t, mag, rest, window, threshold, step = median_step(t)) {
  const T = t.length, out = new Uint8Array(T), n = Math.min(T, Math.max(2, whole(window / step))), sums = new Float64Array(6);
  const middle = [0, 1, 2].map(i => mean(mag, i, rest)), most = threshold * (variance(mag, 0, rest) + variance(mag, 1, rest) + variance(mag, 2, rest));
  let count = 0, in_rest = 0;
  const take = (k, sign) => {
    const known = mag[3 * k] + mag[3 * k + 1] + mag[3 * k + 2];
    if (known !== known) return;
    count += sign;
    if (k < rest) in_rest++;
    for (let i = 0; i < 3; i++) {
      const value = mag[3 * k + i] - middle[i];
      sums[i] += sign * value;
      sums[i + 3] += sign * value * value;
    }
  };
  for (let k = 0; k < T; k++) {
    take(k, 1);
    if (k >= n) take(k - n, -1);
    const c = Math.max(count, 1);
    out[k] = (sums[3] + sums[4] + sums[5]) / c - (sums[0] ** 2 + sums[1] ** 2 + sums[2] ** 2) / (c * c) > most;
  }
  return in_rest ? out : out.fill(0);
}

/** Mean and variance of column i over the first `count` steps, NaN left out. */
function mean(values, i, count) {
  let sum = 0, known = 0;
  for (let at = i; at < 3 * count; at += 3) if (values[at] === values[at]) { sum += values[at]; known++; }
  return sum / known;
}

function variance(values, i, count) {
  const middle = mean(values, i, count);
  let sum = 0, known = 0;
  for (let at = i; at < 3 * count; at += 3) if (values[at] === values[at]) { sum += (values[at] - middle) ** 2; known++; }
  return sum / known;
}

/** The mean direction, which +179 and -179 degrees have at 180; 0 where the sensor is silent. */
function direction(angles, i, count) {
  let sin = 0, cos = 0;
  for (let at = i; at < 3 * count; at += 3) if (angles[at] === angles[at]) { sin += Math.sin(angles[at]); cos += Math.cos(angles[at]); }
  return Math.atan2(sin, cos);
}

/** Variances (3) of the angles around their mean directions; 0 without any. */
function spread(z, count) {
  return [0, 1, 2].map(i => {
    const middle = direction(z, i, count);
    let sum = 0, known = 0;
    for (let at = i; at < 3 * count; at += 3) if (z[at] === z[at]) { sum += wrap(z[at] - middle) ** 2; known++; }
    return known ? sum / known : 0;
  });
}

/** The nearest whole number; a half goes to the even one, as in Python. */
function whole(value) {
  const low = Math.floor(value);
  return value - low === 0.5 ? low + low % 2 : Math.round(value);
}

function median_step(t) {
  const steps = t.subarray(1).map((value, k) => value - t[k]).sort(), half = steps.length >> 1;
  return steps.length % 2 ? steps[half] : (steps[half - 1] + steps[half]) / 2;
}

// --- the flight -------------------------------------------------------------------------------------------------------

/**
 * A SYNTHETIC flight along the paper's route: the thrust is acceleration - gravity + drag, and its direction gives roll and
 * pitch. {T, t, x (6 T), z (3 T), u = gyr, acc, mag, truth (3 T), rest_s}. Noise is white, but for a swaying of the craft
 * and a magnetic disturbance by its motors.
 */
export function simulate(p, rng) {
  const { dt } = p, { t, yaw, speed, aloft } = route(dt), T = t.length, of = n => new Float64Array(n * T), sigma = [1, 1, 0.5].map(value => p.sway * value);
  const sway = coloured(rng, T, dt, 0.5), disturbance = coloured(rng, T, dt, 2), bias = sigma.map(() => p.bias * rng.normal());
  const velocity = of(3), force = of(3), truth = of(3), x = of(6), gyr = of(3), acc = of(3), mag = of(3);
  for (let k = 0; k < T; k++) {
    velocity[3 * k] = speed[k] * Math.cos(yaw[k]);
    velocity[3 * k + 1] = speed[k] * Math.sin(yaw[k]);
  }
  gradient(velocity, dt, force);
  for (let k = 0, at = 0; k < T; k++, at += 3) {
    for (let i = 0; i < 3; i++) force[at + i] += sigma[i] * aloft[k] * sway[at + i];
    force[at + 2] -= GRAVITY;                               // the specific force, north-east-down
    const north = -force[at] - 0.35 * velocity[at], east = -force[at + 1] - 0.35 * velocity[at + 1], down = -force[at + 2];
    const sin = Math.sin(yaw[k]), cos = Math.cos(yaw[k]), ahead = north * cos + east * sin, right = east * cos - north * sin;
    truth[at] = -Math.atan2(right, Math.sqrt(ahead ** 2 + down ** 2));
    truth[at + 1] = Math.atan2(ahead, down);
    truth[at + 2] = yaw[k];
  }
  const rates = gradient(truth, dt, of(3)), field = of(3);
  for (let k = 0; k < T; k++) field.set(FIELD, 3 * k);
  to_body(force, truth, acc);
  to_body(field, truth, mag);
  for (let k = 0, at = 0; k < T; k++, at += 3) {
    const r = rates[at], q = rates[at + 1], w = rates[at + 2], sin_r = Math.sin(truth[at]), cos_r = Math.cos(truth[at]), cos_p = Math.cos(truth[at + 1]);
    gyr[at] = r - w * Math.sin(truth[at + 1]);
    gyr[at + 1] = q * cos_r + w * sin_r * cos_p;
    gyr[at + 2] = w * cos_r * cos_p - q * sin_r;
    for (let i = 0; i < 3; i++) {
      gyr[at + i] += DEG * (bias[i] + p.sigma_gyr * rng.normal());
      acc[at + i] += p.sigma_acc * rng.normal();
      mag[at + i] += aloft[k] * disturbance[at + i] + p.sigma_mag * rng.normal();
      x[2 * (at + i)] = truth[at + i] = wrap(truth[at + i]);
      x[2 * (at + i) + 1] = rates[at + i];
    }
  }
  const z = () => measured(acc, mag, 0, { without: ["estimated tilt"] }).z;
  return { T, t, x, u: gyr, gyr, acc, mag, truth, rest_s: REST, get z() { return z(); } };
}

/** Times t, yaw (rad), speed (m/s), and how much the craft is aloft (0 to 1). */
function route(dt) {
  const corners = [[0, 180, 0], [REST + 2, 180, 0]];        // s, degrees, m/s; it faces south
  let yaw = 180;
  for (const [seconds, turn] of ROUTE) {
    const [now, before] = corners.at(-1), later = now + Math.abs(turn) / 25;        // 25 deg/s
    yaw += turn;
    if (turn) corners.push([now, before, 0.5], [later, yaw, 0.5]);
    corners.push([later, yaw, 2], [later + seconds, yaw, 2]);
  }
  const end = corners.at(-1)[0];
  corners.push([end, yaw, 0], [end + 4, yaw, 0]);
  const t = new Float64Array(Math.floor((end + 4) / dt + 1e-6) + 1).map((_, k) => k * dt);
  const follow = (i, tau) => {
    let next = 1;
    const values = t.map(now => {
      while (next < corners.length - 1 && corners[next][0] < now) next++;
      const [a, b] = [corners[next - 1], corners[next]];
      return b[0] > a[0] ? a[i] + (b[i] - a[i]) * (now - a[0]) / (b[0] - a[0]) : b[i];
    });
    return smooth(values, bell(dt, tau, 1));
  };
  const aloft = t.map(now => { const up = Math.min(Math.max((now - REST) / 2, 0), 1); return up * up * (3 - 2 * up); });
  return { t, yaw: follow(1, 0.3).map(value => value * DEG), speed: follow(2, 0.8).map((value, k) => value * aloft[k]), aloft };
}

/** A bell of the width tau, both in s, scaled so that the sum of its values to this power is 1. */
function bell(dt, tau, power) {
  const n = Math.floor(4 * tau / dt + 1e-9), values = new Float64Array(2 * n + 1).map((_, i) => Math.exp(-0.5 * ((i - n) * dt / tau) ** 2));
  const sum = values.reduce((total, value) => total + value ** power, 0) ** (1 / power);
  return values.map(value => value / sum);
}

function convolve(values, weights) {
  return new Float64Array(values.length - weights.length + 1).map((_, k) => {
    let sum = 0;
    for (let j = 0; j < weights.length; j++) sum += weights[j] * values[k + j];
    return sum;
  });
}

function smooth(values, weights) {
  const half = weights.length >> 1, last = values.length - 1;
  return convolve(new Float64Array(values.length + 2 * half).map((_, k) => values[Math.min(Math.max(k - half, 0), last)]), weights);
}

/** Three random signals (3 T) of standard deviation 1 that change within tau (s): drawn every tau / 10, straight between. */
function coloured(rng, T, dt, tau) {
  const weights = bell(0.1, 1, 2), out = new Float64Array(3 * T);
  for (let i = 0; i < 3; i++) {
    const values = convolve(new Float64Array(Math.ceil(10 * T * dt / tau) + 1 + weights.length).map(rng.normal), weights);
    for (let k = 0; k < T; k++) {
      const place = 10 * k * dt / tau, j = Math.floor(place);
      out[3 * k + i] = values[j] + (place - j) * (values[j + 1] - values[j]);
    }
  }
  return out;
}

/** Derivatives of three series by time: differences of the neighbours, at the ends of the nearest two. */
function gradient(values, dt, out) {
  const last = values.length - 3;
  for (let at = 0; at < values.length; at++) {
    const low = Math.max(at - 3, at % 3), high = Math.min(at + 3, last + at % 3);
    out[at] = (values[high] - values[low]) / (dt * (high - low) / 3);
  }
  return out;
}

/** Vectors (3 T), north-east-down, seen in the body's axes: turned by yaw, pitch, roll. */
function to_body(v, angles, out) {
  for (let at = 0; at < v.length; at += 3) {
    const roll = angles[at], pitch = angles[at + 1], yaw = angles[at + 2], cos_y = Math.cos(yaw), sin_y = Math.sin(yaw);
    const ahead = v[at] * cos_y + v[at + 1] * sin_y, y = v[at + 1] * cos_y - v[at] * sin_y, z = ahead * Math.sin(pitch) + v[at + 2] * Math.cos(pitch);
    out[at] = ahead * Math.cos(pitch) - v[at + 2] * Math.sin(pitch);
    out[at + 1] = y * Math.cos(roll) + z * Math.sin(roll);
    out[at + 2] = z * Math.cos(roll) - y * Math.sin(roll);
  }
}

// --- measures of error ------------------------------------------------------------------------------------------------

/** Equation (25) for three columns: |mean of reference - mean of estimate| / |mean of reference|, in percent. */
export function galat(reference, estimate) {
  const T = reference.length / 3;
  return [0, 1, 2].map(i => galat_of(mean(reference, i, T), mean(estimate, i, T)));
}

const galat_of = (reference, estimate) => 100 * Math.abs(reference - estimate) / Math.abs(reference);

/** Root mean square over time of the wrapped errors (3), degrees; NaN is left out. */
export function rmse_deg(truth, angles) {
  return [0, 1, 2].map(i => {
    let sum = 0, known = 0;
    for (let at = i; at < truth.length; at += 3) {
      const error = wrap(angles[at] - truth[at]);
      if (error === error) { sum += error * error; known++; }
    }
    return Math.sqrt(sum / known) / DEG;
  });
}

// --- what is shown ----------------------------------------------------------------------------------------------------

const SKIP = 20;                // of the flight every twentieth sample is drawn, 0.4 s: about one for a pixel
const WORDS = {
  made: { id: "Penerbangan sintetis (benih acak {seed}).", en: "The flight is synthetic (random seed {seed})." },
  rmse: { id: "RMSE terhadap sudut sebenarnya: roll {roll}°, pitch {pitch}°, yaw {yaw}°; sensor saja {z_roll}°, {z_pitch}°, {z_yaw}°.",
          en: "RMSE against the true angles: roll {roll}°, pitch {pitch}°, yaw {yaw}°; the sensors alone {z_roll}°, {z_pitch}°, {z_yaw}°." },
  lies: { id: "Rumus galat makalah berkata lain: untuk {axis} sensor saja {z} %, filter {x} %, padahal filterlah yang lebih {near} sudut sebenarnya.",
          en: "The paper’s error formula says otherwise: for {axis} the sensor alone {z} %, the filter {x} %, although it is the filter that is {near} the true angle." },
  closer: { id: "dekat ke", en: "closer to" }, farther: { id: "jauh dari", en: "farther from" },
  no_mag: { id: "Tanpa magnetometer, yaw dimulai dari 0 dan hanya giroskop yang memutarnya.", en: "Without the magnetometer the yaw starts at 0 and only the gyroscope turns it." },
  no_turn: { id: "Tanpa magnetometer dan giroskop, yaw tetap 0.", en: "Without magnetometer and gyroscope the yaw stays 0." },
  fixed: { id: "Pada cara adaptif m, q, jendela, dan ambang tidak dipakai.", en: "The adaptive method uses neither m, q, window nor threshold." },
  steep: { id: "Pitch mencapai {steep}°: di atas 75° sudut Euler gagal.", en: "The pitch reaches {steep}°: beyond 75° Euler angles fail." },
};

/** The method with the settings of the reader; the adaptive one has its own. */
const chosen = s => METHODS[s.method].kept ? METHODS[s.method] : { ...METHODS[s.method], m: s.m, q: s.q * DEG ** 2, window: s.window, threshold: s.threshold };

function compute(s, memo) {
  const renew = (part, key, make) => { if (memo[`${part} key`] !== key) Object.assign(memo, { [part]: make(), [`${part} key`]: key }); return key; };
  const data = renew("flight", s.seed, () => simulate(s, generator(s.seed))), { flight } = memo;
  const used = renew("sensors", `${data} ${s.gyr} ${s.acc} ${s.mag}`, () => ({ ...flight, z: null,
    gyr: s.gyr ? flight.gyr : new Float64Array(3 * flight.T), ...Object.fromEntries(["acc", "mag"].filter(name => !s[name]).map(name => [name, new Float64Array(3 * flight.T).fill(NaN)])) }));
  renew("shown", [used, s.method, s.m, s.q, s.window, s.threshold].join(), () => {
    const how = chosen(s), result = attitude(memo.sensors, how, memo.kept ??= {}), { angles, z } = result, { T, truth } = flight;
    for (let at = 0; at < angles.length; at++) angles[at] = wrap(angles[at]);
    const means = values => [0, 1, 2].map(i => mean(values, i, T));
    let found;                  // what the sentences and tables say: they follow a moving slider less often than the figures
    const measures = () => found ??= { rmse: rmse_deg(truth, angles), rmse_z: rmse_deg(truth, z), truth: means(truth), mean: means(angles), mean_z: means(z) };
    return { flight, result, how, lines: lines(flight, result, memo), measures };
  });
  return { ...memo.shown, k: Math.min(Math.round(s.moment / s.dt), flight.T - 1) };
}

/** What the panels draw, in degrees: estimate and truth without a jump where they go round, the measurement beside the estimate. */
function lines({ T, t, truth }, { angles, z }, memo) {
  const count = Math.ceil(T / SKIP), series = memo.series ??= Array.from({ length: 10 }, () => new Float64Array(count));
  for (let i = 0; i < 3; i++) {
    const [x, measured, actual] = series.slice(3 * i, 3 * i + 3);
    let real = truth[i], before = real + wrap(angles[i] - real);
    for (let j = 0, at = i; j < count; j++, at += 3 * SKIP) {
      real += wrap(truth[at] - real);
      before += wrap(angles[at] - before);
      x[j] = before / DEG;
      measured[j] = (before + wrap(z[at] - before)) / DEG;
      actual[j] = real / DEG;
      series[9][j] = t[j * SKIP];
    }
  }
  return series;
}

const size = (value, t) => t.decimal(Number(value.toFixed(Math.abs(value) < 10 ? 2 : 1)), 6);

function outcome(r, s, t) {
  const say = (key, values) => t.say(WORDS[key], values), show = value => size(value, t), sentences = [];
  const { rmse, rmse_z, truth, mean, mean_z } = r.measures(), error = (means, i) => galat_of(truth[i], means[i]);
  sentences.push(say("rmse", Object.fromEntries(AXES.flatMap((axis, i) => [[axis, show(rmse[i])], [`z_${axis}`, show(rmse_z[i])]]))));
  const lies = [1, 0, 2].find(i => (rmse[i] - rmse_z[i]) * (error(mean, i) - error(mean_z, i)) < 0);
  if (lies !== undefined) sentences.push(say("lies", { near: say(rmse[lies] < rmse_z[lies] ? "closer" : "farther"), axis: AXES[lies], x: show(error(mean, lies)), z: show(error(mean_z, lies)) }));
  if (!s.mag) sentences.push(say(s.gyr ? "no_mag" : "no_turn"));
  if (r.how.kept) sentences.push(say("fixed"));
  let steep = 0;
  for (let at = 1; at < r.result.angles.length; at += 3) steep = Math.max(steep, Math.abs(r.result.angles[at]));
  if (steep > 75 * DEG) sentences.push(say("steep", { steep: show(steep / DEG) }));
  return [...sentences, say("made", { seed: String(s.seed) })].join(" ");
}

function facts(r, s, t) {
  const { rmse, rmse_z, truth, mean, mean_z } = r.measures();
  const row = (id, en, value) => [t.say({ id, en }), ...AXES.map((_, i) => size(value(i), t))];
  return { head: ["", ...AXES], rows: [
    row("RMSE sensor saja (°)", "RMSE of the sensors alone (°)", i => rmse_z[i]),
    row("RMSE filter ini (°)", "RMSE of this filter (°)", i => rmse[i]),
    row("galat makalah, sensor saja (%)", "the paper’s error, sensors alone (%)", i => galat_of(truth[i], mean_z[i])),
    row("galat makalah, filter ini (%)", "the paper’s error, this filter (%)", i => galat_of(truth[i], mean[i])),
    row("rata-rata sudut sebenarnya (°)", "mean of the true angle (°)", i => truth[i] / DEG),
    row("rata-rata filter ini (°)", "mean of this filter (°)", i => mean[i] / DEG)] };
}

function numbers({ flight, result }, s, t) {
  const rows = [], show = value => t.decimal(value, 4);
  for (let k = 0; k < flight.T; k += 25) {
    rows.push([show(flight.t[k]), ...AXES.flatMap((_, i) => [flight.truth, result.z, result.angles].map(values => show(values[3 * k + i] / DEG)).concat(show(Math.sqrt(result.P[3 * k + i]) / DEG), show(Math.sqrt(result.R[3 * k + i]) / DEG)))]);
  }
  return { head: ["t (s)", ...AXES.flatMap(axis => [`${axis}_true (°)`, `${axis}_z (°)`, `${axis} (°)`, "√P (°)", "√R (°)"])], rows };
}

// --- the craft --------------------------------------------------------------------------------------------------------

const CIRCLE = Array.from({ length: 33 }, (_, i) => [Math.cos(i * Math.PI / 16), Math.sin(i * Math.PI / 16), 0]);
const TIPS = [[0.75, 0.75, 0], [-0.75, -0.75, 0], [0.75, -0.75, 0], [-0.75, 0.75, 0]];
const SHAPE = [[[-0.2, 0, 0], [1.25, 0, 0], [1, 0.14, 0], [1.25, 0, 0], [1, -0.14, 0]], TIPS.slice(0, 2), TIPS.slice(2),
               ...TIPS.map(tip => CIRCLE.map(point => point.map((value, i) => tip[i] + 0.38 * value)))];

/** Where a point of the body is seen from the south and from above: [to the right, up]. */
function seen([x, y, z], [roll, pitch, yaw]) {
  [y, z] = [y * Math.cos(roll) - z * Math.sin(roll), y * Math.sin(roll) + z * Math.cos(roll)];
  [x, z] = [x * Math.cos(pitch) + z * Math.sin(pitch), z * Math.cos(pitch) - x * Math.sin(pitch)];
  return [x * Math.sin(yaw) + y * Math.cos(yaw), 0.6 * (x * Math.cos(yaw) - y * Math.sin(yaw)) - 0.8 * z];
}

function trace(ctx, X, Y, points) {
  ctx.beginPath();
  for (const [x, y] of points) ctx.lineTo(X(x), Y(y));
  ctx.stroke();
}

function craft({ flight, result, k }, s, t) {
  const [truth, x] = [flight.truth, result.angles].map(values => values.subarray(3 * k, 3 * k + 3)), by = s.larger ? 5 : 1;
  const draw = angles => (ctx, X, Y) => { for (const line of SHAPE) trace(ctx, X, Y, line.map(point => seen(point, [by * angles[0], by * angles[1], angles[2]]))); };
  const paint = (ctx, X, Y, colours) => {
    trace(ctx, X, Y, CIRCLE.map(point => seen(point.map(value => 1.75 * value), [0, 0, 0])));
    ctx.font = `600 12px ${colours.font}`;
    ctx.fillStyle = colours.words;
    ctx.textBaseline = "middle";
    ctx.textAlign = "center";
    [...t.say({ id: "UTSB", en: "NESW" })].forEach((letter, i) => ctx.fillText(letter, ...[X, Y].map((scale, j) => scale(seen([2, 0, 0], [0, 0, i * Math.PI / 2])[j]))));
    ctx.textAlign = "left";
    AXES.forEach((axis, i) => ctx.fillText(`${axis} ${size(x[i] / DEG, t)}° (${size(truth[i] / DEG, t)}°)`, 8, 14 + 17 * i));
  };
  return { xlim: [-4, 2.2], ylim: [-1.45, 1.75], layers: [{ look: "quiet", paint }, { look: "estimate", paint: draw(x), label: "x" }, { look: "truth", paint: draw(truth), label: "x_true" }] };
}

/** One angle against time; the stretches where the filter uses m R are shaded. */
function panel(i, title) {
  return { title, xlabel: "t (s)", height: 150, half: true,
    alt: { id: `Grafik ${AXES[i]} terhadap waktu: titik pengukuran, garis sebenarnya, dan garis estimasi.`, en: `Plot of the ${AXES[i]} against time: measured dots, the true line and the estimated line.` },
    drag: time => ({ moment: time }),
    draw({ lines, result, flight, how, k }) {
      const [x, z, truth] = lines.slice(3 * i, 3 * i + 3), t = lines[9], end = flight.t[flight.T - 1];
      const paint = (ctx, X, Y, colours) => {
        ctx.fillStyle = colours.band;
        for (let k = 0, from = -1; k <= flight.T; k++) {
          if (k < flight.T && result.dynamic[k]) { if (from < 0) from = k; }
          else if (from >= 0) { ctx.fillRect(X(flight.t[from]), 0, X(flight.t[k - 1]) - X(flight.t[from]), 1e4); from = -1; }
        }
      };
      return { xlim: [0, end], layers: [how.kept ? null : { look: "band", paint, label: i ? "" : "m R" }, ...Object.entries({ measurement: [z, "z"], estimate: [x, "x"], truth: [truth, "x_true"] })
        .map(([look, [y, label]]) => ({ look, x: t, y, label: i ? "" : label })), { look: "quiet", at: flight.t[k] }] };
    } };
}

// --- the hand check ---------------------------------------------------------------------------------------------------

function question(r, s, t, random) {
  const axis = random.whole(2), at = 3 * r.k + axis, square = DEG ** 2, near = (a, b) => Math.abs(a - b) <= 0.02 * Math.abs(b), pick = (low, high) => low + random.whole(high - low + 1);
  const R = r.result.R[at] / square, P = r.result.P[at] / square, P_pred = P < R ? P * R / (R - P) : P, times = [0.16, 10, 100][random.whole(3)];
  const ahead = pick(171, 179), z = -pick(170, 179), y = 360 + z - ahead, { truth, mean } = r.measures(), reference = truth[axis] / DEG, estimate = mean[axis] / DEG;
  const pitch = pick(4, 30), sign = random.whole(2) ? 1 : -1, ax = Number((sign * GRAVITY * Math.sin(pitch * DEG)).toFixed(2)), az = -Number((GRAVITY * Math.cos(pitch * DEG)).toFixed(2));
  const given = { axis: AXES[axis], time: t.decimal(r.flight.t[r.k], 4), P: t.decimal(P_pred), R: t.decimal(R), times: t.decimal(times), ahead: String(ahead), z: t.decimal(z), reference: t.decimal(reference, 4), estimate: t.decimal(estimate, 4), ax: t.decimal(ax), az: t.decimal(az) };
  const kinds = [
    { text: { id: "Pada t = {time} s, untuk {axis}, P_pred = {P} deg² dan R = {R} deg². Seandainya wahana dinamis dan m = {times}, berapa penguatan K sudutnya?", en: "At t = {time} s, for the {axis}, P_pred = {P} deg² and R = {R} deg². If the craft were dynamic and m = {times}, what would be the gain K of the angle?" },
      answer: P_pred / (P_pred + times * R), tolerance: 0.02,
      hint: value => near(value, P_pred / (P_pred + R)) ? { id: "Itu K tanpa m. Pakailah m R.", en: "That is K without m. Use m R." } : { id: "K = P_pred / (P_pred + m R): m di bawah 1 memperbesar K.", en: "K = P_pred / (P_pred + m R): an m below 1 raises K." } },
    { text: { id: "Prediksi yaw {ahead}°, pengukurannya {z}°. Berapa inovasinya, dalam derajat?", en: "The predicted yaw is {ahead}°, the measured one {z}°. What is the innovation, in degrees?" },
      answer: y,
      hint: value => near(value, z - ahead) ? { id: "Itu jalan yang jauh: tambahkan 360°.", en: "That is the long way round: add 360°." }
        : { id: "Hitung z − x_pred, lalu tambahkan 360° supaya hasilnya antara −180° dan 180°.", en: "Take z − x_pred, then add 360° to bring it between −180° and 180°." } },
    { text: { id: "Rata-rata {axis} yang sebenarnya {reference}°, rata-rata filter {estimate}°. Berapa galat menurut makalah, dalam persen?", en: "The mean of the true {axis} is {reference}°, that of the filter {estimate}°. What is the error by the paper’s formula, in percent?" },
      answer: galat_of(Number(reference.toPrecision(4)), Number(estimate.toPrecision(4))), tolerance: 0.02,
      hint: value => near(100 * value, galat_of(reference, estimate)) ? { id: "Dalam persen: kalikan 100.", en: "In percent: times 100." } : near(value, galat_of(estimate, reference)) ? { id: "Bagilah dengan rata-rata yang sebenarnya.", en: "Divide by the true mean." }
        : { id: "|rata-rata sebenarnya − rata-rata filter| / |rata-rata sebenarnya| × 100.", en: "|true mean − mean of the filter| / |true mean| × 100." } },
    { text: { id: "Diam, akselerometer menunjukkan a_x = {ax}, a_y = 0, a_z = {az} m/s². Berapa pitch, dalam derajat?", en: "At rest the accelerometer shows a_x = {ax}, a_y = 0, a_z = {az} m/s². What is the pitch, in degrees?" },
      answer: Math.atan2(ax, -az) / DEG,
      hint: value => near(value, Math.atan2(ax, -az)) ? { id: "Itu dalam radian: kalikan 180/π.", en: "That is in radians: times 180/π." } : near(value, -sign * pitch) ? { id: "Hidung naik berarti pitch positif, dan a_x positif.", en: "Nose up means a positive pitch, and a positive a_x." }
        : { id: "pitch = arctan(a_x / √(a_y² + a_z²)).", en: "pitch = arctan(a_x / √(a_y² + a_z²))." } },
  ];
  const kind = kinds[random.whole(kinds.length)];
  return { text: t.say(kind.text, given), answer: kind.answer, tolerance: kind.tolerance, hint: value => t.say(kind.hint(value), given) };
}

// --- the view ---------------------------------------------------------------------------------------------------------

const adaptive = s => METHODS[s.method].kept, check = (name, id, en) => ({ kind: "check", name, default: true, id, en });
const factor = m => ({ id: `m = ${String(m).replace(".", ",")}`, en: `m = ${m}`, set: { m }, pressed: s => s.m === m && !adaptive(s), disabled: adaptive });

export const views = {
  flight: {
    name: { id: "Sikap quadrotor", en: "The attitude of the quadrotor" },
    noise: true,
    controls: [
      { kind: "select", name: "method", default: "paper", id: "Cara", en: "Method", options: [
        ["paper", { id: "makalah, dibetulkan", en: "the paper, corrected" }], ["adaptive", { id: "adaptif", en: "adaptive" }], ["literal", { id: "persis seperti tercetak", en: "to the letter of the paper" }]] },
      { name: "moment", symbol: "t", unit: "s", min: 0, max: 126, step: 0.1, default: 60, id: "saat yang digambar", en: "the moment that is drawn" },
      { kind: "buttons", items: [{ play: "moment", seconds: 40, id: "Terbangkan", en: "Fly" }, factor(0.16), factor(1), factor(10)] },
      ...["m", "q", "window", "threshold"].map(name => ({ name, symbol: name.length > 1 ? "" : name, disabled: adaptive })),
      check("gyr", "giroskop dipakai", "gyroscope in use"), check("acc", "akselerometer dipakai", "accelerometer in use"), check("mag", "magnetometer dipakai", "magnetometer in use"),
      check("larger", "kemiringan wahana digambar 5 kali lebih besar", "tilt of the craft drawn 5 times as large"),
    ],
    compute,
    plots: [panel(0, { id: "Roll, guling (°)", en: "Roll (°)" }), panel(1, { id: "Pitch, angguk (°)", en: "Pitch (°)" }), panel(2, { id: "Yaw, geleng (°)", en: "Yaw (°)" }),
      { title: { id: "Wahana", en: "The craft" }, height: 150, half: true, equal: true, bare: true, draw: craft,
        alt: { id: "Wahana dilihat dari selatan dan dari atas: estimasi tebal, sudut sebenarnya tipis, panahnya hidung.", en: "The craft seen from the south and from above: estimate thick, true angles thin, the arrow is its nose." } }],
    outcome, facts, numbers, question,
  },
};
