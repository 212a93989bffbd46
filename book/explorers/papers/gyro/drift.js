// The view "drift": a gyroscope at rest whose rate is added up, alone or together with an angle sensor. In
// degrees: the filter does not mind, as long as all its numbers have the same unit. The gyroscope is
// synthetic, or that of the reader's own phone (phone.js).
import { generator } from "../../numerics/random.js";
import { sensorControl } from "../../own/phone.js";
import { exampleMotion } from "../../sensors/example.js";
import { run } from "./model.js";
import { REST, TURNS, follow, ghosts, limitsOf, sigmaOf } from "./phone.js";
import { DRIFT, LABELS, NAMES, PHONE } from "./words.js";

const T = 0.1; // s
const STEPS = 600; // a minute
const OTHERS = 11; // more gyroscopes of the same kind
const REACH = 10; // degrees up and down; it stays, so that the fan can be seen to grow
const MOVED = 3; // degrees a second: a phone that lies still does not tremble so much
const ROWS = [1, 10, 50, 100, 200, 300, 400, 500, 600]; // steps in the table

// --- the numbers -------------------------------------------------------------------------------------------

function compute(s, memo) {
  if (s.motion) {
    return follow(s);
  }
  if (memo.seed !== s.seed) {
    Object.assign(memo, { seed: s.seed, ...noiseOf(generator(s.seed)) });
  }
  const u = memo.of_rate.map((number) => s.noise_w * number); // what the gyroscope says while it lies still
  const z = memo.of_angle.map((number) => s.noise_v * number);
  const p = { T, sigma_w: s.noise_w, sigma_v: s.noise_v };
  const filter = run(p, { z, u });
  const walks = memo.walks.map((walk) => walk.map((sum) => T * s.noise_w * sum));
  const fan = memo.t.map((t) => 2 * s.noise_w * Math.sqrt(T * t));
  const alone = walks[0];
  const band = s.sensor ? filter.P.map((P) => 2 * Math.sqrt(P)) : fan;
  return { t: memo.t, z, filter, alone, walks, fan, band, x: s.sensor ? filter.x : alone };
}

/** Standard normal numbers: of the rate, of the angle sensor, and sums of them for every gyroscope. */
function noiseOf(rng) {
  const normal = () => Float64Array.from({ length: STEPS }, () => rng.normal());
  const of_rate = normal();
  const of_angle = normal();
  const walks = [summed(of_rate)];
  for (let i = 0; i < OTHERS; i++) {
    walks.push(summed(normal()));
  }
  return { t: Float64Array.from({ length: STEPS }, (_, k) => T * (k + 1)), of_rate, of_angle, walks };
}

function summed(values) {
  let sum = 0;
  return values.map((value) => (sum += value));
}

// --- drawing -----------------------------------------------------------------------------------------------

const minus = (values) => values.map((value) => -value);

function draw(r, s) {
  const layers = [
    { look: "band", x: r.t, low: minus(r.band), high: r.band, label: "±2σ" },
    ...(s.sensor ? withSensor(r) : others(r)),
    s.motion ? { look: "quiet", level: 0 } : { look: "truth", level: 0, label: "x_true" },
    { look: "estimate", x: r.t, y: r.x, label: "x" },
  ];
  const limits = s.motion ? limitsOf(r) : { xlim: [0, T * STEPS], ylim: [-REACH, REACH] };
  return { ...limits, layers };
}

function withSensor(r) {
  return [
    { look: "measurement", x: r.t, y: r.z, label: "z" },
    { look: "rival", x: r.t, y: r.alone, label: LABELS.alone },
    { look: "quiet", x: r.t, y: r.fan },
    { look: "quiet", x: r.t, y: minus(r.fan) },
  ];
}

