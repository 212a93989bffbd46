// Text in, grid out: finds what separates the columns. Twin of kalman_lib/data/grid.py. A grid is a list of
// [line, cells], in which a blank line has no cells. Every way to part the lines is tried on the first of
// them (readings.js weighs the results); the best one parts the whole text.
import { InputError } from "../language/input.js";
import { BETWEEN_NUMBERS, BLANK, count, strip } from "./blanks.js";
import { MAX_CELLS, MAX_READ, tooLong, tooManyCells } from "./limits.js";
import { TIGHT_COMMA, bestOf } from "./readings.js";

const TRIED_LINES = 500; // tell how the columns are separated
const TRIED_SIGNS = 200000;
const AROUND = 1000; // lines of text around a table
const MAX_CELL = 131072; // the longest cell that Python's csv takes
const SIGNS = { tab: "\t", semicolon: ";", comma: "," };
const BETWEEN = {
  "comma and blank": /, +/,
  "two blanks": new RegExp(`[${BLANK}]{2,}`),
  blank: new RegExp(`[${BETWEEN_NUMBERS}]+`),
};
const NAMED_DAY = /\b([0-9]{1,2}) ([A-Za-z]{3,9}) ([0-9]{4})\b/g;
const HALF_OF_DAY = /([0-9]) ([AaPp]\.?[Mm]\b)/g;
const CONTROL = /[\x00-\x08\x0e-\x1f]/; // no text holds these
const NOT_IN_WINDOWS_1252 = /[\x81\x8d\x8f\x90\x9d]/;

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

/** A text -> [grid, remark {en, id} or null]. decimal: "," or "." if the reader has chosen it. */
export function split(text, decimal) {
  const lines = count(text, "\n") + 1;
  if (lines > MAX_READ + AROUND) {
    throw tooLong(lines);
  }
  const sample = text.slice(0, TRIED_SIGNS).split("\n").slice(0, TRIED_LINES).join("\n");
  const ways = tried(sample);
  if (ways.size === 0) {
    return [part(text, "lines"), null];
  }
  const [name, remark] = bestOf(ways, decimal);
  const cells = name in SIGNS ? count(text, SIGNS[name]) + lines : 0;
  if (cells > MAX_CELLS) {
    throw tooManyCells(cells);
  }
  return [part(text, name), remark];
}

/** Map of name -> grid: the ways that part the sample without trouble. */
function tried(sample) {
  const found = new Map();
  for (const name of waysFor(sample)) {
    try {
      found.set(name, part(sample, name, false));
    } catch (error) {
      if (!(error instanceof InputError)) {
        throw error;
      }
    }
  }
  return found;
}

/** How the lines may be parted, the likeliest first. */
function waysFor(sample) {
  const mayBe = {
    tab: sample.includes("\t"),
    semicolon: sample.includes(";"),
    "comma and blank": sample.includes(", ") && TIGHT_COMMA.test(sample),
    comma: sample.includes(","),
    "two blanks": true,
    blank: true,
    lines: true,
  };
  return Object.keys(mayBe).filter((name) => mayBe[name]);
}

/** The grid of a text, parted in one of these ways. */
function part(text, name, strict = true) {
  if (name in SIGNS) {
    return csv(text, SIGNS[name], strict);
  }
  const grid = csv(text, "\t", strict);
  if (name === "lines") {
    return grid;
  }
  return partedAt(BETWEEN[name], grid, name === "comma and blank" ? (line) => line : glued);
}

/** One word of "1 Mei 2024", of "10:00 PM" and of "# t". */
function glued(text) {
  const whole = text.replace(HALF_OF_DAY, "$1$2").replace(NAMED_DAY, "$1-$2-$3");
  return whole.startsWith("#") ? `#${strip(whole.slice(1))}` : whole;
}

/** The cells between these blanks; InputError if they are too many. */
function partedAt(blanks, grid, prepared) {
  let total = 0;
  return grid.map(([line, cells]) => {
    const parts = cells.length > 0 ? prepared(cells[0]).split(blanks) : [];
    total += parts.length;
    if (total > MAX_CELLS) {
      throw tooManyCells(total);
    }
    return [line, parts];
  });
}

/** A text -> grid without blanks around a cell. Quotation marks as in Python's csv, strict. */
function csv(text, separator, strict) {
  const lines = text.replace(/\r\n?/g, "\n").split("\n");
  if (lines.at(-1) === "") {
    lines.pop();
  }
  const reader = { separator, grid: [], cells: [], cell: "", inside: false, strict, total: 0 };
  lines.forEach((line, i) => {
    reader.line = i + 1;
    readLine(reader, line);
    if (!reader.inside) {
      endRow(reader, i + 1);
    }
  });
  if (reader.inside && strict) {
    throw unpaired(lines.length);
  }
  if (reader.inside) {
    reader.cells.push(reader.cell);
    endRow(reader, lines.length);
  }
  return reader.grid;
}

function endRow(reader, line) {
  if (reader.cells.some((cell) => cell.length > MAX_CELL)) {
    throw tooLongCell(line);
  }
  const cells = reader.cells.map((cell) => strip(cell));
  reader.total += cells.length;
  if (reader.total > MAX_CELLS) {
    throw tooManyCells(reader.total);
  }
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
  if (reader.cell.length > MAX_CELL) {
    throw tooLongCell(reader.line);
  }
  const after = end + 1;
  if (line[after] === '"') {
    reader.cell += '"'; // two of them stand for one
    return after + 1;
  }
  if (after < line.length && line[after] !== reader.separator && reader.strict) {
    throw unpaired(reader.line);
  }
  if (after < line.length && line[after] !== reader.separator) {
    return restOfCell(reader, line, after);
  }
  reader.cells.push(reader.cell);
  reader.inside = false;
  return after + 1;
}

/** Words behind a quotation mark belong to the cell, where nothing is certain yet. */
function restOfCell(reader, line, at) {
  const found = line.indexOf(reader.separator, at);
  const end = found < 0 ? line.length : found;
  reader.cells.push(reader.cell + line.slice(at, end));
  reader.inside = false;
  return end + 1;
}

function unpaired(line) {
  return new InputError({
    en: `The quotation marks do not pair up (line ${line}).`,
    id: `Tanda kutip tidak berpasangan (baris ${line}).`,
  });
}

function tooLongCell(line) {
  return new InputError({
    en: `Line ${line}: a cell is too long; no column can be told apart.`,
    id: `Baris ${line}: sebuah sel terlalu panjang; kolomnya tidak dapat dibedakan.`,
  });
}
