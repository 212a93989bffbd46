// From a text or the bytes of a file to a grid: a list of [line, cells], in which a blank line has no cells.
// The same rules as Python's reader: which encoding, which separator, which quotation marks.
import { InputError } from "../language/input.js";
import { isGap, isNumber, quoted, valueOf } from "./cells.js";

const MAX_CELL = 131072; // the longest cell that Python's csv takes

// What Python calls a blank
const BLANK = "[\\t-\\r\\x1c- \\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]";
const ENDS = new RegExp(`^${BLANK}+|${BLANK}+$`, "g");
export const BLANKS = new RegExp(`${BLANK}+`);
const TWO_BLANKS = new RegExp(`${BLANK}{2,}`);
const CONTROL = /[\x00-\x08\x0e-\x1f]/; // no text holds these
const NOT_IN_WINDOWS_1252 = /[\x81\x8d\x8f\x90\x9d]/;
export const NO_REMARK = { en: "", id: "" };

export function strip(text) {
  return text.replace(ENDS, "");
}

/** Bytes -> text: UTF-8, UTF-16 or Windows-1252; null if it is no text at all. */
export function decode(bytes) {
  for (const encoding of encodings(bytes)) {
    const text = decodedAs(encoding, bytes);
    if (text !== null) {
      return CONTROL.test(text) ? null : text;
    }
  }
  return null;
}

/** What the bytes may be: a mark at the start, or a zero beside a Latin letter, gives UTF-16 away. */
function encodings([first, second]) {
  if ((first === 0xff && second === 0xfe) || second === 0) {
    return ["utf-16le"];
  }
  if ((first === 0xfe && second === 0xff) || first === 0) {
    return ["utf-16be"];
  }
  return ["utf-8", "windows-1252"];
}

function decodedAs(encoding, bytes) {
  try {
    const text = new TextDecoder(encoding, { fatal: true }).decode(bytes);
    return encoding === "windows-1252" && NOT_IN_WINDOWS_1252.test(text) ? null : text;
  } catch {
    return null;
  }
}

/** A text -> [grid, remark]: finds the separator. decimal: "," or "." if the reader has chosen it. */
export function split(text, decimal) {
  for (const separator of ["\t", ";"]) {
    if (text.includes(separator)) {
      return [csv(text, separator), NO_REMARK];
    }
  }
  if (!text.includes(",")) {
    return [betweenBlanks(csv(text, "\t")), NO_REMARK];
  }
  if (text.includes('",') || text.includes(',"')) {
    return [csv(text, ","), NO_REMARK];
  }
  return splitAtCommas(text, decimal);
}

/** The hard case: do the commas separate columns, or are they decimal signs? */
function splitAtCommas(text, decimal) {
  const commas = csv(text, ",");
  const whole = betweenBlanks(csv(text, "\t"));
  if (decimal === ",") {
    return [whole, NO_REMARK];
  }
  const firstRow = firstCells(commas);
  const isHeader = ![...firstRow, ...firstCells(whole)].some(isNumber);
  if (isHeader) {
    return [firstRow.length > 1 ? commas : whole, NO_REMARK];
  }
  const numeric = (cell) => isNumber(cell) || isGap(cell);
  if (text.includes(", ") || !whole.every(([, cells]) => cells.every(numeric))) {
    return [commas, NO_REMARK];
  }
  if (!isEven(commas)) {
    return [whole, NO_REMARK];
  }
  return decimal === "." ? [commas, NO_REMARK] : asDecimals(whole);
}

/**
 * The commas may be either: taken as decimal signs, and the remark says so; InputError where that cannot be.
 */
