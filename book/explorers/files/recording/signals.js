// The sheets of a recording in, one signal a sensor out, in SI units and the sensor's own axes. Twin of
// kalman_lib/data/signals.py. A signal is {kind, t (n) s, values (3 n), place, lines (n), source: "units",
// "plain" (gx, ax, mx) or "logger" (Sensor Logger)}.
import { quoted } from "../cells.js";
import { ACCEPTED, PLAIN_NAMES, UNITS, isGravity, isLinear, readHeader } from "./headers.js";
import { NAMES, everyDigit, median, say, stemOf, wrong } from "./notes.js";

const SENSOR_LOGGER = {
  gyroscope: "gyr", // its file -> what is in it
  totalacceleration: "acc",
  accelerometer: "linear",
  gravity: "gravity",
  magnetometer: "mag",
  orientation: "orientation",
};
const AXES = ["x", "y", "z"];
const SHORTEST = 1e-6; // s between two measurements
const LEAST = { gyr: 10 }; // measurements; of other sensors two

/** A sheet -> its signals. */
export function signalsIn(sheet, notes) {
  if (sheet.names.includes("seconds_elapsed")) {
    return ofSensorLogger(sheet);
  }
  const groups = groupsIn(sheet, notes);
  return groups.map((group) => signalOf(sheet, group, notes)).filter(Boolean);
}

/** [{name, kind, clock, axes: {x: {k, factor}, ...}}, ...]; clock: the {k, factor} of time to the left. */
function groupsIn(sheet, notes) {
  const groups = new Map();
  let clock = null;
  sheet.names.forEach((title, k) => {
    const column = readHeader(title);
    const { name, kind, axis, unit } = column;
    if (kind === "unknown" || (kind === "time" && unit !== null && !UNITS.has(unit))) {
      throw unitIsMissing(sheet.place, title);
    }
    if (kind === "time") {
      clock = clockOf(sheet.place, title, k, unit, notes);
    } else if (kind && kind !== "logger") {
      const key = JSON.stringify([name, kind, clock]);
      const group = groups.get(key) ?? { name, kind, clock, axes: {} };
      if (group.axes[axis]) {
        throw comesTwice(sheet.place, title);
      }
      group.axes[axis] = { k, factor: UNITS.get(unit)?.[1] ?? 1 };
      groups.set(key, group);
    }
  });
  return [...groups.values()];
}

function clockOf(place, title, k, unit, notes) {
  if (unit === null) {
    say(
      notes,
      `${place}: column ${quoted(title, Infinity)} has no unit; seconds were taken.`,
      `${place}: kolom ${quoted(title, Infinity)} tanpa satuan; dipakai detik.`,
    );
  }
  return { k, factor: UNITS.get(unit)?.[1] ?? 1 };
}

function comesTwice(place, header) {
  return wrong(
    `${place}: column ${quoted(header)} comes twice; leave one of them.`,
    `${place}: kolom ${quoted(header)} ada dua kali; tinggalkan satu saja.`,
  );
}

function unitIsMissing(place, header) {
  return wrong(
    `${place}: column ${quoted(header)} must have its unit in parentheses, one of ${ACCEPTED}.`,
    `${place}: kolom ${quoted(header)} harus memuat satuannya dalam kurung, salah satu dari ${ACCEPTED}.`,
  );
}

