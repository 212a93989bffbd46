// The second explorer of chapter 4: noise is added to the towing run, and the fitted poles move.
import { generator } from "../../numerics/random.js";
import { bias, LEAST, noiseAt } from "./bias.js";
import { expected_fit, fit, poles, towing_run } from "./model.js";
import { circle, marks, polesText } from "./plane.js";
import { forecast } from "./poles.js";
import { aboutFit } from "./questions.js";
import { CONTROLS, FROM_TWO, HAND_POLES, LABELS, MOVED } from "./words.js";

const NOW = 80; // samples: at 8 s, in the middle of the acceleration
const AHEAD = 15; // samples
const SHOWN = 35; // samples before
const REACH = 1.2;
const MOST_DRAGGED = 0.15; // m/s: with more noise the pole comes back

function compute(s, memo) {
  const curve = bias(s, memo);
  const { t, z } = towing_run(generator(s.seed), s.sigma);
  const theta = fit(z);
  memo.without ??= expected_fit(curve.x, 0);
  return {
    curve,
    t,
    z,
    x: curve.x,
    theta,
    still: memo.without,
    poles: poles(theta[1], theta[2]),
    still_poles: poles(memo.without[1], memo.without[2]),
    ahead: aheadOf(theta, z),
    ahead_still: aheadOf(memo.without, z),
  };
}

/** What a model says after the measurements NOW-1 and NOW. */
function aheadOf([c, a1, a2], z) {
  return forecast(a1, a2, [z[NOW - 1], z[NOW]], c, AHEAD + 2).subarray(1);
}

// --- the figures -------------------------------------------------------------------------------------------

function drawPlane(r) {
  return {
    xlim: [-REACH, REACH],
    ylim: [-REACH, REACH],
    layers: [
      ...circle(true),
      ...marks(r.poles, "estimate", LABELS.with_noise, "o"),
      ...marks(r.still_poles, "truth", LABELS.still, "+"),
    ],
  };
}

/** The noise that puts the second pole, on average, under the pointer. */
function dragPole(x, y, s, { curve }) {
  const { sigma, low } = curve.formula;
  const count = sigma.findIndex((value) => value > MOST_DRAGGED);
  let at = 0;
  for (let i = 1; i < count; i++) {
    if (Math.abs(low[i] - x) < Math.abs(low[at] - x)) {
      at = i;
    }
  }
  return { sigma: noiseAt(sigma[at]) };
}

function drawForecast(r) {
  const from = NOW - SHOWN;
  const end = NOW + AHEAD + 1;
  const coming = r.t.subarray(NOW, end);
  return {
    xlim: [r.t[from], r.t[end - 1]],
    ylim: [-0.5, 2.5],
    layers: [
      { look: "truth", x: r.t.subarray(from, end), y: r.x.subarray(from, end), label: "x_true" },
      { look: "rival", x: coming, y: r.ahead_still, label: LABELS.still },
      { look: "prediction", x: coming, y: r.ahead, label: LABELS.with_noise },
      { look: "measurement", x: r.t.subarray(from, NOW + 1), y: r.z.subarray(from, NOW + 1), label: "z" },
    ],
  };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const [, a1, a2] = r.theta;
  const values = { sigma: s.sigma, a1, a2, poles: polesText(r.poles, t) };
  return t.say(MOVED.result, values);
}

function numbers(r, s, t) {
  const rows = [];
  for (let k = NOW - SHOWN; k <= NOW + AHEAD; k++) {
    const ahead = k < NOW ? ["–", "–"] : [r.ahead, r.ahead_still].map((y) => t.decimal(y[k - NOW], 4));
    const measured = k > NOW ? "–" : t.decimal(r.z[k], 4);
    rows.push([t.decimal(r.t[k]), t.decimal(r.x[k], 4), measured, ...ahead]);
  }
  const models = [LABELS.with_noise, LABELS.still].map((words) => `${t.say(words)} (m/s)`);
  return { head: ["t (s)", "x_true (m/s)", "z (m/s)", ...models], rows };
}

export const noise = {
  name: MOVED.name,
  controls: [
    { name: "sigma", symbol: "σ", log: true, low: LEAST },
    { kind: "buttons", items: [{ ...CONTROLS.noise, set: (s) => ({ seed: s.seed + 1 }) }] },
  ],
  compute,
  plots: [
    { ...HAND_POLES, bare: true, height: 210, equal: true, drag: dragPole, draw: drawPlane },
    { ...FROM_TWO, xlabel: "t (s)", height: 180, draw: drawForecast },
  ],
  outcome,
  numbers,
  question: aboutFit,
};
