// Recordings of a gyroscope, an accelerometer and a magnetometer: files of phone apps in, one tidy recording
// out. Twin of kalman_lib/data/recording.py: the same rules, the same sentences; only an old .xls is refused.
//
// The body frame is forward-right-down (FRD). A phone's own axes are x to the right edge, y to the top edge
// and z out of the screen; so forward = y, right = x, down = -z. The accelerometer measures specific force:
// at rest it points up.
import { openFiles } from "./recording/archives.js";
import { tiltAgainst } from "./recording/angles.js";
import { bodyAxes, tellAxes, turned, usualAxes } from "./recording/axes.js";
import { noSensor, sheetsOf } from "./recording/csvs.js";
import { tellDip } from "./recording/dip.js";
import { NoSensor, say, stemOf } from "./recording/notes.js";
import { rateOf, resample } from "./recording/resample.js";
import { checkMagnitudes, deviceOf, isApple, totalAcceleration } from "./recording/sensors.js";
import { clean, keep, signalsIn } from "./recording/signals.js";

const MOST_TILT = 10; // degrees; gravity differs more from the app's orientation: it means something else
const WINDOW = 0.25; // s
const STEADY = { gyr: 0.06, acc: 0.5 }; // rad/s and m/s2: spread of a window at rest
const UNTURNED = 0.2; // rad/s: its mean
const UNMOVED = 0.5; // m/s2 from its first mean

/**
 * Files of one recording, [{name, bytes}, ...], -> a promise of what three sensors measured at T times:
 *
 * t          (T) s, from 0
 * gyr        (3 T) rad/s
 * acc        (3 T) m/s2, specific force: (0, 0, -9.81) at rest and level
 * mag        (3 T) in any scale, or null
 * rate       samples per second
 * rest_s     seconds of rest at the start
 * notes      [{en, id}, ...]: what was converted, resampled or left out
 * reference  the device's own roll, pitch, yaw (3 T) rad, north-east-down, or null
 *
 * axes: the sensors' own, "phone", "flu" or "frd", or those that point forward, right and down, such as
 * "y x -z"; null: "phone" for the apps; for a plain CSV "flu" if its z points up at the start, else "frd";
 * {gyr, acc, mag}: one for each. InputError: a sensor is missing, a unit is unknown or cannot be right, ...
 */
export async function readRecording(files, axes = null) {
  const notes = [];
  const chosen = bodyAxes(axes);
  const { signals, device } = await signalsOf(await openFiles(files), notes);
  totalAcceleration(signals, device, notes);
  checkMagnitudes(signals);
  const usual = axes === null ? usualAxes(signals, notes) : null;
  const turns = chosen ?? bodyAxes(usual);
  tellAxes(axes ?? usual, notes);
  const { t, columns } = resample(signals, notes);
  const inBody = (kind) => (columns[kind] ? turned(columns[kind], turns[kind]) : null);
  const [gyr, acc, mag] = ["gyr", "acc", "mag"].map(inBody);
  const rate = rateOf(t);
  if (mag === null) {
    tellSilentCompass(notes);
  } else {
    tellDip({ acc, mag, gyr }, rate, notes);
  }
  const isSure = [axes, usual].includes("phone") && !isApple(device);
  const reference = columns.orientation ? phoneReference(columns.orientation, acc, isSure, notes) : null;
  const recording = { T: t.length, t: t.map((time) => time - t[0]), gyr, acc, mag, rate, notes, reference };
  recording.rest_s = restSeconds(recording);
  tellRest(recording);
  return recording;
}

function tellSilentCompass(notes) {
  say(
    notes,
    "There is no magnetometer; the heading can only be followed, not measured.",
    "Tidak ada magnetometer; arah hadap hanya dapat diikuti, tidak terukur.",
  );
}

/** [[name, bytes], ...] -> {signals: {kind: signal}, device: what Metadata.csv of Sensor Logger tells}. */
async function signalsOf(tables, notes) {
  const found = {};
  const useless = [];
  let device = new Map();
  for (const [name, bytes] of tables) {
    if (stemOf(name) === "metadata") {
      device = deviceOf(bytes);
      continue;
    }
    const sheets = await sheetsOf(name, bytes).catch((error) => {
      if (!(error instanceof NoSensor)) {
        throw error;
      }
      useless.push(error);
      return null;
    });
    if (sheets === null) {
      continue;
    }
    const signals = sheets.flatMap((sheet) => signalsIn(sheet, notes));
    if (signals.length === 0) {
      useless.push(noSensor(sheets[0].place, sheets[0].names));
    }
    signals.forEach((signal) => keep(found, signal));
  }
  tellUseless(useless, found, notes);
  const signals = Object.entries(found).map(([kind, signal]) => [kind, clean(signal, notes)]);
  return { signals: Object.fromEntries(signals), device };
}

