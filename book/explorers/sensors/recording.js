// A recording of a phone's sensors: what is kept, drawn, filtered and handed on. Pure. A motion is
//   {T, t (T) s from 0, gyr (3 T) degrees a second, acc (3 T) m/s2, heading (T) degrees or NaN, live}
// step after step, in the axes and signs of units.js. A motion never changes: while it goes on, the next
// one is longer.
const SIGNIFICANT = 9; // digits in a file
const HEAD = [
  "Time (s)",
  ...["x", "y", "z"].map((axis) => `Gyroscope ${axis} (deg/s)`),
  ...["x", "y", "z"].map((axis) => `Acceleration ${axis} (m/s^2)`),
  "Compass (deg)",
];
const FIRST_ROOM = 1024; // steps

/** A recording that grows: {add(reading), motion(live), duration() s, latest() ms or null}. */
export function recorder() {
  let arrays = roomFor(FIRST_ROOM);
  let T = 0;
  let start = 0; // ms
  const add = ({ t, gyr, acc, heading }) => {
    if (T === arrays.t.length) {
      arrays = copied(arrays, roomFor(2 * T));
    }
    start = T === 0 ? t : start;
    arrays.t[T] = (t - start) / 1000;
    arrays.gyr.set(gyr, 3 * T);
    arrays.acc.set(acc, 3 * T);
    arrays.heading[T] = heading;
    T++;
  };
  const motion = (live) => ({ T, live, ...firstOf(arrays, T) });
  const duration = () => (T > 0 ? arrays.t[T - 1] : 0);
  const latest = () => (T > 0 ? start + 1000 * arrays.t[T - 1] : null);
  return { add, motion, duration, latest };
}

function roomFor(steps) {
  return {
    t: new Float64Array(steps),
    gyr: new Float64Array(3 * steps),
    acc: new Float64Array(3 * steps),
    heading: new Float64Array(steps),
  };
}

function copied(from, to) {
  for (const [name, values] of Object.entries(from)) {
    to[name].set(values);
  }
  return to;
}

function firstOf({ t, gyr, acc, heading }, T) {
  return {
    t: t.subarray(0, T),
    gyr: gyr.subarray(0, 3 * T),
    acc: acc.subarray(0, 3 * T),
    heading: heading.subarray(0, T),
  };
}

/** Readings a second. */
export function rateOf({ T, t }) {
  return T > 1 ? (T - 1) / t[T - 1] : 0;
}

// --- as a file ---------------------------------------------------------------------------------------------

/**
 * A CSV that read_recording of kalman_lib.data takes for a phone's; in Indonesian with the signs that its
 * spreadsheets expect.
 */
export function toCsv({ T, t, gyr, acc, heading }, language) {
  const separator = language === "id" ? ";" : ",";
  const lines = [HEAD.join(separator)];
  for (let k = 0; k < T; k++) {
    const step = [t[k], ...gyr.subarray(3 * k, 3 * k + 3), ...acc.subarray(3 * k, 3 * k + 3), heading[k]];
    lines.push(step.map((value) => cellOf(value, language)).join(separator));
  }
  return `${lines.join("\n")}\n`;
}

function cellOf(value, language) {
  if (Number.isNaN(value)) {
    return "";
  }
  const text = String(Number(value.toPrecision(SIGNIFICANT)));
  return language === "id" ? text.replace(".", ",") : text;
}

/** The motion in a text that toCsv has written in English; null if it is none. */
export function fromCsv(text) {
  const [head, ...lines] = text.trimEnd().split("\n");
  if (head !== HEAD.join(",") || lines.length === 0) {
    return null;
  }
  const made = recorder();
  for (const line of lines) {
    const cells = line.split(",").map((cell) => (cell === "" ? NaN : Number(cell)));
    made.add({
      t: 1000 * cells[0],
      gyr: cells.slice(1, 4),
      acc: cells.slice(4, 7),
      heading: cells[7],
    });
  }
  return made.motion(false);
}
