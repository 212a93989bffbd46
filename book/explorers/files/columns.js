// A table in a grid -> its columns: numbers, dates and clock times as seconds, notes. Twin of
// kalman_lib/data/build.py.
import { InputError } from "../language/input.js";
import { strip } from "./blanks.js";
import { noNumber } from "./block.js";
import { cut, hasLetter, isGap, isValue, numberIn, quoted, shownCell, toNumber } from "./cells.js";
import { dotted, moment, secondsOf } from "./clock.js";
import { signOf } from "./decimals.js";
import { MAX_COLUMNS, MAX_NUMBER, tooWide } from "./limits.js";
import { CLOCK_WORDS, canonical, unitOf, wordsOf } from "./units.js";

const QUICK = /^[0-9.,+\-eE]*$/; // nothing but a plain number or an empty cell
const DATE = /[0-9]-[0-9]/;
const NUMBERS = "numbers";
const DOTTED = "dotted"; // "10.30" may be a clock time
const MOMENTS = "moments";
const WORDS = "words";
const EMPTY = "empty";
const LONGEST_NAME = 40;

/** {columns with values, skipped names, sign, notes} of a table as block.js finds it. */
export function columnsOf(block, decimal) {
  const { rows, names, notes } = turned(block);
  const width = names.length;
  if (width > MAX_COLUMNS) {
    throw tooWide(width);
  }
  const units = block.units.length === width ? block.units : Array(width).fill("");
  const taken = unique(names);
  const made = names.map((head, place) => {
    const cells = rows.map(([, row]) => row[place] ?? "");
    return columnOf({ place, head, name: taken[place], cells }, units[place]);
  });
  const [sign, remark] = decimalSign(rows, made, decimal);
  if (remark) {
    notes.push(remark);
  }
  const columns = joined(made);
  const lines = rows.map(([line]) => line);
  columns.forEach((column) => fill(column, sign, lines, notes));
  return {
    columns: columns.filter(({ values }) => values !== null),
    skipped: columns.filter(({ kind }) => kind === WORDS).map(({ name }) => name),
    sign,
    notes,
  };
}

function columnOf(column, given) {
  const moments = momentsIn(column.cells);
  const kind = moments ? MOMENTS : kindOf(column.cells, column.head);
  const unit = given ? canonical(given) : unitOf(column.head);
  return { ...column, moments, kind, unit, values: null };
}

/** {rows, names, notes}: a row of numbers, or rows that begin with their names, as columns. */
function turned({ rows, names, hasHeader }) {
  const filled = rows.map(([, cells]) => cells).filter((cells) => cells.length > 0);
  const width = filled[0].length;
  const isRow = filled.length === 1 && width > 1 && !hasHeader && areNumbers(filled[0]);
  const hasNames = !hasHeader && filled.length < width - 1 && filled.every(isNamedRow);
  if (!isRow && !hasNames) {
    return { rows, names, notes: [] };
  }
  const lists = isRow ? filled : filled.map((cells) => cells.slice(1));
  const note = { en: "a row was read as a column", id: "baris dibaca sebagai kolom" };
  return {
    rows: lists[0].map((_, k) => [k + 1, lists.map((cells) => cells[k])]),
    names: isRow ? [""] : filled.map((cells) => strip(shownCell(cells[0]))),
    notes: [note],
  };
}

function areNumbers(cells) {
  const isNumber = (cell) => toNumber(cell, ".") !== null || toNumber(cell, ",") !== null;
  return cells.every((cell) => isGap(cell) || isNumber(cell));
}

function isNamedRow(cells) {
  return hasLetter(cells[0]) && !isValue(cells[0]) && areNumbers(cells.slice(1));
}

/** The names, none of them empty or twice. */
function unique(names) {
  const taken = new Set(names);
  const counts = new Map();
  return names.map((name, i) => {
    const base = name || String(i + 1);
    let count = (counts.get(base) ?? 0) + 1;
    let unused = count === 1 ? base : `${base} (${count})`;
    while (count > 1 && taken.has(unused)) {
      count++;
      unused = `${base} (${count})`;
    }
    counts.set(base, count);
    return unused;
  });
}

// --- what stands in a column -------------------------------------------------------------------------------

function kindOf(cells, head) {
  const nothing = head ? WORDS : EMPTY;
  if (cells.every(isPlain)) {
    if (!cells.some((cell) => cell !== "")) {
      return nothing;
    }
    return areDotted(cells, head) ? DOTTED : NUMBERS;
  }
  const known = cells.filter((cell) => !isGap(cell));
  if (known.length === 0) {
    return cells.some((cell) => cell !== "") ? WORDS : nothing;
  }
  const words = known.filter((cell) => !isValue(cell)).length;
  return 2 * words > known.length ? WORDS : NUMBERS;
}

/** Is it a plain number or empty? */
function isPlain(cell) {
  return typeof cell === "string" && QUICK.test(cell) && !DATE.test(cell);
}