/** The signal of one group of columns; null if it has not three axes, like a single "y (g)". */
function signalOf(sheet, { name, kind, clock, axes }, notes) {
  const { place, names } = sheet;
  if (Object.keys(axes).length < 3) {
    return null;
  }
  if (clock === null) {
    throw wrong(
      `${place}: there is no column of time, such as 't (s)', left of the sensor.`,
      `${place}: tidak ada kolom waktu, misalnya 't (s)', di kiri sensor.`,
    );
  }
  const columns = AXES.map((axis) => axes[axis]);
  const converted = columns.filter(({ factor }) => factor !== 1).map(({ k }) => names[k]);
  if (converted.length > 0) {
    const si = kind === "gyr" ? "rad/s" : "m/s2";
    const titles = converted.join(", ");
    say(notes, `${place}: converted to ${si}: ${titles}.`, `${place}: diubah ke ${si}: ${titles}.`);
  }
  const isPlain = PLAIN_NAMES.includes(name) || names[columns[0].k].includes("_");
  return {
    kind: kind === "acc" ? accelerationOf(name) : kind,
    t: sheet.columns[clock.k].map((value) => value * clock.factor),
    values: joined(columns.map(({ k, factor }) => sheet.columns[k].map((value) => value * factor))),
    place,
    lines: sheet.lines,
    source: isPlain ? "plain" : "units",
  };
}

function accelerationOf(name) {
  if (isLinear(name)) {
    return "linear";
  }
  return isGravity(name) ? "gravity" : "acc";
}

/** Three columns (n) -> (3 n), step after step. */
function joined(columns) {
  const values = new Float64Array(3 * columns[0].length);
  columns.forEach((column, i) => {
    for (let k = 0; k < column.length; k++) {
      values[3 * k + i] = column[k];
    }
  });
  return values;
}

/** A CSV of Sensor Logger, which has SI units. */
function ofSensorLogger(sheet) {
  const kind = SENSOR_LOGGER[stemOf(sheet.place)];
  const wanted = kind === "orientation" ? ["roll", "pitch", "yaw"] : AXES;
  const column = new Map(sheet.names.map((name, k) => [name, sheet.columns[k]]));
  if (!kind || !wanted.every((name) => column.has(name))) {
    return [];
  }
  const values = joined(wanted.map((name) => column.get(name)));
  const { place, lines } = sheet;
  return [{ kind, t: column.get("seconds_elapsed"), values, place, lines, source: "logger" }];
}

/** Add a signal to the others; InputError if that sensor is there already. */
export function keep(signals, signal) {
  const other = signals[signal.kind];
  if (other) {
    const { en, id } = NAMES[signal.kind];
    throw wrong(
      `The ${en} comes twice, in ${other.place} and in ${signal.place}; give one recording.`,
      `Sensor ${id} ada dua kali, di ${other.place} dan di ${signal.place}; berikan satu rekaman.`,
    );
  }
  signals[signal.kind] = signal;
}

// --- rows that cannot be used ------------------------------------------------------------------------------

/** The signal with these rows only: isKept (n). */
export function rowsOf(signal, isKept) {
  const rows = [...isKept.keys()].filter((k) => isKept[k]);
  const values = new Float64Array(3 * rows.length);
  rows.forEach((k, j) => values.set(signal.values.subarray(3 * k, 3 * k + 3), 3 * j));
  const of = (series) => Float64Array.from(rows, (k) => series[k]);
  return { ...signal, t: of(signal.t), values, lines: of(signal.lines) };
}

/** Does it hold of all three values of a row? (n) */
function ofAll({ t, values }, holds) {
  return Array.from(t, (_, k) => holds(3 * k) && holds(3 * k + 1) && holds(3 * k + 2), values);
}

/** The signal without empty and repeated rows; InputError: a value is missing, or time stands still. */
export function clean(given, notes) {
  const { en, id } = NAMES[given.kind];
  const { place, values } = given;
  const empty = ofAll(given, (at) => Number.isNaN(values[at])); // phyphox fills short columns
  checkValues(given, empty);
  const known = rowsOf(
    given,
    empty.map((is) => !is),
  );
  const n = known.t.length;
  const least = LEAST[given.kind] ?? 2;
  if (n < least) {
    throw wrong(
      `${place}: the ${en} has only ${n} measurements; at least ${least} are needed.`,
      `${place}: ${id} hanya memiliki ${n} pengukuran; diperlukan sedikitnya ${least}.`,
    );
  }
  if (empty.slice(0, n).includes(true)) {
    const count = empty.filter(Boolean).length; // not only at the end
    say(
      notes,
      `${place}: ${count} rows without a value of the ${en} were left out.`,
      `${place}: ${count} baris tanpa nilai ${id} tidak dipakai.`,
    );
  }
  const single = withoutRepeated(known, notes);
  checkTimes(single);
  return oneATime(single, notes);
}

