// Which column is the time, and which one the measurement, unless the reader chooses others. Twin of
// kalman_lib/data/roles.py.
import { namesMeasurement, namesRow, namesSide, namesTime } from "./units.js";

const EPOCHS = { s: 1e9, ms: 1e12, us: 1e15, ns: 1e18 }; // since 1970, today

/**
 * {time or null, value or null}: names of columns. columns: Map of name -> numbers; heads: Map of name ->
 * text of the header, "" without one; moments: a Set of the names of columns of dates and clock times.
 */
export function rolesOf(columns, units, heads, moments) {
  const all = [...columns.keys()];
  const hasNames = [...heads.values()].some(Boolean);
  const counters = new Set(all.filter((name) => countsRows(columns.get(name), heads.get(name), hasNames)));
  let times = all.filter((name) => {
    const isMoment = moments.has(name);
    return (isMoment || isTime(columns.get(name), heads.get(name), units[name] ?? "")) && !counters.has(name);
  });
  if (times.length === 0 && !hasNames) {
    times = firstThatGrows(columns, counters);
  }
  const rest = all.filter((name) => !times.includes(name) && !counters.has(name));
  if (rest.length === 0) {
    return ofFew(all, times, moments);
  }
  const time = times.find((name) => grows(columns.get(name))) ?? times[0] ?? null;
  return { time, value: measurementIn(rest, heads) };
}

/** The first column whose name says that it is measured; else the first one. */
export function measurementIn(names, heads, words = undefined) {
  const named = names.find((name) => namesMeasurement(heads.get(name), words));
  return named ?? names.find((name) => !namesSide(heads.get(name))) ?? names[0] ?? null;
}

/** Only times or numbers of rows: the last one is what was measured, if it is no clock. */
function ofFew(all, times, moments) {
  const value = all.filter((name) => !moments.has(name)).at(-1) ?? null;
  return { time: times.find((name) => name !== value) ?? null, value };
}

/** Does it never go back, and gets somewhere? */
function grows(values) {
  const known = values.filter(Number.isFinite);
  const goesOn = known.every((value, k) => k === 0 || value >= known[k - 1]);
  return known.length > 1 && goesOn && known.at(-1) > known[0];
}

function isTime(values, head, unit) {
  if (!head || !namesTime(head, unit)) {
    return false;
  }
  return head.trim() !== "T" || grows(values); // T: a temperature, unless it grows
}

/** Is every step so large? */
function steps(values, isRight) {
  return values.every((value, k) => k === 0 || isRight(value - values[k - 1]));
}

const byOne = (step) => step === 1;
const up = (step) => step > 0;

/** 1, 2, 3 under "No", or under nothing while other columns have names. */
function countsRows(values, head, hasNames) {
  if (!steps(values, byOne) || (values[0] !== 0 && values[0] !== 1)) {
    return false;
  }
  return namesRow(head) || (!head && hasNames);
}

/** Without names: the first column if it grows; where it only counts, the second that does. */
function firstThatGrows(columns, counters) {
  const [[name, first], [other, second] = []] = columns;
  if (columns.size < 2 || first.length < 2 || !steps(first, up)) {
    return [];
  }
  const counts = columns.size > 2 && first.length > 2 && steps(first, byOne);
  if (counts && (first[0] === 0 || first[0] === 1) && steps(second, up)) {
    counters.add(name);
    return [other];
  }
  return [name];
}

/** "ms" for 1700000000000: the unit of times since 1970; "" if they cannot be that. */
export function epochUnit(values) {
  const known = values.filter(Number.isFinite);
  const fits = ([, size]) => known.every((value) => value >= 0.5 * size && value < 5 * size);
  const found = known.length > 0 && Object.entries(EPOCHS).find(fits);
  return found ? found[0] : "";
}