/** The dates and clock times of a column, null where there is a gap; null if it has others. */
function momentsIn(cells) {
  const moments = [];
  for (const cell of cells) {
    const one = typeof cell === "string" ? moment(cell) : null;
    if (one === null && !isGap(cell)) {
      return null;
    }
    moments.push(one);
  }
  return moments.some(Boolean) ? moments : null;
}

function areDotted(cells, head) {
  const isClock = wordsOf(head).some((word) => CLOCK_WORDS.has(word));
  return isClock && cells.every((cell) => cell === "" || dotted(cell));
}

/** The decimal sign; "10.30" is a clock time where it would be the only number with a point. */
function decimalSign(rows, columns, decimal) {
  const clocks = columns.filter(({ kind }) => kind === DOTTED);
  const places = columns.filter(({ kind }) => kind === NUMBERS).map(({ place }) => place);
  const found = signOf(rows, places, decimal);
  if (clocks.length === 0) {
    return found;
  }
  const areClocks = found[0] === "," || clocks.every(({ head }) => wordsOf(head).includes("pukul"));
  for (const column of clocks) {
    column.kind = areClocks ? MOMENTS : NUMBERS;
    column.moments = areClocks ? column.cells.map(dotted) : null;
  }
  return areClocks ? found : signOf(rows, [...places, ...clocks.map(({ place }) => place)], decimal);
}

/** Dates in one column and clock times in another are one time. */
function joined(columns) {
  const has = ({ moments }, part) => moments?.some((one) => one && one[part] !== null) ?? false;
  const date = columns.find((one) => has(one, "date") && !has(one, "clock"));
  const time = columns.find((one) => has(one, "clock") && !has(one, "date"));
  if (!date || !time) {
    return columns;
  }
  date.moments = date.moments.map((one, k) => {
    const other = time.moments[k];
    return one && other && { ...other, date: one.date };
  });
  if (date.head && time.head) {
    date.head = `${date.head} ${time.head}`;
    date.name = date.head;
  }
  return columns.filter((one) => one !== time);
}

// --- values ------------------------------------------------------------------------------------------------

function fill(column, sign, lines, notes) {
  if (column.kind === MOMENTS) {
    fillSeconds(column, notes);
  } else if (column.kind === NUMBERS) {
    column.values = numbersIn(column, sign, lines);
    if (column.values.every(Number.isNaN)) {
      column.values = null;
      column.kind = WORDS;
    } else {
      checkSize(column, lines);
    }
  }
}

function fillSeconds(column, notes) {
  const found = secondsOf(column.moments);
  if (found === null) {
    column.kind = WORDS;
    return;
  }
  const { seconds, assumed } = found;
  const start = seconds.findIndex((value) => value !== null);
  const name = cut(column.name, LONGEST_NAME);
  const first = cut(shownCell(column.cells[start]), LONGEST_NAME);
  column.values = Float64Array.from(seconds, (value) => (value === null ? NaN : value - seconds[start]));
  column.unit = "s";
  notes.push({ en: `${name}: seconds since ${first}`, id: `${name}: detik sejak ${first}` });
  if (assumed.has("day")) {
    notes.push({
      en: `${first} was read as day before month`,
      id: `${first} dibaca dengan hari sebelum bulan`,
    });
  }
  if (assumed.has("midnight")) {
    notes.push({ en: "it goes on after midnight", id: "lewat tengah malam diteruskan" });
  }
}

/** The values; InputError where a cell is no number, or has another unit. */
function numbersIn(column, sign, lines) {
  const { cells, name } = column;
  let unit = "";
  return Float64Array.from(cells, (cell, k) => {
    const [value, other] = numberIn(cell, sign ?? ".");
    if (value === null) {
      throw noNumber(lines[k], name, cell);
    }
    if (other && !unit) {
      unit = other;
      column.unit = canonical(unit);
    } else if (other && canonical(other) !== canonical(unit)) {
      throw mixed(lines[k], name, unit, other);
    }
    return value;
  });
}

function mixed(line, name, unit, other) {
  return new InputError({
    en: `Line ${line}, column ${quoted(name)}: the units ${unit} and ${other} are mixed.`,
    id: `Baris ${line}, kolom ${quoted(name)}: satuan ${unit} dan ${other} bercampur.`,
  });
}

/** InputError: a number beyond all sense. */
function checkSize({ values, cells, name }, lines) {
  const at = values.findIndex((value) => Math.abs(value) > MAX_NUMBER);
  if (at >= 0) {
    const shown = quoted(cells[at]);
    throw new InputError({
      en: `Line ${lines[at]}, column ${quoted(name)}: ${shown} is too large (beyond 1e+300).`,
      id: `Baris ${lines[at]}, kolom ${quoted(name)}: ${shown} terlalu besar (di atas 1e+300).`,
    });
  }
}
