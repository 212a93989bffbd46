// What the explorer of chapter 6 shows: a flight, three methods, and sensors that can be switched off.
import { METHODS } from "./attitude.js";
import { craft, panel, size } from "./figures.js";
import { compute, openRecording } from "./flown.js";
import { AXES, DEG, galat_of } from "./model.js";
import { question } from "./questions.js";
import { CONTROLS, CRAFT, FACTS, NAME, OUTCOME, SHOWN } from "./words.js";

const STEEP = 75; // degrees: beyond, Euler angles fail
const LONGEST = 126; // s, the synthetic flight
const LARGEST_FILE = 80000000; // bytes
const TABLE_STEP = 25; // samples: half a second

// --- words and numbers -------------------------------------------------------------------------------------

function outcome(r, s, t) {
  const { reference, mag, note } = r.flight;
  const sentences = [s.recording ? t.say(note) : "", rmseSentence(r, t)];
  if (reference === "truth") {
    sentences.push(paradox(r, t));
  }
  if (!s.mag || (s.recording && Number.isNaN(mag[0]))) {
    sentences.push(t.say(s.gyr ? OUTCOME.no_mag : OUTCOME.no_turn));
  }
  if (r.how.kept) {
    sentences.push(t.say(OUTCOME.fixed));
  }
  const steepest = steepestPitch(r.result.angles);
  if (steepest > STEEP) {
    sentences.push(t.say(OUTCOME.steep, { steep: size(steepest, t) }));
  }
  if (!s.recording) {
    sentences.push(t.say(OUTCOME.made, { seed: String(s.seed) }));
  }
  return sentences.filter(Boolean).join(" ");
}

function rmseSentence(r, t) {
  const { reference } = r.flight;
  if (!reference) {
    return t.say(OUTCOME.nothing);
  }
  const { rmse, rmse_z } = r.measures();
  const values = { reference: t.say(OUTCOME[reference]) };
  AXES.forEach((axis, i) => {
    values[axis] = size(rmse[i], t);
    values[`z_${axis}`] = size(rmse_z[i], t);
  });
  return t.say(OUTCOME.rmse, values);
}

/** Where the paper's formula calls the worse of filter and sensors the better one: pitch first. */
function paradox(r, t) {
  const { rmse, rmse_z, truth, mean, mean_z } = r.measures();
  for (const i of [1, 0, 2]) {
    const x = galat_of(truth[i], mean[i]);
    const z = galat_of(truth[i], mean_z[i]);
    if ((rmse[i] - rmse_z[i]) * (x - z) < 0) {
      const near = t.say(rmse[i] < rmse_z[i] ? OUTCOME.closer : OUTCOME.farther);
      return t.say(OUTCOME.lies, { near, axis: AXES[i], x: size(x, t), z: size(z, t) });
    }
  }
  return "";
}

/** The largest size of the pitch, degrees. */
function steepestPitch(angles) {
  let steepest = 0;
  for (let at = 1; at < angles.length; at += 3) {
    steepest = Math.max(steepest, Math.abs(angles[at]));
  }
  return steepest / DEG;
}

function facts(r, s, t) {
  const { rmse, rmse_z, truth, mean } = r.measures();
  const row = (words, value) => [t.say(words), ...AXES.map((_, i) => size(value(i), t))];
  return {
    head: ["", ...AXES],
    rows: [
      row(FACTS.rmse_z, (i) => rmse_z[i]),
      row(FACTS.rmse, (i) => rmse[i]),
      row(FACTS.galat, (i) => galat_of(truth[i], mean[i])),
    ],
  };
}

function numbers({ flight, result }, s, t) {
  const show = (value) => t.decimal(value, 4);
  const rows = [];
  for (let k = 0; k < flight.T; k += TABLE_STEP) {
    rows.push([show(flight.t[k]), ...AXES.flatMap((_, i) => anglesAt(3 * k + i, flight, result).map(show))]);
  }
  const heads = AXES.flatMap((axis) => [
    `${axis}_true (°)`,
    `${axis}_z (°)`,
    `${axis} (°)`,
    "√P (°)",
    "√R (°)",
  ]);
  return { head: ["t (s)", ...heads], rows };
}

/** Truth, measurement, estimate and both standard deviations at one place of the series, in degrees. */
function anglesAt(at, flight, { z, angles, P, R }) {
  const radians = [flight.truth[at], z[at], angles[at], Math.sqrt(P[at]), Math.sqrt(R[at])];
  return radians.map((value) => value / DEG);
}

// --- the view ----------------------------------------------------------------------------------------------

const isAdaptive = (s) => METHODS[s.method].kept;

/** Does it matter when the craft is dynamic? */
const hasFactor = (s) => !isAdaptive(s) && s.m !== 1;

/** A button that sets m. */
function mButton(m) {
  return {
    id: `m = ${String(m).replace(".", ",")}`,
    en: `m = ${m}`,
    set: { m },
    pressed: (s) => s.m === m && !isAdaptive(s),
    disabled: isAdaptive,
  };
}

function check(name) {
  return { kind: "check", name, default: true, ...CONTROLS[name] };
}

const controls = [
  {
    kind: "select",
    name: "method",
    default: "paper",
    ...CONTROLS.method,
    options: [
      ["paper", CONTROLS.paper],
      ["adaptive", CONTROLS.adaptive],
      ["literal", CONTROLS.literal],
    ],
  },
  {
    kind: "select",
    name: "shown",
    default: "pitch",
    ...CONTROLS.shown,
    options: [...AXES.map((axis) => [axis, SHOWN[axis]]), ["all", SHOWN.all]],
  },
  {
    kind: "file",
    name: "recording",
    multiple: true,
    accept: ".csv,.zip,.txt,.xlsx,.xls",
    ...CONTROLS.recording,
    largest: LARGEST_FILE,
    reads: "recording",
    open: openRecording,
    follows: "axes",
  },
  {
    kind: "select",
    name: "axes",
    default: "",
    ...CONTROLS.axes,
    visible: (s) => s.recording,
    options: ["", "phone", "flu", "frd"].map((axes) => [axes, CONTROLS.frames[axes]]),
  },
  { kind: "buttons", items: [{ ...CONTROLS.back, set: { recording: null } }], visible: (s) => s.recording },
  {
    name: "moment",
    symbol: "t",
    unit: "s",
    min: 0,
    max: LONGEST,
    step: 0.1,
    default: 60,
    end: (s, r) => (s.recording && r ? r.flight.t[r.flight.T - 1] : LONGEST),
    ...CONTROLS.moment,
  },
  {
    kind: "buttons",
    items: [{ play: "moment", seconds: 40, ...CONTROLS.fly }, mButton(0.16), mButton(1), mButton(10)],
  },
  { name: "m", symbol: "m", disabled: isAdaptive },
  { name: "q", symbol: "q", disabled: isAdaptive },
  { name: "window", symbol: "", visible: hasFactor },
  { name: "threshold", symbol: "", visible: hasFactor },
  check("gyr"),
  check("acc"),
  check("mag"),
  check("larger"),
];

export const flight = {
  name: NAME,
  noise: true,
  controls,
  compute,
  plots: [
    panel(0),
    panel(1),
    panel(2),
    { ...CRAFT, height: 150, half: true, equal: true, bare: true, draw: craft },
  ],
  outcome,
  facts,
  numbers,
  question,
};
