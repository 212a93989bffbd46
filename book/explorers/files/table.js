// Numbers in: reads a pasted text or a CSV file. Twin of kalman_lib/data/table.py: the
// same rules, the same sentences; what it does not read is .xlsx, and then it says so.
import { InputError } from "../language/input.js";
import { cut, isGap, isNumber, quoted, valueOf } from "./cells.js";
import { BLANKS, NO_REMARK, decode, split, strip } from "./grid.js";

export const MAX_READ = 200000; // rows
const MAX_NUMBER = 1e300;
const MAX_LISTED = 5; // names of columns in a sentence

/**
 * A pasted text or CSV -> {columns: Map of name -> Float64Array (NaN = gap), lines, skipped, decimal, note
 * {id, en}}. decimal "," or "." says which decimal sign it has; null: find out. InputError: whatever cannot
 * be understood.
 */
export function readText(text, decimal = null) {
  const [grid, remark] = split(text.replace(/^\ufeff/, ""), decimal);
  return tableOf(grid, decimal, remark);
}

/** The bytes (Uint8Array) of a .csv, .txt or .tsv file, the same way. */
export function readFile(name, bytes, decimal = null) {
  const text = /\.(csv|txt|tsv)$/i.test(name) ? decode(bytes) : null;
  if (text === null) {
    const shown = quoted(name, 60);
    throw new InputError({
      en:
        `${shown} is not a text file (.csv, .txt, .tsv); save it as CSV, ` +
        "or copy the column and paste it.",
      id:
        `${shown} bukan berkas teks (.csv, .txt, .tsv); simpanlah sebagai CSV, ` +
        "atau salin kolomnya lalu tempelkan.",
    });
  }
  return readText(text, decimal);
}

/**
 * What a reader brought, a text or a file; a workbook comes as a table already, which the kernel of a
 * notebook has read.
 */
export function readBrought({ text, file }, decimal = null) {
  if (!file) {
    return readText(text, decimal);
  }
  return file.table ?? readFile(file.name, file.bytes, decimal);
}

export function tooLong(rows, limit) {
  return new InputError({
    en: `${rows} rows are too many; the limit is ${limit}.`,
    id: `${rows} baris terlalu banyak; batasnya ${limit}.`,
  });
}

/** Grid -> table; finds the header and the decimal sign, checks every cell. */
function tableOf(grid, decimal, remark) {
  const rows = trimmed(grid);
  if (rows.length > MAX_READ + 1) {
    throw tooLong(rows.length, MAX_READ);
  }
  const columns = columnsOf(rows);
  const full = columns.map((column) => column.some(Boolean));
  const header = takeHeader(rows, columns);
  const names = unique(columns.map((_, i) => header[i] ?? ""));
  const lines = rows.map(([line]) => line);
  const [sign, signRemark] = decimalSign(rows, decimal);
  const numbers = new Map();
  const skipped = [];
  columns.forEach((cells, i) => {
    const values = cells.map((cell) => valueOf(cell, sign || "."));
    if (values.some((value) => value !== null && !Number.isNaN(value))) {
      numbers.set(names[i], checked(names[i], values, cells, lines));
    } else if (full[i]) {
      skipped.push(names[i]);
    }
  });
  if (numbers.size === 0) {
    throw new InputError({
      en: "There is no column of numbers in it.",
      id: "Tidak ada kolom bilangan di dalamnya.",
    });
  }
  if (lines.length > MAX_READ) {
    throw tooLong(lines.length, MAX_READ);
  }
  const table = { columns: numbers, lines, skipped, decimal: sign };
  return { ...table, note: noteOn(table, signRemark, remark) };
}

/** The rows without the blank ones before and after them. */
function trimmed(grid) {
  const filled = grid.map(([, cells]) => cells.length > 0);
  const first = filled.indexOf(true);
  return first < 0 ? [] : grid.slice(first, filled.lastIndexOf(true) + 1);
}

/** The columns as lists of cells; InputError: the rows are not equally long. */
function columnsOf(rows) {
  const width = rows.length ? rows[0][1].length : 0;
  const odd = rows.find(([, cells]) => cells.length > 0 && cells.length !== width);
  if (odd) {
    const [line, cells] = odd;
    throw new InputError({
      en: `Line ${line} has not as many cells (${cells.length}) as the first line (${width}).`,
      id: `Banyaknya sel di baris ${line} (${cells.length}) tidak sama dengan baris pertama (${width}).`,
    });
  }
  return Array.from({ length: width }, (_, i) => rows.map(([, cells]) => cells[i] ?? ""));
}

/**
 * Take the header out of rows and columns, if there is one: a row without numbers, with a letter above
 * numbers.
 */
function takeHeader(rows, columns) {
  const isName = (cell) => !isGap(cell) && /[\p{L}\p{Nl}\p{No}]/u.test(cell);
  const namesNumbers = (column) => isName(column[0]) && column.some(isNumber);
  if (columns.some((column) => isNumber(column[0])) || !columns.some(namesNumbers)) {
    return [];
  }
  rows.shift();
  return columns.map((column) => column.shift());
}

