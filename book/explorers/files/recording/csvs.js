// A file of a recording in, its sheets of numbers out: {place, names, columns: one Float64Array a name (null:
// of no sensor), lines}; an empty cell is NaN; place and lines are for messages. Twin of
// kalman_lib/data/csvs.py.
import { quoted, toNumber } from "../cells.js";
import { isTime, moment, secondsOf } from "../clock.js";
import { decode } from "../grid.js";
import { count } from "../blanks.js";
import { tooWide } from "../limits.js";
import { tableOf } from "../table.js";
import { gridsOfSheets } from "../workbook.js";
import { TEXTS, endsWith, isPacked } from "./archives.js";
import { isWanted, readHeader } from "./headers.js";
import { NoSensor, everyDigit, wrong } from "./notes.js";
import { rowsIn } from "./rows.js";

const MAX_ROWS = 2000000; // of a file
const MAX_COLUMNS = 1000;
const LONGEST_PLACE = 60; // characters in a message
const METADATA_SHEETS = ["Metadata Device", "Metadata Time"]; // so phyphox calls them
const QUOTED_DECIMAL = /"[+-]?[0-9]+,[0-9]+([eE][+-]?[0-9]+)?"/;
const LOOKED_AT = 5000; // characters in which a quoted decimal comma shows itself
const PLAIN = /^[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?$/;

/** The bytes of one file -> a promise of its sheets: one of a text, several of a workbook. */
export async function sheetsOf(name, bytes) {
  const letters = Array.from(name);
  const place = letters.length > LONGEST_PLACE ? `...${letters.slice(3 - LONGEST_PLACE).join("")}` : name;
  if (!bytes.some((byte) => byte > 32 || byte < 9 || (byte > 13 && byte < 32))) {
    throw empty(place);
  }
  if (name.toLowerCase().endsWith(".xls") && !isPacked(bytes)) {
    throw wrong(
      `${place}: this .xls file cannot be read here; open it and save it as .xlsx, or export a .csv.`,
      `${place}: berkas .xls ini tidak dapat dibaca di sini; simpanlah sebagai .xlsx, atau ekspor .csv.`,
    );
  }
  if (endsWith(name, [".xlsx", ".xls"])) {
    const grids = await gridsOfSheets({ name, bytes }, METADATA_SHEETS);
    return grids.map(([title, grid]) => sheetOf(`${place}, ${title}`, tableOf(grid, null, [], [])));
  }
  const text = endsWith(name, TEXTS) ? decode(bytes) : null;
  if (text === null) {
    const en = `${place}: not a .csv, .zip or .xlsx file; export the recording as one of these.`;
    const id = `${place}: bukan berkas .csv, .zip atau .xlsx; eksporlah rekaman sebagai salah satunya.`;
    throw new NoSensor({ en, id });
  }
  return [readCsv(place, text.replace(/^\ufeff/, "").replace(/\r\n?/g, "\n"))];
}

function sheetOf(place, { columns, lines }) {
  return { place, names: [...columns.keys()], columns: [...columns.values()], lines };
}

/** The NoSensor that tells which headers were not understood. */
export function noSensor(place, names) {
  const shown = names.slice(0, 4).map((name) => quoted(name));
  const called = "'Gyroscope x (rad/s)'";
  return new NoSensor({
    en:
      `${place}: none of its columns is needed (${shown.join(", ")}); ` +
      `a sensor's are called for example ${called}.`,
    id:
      `${place}: tidak ada kolom yang diperlukan (${shown.join(", ")}); ` +
      `kolom sensor bernama misalnya ${called}.`,
  });
}

function empty(place) {
  return new NoSensor({ en: `${place}: the file is empty.`, id: `${place}: berkasnya kosong.` });
}

/** The text of a CSV -> its sheet; columns of no sensor are passed over. */
function readCsv(place, text) {
  const rows = count(text, "\n");
  if (rows > MAX_ROWS + 10) {
    throw wrong(
      `${place}: ${rows} rows are too many; the limit is ${MAX_ROWS}.`,
      `${place}: ${rows} baris terlalu banyak; batasnya ${MAX_ROWS}.`,
    );
  }
  const { line, start } = headerIn(text);
  const found = text.indexOf("\n", start);
  const end = found < 0 ? text.length : found;
  const body = text.slice(end + 1).trimEnd();
  const { separator, names } = namesIn(place, line, text.slice(start, end).trim());
  if (names.length > MAX_COLUMNS) {
    throw tooWide(names.length, MAX_COLUMNS);
  }
  if (body === "") {
    throw new NoSensor({
      en: `${place}: there is no row below the header.`,
      id: `${place}: tidak ada baris di bawah judul.`,
    });
  }
  const wanted = [...names.keys()].filter((k) => isWanted(names[k]));
  if (wanted.length === 0) {
    throw noSensor(place, names);
  }
  return readCells(place, names, clocksInSeconds(body, names, separator), separator, line, wanted);
}

/** The number of the header's line, and where it begins: blank lines and comments come before. */
function headerIn(text) {
  let line = 1;
  let start = 0;
  while (start < text.length) {
    const found = text.indexOf("\n", start);
    const end = found < 0 ? text.length : found;
    const first = text.slice(start, end).trim();
    if (first !== "" && first[0] !== "#") {
      break;
    }
    line++;
    start = end + 1;
  }
  return { line, start: Math.min(start, text.length) };
}

/** The separator of a header line, and the names between. */
function namesIn(place, line, header) {
  if (header === "" || header[0] === "#") {
    throw empty(place);
  }
  const separator = Array.from("\t;,").find((sign) => header.includes(sign)) ?? ",";
  const [[, cells]] = rowsIn(header, separator, true);
  const names = cells.map((cell) => cell.trim());
  if (names.every(readsAsNumber)) {
    throw wrong(
      `${place}, line ${line}: a line with the names and units of the columns is needed above the numbers.`,
      `${place}, baris ${line}: diperlukan baris judul berisi nama dan satuan kolom di atas bilangan.`,
    );
  }
  return { separator, names };
}

function readsAsNumber(cell) {
  return toNumber(cell, ".") !== null || toNumber(cell, ",") !== null;
}

/** The body with dates and clock times written as seconds, where a column of times holds them. */
function clocksInSeconds(body, names, separator) {
  const first = body.split("\n", 1)[0].split(separator);
  const clocks = [...names.keys()].filter((k) => {
    const cell = first[k]?.replace(/^[ "]+|[ "]+$/g, "");
    return cell !== undefined && readHeader(names[k]).kind === "time" && isTime(cell) && !readsAsNumber(cell);
  });
  if (clocks.length === 0) {
    return body;
  }
  const rows = [...rowsIn(body, separator, true)].map(([, cells]) => cells);
  for (const k of clocks) {
    const found = secondsOf(rows.map((row) => moment(row[k]?.trim() ?? "")));
    if (found === null) {
      return body;
    }
    found.seconds.forEach((second, i) => {
      if (second !== null) {
        rows[i][k] = everyDigit(second);
      }
    });
  }
  return rows
    .map((row) => row.map((cell) => inQuotes(cell, separator)).join(separator))
    .join("\n")
    .trimEnd();
}

function inQuotes(cell, separator) {
  return cell.includes(separator) || /["\n]/.test(cell) ? `"${cell.replaceAll('"', '""')}"` : cell;
}

function readCells(place, names, body, separator, line, wanted) {
  const hasQuoted = QUOTED_DECIMAL.test(body.slice(0, LOOKED_AT));
  const sign = (separator !== "," && body.includes(",")) || hasQuoted ? "," : ".";
  const rows = count(body, "\n") + 1;
  const lines = new Float64Array(rows);
  const columns = names.map((_, k) => (wanted.includes(k) ? new Float64Array(rows) : null));
  let T = 0;
  for (const [number, cells] of rowsIn(body, separator, separator !== "\t")) {
    if (cells.every((cell) => cell.trim() === "")) {
      continue;
    }
    const at = line + number;
    if (cells.length !== names.length) {
      throw wrong(
        `${place}, line ${at}: ${cells.length} cells instead of ${names.length}.`,
        `${place}, baris ${at}: ${cells.length} sel, seharusnya ${names.length}.`,
      );
    }
    for (const k of wanted) {
      columns[k][T] = numberIn(place, at, names[k], cells[k].trim(), sign);
    }
    lines[T++] = at;
  }
  const first = (values) => values && values.subarray(0, T);
  return { place, names, columns: columns.map(first), lines: first(lines) };
}

function numberIn(place, line, name, cell, sign) {
  if (sign === "." && PLAIN.test(cell)) {
    return Number(cell);
  }
  const value = sign === "," && cell.includes(".") ? null : toNumber(cell, sign);
  if (value === null) {
    const [en, id] =
      sign === "," ? [" (others have a decimal comma)", " (yang lain memakai koma desimal)"] : ["", ""];
    throw wrong(
      `${place}, line ${line}, column ${quoted(name)}: ${quoted(cell)} is not a number${en}.`,
      `${place}, baris ${line}, kolom ${quoted(name)}: ${quoted(cell)} bukan bilangan${id}.`,
    );
  }
  return value;
}
