// The first explorer of chapter 4: a pair of poles by hand, and how their model continues two speeds.
import { poles } from "./model.js";
import { circle, marks, polesText } from "./plane.js";
import { aboutForecast } from "./questions.js";
import { BY_HAND, CONTINUED, HAND_POLES, LABELS } from "./words.js";

const GIVEN = [0.9, 1]; // m/s: the two speeds that are known
const LAST = 30; // k of the last forecast
const REACH = 1.2; // of the plane, so that the circle stays as large as it is
const SNAP = 0.05; // so near to the real axis a pole lies on it
const ROUND = 0.003; // so far from 1 is still 1: the sliders have two digits

/** Both known speeds and what the model says after them, (LAST). */
export function forecast(a1, a2, [first, second] = GIVEN, c = 0, count = LAST) {
  const s = [first, second];
  while (s.length < count) {
    s.push(c + a1 * s.at(-1) + a2 * s.at(-2));
  }
  return Float64Array.from(s);
}

function compute({ a1, a2 }) {
  return { poles: poles(a1, a2), s: forecast(a1, a2) };
}

// --- the figures -------------------------------------------------------------------------------------------

function drawPlane(r) {
  return {
    xlim: [-REACH, REACH],
    ylim: [-REACH, REACH],
    layers: [...circle(true), ...marks(r.poles, "estimate", "λ")],
  };
}

/** Two poles side by side on the real axis, or one above the other. */
function dragPole(x, y, s, r) {
  const real = clamp(x);
  if (Math.abs(y) > SNAP) {
    const imaginary = clamp(y);
    return { a1: 2 * real, a2: -(real ** 2 + imaginary ** 2) };
  }
  const [[high, imaginary], [low]] = r.poles;
  if (imaginary > 0) {
    return { a1: 2 * real, a2: -(real ** 2) };
  }
  const other = Math.abs(real - high) < Math.abs(real - low) ? low : high; // the nearer one follows
  return { a1: real + other, a2: -real * other };
}

function clamp(value) {
  return Math.min(Math.max(value, -1.08), 1.08);
}

function drawForecast({ s }) {
  const k = Float64Array.from(s, (_, i) => i + 1);
  const dots = (ctx, X, Y) => {
    for (let i = 2; i < s.length; i++) {
      ctx.beginPath();
      ctx.arc(X(k[i]), Y(s[i]), 2, 0, 7);
      ctx.fill();
    }
  };
  return {
    xlim: [0, LAST],
    ylim: [-2, 2.5],
    layers: [
      { look: "quiet", level: 0 },
      { look: "prediction", x: k.subarray(1), y: s.subarray(1), label: LABELS.forecast },
      { look: "prediction", paint: dots },
      { look: "measurement", mark: [1, s[0]], label: LABELS.given },
      { look: "measurement", mark: [2, s[1]] },
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const [[real, imaginary]] = r.poles;
  const values = {
    poles: polesText(r.poles, t),
    size: Math.max(...r.poles.map(([a, b]) => Math.hypot(a, b))),
    turn: (2 * Math.PI) / Math.atan2(imaginary, real),
  };
  const sentences = [t.say(BY_HAND.poles, values), t.say(BY_HAND[behaviour(r.poles)], values)];
  const zigzags = imaginary === 0 && r.poles[1][0] < -SNAP;
  return [...sentences, zigzags && t.say(BY_HAND.zigzag)].filter(Boolean).join(" ");
}

/** What the forecast does in the long run: the name of its sentence. */
function behaviour([[real, imaginary], [other, its]]) {
  const size = Math.max(Math.hypot(real, imaginary), Math.hypot(other, its));
  if (imaginary > 0) {
    return byDistance(size, ["swing_in", "swing", "swing_out"]);
  }
  if (Math.min(real, other) > 1 - ROUND && size < 1 + ROUND) {
    return "line";
  }
  return byDistance(size, ["decay", real > -other ? "stay" : "flip", "grow"]);
}

function byDistance(size, [inside, on, outside]) {
  if (Math.abs(size - 1) < ROUND) {
    return on;
  }
  return size < 1 ? inside : outside;
}

function equations({ s }, { a1, a2 }, t) {
  const write = (value) => t.unbroken(value);
  const bracketed = (value) => (value < 0 ? `( ${write(value)} )` : write(value));
  const line = (k) => {
    const sum = `${write(a1)} · ${bracketed(s[k - 2])} + ${bracketed(a2)} · ${bracketed(s[k - 3])}`;
    return [`s_${k} = ${sum} = ${write(s[k - 1])}`];
  };
  return [["s_k = a_1 s_k−1 + a_2 s_k−2"], line(3), line(4)];
}

function numbers({ s }, { a1, a2 }, t) {
  const rows = Array.from(s.subarray(2), (value, i) => {
    const parts = [s[i], s[i + 1], a1 * s[i + 1], a2 * s[i], value];
    return [String(i + 3), ...parts.map((part) => t.decimal(part, 4))];
  });
  return { head: ["k", "s[k−2] (m/s)", "s[k−1] (m/s)", "a_1 s[k−1]", "a_2 s[k−2]", "s[k] (m/s)"], rows };
}

const RANGE = { step: 0.01, log: false };

export const by_hand = {
  name: BY_HAND.name,
  start: { a1: 1.6, a2: -0.8 },
  controls: [
    { name: "a1", symbol: "a_1", min: -2.2, max: 2.2, ...RANGE },
    { name: "a2", symbol: "a_2", min: -1.2, max: 1.2, ...RANGE },
    {
      kind: "buttons",
      items: [
        { ...BY_HAND.line_preset, set: { a1: 2, a2: -1 }, glide: 600 },
        { ...BY_HAND.mean_preset, set: { a1: 0.5, a2: 0.5 }, glide: 600 },
      ],
    },
  ],
  compute,
  plots: [
    {
      ...HAND_POLES,
      bare: true,
      height: 220,
      equal: true,
      handles: (r) => r.poles,
      drag: dragPole,
      draw: drawPlane,
    },
    { ...CONTINUED, xlabel: "k", height: 180, draw: drawForecast },
  ],
  outcome,
  equations,
  numbers,
  question: aboutForecast,
};
