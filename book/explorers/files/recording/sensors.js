// Do the signals of a recording make sense? An accelerometer with gravity in it is needed, and a gyroscope.
// Twin of kalman_lib/data/sensors.py.
import { quoted } from "../cells.js";
import { decode } from "../grid.js";
import { NAMES, general, median, say, wrong } from "./notes.js";
import { interpolate, noOverlap } from "./resample.js";
import { rowsIn } from "./rows.js";
import { rowsOf } from "./signals.js";

const MAX_RATE = 60; // rad/s
const MOST_METADATA = 100000; // bytes
const MOST_FIELD = 1e6; // in any unit
const LEAST_GRAVITY = 6; // m/s2: the median of the acceleration lies between
const MOST_GRAVITY = 14;
const HEADERS = { gyr: "Gyroscope x (rad/s)", acc: "Acceleration x (m/s^2)" };

/** See to it that signals has "gyr" and "acc", with gravity and in the sign of Android. */
export function totalAcceleration(signals, device, notes) {
  if (!signals.acc && signals.linear && signals.gravity) {
    signals.acc = withGravity(signals.linear, signals.gravity);
    say(
      notes,
      "Acceleration without gravity and gravity were added.",
      "Percepatan tanpa gravitasi dan gravitasi dijumlahkan.",
    );
  }
  checkPresence(signals);
  const { acc } = signals;
  // Sensor Logger on iOS turns the sign, unless "Standardise Units & Frames" is on (its COORDINATES.md and
  // CROSSPLATFORM.md); phyphox on iOS multiplies by -9.81 (its ExperimentSensorInput.swift)
  if (acc.source === "logger" && isApple(device)) {
    signals.acc = { ...acc, values: acc.values.map((value) => -value) };
    say(notes, "iPhone: the sign of the acceleration was turned.", "iPhone: tanda percepatan dibalik.");
  } else if (acc.source === "logger" && !device.get("platform")) {
    say(
      notes,
      "Metadata.csv is missing: the signs of Android were taken (an iPhone's acceleration is opposite).",
      "Metadata.csv tidak ada: dipakai tanda Android (percepatan iPhone berlawanan).",
    );
  }
}

/** The first row of Metadata.csv, a Map; empty if it cannot be read. */
export function deviceOf(bytes) {
  const text = (decode(bytes.subarray(0, MOST_METADATA)) ?? "").replace(/\r\n?/g, "\n");
  const rows = [...rowsIn(text, ",", false)].map(([, cells]) => cells).filter((cells) => cells.length > 0);
  const [names = [], values = []] = rows;
  return new Map(rows.length > 1 ? names.map((name, k) => [name, values[k] ?? ""]) : []);
}

/** Does this Metadata.csv of Sensor Logger tell of an iPhone with its own signs? */
export function isApple(device) {
  const of = (name) => (device.get(name) ?? "").toLowerCase();
  return of("platform") === "ios" && of("standardisation") !== "true";
}

function withGravity(linear, gravity) {
  const [first, last] = [gravity.t[0], gravity.t.at(-1)];
  const inside = Array.from(linear.t, (time) => time >= first && time <= last);
  if (inside.filter(Boolean).length < 2) {
    throw noOverlap(linear, gravity);
  }
  const total = rowsOf(linear, inside);
  const added = interpolate(total.t, gravity);
  return { ...total, kind: "acc", values: total.values.map((value, at) => value + added[at]) };
}

/** InputError if the gyroscope or an accelerometer with gravity is missing. */
function checkPresence(signals) {
  if (!signals.acc && signals.linear) {
    const { place } = signals.linear;
    throw wrong(
      `${place}: this accelerometer has no gravity in it; record the one with g (phyphox) or ` +
        "also TotalAcceleration or Gravity (Sensor Logger).",
      `${place}: akselerometer ini tanpa gravitasi; rekamlah yang memakai g (phyphox) atau ` +
        "juga TotalAcceleration atau Gravity (Sensor Logger).",
    );
  }
  for (const [kind, header] of Object.entries(HEADERS)) {
    if (!signals[kind]) {
      const { en, id } = NAMES[kind];
      throw wrong(
        `There is no ${en} in the files; record one, with headers such as ${quoted(header)}.`,
        `Tidak ada ${id} dalam berkas; rekamlah, dengan judul seperti ${quoted(header)}.`,
      );
    }
  }
}

/** InputError for rates and accelerations that only a wrong unit explains; mag may be missing. */
export function checkMagnitudes({ gyr, acc, mag }) {
  [acc, mag].filter(Boolean).forEach(checkSize);
  const { k, size: fastest } = largestOf(gyr);
  if (fastest > MAX_RATE) {
    const shown = fastest.toFixed(0);
    const line = gyr.lines[k];
    throw wrong(
      `${gyr.place}, line ${line}: ${shown} rad/s is faster than any such sensor measures ` +
        `(${MAX_RATE}); is the unit deg/s?`,
      `${gyr.place}, baris ${line}: ${shown} rad/s melebihi kemampuan sensor seperti itu ` +
        `(${MAX_RATE}); apakah satuannya deg/s?`,
    );
  }
  const sizes = acc.t.map((_, at) => Math.hypot(...acc.values.subarray(3 * at, 3 * at + 3)));
  const g = median(sizes);
  if (!(g > LEAST_GRAVITY && g < MOST_GRAVITY)) {
    throw wrong(
      `${acc.place}: half of the accelerations are below ${g.toFixed(2)} m/s2, but with gravity they ` +
        "lie around 9.8; either gravity was taken out or the unit in the header is wrong.",
      `${acc.place}: separuh percepatan di bawah ${g.toFixed(2)} m/s2, padahal dengan gravitasi ` +
        "nilainya sekitar 9,8; gravitasinya dihilangkan atau satuan di judul salah.",
    );
  }
}

function checkSize(signal) {
  const { k, size } = largestOf(signal);
  if (size > MOST_FIELD) {
    const { en, id } = NAMES[signal.kind];
    const line = signal.lines[k];
    throw wrong(
      `${signal.place}, line ${line}: no ${en} shows ${general(size, 6)}.`,
      `${signal.place}, baris ${line}: tidak ada ${id} yang menunjukkan ${general(size, 6)}.`,
    );
  }
}

/** The row with the largest value. */
function largestOf({ values }) {
  let best = 0;
  for (let at = 1; at < values.length; at++) {
    best = Math.abs(values[at]) > Math.abs(values[best]) ? at : best;
  }
  return { k: Math.floor(best / 3), size: Math.abs(values[best]) };
}