function asDecimals(whole) {
  const hasComma = (cell) => cell.includes(",");
  const [line, cells] = whole.find((row) => row[1].some(hasComma));
  const shown = quoted(cells.find(hasComma));
  const unreadable = (cell) => valueOf(cell, ",") === null;
  if (whole.some((row) => row[1].some(unreadable))) {
    throw new InputError({
      en:
        `Line ${line}, ${shown}: the comma may separate thousands or columns; add a header line, ` +
        "use semicolons between columns, or choose the decimal sign.",
      id:
        `Baris ${line}, ${shown}: koma dapat memisahkan ribuan atau kolom; tambahkan baris judul, ` +
        "pisahkan kolom dengan titik koma, atau pilih tanda desimal.",
    });
  }
  const remark = {
    en: `; ${shown} was read as one number with decimal comma, not as columns`,
    id: `; ${shown} dibaca sebagai satu bilangan dengan koma desimal, bukan beberapa kolom`,
  };
  return [whole, remark];
}

function firstCells(grid) {
  const row = grid.find(([, cells]) => cells.length > 0);
  return row ? row[1] : [];
}

/** A text -> grid without blanks around a cell. Quotation marks as in Python's csv, strict. */
function csv(text, separator) {
  const lines = text.replace(/\r\n?/g, "\n").split("\n");
  if (lines.at(-1) === "") {
    lines.pop();
  }
  const reader = { separator, grid: [], cells: [], cell: "", inside: false };
  lines.forEach((line, i) => {
    readLine(reader, line);
    if (!reader.inside) {
      endRow(reader, i + 1);
    }
  });
  if (reader.inside) {
    throw unpaired("unexpected end of data");
  }
  return reader.grid;
}

function endRow(reader, line) {
  if (reader.cells.some((cell) => cell.length > MAX_CELL)) {
    throw unpaired(`field larger than field limit (${MAX_CELL})`);
  }
  const cells = reader.cells.map(strip);
  reader.grid.push([line, cells.some(Boolean) ? cells : []]);
  reader.cells = [];
}

/** Add the cells of one line; `inside`: a cell between quotation marks goes on in the next line. */
function readLine(reader, line) {
  if (!reader.inside && !line.includes('"')) {
    reader.cells = line.split(reader.separator);
    return;
  }
  let at = 0;
  while (at <= line.length) {
    at = reader.inside ? readQuoted(reader, line, at) : beginCell(reader, line, at);
  }
}

/** A cell begins at this place of the line -> the place behind what was read. */
function beginCell(reader, line, at) {
  let start = at;
  while (reader.separator !== "\t" && line[start] === " ") {
    start++;
  }
  if (line[start] === '"') {
    reader.inside = true;
    reader.cell = "";
    return start + 1;
  }
  const found = line.indexOf(reader.separator, start);
  const end = found < 0 ? line.length : found;
  reader.cells.push(line.slice(start, end));
  return end + 1;
}

/** Between quotation marks, up to the next one -> the place behind it. */
function readQuoted(reader, line, at) {
  const end = line.indexOf('"', at);
  if (end < 0) {
    reader.cell += `${line.slice(at)}\n`;
    return line.length + 1;
  }
  reader.cell += line.slice(at, end);
  const after = end + 1;
  if (line[after] === '"') {
    reader.cell += '"'; // two of them stand for one
    return after + 1;
  }
  if (after < line.length && line[after] !== reader.separator) {
    throw unpaired(`'${reader.separator}' expected after '"'`);
  }
  reader.cells.push(reader.cell);
  reader.inside = false;
  return after + 1;
}

function unpaired(why) {
  return new InputError({
    en: `The quotation marks in the text do not pair up (${why}).`,
    id: `Tanda kutip dalam teks tidak berpasangan (${why}).`,
  });
}

/** Rows of one cell -> the cells between blanks; two blanks or more where single ones are part of a name. */
function betweenBlanks(grid) {
  const splitAt = (gap) => grid.map(([line, cells]) => [line, cells.length ? cells[0].split(gap) : []]);
  const single = splitAt(BLANKS);
  const several = splitAt(TWO_BLANKS);
  const holdsNumbers = several.some(([, cells]) => cells.some(isNumber));
  return !isEven(single) && isEven(several) && holdsNumbers ? several : single;
}

/** Has every row that is not blank as many cells? */
function isEven(grid) {
  const widths = grid.map(([, cells]) => cells.length).filter((width) => width > 0);
  return new Set(widths).size <= 1;
}
