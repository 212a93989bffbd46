// The header of a column -> which sensor it is, along which axis, in which unit. A sensor is recognised by
// its unit, so the language of the header does not matter. Twin of kalman_lib/data/columns.py.
import { words } from "../blanks.js";

export const GRAVITY = 9.80665; // m/s2, the standard g
const DEG = Math.PI / 180;

/** "unit, unit" -> [[unit, [what it measures, factor to SI]], ...] */
function each(units, kind, factor) {
  return units.split(" ").map((unit) => [unit, [kind, factor]]);
}

export const UNITS = new Map([
  ...each("rad/s rad/sec radians/s rps", "gyr", 1),
  ...each("deg/s deg/sec °/s °/sec dps degrees/s degree/s", "gyr", DEG),
  ...each("mdps mdeg/s", "gyr", DEG / 1000),
  ...each("m/s2 m/s/s m/sec2 ms-2 m·s-2", "acc", 1),
  ...each("g gn", "acc", GRAVITY),
  ...each("mg", "acc", GRAVITY / 1000),
  ...each("μt ut nt mt t G mG gauss mgauss", "mag", 1), // any
  ...each("s sec secs second seconds detik dtk", "time", 1),
  ...each("ms msec millis milliseconds milidetik", "time", 1e-3),
  ...each("μs us usec micros microseconds", "time", 1e-6),
  ...each("ns nsec nanos nanoseconds", "time", 1e-9),
]);
export const ACCEPTED = "rad/s, deg/s, °/s; m/s2, m/s^2, g, mg; s, ms, us, ns";
const CASE_MATTERS = ["G", "mG"]; // gauss, not gravity
const TIMES = ["t", "time", "timestamp", "waktu", "detik", "zeit", "seconds", "seconds_elapsed"];
const ACCELERATIONS = ["acc", "accel", "acel", "beschl", "percep"];
const SENSOR_WORDS = ["gyr", "giro", ...ACCELERATIONS];
const LINEAR_WORDS = ["linear", "linier", "lineal", "linéaire", "user"];
const WITHOUT = ["without", "ohne", "tanpa", "sin", "sans", "senza", "sem"];
const GRAVITY_WORDS = ["gravit", "schwerkraft"];
/** Of loggers: gx, acc_x, MagX. */
export const PLAIN_NAMES = ["g", "gyr", "gyro", "a", "acc", "accel", "m", "mag"];
const LONGEST = 120; // characters of a header that are looked at
const KINDS = ["gyr", "acc", "mag"];

/**
 * "Gyroscope x (rad/s)" -> {name: "gyroscope", axis: "x", unit: "rad/s", kind: "gyr"}. kind: "time"; "gyr",
 * "acc" or "mag"; "unknown": a sensor whose unit we do not know; "logger": a bare x, y or z; null: no sensor.
 */
export function readHeader(header) {
  const looked = Array.from(header.slice(0, 2 * LONGEST))
    .slice(0, LONGEST)
    .join("");
  const [whole, unit] = nameAndUnit(words(looked).join(" "));
  const [name, axis] = nameAndAxis(whole.toLowerCase());
  const measured = UNITS.get(unit)?.[0] ?? null;
  if (axis === null) {
    const isTime = measured === "time" || TIMES.includes(name);
    return { name, axis, unit, kind: isTime ? "time" : null };
  }
  const by_name = kindByName(name);
  if (CASE_MATTERS.includes(unit) && by_name === "unknown" && isAcceleration(name)) {
    return { name, axis, unit: unit.toLowerCase(), kind: "acc" }; // an accelerometer in "G" or "mG"
  }
  return { name, axis, unit, kind: KINDS.includes(measured) ? measured : by_name };
}

/** "a x (m/s^2)" -> ["a x", "m/s2"]; "Time since start in ms" -> ["time", "ms"]. */
function nameAndUnit(header) {
  for (const [left, right] of ["()", "[]"]) {
    const at = header.lastIndexOf(left);
    const rest = header.slice(at + 1);
    if (at >= 0 && rest.indexOf(right) === rest.length - 1 && rest !== "") {
      return [header.slice(0, at).trim(), plainUnit(rest.slice(0, -1))];
    }
  }
  const parts = header.toLowerCase().split(" ").filter(Boolean);
  if (parts.length > 2 && parts[0] === "time" && parts.at(-2) === "in") {
    return ["time", plainUnit(parts.at(-1))];
  }
  return [header, null];
}

/** "gyro_x" -> ["gyro", "x"]; the axis stands at the end. */
function nameAndAxis(name) {
  const last = name.slice(-1);
  if (last === "" || !"xyz".includes(last)) {
    return [name, null];
  }
  let end = name.length - 1;
  while (end > 0 && " _.-".includes(name[end - 1])) {
    end--;
  }
  return [name.slice(0, end), last];
}

/** m/s², m/s^2 and m / s2 are all m/s2. */
function plainUnit(unit) {
  const plain = unit.normalize("NFKC").replaceAll("^", "").replaceAll(" ", "");
  return CASE_MATTERS.includes(plain) ? plain : plain.toLowerCase();
}

/** The kind of a column with an axis but without a unit that we know. */
function kindByName(name) {
  if (name === "") {
    return "logger";
  }
  if (name === "m" || name.includes("mag")) {
    return "mag";
  }
  const isSensor = name === "g" || name === "a" || SENSOR_WORDS.some((word) => name.includes(word));
  return isSensor ? "unknown" : null;
}

function isAcceleration(name) {
  return name === "a" || ACCELERATIONS.some((word) => name.includes(word));
}

/** Without gravity? */
export function isLinear(name) {
  const parts = words(name.replaceAll("(", " ").replaceAll(")", " "));
  const without_g = parts.some((word, i) => WITHOUT.includes(word) && parts[i + 1] === "g");
  return without_g || LINEAR_WORDS.some((word) => name.includes(word));
}

export function isGravity(name) {
  return GRAVITY_WORDS.some((word) => name.includes(word));
}

/** Does the column below this header belong to a sensor, to its times or to a device's angles? */
export function isWanted(header) {
  return readHeader(header).kind !== null || ["roll", "pitch", "yaw"].includes(header);
}