function withoutRepeated(signal, notes) {
  const { t, values, place } = signal;
  const isNew = ofAll(signal, () => true);
  for (let k = 1; k < t.length; k++) {
    const isSame = [0, 1, 2].every((i) => values[3 * k + i] === values[3 * k - 3 + i]);
    isNew[k] = !(t[k] === t[k - 1] && isSame);
  }
  const repeated = isNew.filter((is) => !is).length;
  if (repeated === 0) {
    return signal;
  }
  say(
    notes,
    `${place}: ${repeated} rows that repeat the one before were left out.`,
    `${place}: ${repeated} baris yang mengulang baris sebelumnya tidak dipakai.`,
  );
  return rowsOf(signal, isNew);
}

/** The mean of rows with the same time. */
function oneATime(signal, notes) {
  const { t, values, place } = signal;
  const isFirst = Array.from(t, (time, k) => k === 0 || time > t[k - 1]);
  if (!isFirst.includes(false)) {
    return signal;
  }
  const single = rowsOf(signal, isFirst);
  const counts = new Float64Array(single.t.length);
  single.values.fill(0);
  let j = -1;
  for (let k = 0; k < t.length; k++) {
    j += Number(isFirst[k]);
    counts[j]++;
    for (let i = 0; i < 3; i++) {
      single.values[3 * j + i] += values[3 * k + i];
    }
  }
  single.values = single.values.map((sum, at) => sum / counts[Math.floor(at / 3)]);
  const shared = counts.reduce((sum, count) => sum + (count > 1 ? count : 0), 0);
  say(
    notes,
    `${place}: ${shared} rows share their times with others; their means were taken.`,
    `${place}: ${shared} baris waktunya sama dengan baris lain; dipakai rata-ratanya.`,
  );
  return single;
}

function checkValues(signal, empty) {
  const { en, id } = NAMES[signal.kind];
  const good = ofAll(signal, (at) => Number.isFinite(signal.values[at]));
  const bad = empty.findIndex((isEmpty, k) => !isEmpty && !(good[k] && Number.isFinite(signal.t[k])));
  if (bad >= 0) {
    const line = signal.lines[bad];
    throw wrong(
      `${signal.place}, line ${line}: a value of the ${en} or its time is missing or infinite.`,
      `${signal.place}, baris ${line}: nilai ${id} atau waktunya kosong atau tak hingga.`,
    );
  }
}

function checkTimes({ kind, place, t, lines }) {
  const { en, id } = NAMES[kind];
  const steps = stepsOf(t);
  const back = steps.findIndex((step) => step < 0) + 1;
  if (back > 0) {
    const [now, before] = [everyDigit(t[back]), everyDigit(t[back - 1])];
    throw wrong(
      `${place}, line ${lines[back]}: the time of the ${en} does not increase, ${now} s after ${before} s.`,
      `${place}, baris ${lines[back]}: waktu ${id} tidak bertambah, ${now} s sesudah ${before} s.`,
    );
  }
  const forward = steps.filter((step) => step > 0);
  if (forward.length === 0 || median(forward) < SHORTEST) {
    throw wrong(
      `${place}: the times of the ${en} hardly differ; is their unit right?`,
      `${place}: waktu ${id} hampir tidak berbeda; apakah satuannya benar?`,
    );
  }
}

/** t (n) -> the steps between them (n - 1). */
export function stepsOf(t) {
  return t.subarray(1).map((time, k) => time - t[k]);
}
