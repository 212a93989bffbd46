// Recordings that the reader keeps: in this browser alone, the same for all chapters, the latest first.
// Each is a CSV of its own; the list of them is short, for it is read often.
import { fromCsv, toCsv } from "../sensors/recording.js";

const KEY = "kalman-motion";
const MOST = 5;

/** [{when (a time, its name), seconds}, ...] */
export function keptRecordings() {
  try {
    const kept = JSON.parse(localStorage.getItem(KEY));
    return Array.isArray(kept) ? kept : [];
  } catch {
    return []; // spoilt, or the browser refuses
  }
}

/** false: the browser refuses. */
export function keepRecording(motion, when) {
  const one = { when, seconds: Math.round(motion.t[motion.T - 1]) };
  const all = [one, ...keptRecordings()];
  const text = toCsv(motion, "en");
  try {
    all.slice(MOST).forEach(remove);
    localStorage.setItem(nameOf(one), text);
    localStorage.setItem(KEY, JSON.stringify(all.slice(0, MOST)));
    return true;
  } catch {
    return false;
  }
}

/** The motion that was kept at that time; null if it is gone or spoilt. */
export function replayed(when) {
  return fromCsv(localStorage.getItem(nameOf({ when })) ?? "");
}

export function forgetRecordings() {
  keptRecordings().forEach(remove);
  localStorage.removeItem(KEY);
}

function nameOf({ when }) {
  return `${KEY}-${when}`;
}

function remove(one) {
  localStorage.removeItem(nameOf(one));
}