/** Files without a sensor are passed over; if a sensor is missing they may be the reason. */
function tellUseless(useless, signals, notes) {
  const isComplete = signals.gyr && (signals.acc || signals.linear);
  if (useless.length > 0 && !isComplete) {
    throw useless[0];
  }
  for (const { en, id } of useless) {
    say(notes, `Passed over: ${en}`, `Dilewati: ${id}`);
  }
}

/**
 * Sensor Logger's roll, pitch, yaw (3 T) rad -> ours, or null if their meaning is not certain. On Android
 * they are those of SensorManager.getOrientation (COORDINATES.md): yaw and roll as ours, pitch turned.
 */
function phoneReference(given, acc, isSure, notes) {
  const angles = given.map((angle, at) => (at % 3 === 1 ? -angle : angle));
  const tilt = tiltAgainst(angles, acc);
  if (isSure && tilt <= MOST_TILT) {
    const shown = tilt.toFixed(1);
    say(
      notes,
      `Reference: the app's own orientation; its tilt differs from gravity by ${shown} degrees (median).`,
      `Acuan: orientasi dari aplikasi; kemiringannya berbeda ${shown} derajat dari gravitasi (median).`,
    );
    return angles;
  }
  const shown = tilt.toFixed(0);
  const [why_en, why_id] = isSure
    ? [` (it differs from gravity by ${shown} degrees)`, ` (berbeda ${shown} derajat dari gravitasi)`]
    : ["", ""];
  say(
    notes,
    `The app's own orientation was left out: its convention is not certain here${why_en}.`,
    `Orientasi dari aplikasi tidak dipakai: konvensinya tidak pasti di sini${why_id}.`,
  );
  return null;
}

// --- rest at the start -------------------------------------------------------------------------------------

/**
 * Seconds of rest at the start, a multiple of the window; 0 if it does not begin at rest. At rest every axis
 * of the gyroscope spreads little and hardly turns on average, every axis of the accelerometer spreads little
 * and stays near its first mean.
 */
export function restSeconds({ t, gyr, acc, rate }) {
  const size = Math.max(Math.round(WINDOW * rate), 2);
  const count = Math.floor(t.length / size);
  const first = count > 0 ? momentsIn(acc, 0, size).mean : null;
  let windows = 0;
  while (windows < count && isStill(gyr, acc, windows * size, size, first)) {
    windows++;
  }
  return windows === 0 ? 0 : t[windows * size - 1] + 1 / rate;
}

function isStill(gyr, acc, from, size, first) {
  const turning = momentsIn(gyr, from, size);
  const moving = momentsIn(acc, from, size);
  return [0, 1, 2].every((i) => {
    const isSteady = turning.spread[i] < STEADY.gyr && moving.spread[i] < STEADY.acc;
    return isSteady && Math.abs(turning.mean[i]) < UNTURNED && Math.abs(moving.mean[i] - first[i]) < UNMOVED;
  });
}

/** {mean, spread} of each axis over some steps. */
function momentsIn(values, from, size) {
  const mean = [0, 0, 0];
  const square = [0, 0, 0];
  for (let at = 3 * from; at < 3 * (from + size); at++) {
    mean[at % 3] += values[at] / size;
  }
  for (let at = 3 * from; at < 3 * (from + size); at++) {
    square[at % 3] += (values[at] - mean[at % 3]) ** 2 / size;
  }
  return { mean, spread: square.map(Math.sqrt) };
}

function tellRest({ rest_s, notes }) {
  if (rest_s > 0) {
    const shown = rest_s.toFixed(2);
    say(
      notes,
      `The recording lies still for its first ${shown} s.`,
      `Rekaman diam selama ${shown} s pertama.`,
    );
    return;
  }
  say(
    notes,
    "The recording does not begin at rest: the bias of the gyroscope must be found in the motion.",
    "Rekaman tidak dimulai dalam keadaan diam: bias giroskop harus dicari selagi bergerak.",
  );
}