/** What was read, in one sentence of both languages. */
function noteOn({ columns, lines, skipped, decimal }, signRemark, remark) {
  let gaps = 0;
  for (const column of columns.values()) {
    gaps += column.filter(Number.isNaN).length;
  }
  const names = listed(columns.keys());
  const left_out = listed(skipped);
  const sign = {
    en: { ",": "comma", ".": "point" }[decimal] ?? "none",
    id: { ",": "koma", ".": "titik" }[decimal] ?? "tidak ada",
  };
  const without = {
    en: skipped.length ? `; left out, no numbers: ${left_out}` : "",
    id: skipped.length ? `; tidak dipakai, tanpa bilangan: ${left_out}` : "",
  };
  const ending = {
    en: `${without.en}${signRemark.en}${remark.en}.`,
    id: `${without.id}${signRemark.id}${remark.id}.`,
  };
  return {
    en:
      `Rows: ${lines.length}; columns: ${columns.size} (${names}); gaps: ${gaps}; ` +
      `decimal sign: ${sign.en}${ending.en}`,
    id:
      `Baris: ${lines.length}; kolom: ${columns.size} (${names}); sel kosong: ${gaps}; ` +
      `tanda desimal: ${sign.id}${ending.id}`,
  };
}

function listed(names) {
  const all = [...names];
  const shown = all.slice(0, MAX_LISTED).map((name) => cut(name, 40));
  return shown.join(", ") + (all.length > MAX_LISTED ? ", ..." : "");
}

/** Names in which nothing is empty (then its position) and nothing comes twice. */
function unique(names) {
  const result = [];
  names.forEach((text, i) => {
    const base = strip(text).split(BLANKS).join(" ") || String(i + 1);
    let name = base;
    for (let count = 2; result.includes(name); count++) {
      name = `${base} (${count})`;
    }
    result.push(name);
  });
  return result;
}

/** The decimal sign of a grid (null: no number has one) and a remark in both languages. */
function decimalSign(rows, decimal) {
  const { proof, maybe } = signsIn(rows);
  const found = proof.size > 0 ? proof : maybe;
  if (found.size === 0) {
    return [null, NO_REMARK];
  }
  if (decimal) {
    return [decimal, NO_REMARK];
  }
  if (found.size === 2) {
    throw bothSigns(found.get("."), found.get(","));
  }
  const [[sign, [, cell]]] = found;
  if (found === proof) {
    return [sign, NO_REMARK];
  }
  const remark = {
    en: ` (${quoted(cell)} was read as a decimal, not as thousands)`,
    id: ` (${quoted(cell)} dibaca sebagai desimal, bukan ribuan)`,
  };
  return [sign, remark];
}

/**
 * Two maps, sign -> [line, cell]: the first cell that only this sign can explain, and the first that it may.
 */
function signsIn(rows) {
  const proof = new Map();
  const maybe = new Map();
  for (const [line, cells] of rows) {
    for (const cell of cells) {
      const readings = readingsOf(cell);
      const found = readings.length === 1 ? proof : maybe;
      const likely = cell.includes(",") ? "," : ".";
      const sign = readings.length === 1 ? readings[0] : likely;
      if (readings.length > 0 && !found.has(sign)) {
        found.set(sign, [line, cell]);
      }
    }
  }
  return { proof, maybe };
}

/** With which decimal signs is this cell a number or a gap? */
function readingsOf(cell) {
  if (!/[.,]/.test(cell)) {
    return [];
  }
  return [",", "."].filter((sign) => valueOf(cell, sign) !== null);
}

function bothSigns([line, cell], [other_line, other]) {
  return new InputError({
    en:
      `Both decimal point and comma occur: ${quoted(cell)} in line ${line}, ` +
      `${quoted(other)} in line ${other_line}; use one, or choose the decimal sign.`,
    id:
      `Ada titik dan koma desimal: ${quoted(cell)} di baris ${line}, ` +
      `${quoted(other)} di baris ${other_line}; pakailah satu saja, atau pilih tanda desimal.`,
  });
}

/** The values of a column; InputError names the first cell that is no usable number. */
function checked(name, values, cells, lines) {
  const at = values.findIndex((value) => value === null || Math.abs(value) > MAX_NUMBER);
  if (at < 0) {
    return Float64Array.from(values);
  }
  const unreadable = { en: "neither a number nor a gap", id: "bukan bilangan dan bukan sel kosong" };
  const huge = { en: "too large (beyond 1e+300)", id: "terlalu besar (di atas 1e+300)" };
  const why = values[at] === null ? unreadable : huge;
  throw new InputError({
    en: `Line ${lines[at]}, column ${quoted(name)}: ${quoted(cells[at])} is ${why.en}.`,
    id: `Baris ${lines[at]}, kolom ${quoted(name)}: ${quoted(cells[at])} ${why.id}.`,
  });
}
