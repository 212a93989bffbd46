// What messages about recordings call things, the notes of a recording, and numbers as Python writes them.
// Twin of kalman_lib/data/words.py.
import { InputError } from "../../language/input.js";

export const NAMES = {
  gyr: { en: "gyroscope", id: "giroskop" },
  acc: { en: "accelerometer", id: "akselerometer" },
  linear: { en: "accelerometer without gravity", id: "akselerometer tanpa gravitasi" },
  gravity: { en: "gravity sensor", id: "sensor gravitasi" },
  mag: { en: "magnetometer", id: "magnetometer" },
  orientation: { en: "orientation", id: "orientasi" },
};
export const AXES_NAMES = {
  phone: {
    en: "those of a phone (x right, y to the top edge, z out of the screen)",
    id: "sumbu ponsel (x ke kanan, y ke tepi atas, z keluar dari layar)",
  },
  flu: { en: "forward-left-up", id: "depan-kiri-atas" },
  frd: { en: "forward-right-down", id: "depan-kanan-bawah" },
};

/** Add a sentence to the notes of a recording. */
export function say(notes, en, id) {
  notes.push({ en, id });
}

export function wrong(en, id) {
  return new InputError({ en, id });
}

/** A file without a sensor: others may have them. */
export class NoSensor extends InputError {}

/** As Python's format "g" writes it, with so many digits. */
export function general(value, digits) {
  const [head, tail] = value.toExponential(digits - 1).split("e");
  const power = Number(tail);
  if (power >= -4 && power < digits) {
    return String(Number(value.toPrecision(digits)));
  }
  return `${Number(head)}e${exponent(power)}`;
}

/** As Python's repr writes a float: every digit, and "5.0". */
export function everyDigit(value) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e16)) {
    const [head, tail] = value.toExponential().split("e");
    return `${head}e${exponent(Number(tail))}`;
  }
  return Number.isInteger(value) ? `${value}.0` : String(value);
}

function exponent(power) {
  return `${power < 0 ? "-" : "+"}${String(Math.abs(power)).padStart(2, "0")}`;
}

/** The name of a file without its folders and its ending, in small letters. */
export function stemOf(place) {
  const name = place.split("/").filter(Boolean).at(-1) ?? "";
  const dot = name.lastIndexOf(".");
  return (dot > 0 && dot < name.length - 1 ? name.slice(0, dot) : name).toLowerCase();
}

export function median(values) {
  const sorted = Float64Array.from(values).sort();
  const half = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}
