// The first explorer of chapter 6: one axis in the hand, and three opinions of it. It is synthetic, or the
// reader's own phone (phone.js).
import { rmse } from "../../numerics/metrics.js";
import { generator } from "../../numerics/random.js";
import { HAND_STEP, PUSHED, SECONDS, addUp, filterHeld, hold } from "./hand.js";
import { DEG } from "./model.js";
import * as phone from "./phone.js";
import { gainQuestion } from "./questions.js";
import { size } from "./figures.js";
import { TILT, TILT_CONTROLS } from "./words.js";

const ARM = 1; // length of the craft's arm, in its figure
const EVERYWHERE = 1e4; // pixels: beyond the canvas
const LARGEST = 45; // degrees that the reader can hold it at

const { hasPhone } = phone;

function compute(s, memo) {
  return hasPhone(s) ? phone.follow(s) : ofOneAxis(s, memo);
}

function ofOneAxis(s, memo) {
  const held = hold(generator(s.seed), s);
  memo.filter = filterHeld(s, held, memo.filter);
  const { T, x, z, u } = held;
  const gyro = addUp(u);
  const estimate = memo.filter.x;
  const k = Math.min(T, Math.max(1, Math.round(s.when / HAND_STEP))) - 1;
  const t = Float64Array.from(x, (_, step) => HAND_STEP * (step + 1));
  const [of_gyro, of_acc, of_filter] = [gyro, z, estimate].map((angles) => rmse(x, angles)[0]);
  const off = { gyro: of_gyro, acc: of_acc, filter: of_filter };
  return { T, t, x, z, u, gyro, estimate, filter: memo.filter, k, rmse: off };
}

// --- figures -----------------------------------------------------------------------------------------------

function drawAngles(r, s) {
  if (hasPhone(s)) {
    return phone.drawAngle(r, s);
  }
  const { t, x, z, gyro, estimate, k } = r;
  return {
    xlim: [0, SECONDS],
    layers: [
      { look: "band", paint: paintPush },
      { look: "measurement", x: t, y: z, label: TILT.acc },
      { look: "prediction", x: t, y: gyro, label: TILT.gyro },
      { look: "estimate", x: t, y: estimate, label: TILT.filter },
      { look: "truth", x: t, y: x, label: "x_true" },
      { look: "quiet", at: t[k] },
    ],
  };
}

/** A band over the second in which the craft is pushed. */
function paintPush(ctx, X, Y, colours) {
  ctx.fillStyle = colours.band;
  ctx.fillRect(X(PUSHED[0]), 0, X(PUSHED[1]) - X(PUSHED[0]), EVERYWHERE);
}

/** The craft from behind, four times: as it is, and as gyroscope, accelerometer and filter see it. */
function drawCraft({ x, z, gyro, estimate, k }, s) {
  if (hasPhone(s)) {
    return { xlim: [0, 1], ylim: [0, 1], layers: [] };
  }
  const pushed = k * HAND_STEP + HAND_STEP >= PUSHED[0] && k * HAND_STEP + HAND_STEP < PUSHED[1];
  return {
    xlim: [-1.6, 1.6],
    ylim: [-0.85, 0.75],
    layers: [
      { look: "prediction", paint: paintArms(gyro[k]), label: TILT.gyro },
      { look: "measurement", paint: paintArms(z[k]), label: TILT.acc },
      { look: "estimate", paint: paintArms(estimate[k]), label: TILT.filter },
      { look: "truth", paint: paintArms(x[k]), label: "x_true" },
      pushed && s.push !== 0 && { look: "truth", paint: paintArrow(-Math.sign(s.push)) },
    ],
  };
}

/** Two arms with a rotor each, right side down for a positive angle (degrees). */
function paintArms(angle) {
  const cosine = Math.cos(angle * DEG);
  const sine = Math.sin(angle * DEG);
  const place = (along, up) => [along * cosine + up * sine, up * cosine - along * sine];
  const lines = [
    [place(-ARM, 0), place(ARM, 0)],
    ...[-ARM, ARM].flatMap((tip) => [
      [place(tip, 0), place(tip, 0.16)],
      [place(tip - 0.3, 0.16), place(tip + 0.3, 0.16)],
    ]),
  ];
  return (ctx, X, Y) => lines.forEach((line) => paintLine(ctx, X, Y, line));
}

