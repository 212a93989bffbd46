// Signals with times of their own in, all of them at the times of the gyroscope out. Twin of
// kalman_lib/data/resample.py.
import { interpolateAngles } from "./angles.js";
import { interpolated } from "./lines.js";
import { NAMES, general, median, say, wrong } from "./notes.js";
import { stepsOf } from "./signals.js";

const GAP = 0.1; // s; a longer pause is told
const KINDS = ["gyr", "acc", "mag", "orientation"];
const LEAST_IN_COMMON = 10; // times

/** {kind: signal} -> {t (T) s, columns: {kind: values at t}}, over the time that all sensors cover. */
export function resample(signals, notes) {
  const parts = KINDS.filter((kind) => signals[kind]).map((kind) => signals[kind]);
  const { gyr } = signals;
  let { t } = gyr;
  for (const signal of parts) {
    const [first, last] = [signal.t[0], signal.t.at(-1)];
    t = t.filter((time) => time >= first && time <= last);
    if (t.length < LEAST_IN_COMMON) {
      throw noOverlap(gyr, signal);
    }
  }
  tellRates(parts, notes);
  if (t.length < gyr.t.length) {
    const kept = (t.at(-1) - t[0]).toFixed(2);
    const all = (gyr.t.at(-1) - gyr.t[0]).toFixed(2);
    say(
      notes,
      `Only the ${kept} s that all sensors cover are kept, of ${all} s.`,
      `Hanya ${kept} s yang dicakup semua sensor dipakai, dari ${all} s.`,
    );
  }
  parts.forEach((signal) => tellGaps(signal, t, notes));
  const at = (signal) => (signal.kind === "orientation" ? anglesAt(t, signal) : interpolate(t, signal));
  return { t, columns: Object.fromEntries(parts.map((signal) => [signal.kind, at(signal)])) };
}

function anglesAt(t, signal) {
  return interpolateAngles(t, signal.t, signal.values);
}

/** The values of a signal at t (T), straight between its own times -> (3 T). */
export function interpolate(t, signal) {
  return interpolated(t, signal.t, signal.values, 3);
}

/** Samples per second. */
export function rateOf(t) {
  return 1 / median(stepsOf(t));
}

function tellRates(parts, notes) {
  const told = (language) =>
    parts.map(({ kind, t }) => `${NAMES[kind][language]} ${general(rateOf(t), 4)} Hz`).join(", ");
  const [{ t }] = parts;
  if (parts.every((other) => other.t.length === t.length && other.t.every((time, k) => time === t[k]))) {
    say(notes, `Rates: ${told("en")}.`, `Laju: ${told("id")}.`);
    return;
  }
  say(
    notes,
    `Rates: ${told("en")}; all were interpolated linearly to the gyroscope's times.`,
    `Laju: ${told("id")}; semua diinterpolasi linear ke waktu giroskop.`,
  );
}

/** A note on the pauses of a signal between the first and the last of the times t. */
function tellGaps(signal, t, notes) {
  const least = Math.max(GAP, 3 / rateOf(signal.t));
  let worst = -1;
  let count = 0;
  const pauses = stepsOf(signal.t);
  pauses.forEach((pause, k) => {
    if (pause > least && signal.t[k + 1] > t[0] && signal.t[k] < t.at(-1)) {
      count++;
      worst = worst < 0 || pause > pauses[worst] ? k : worst;
    }
  });
  if (count === 0) {
    return;
  }
  const { en, id } = NAMES[signal.kind];
  const pause = `${pauses[worst].toFixed(2)} s`;
  const start = `${(signal.t[worst] - t[0]).toFixed(2)} s`;
  say(
    notes,
    `Gaps of the ${en}: ${count}; the longest, ${pause}, begins at ${start}.`,
    `Celah ${id}: ${count}; yang terpanjang, ${pause}, mulai pada ${start}.`,
  );
}

/** The InputError for two signals that were not recorded at the same time. */
export function noOverlap(one, other) {
  const span = ({ place, t }, to) => `${place} (${t[0].toFixed(2)} ${to} ${t.at(-1).toFixed(2)} s)`;
  return wrong(
    `${span(one, "to")} and ${span(other, "to")} have fewer than 10 times of the gyroscope in common.`,
    `${span(one, "sampai")} dan ${span(other, "sampai")} memiliki kurang dari 10 waktu giroskop yang sama.`,
  );
}
