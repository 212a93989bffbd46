// What was answered stays on this device: {wrong, value, typed} of every exercise that was tried. Where
// storage is switched off nothing is kept, and everything else works.

const KEY = "filter-kalman/exercise/"; // and the number: both languages of the book know it

/** What was kept of an exercise, {} if nothing. */
export function recall(number) {
  try {
    return JSON.parse(localStorage.getItem(KEY + number)) ?? {};
  } catch {
    return {};
  }
}

export function keep(number, entry) {
  try {
    localStorage.setItem(KEY + number, JSON.stringify(entry));
  } catch {
    // switched off, or full
  }
}

export function forget(number) {
  try {
    localStorage.removeItem(KEY + number);
  } catch {
    // switched off: nothing is there
  }
}
