// Two columns of a table -> times in seconds and what was measured then. Twin of kalman_lib/data/series.py.
import { InputError } from "../language/input.js";
import { TIME_UNITS } from "./units.js";

/**
 * {t: seconds from 0 (null without a column of times), z, lines, notes} of a table; time and value: names of
 * other columns, unit: that of the time. Equal times are averaged; InputError: they go back.
 */
export function seriesOf(table, { time = null, value = null, unit = null } = {}) {
  const name = time ?? table.time;
  const all = table.columns.get(value ?? table.value);
  if (name === null) {
    return { t: null, z: all, lines: table.lines, notes: [] };
  }
  const notes = [];
  const seconds = TIME_UNITS[unit ?? table.units[name]]?.[0];
  if (seconds === undefined) {
    notes.push({ en: `${name} was taken as seconds`, id: `${name} dianggap dalam detik` });
  }
  const stamps = table.columns.get(name);
  const known = [...stamps.keys()].filter((k) => Number.isFinite(stamps[k]));
  const rest = stamps.length - known.length;
  if (rest > 0) {
    notes.push({ en: `rows without a time: ${rest}`, id: `baris tanpa waktu: ${rest}` });
  }
  checkOrder(stamps, known, table.lines);
  const t = Float64Array.from(known, (k) => (stamps[k] - stamps[known[0]]) * (seconds ?? 1));
  const z = Float64Array.from(known, (k) => all[k]);
  const lines = known.map((k) => table.lines[k]);
  return averaged({ t, z, lines, notes });
}

function checkOrder(stamps, known, lines) {
  const at = known.findIndex((k, i) => i > 0 && stamps[k] < stamps[known[i - 1]]);
  if (at > 0) {
    const [line, now, before] = [lines[known[at]], stamps[known[at]], stamps[known[at - 1]]].map(digits);
    throw new InputError({
      en: `Line ${line}: the time goes back, ${now} after ${before}.`,
      id: `Baris ${line}: waktunya mundur, ${now} setelah ${before}.`,
    });
  }
}

/** Every digit that tells. */
function digits(value) {
  return String(Number(value.toPrecision(15)));
}

/** Of equal times one, with the mean of what was measured. */
function averaged({ t, z, lines, notes }) {
  const first = [...t.keys()].filter((k) => k === 0 || t[k] > t[k - 1]);
  const fewer = t.length - first.length;
  if (fewer === 0) {
    return { t, z, lines, notes };
  }
  const means = first.map((start, i) => {
    const known = z.subarray(start, first[i + 1] ?? z.length).filter((value) => !Number.isNaN(value));
    return known.length > 0 ? known.reduce((sum, value) => sum + value, 0) / known.length : NaN;
  });
  const note = {
    en: `equal times were averaged: ${fewer} rows fewer`,
    id: `waktu yang sama dirata-ratakan: berkurang ${fewer} baris`,
  };
  return {
    t: Float64Array.from(first, (k) => t[k]),
    z: Float64Array.from(means),
    lines: first.map((k) => lines[k]),
    notes: [...notes, note],
  };
}