/** The push: an arrow below the craft, to the right for side 1. */
function paintArrow(side) {
  return (ctx, X, Y) => {
    paintLine(ctx, X, Y, [
      [-0.4 * side, -0.7],
      [0.4 * side, -0.7],
      [0.25 * side, -0.6],
      [0.4 * side, -0.7],
      [0.25 * side, -0.8],
    ]);
  };
}

function paintLine(ctx, X, Y, points) {
  ctx.beginPath();
  points.forEach(([right, up]) => ctx.lineTo(X(right), Y(up)));
  ctx.stroke();
}

/** The pointer takes the right arm. */
function turnByHand(right, up) {
  if (Math.abs(right) < 0.1) {
    return null;
  }
  const angle = -Math.atan2(up * Math.sign(right), Math.abs(right)) / DEG;
  return { held: Math.round(Math.max(-LARGEST, Math.min(LARGEST, angle))), when: 8 };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  if (hasPhone(s)) {
    return phone.outcome(r, s, t);
  }
  const { k, rmse: off, x, z, gyro, estimate } = r;
  const round = (angle) => size(Number(angle.toFixed(1)), t);
  const now = { x: round(x[k]), z: round(z[k]), gyro: round(gyro[k]), filter: round(estimate[k]) };
  const all = { gyro: size(off.gyro, t), z: size(off.acc, t), filter: size(off.filter, t) };
  return [
    t.say(TILT.all, all),
    t.say(TILT.now, { ...now, when: t.decimal(r.t[k]) }),
    t.say(TILT.gain, { K: r.filter.K[r.T - 1], R: s.R_acc }),
  ].join(" ");
}

function numbers(r, s, t) {
  if (hasPhone(s)) {
    return phone.numbers(r, s, t);
  }
  const { T, t: time, x, z, u, gyro, estimate, filter } = r;
  const rows = [];
  for (let k = 4; k < T; k += 5) {
    const values = [time[k], x[k], u[k], gyro[k], z[k], filter.K[k], estimate[k]];
    rows.push(values.map((value) => t.decimal(value)));
  }
  return { head: ["t (s)", "x_true (°)", "u (°/s)", t.say(TILT.gyro), "z (°)", "K", "x (°)"], rows };
}

const endOf = (s) => (hasPhone(s) ? phone.lastTime(s) : SECONDS);
const isSynthetic = (s) => !hasPhone(s);

const sliders = [
  { name: "R_acc", symbol: "R", unit: "°²", log: true, min: 0.01, max: 1e4, step: 0.1, default: 100 },
  {
    name: "when",
    symbol: "t",
    unit: "s",
    min: 0.1,
    max: SECONDS,
    step: 0.1,
    default: 13.5,
    end: endOf,
    visible: (s) => !s.motion?.live,
  },
  { name: "bias", symbol: "s", visible: isSynthetic },
  { name: "push", symbol: "a", unit: "m/s²", min: -5, max: 5, step: 0.1, default: 3, visible: isSynthetic },
  {
    name: "held",
    symbol: "",
    unit: "°",
    min: -LARGEST,
    max: LARGEST,
    step: 1,
    default: 20,
    visible: isSynthetic,
  },
].map((control) => ({ ...control, ...TILT_CONTROLS[control.name] }));

export const tilt = {
  name: TILT.name,
  noise: true,
  start: { bias: 0.5, sigma_acc: 1, sigma_gyr: 1 },
  controls: [...sliders, ...phone.controls],
  compute,
  plots: [
    {
      ...TILT.craft,
      height: 130,
      half: true,
      equal: true,
      bare: true,
      visible: isSynthetic,
      draw: drawCraft,
      drag: turnByHand,
    },
    phone.ghosts,
    {
      ...TILT.angles,
      xlabel: "t (s)",
      height: 210,
      half: true,
      draw: drawAngles,
      drag: (time, _, s) => ({ when: Math.max(HAND_STEP, Math.min(endOf(s), time)) }),
    },
    phone.instruments,
  ],
  outcome,
  numbers,
  question: gainQuestion,
};
