// One flight, filtered as the reader has chosen. What does not change is kept: the flight, the sensors, the
// result.
import { readRecording } from "../../files/recording.js";
import { generator } from "../../numerics/random.js";
import { METHODS, attitude } from "./attitude.js";
import { simulate } from "./flight.js";
import { DEG, wrap } from "./model.js";
import { mean, rmse_deg } from "./statistics.js";

const DRAWN = 315; // samples: of the flight every twentieth, 0.4 s, about one for a pixel

/** The reader's files -> a promise of the recording in them, as the kernel of a notebook reads it. */
export async function openRecording(files, { axes }) {
  const found = await readRecording(files, axes || null);
  const told = (language) => found.notes.map((note) => note[language]).join(" ");
  const note = { en: told("en"), id: told("id") };
  return { ...found, truth: found.reference, note, name: files[0].name, files, axes };
}

/** The synthetic flight, or a recording of the reader's. */
export function compute(s, memo) {
  const source = s.recording ?? s.seed;
  const flight = kept(memo, "flight", [source], () => flightOf(s));
  const sensors = kept(memo, "sensors", [flight, s.gyr, s.acc, s.mag], () => sensorsInUse(flight, s));
  const method = [s.method, s.m, s.q, s.window, s.threshold];
  const shown = kept(memo, "shown", [sensors, ...method], () => filtered(flight, sensors, s, memo));
  return { ...shown, k: stepAt(flight, s) };
}

/** What memo holds under this name, made anew only when its key, a list, has changed. */
function kept(memo, name, key, make) {
  if (!memo[name]?.key.every((value, i) => value === key[i])) {
    memo[name] = { key, value: make() };
  }
  return memo[name].value;
}

/** {T, t, gyr, acc, mag, truth, rest_s, reference: "truth", "device" or null}. */
function flightOf(s) {
  const { recording } = s;
  if (!recording) {
    return { ...simulate(s, generator(s.seed)), reference: "truth" };
  }
  const nothing = new Float64Array(3 * recording.T).fill(NaN);
  return {
    ...recording,
    mag: recording.mag ?? nothing,
    truth: recording.truth ?? nothing,
    reference: recording.truth ? "device" : null,
  };
}

/** The step of the moment that is drawn. */
function stepAt({ T, t }, s) {
  if (!s.recording) {
    const step = Math.min(Math.round(s.moment / s.dt), T - 1);
    return Math.max(0, step); // a finger may leave the figure to the left
  }
  return Math.max(
    0,
    t.findLastIndex((time) => time <= s.moment),
  );
}

/** The recording as the filter gets it: a gyroscope that is switched off says 0, another sensor nothing. */
function sensorsInUse({ T, t, gyr, acc, mag, rest_s }, s) {
  const zero = new Float64Array(3 * T);
  const nothing = new Float64Array(3 * T).fill(NaN);
  return { t, rest_s, gyr: s.gyr ? gyr : zero, acc: s.acc ? acc : nothing, mag: s.mag ? mag : nothing };
}

/** The method with the settings of the reader; the adaptive one has its own. */
function methodOf(s) {
  const method = METHODS[s.method];
  if (method.kept) {
    return method;
  }
  return { ...method, m: s.m, q: s.q * DEG ** 2, window: s.window, threshold: s.threshold };
}

function filtered(flight, sensors, s, memo) {
  const how = methodOf(s);
  const result = attitude(
    sensors,
    how,
    kept(memo, "filter", [flight], () => ({})),
  );
  const { angles } = result;
  for (let at = 0; at < angles.length; at++) {
    angles[at] = wrap(angles[at]);
  }
  let found; // the sentences and tables follow a moving slider less often than the figures
  const measures = () => {
    found ??= measuresOf(flight.truth, result);
    return found;
  };
  return { flight, result, how, lines: linesOf(flight, result, memo), measures };
}

/** RMSE (3) in degrees and means (3) in rad of filter and sensors alone. */
function measuresOf(truth, { angles, z }) {
  const means = (values) => [0, 1, 2].map((i) => mean(values, i, truth.length / 3));
  return {
    rmse: rmse_deg(truth, angles),
    rmse_z: rmse_deg(truth, z),
    truth: means(truth),
    mean: means(angles),
    mean_z: means(z),
  };
}

/** What the panels draw, in degrees: {t, panels: [{x, z, truth}, ...]}, some of the samples. */
function linesOf({ T, t, truth }, { angles, z }, memo) {
  const skip = Math.max(1, Math.round(T / DRAWN));
  const count = Math.ceil(T / skip);
  const empty = () => new Float64Array(count);
  const lines = kept(memo, "lines", [count], () => ({
    t: empty(),
    panels: [0, 1, 2].map(() => ({ x: empty(), z: empty(), truth: empty() })),
  }));
  for (let j = 0; j < count; j++) {
    lines.t[j] = t[j * skip];
  }
  lines.panels.forEach((panel, i) => fillPanel(panel, i, skip, { truth, angles, z }));
  return lines;
}

/** Estimate and truth without a jump where they go round, the measurement beside the estimate. */
function fillPanel(panel, i, skip, { truth, angles, z }) {
  let actual = truth[i];
  let estimate = Number.isNaN(actual) ? angles[i] : actual + wrap(angles[i] - actual);
  for (let j = 0; j < panel.x.length; j++) {
    const at = 3 * skip * j + i;
    actual += wrap(truth[at] - actual);
    estimate += wrap(angles[at] - estimate);
    panel.x[j] = estimate / DEG;
    panel.z[j] = (estimate + wrap(z[at] - estimate)) / DEG;
    panel.truth[j] = actual / DEG;
  }
}
