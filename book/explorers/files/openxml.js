// The XML of a workbook -> titles, strings, formats and grids (ECMA-376, SpreadsheetML). Twin of
// kalman_lib/data/openxml.py. A sheet is read some rows at a time, so that the browser never holds all of it
// as XML; rows and cells are counted before, and what is empty takes no room.
import { count, strip } from "./blanks.js";
import { MAX_CELLS, MAX_READ, tooLong, tooManyCells } from "./limits.js";
import { MORE_ROWS, filled, uncalculated } from "./sparse.js";
import { Damaged } from "./unzip.js";

const MAX_TAGS = 4 * MAX_CELLS + 100000;
const MAX_STRINGS = 300000;
const ROWS_AT_ONCE = 500;
const LAST_ROW = 1048576; // of Excel
const LAST_COLUMN = 16384;
const QUOTED = /"[^"]*"|\\.|_.|\*.|\[[^\]hms]*\]/g;
const NUMBER = /^[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?$/;
const EPOCHS = new Map([
  [false, Date.UTC(1899, 11, 30)],
  [true, Date.UTC(1904, 0, 1)],
]);
const LAST_DAY = 2958465; // 9999-12-31
const A_DAY = 86400000; // ms
const TRUTH = { 0: "FALSE", 1: "TRUE" };

/** Neither entities nor too many elements. */
function checkTags(text) {
  if (text.includes("<!DOCTYPE")) {
    throw new Damaged("a workbook declares no entities");
  }
  if (count(text, "<") > 2 * MAX_TAGS) {
    throw tooManyCells(Math.floor(count(text, "<") / 2));
  }
}

/** A text -> its XML; Damaged if it is none. */
function parsed(text) {
  checkTags(text);
  const xml = new DOMParser().parseFromString(text, "application/xml");
  if (xml.getElementsByTagName("parsererror").length > 0) {
    throw new Damaged("no XML");
  }
  return xml;
}

function elements(parent, name) {
  return Array.from(parent.getElementsByTagNameNS("*", name));
}

/** [[title, id of its relation], ...] and whether days are counted from 1904. */
export function sheetsIn(text) {
  const xml = parsed(text);
  const sheets = elements(xml, "sheet").map((sheet) => {
    const relation = Array.from(sheet.attributes).find(({ name }) => name.endsWith(":id"));
    return [sheet.getAttribute("name") ?? "", relation?.value ?? ""];
  });
  const from1904 = elements(xml, "workbookPr").some((one) => {
    return ["1", "true"].includes(one.getAttribute("date1904"));
  });
  return { sheets, from1904 };
}

/** Map of id -> path. */
export function relationsIn(text) {
  const found = text ? elements(parsed(text), "Relationship") : [];
  return new Map(found.map((one) => [one.getAttribute("Id"), one.getAttribute("Target") ?? ""]));
}

/** The texts that cells share. */
export function stringsIn(text) {
  if (count(text, "<si") > MAX_STRINGS) {
    throw tooManyCells(count(text, "<si"), MAX_STRINGS);
  }
  const all = text ? elements(parsed(text), "si") : [];
  return all.map((one) => strip(textsIn(one, "t")));
}

function textsIn(parent, name) {
  return elements(parent, name)
    .map(({ textContent }) => textContent)
    .join("");
}

/** For each style of a cell "date", "clock" or "". */
export function formatsIn(text) {
  if (!text) {
    return [];
  }
  const xml = parsed(text);
  const custom = new Map();
  for (const format of elements(xml, "numFmt")) {
    custom.set(format.getAttribute("numFmtId"), kindOf(format.getAttribute("formatCode") ?? ""));
  }
  const styles = elements(xml, "cellXfs").flatMap((one) => elements(one, "xf"));
  const numbers = styles.map((style) => style.getAttribute("numFmtId") ?? "0");
  return numbers.map((number) => custom.get(number) ?? knownKind(Number(number)));
}

function knownKind(number) {
  const isIn = (ranges) => ranges.some(([first, last]) => number >= first && number <= last);
  if (
    isIn([
      [14, 17],
      [22, 22],
      [27, 36],
      [50, 58],
    ])
  ) {
    // prettier-ignore
    return "date";
  }
  return isIn([[18, 21], [45, 47]]) ? "clock" : ""; // prettier-ignore
}

/** "dd/mm/yyyy hh:mm" -> "date", "[h]:mm:ss" -> "clock", "0.00" -> "". */
function kindOf(code) {
  const signs = code.slice(0, 200).replace(QUOTED, "").toLowerCase();
  if (/general/i.test(code) || !/[dmyhs]/.test(signs)) {
    return "";
  }
  return /[dy]/.test(signs) ? "date" : "clock";
}

// --- a sheet -----------------------------------------------------------------------------------------------

/**
 * The grid of a sheet: a number as a number, anything else as text, all rows equally wide. book: {strings,
 * formats, from1904}.
 */
export function gridIn(text, title, book) {
  const [rows, cells] = [count(text, "<row"), count(text, "<c")];
  if (rows > MAX_READ + MORE_ROWS) {
    throw tooLong(rows);
  }
  if (cells > MAX_CELLS + MORE_ROWS) {
    throw tooManyCells(cells);
  }
  checkTags(text);
  const found = [];
  for (const xml of piecesOf(text)) {
    elements(xml, "row").forEach((row) => readRow(row, found, title, book));
  }
  return filled(found);
}

/** The rows of a sheet, some at a time, as documents. */
function* piecesOf(text) {
  const start = /<([A-Za-z0-9_]{1,20}:)?sheetData[ >]/.exec(text);
  if (!start) {
    parsed(text);
    return;
  }
  const prefix = start[1] ?? "";
  const last = text.indexOf(`</${prefix}sheetData>`, start.index);
  if (last < 0) {
    throw new Damaged("no end of the sheet");
  }
  const space = prefix ? ` xmlns:${prefix.slice(0, -1)}="x"` : "";
  let at = text.indexOf(">", start.index) + 1;
  while (at < last) {
    const end = endOfRows(text, at, last, `</${prefix}row>`);
    yield parsed(`<rows${space}>${text.slice(at, end)}</rows>`);
    at = end;
  }
}

function endOfRows(text, start, last, tag) {
  let end = start;
  for (let i = 0; i < ROWS_AT_ONCE; i++) {
    const found = text.indexOf(tag, end);
    if (found < 0 || found >= last) {
      return last;
    }
    end = found + tag.length;
  }
  return end;
}

/** Add [number, Map of column -> cell]. */
function readRow(row, found, title, book) {
  const before = found.at(-1)?.[0] ?? 0;
  const number = Number(row.getAttribute("r") ?? before + 1);
  if (!(number > before && number <= LAST_ROW)) {
    throw new Damaged("rows out of order");
  }
  const cells = new Map();
  let column = 0;
  for (const cell of elements(row, "c")) {
    const place = cell.getAttribute("r");
    column = place ? columnOf(place) : column + 1;
    const content = contentOf(cell, title, book);
    if (content !== "") {
      cells.set(column, content);
    }
  }
  found.push([number, cells]);
}

function contentOf(cell, title, book) {
  const kind = cell.getAttribute("t") ?? "n";
  if (kind === "inlineStr") {
    return strip(textsIn(cell, "t"));
  }
  const value = strip(textsIn(cell, "v"));
  if (value === "" && kind === "n" && elements(cell, "f").length > 0) {
    throw uncalculated(cell.getAttribute("r") ?? "", title);
  }
  if (value === "") {
    return "";
  }
  const style = Number(cell.getAttribute("s") ?? 0);
  const readers = {
    s: () => stringAt(book.strings, value),
    b: () => TRUTH[value] ?? value,
    n: () => numberOf(value, style, book),
  };
  return Object.hasOwn(readers, kind) ? readers[kind]() : value;
}

function stringAt(strings, value) {
  const found = strings[Number(value)];
  if (found === undefined) {
    throw new Damaged("no such string");
  }
  return found;
}

function numberOf(text, style, { formats, from1904 }) {
  const value = Number(text);
  if (!NUMBER.test(text)) {
    throw new Damaged("no number");
  }
  const kind = formats[style] ?? "";
  return kind === "" || value < 0 || value > LAST_DAY ? value : timeText(value, kind, from1904);
}

/** "BC12" -> 55. */
function columnOf(place) {
  let column = 0;
  for (const sign of place.slice(0, 4)) {
    if (sign < "A" || sign > "Z") {
      break;
    }
    column = 26 * column + sign.charCodeAt(0) - 64;
  }
  if (column < 1 || column > LAST_COLUMN) {
    throw new Damaged("no such column");
  }
  return column;
}

/** A day and its fraction -> "2024-01-01 10:00:00", or "10:00:00" of a clock. */
function timeText(serial, kind, from1904) {
  const all = Math.round(serial * A_DAY);
  const day = Math.floor(all / A_DAY);
  const rest = all - day * A_DAY;
  const parts = [Math.floor(rest / 3600000), Math.floor(rest / 60000) % 60, Math.floor(rest / 1000) % 60];
  const [hours, minutes, seconds] = parts;
  const thousandths = rest % 1000 ? `.${two(rest % 1000, 3)}` : "";
  const tail = `${two(minutes)}:${two(seconds)}${thousandths}`;
  if (kind === "clock") {
    return `${two(24 * day + hours)}:${tail}`;
  }
  const date = new Date(EPOCHS.get(from1904) + day * A_DAY).toISOString().slice(0, 10);
  return rest === 0 ? date : `${date} ${two(hours)}:${tail}`;
}

function two(number, digits = 2) {
  return String(number).padStart(digits, "0");
}