/** The other gyroscopes, thin and pale. */
function others({ t, walks = [] }) {
  if (walks.length === 0) {
    return []; // of one phone there are no others
  }
  const paint = (ctx, X, Y) => {
    ctx.lineWidth = 1;
    ctx.globalAlpha = 0.5;
    for (const walk of walks.slice(1)) {
      ctx.beginPath();
      for (let k = 0; k < walk.length; k += 3) {
        ctx.lineTo(X(t[k]), Y(walk[k]));
      }
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
  };
  return [{ look: "quiet", paint, label: LABELS.others }];
}

/** The edge of the fan follows the pointer. */
function drag(x, y, s) {
  if (s.motion || !(x > 0.05 * T * STEPS)) {
    return null;
  }
  const { min, max } = OF_RATE;
  return { noise_w: Math.min(Math.max(Math.abs(y) / (2 * Math.sqrt(T * x)), min), max) };
}

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  if (s.motion) {
    return ofPhone(r, s, t);
  }
  const last = STEPS - 1;
  const two = (value) => t.decimal(value, 2);
  const values = {
    x: two(r.x[last]),
    alone: two(r.alone[last]),
    fan: two(r.fan[last]),
    band: two(r.band[last]),
    sensor: two(2 * s.noise_v),
    K: two(r.filter.K[last]),
  };
  return t.say(s.sensor ? DRIFT.together : DRIFT.alone, values);
}

/** What came out of the reader's own phone. */
function ofPhone({ t: time, alone, fan, x, band, at_rest }, s, t) {
  const last = alone.length - 1;
  const two = (value) => t.decimal(Number(value.toFixed(2)), 5);
  const values = {
    rest: t.decimal(REST),
    mean: two(at_rest.mean),
    sigma: two(at_rest.sigma),
    time: t.decimal(Math.round(time[last])),
    alone: two(alone[last]),
    fan: two(fan[last]),
    x: two(x[last]),
    band: two(band[last]),
  };
  const sentences = [at_rest.sigma > MOVED ? PHONE.moved : PHONE.rest, PHONE.alone];
  if (s.sensor) {
    sentences.push(PHONE.together);
  }
  if (s.motion.synthetic) {
    sentences.push(PHONE.synthetic);
  }
  return sentences.map((words) => t.say(words, values)).join(" ");
}

function numbers(r, s, t) {
  const columns = [r.t, r.alone, r.fan, r.z, r.filter.x, r.filter.P.map((P) => 2 * Math.sqrt(P)), r.filter.K];
  const row = (k) => [String(k), ...columns.map((values) => t.decimal(values[k - 1], 3))];
  return {
    head: ["k", "t (s)", "∫ u dt (°)", "2 σ_w √(T t) (°)", "z (°)", "x (°)", "2√P (°)", "K"],
    rows: rowsOf(r.t.length).map(row),
  };
}

/** The steps in the table: those of a minute, or as many of a recording. */
function rowsOf(steps) {
  const share = steps / STEPS;
  return steps === STEPS ? ROWS : ROWS.map((k) => Math.max(1, Math.round(k * share)));
}

// --- controls ----------------------------------------------------------------------------------------------

const OF_RATE = { unit: "°/s", min: 0.1, max: 2, step: 0.1, log: false, default: 1 };
const OF_ANGLE = { unit: "°", min: 0.2, max: 5, step: 0.1, log: false, default: 1 };

const OF_PHONE = { unit: "°/s", min: 0.01, max: 5, step: 0.01, log: true, default: null };
const TURNED = Object.keys(TURNS).map((turn) => [turn, PHONE[turn]]);
const NOTHING = { xlim: [0, 1], ylim: [0, 1], layers: [] };

const hasPhone = (s) => Boolean(s.motion);

export const drift = {
  name: NAMES.drift,
  noise: true,
  controls: [
    { kind: "check", name: "sensor", default: false, ...DRIFT.sensor },
    { name: "noise_w", symbol: "σ_w", ...DRIFT.noise_w, ...OF_RATE, visible: (s) => !s.motion },
    { name: "sigma", symbol: "σ_w", ...DRIFT.noise_w, ...OF_PHONE, auto: sigmaOf, visible: hasPhone },
    { name: "noise_v", symbol: "σ_v", ...DRIFT.noise_v, ...OF_ANGLE, disabled: (s) => !s.sensor },
    { kind: "check", name: "centred", default: false, ...PHONE.centred, visible: hasPhone },
    { kind: "select", name: "turn", default: "roll", ...PHONE.turn, options: TURNED, visible: hasPhone },
    sensorControl({ name: "motion", example: exampleMotion }),
  ],
  compute,
  plots: [
    { title: DRIFT.title, alt: DRIFT.alt, xlabel: "t (s)", height: 240, draw, drag },
    {
      ...PHONE.ghosts,
      height: 130,
      equal: true,
      bare: true,
      visible: hasPhone,
      draw: (r, s) => (s.motion ? ghosts(r, s, LABELS) : NOTHING),
    },
  ],
  outcome,
  numbers,
};
