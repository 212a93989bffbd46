// Numbers in: reads a pasted text or a CSV file. Twin of the reading half of kalman_lib/spreadsheet.py: the same rules, the
// same sentences; what it does not read is .xlsx, and then it says so. Pure: what a cell says is never more than a text.
import { InputError } from "./words.js";

export const MAX_READ = 200000;                 // rows
const MAX_NUMBER = 1e300, MAX_CELL = 131072;    // the longest cell that Python's csv takes

/**
 * A pasted text or CSV -> {columns: Map of name -> Float64Array (NaN = gap), lines, skipped, decimal, note {id, en}}.
 * decimal "," or "." says which decimal sign it has; null: find out. InputError: whatever cannot be understood.
 */
export function readText(text, decimal = null) {
  const [grid, remark] = split(text.replace(/^\ufeff/, ""), decimal);
  return table(grid, decimal, remark);
}

/** The bytes (Uint8Array) of a .csv, .txt or .tsv file, the same way. */
export function readFile(name, bytes, decimal = null) {
  const text = /\.(csv|txt|tsv)$/i.test(name) ? decode(bytes) : null;
  if (text === null) {
    const shown = quoted(name, 60);
    throw new InputError({ en: `${shown} is not a text file (.csv, .txt, .tsv); save it as CSV, or copy the column and paste it.`,
                           id: `${shown} bukan berkas teks (.csv, .txt, .tsv); simpanlah sebagai CSV, atau salin kolomnya lalu tempelkan.` });
  }
  return readText(text, decimal);
}

/** Bytes -> text: UTF-8, UTF-16 or Windows-1252; null if it is no text at all. */
function decode(bytes) {
  const [a, b] = bytes;
  const encodings = a === 0xff && b === 0xfe || b === 0 ? ["utf-16le"] : a === 0xfe && b === 0xff || a === 0 ? ["utf-16be"] : ["utf-8", "windows-1252"];
  for (const encoding of encodings) {
    let text;
    try {
      text = new TextDecoder(encoding, { fatal: true }).decode(bytes);
    } catch {
      continue;
    }
    if (encoding === "windows-1252" && /[\x81\x8d\x8f\x90\x9d]/.test(text)) continue;
    return /[\x00-\x08\x0e-\x1f]/.test(text) ? null : text;
  }
  return null;
}

// --- text -> grid [[line, cells]] -----------------------------------------------------------------------------------

const BLANK = "[\\t-\\r\\x1c- \\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000]";     // what Python calls so
const ENDS = new RegExp(`^${BLANK}+|${BLANK}+$`, "g"), ONE = new RegExp(`${BLANK}+`), TWO = new RegExp(`${BLANK}{2,}`);
const strip = text => text.replace(ENDS, "");
const NOTHING = { en: "", id: "" };

/** A text -> [grid, remark]: finds the separator. */
function split(text, decimal) {
  for (const separator of "\t;") if (text.includes(separator)) return [csv(text, separator), NOTHING];
  if (!text.includes(",")) return [blanks(csv(text, "\t")), NOTHING];
  if (text.includes('",') || text.includes(',"')) return [csv(text, ","), NOTHING];
  const commas = csv(text, ","), whole = blanks(csv(text, "\t"));
  if (decimal === ",") return [whole, NOTHING];
  const first = grid => (grid.find(([, cells]) => cells.length) || [0, []])[1];
  if (![...first(commas), ...first(whole)].some(isNumber)) return [first(commas).length > 1 ? commas : whole, NOTHING];   // a header decides
  if (text.includes(", ") || !whole.every(([, cells]) => cells.every(cell => isNumber(cell) || isGap(cell)))) return [commas, NOTHING];
  if (!even(commas)) return [whole, NOTHING];
  if (decimal === ".") return [commas, NOTHING];
  const has = cell => cell.includes(","), [line, cells] = whole.find(([, cells]) => cells.some(has)), shown = quoted(cells.find(has));
  if (whole.some(([, cells]) => cells.some(cell => value(cell, ",") === null))) {
    throw new InputError({ en: `Line ${line}, ${shown}: the comma may separate thousands or columns; add a header line, use semicolons between columns, or choose the decimal sign.`,
                           id: `Baris ${line}, ${shown}: koma dapat memisahkan ribuan atau kolom; tambahkan baris judul, pisahkan kolom dengan titik koma, atau pilih tanda desimal.` });
  }
  return [whole, { en: `; ${shown} was read as one number with decimal comma, not as columns`,
                   id: `; ${shown} dibaca sebagai satu bilangan dengan koma desimal, bukan beberapa kolom` }];
}

/** A text -> [[line, cells]] without blanks around a cell; a blank line has no cells. Quotation marks as in Python's csv, strict. */
function csv(text, separator) {
  const lines = text.replace(/\r\n?/g, "\n").split("\n"), grid = [];
  if (lines.at(-1) === "") lines.pop();
  const refuse = why => new InputError({ en: `The quotation marks in the text do not pair up (${why}).`, id: `Tanda kutip dalam teks tidak berpasangan (${why}).` });
  let cells = [], inside = false, cell = "";
  const push = line => {
    if (cells.some(text => text.length > MAX_CELL)) throw refuse(`field larger than field limit (${MAX_CELL})`);
    cells = cells.map(strip);
    grid.push([line, cells.some(Boolean) ? cells : []]);
    cells = [];
  };
  lines.forEach((line, i) => {
    if (!inside && !line.includes('"')) {
      cells = line.split(separator);
      push(i + 1);
      return;
    }
    for (let at = 0; at <= line.length;) {
      if (!inside) {                                    // a cell begins
        if (separator !== "\t") while (line[at] === " ") at++;
        if (line[at] !== '"') {
          const end = (line + separator).indexOf(separator, at);
          cells.push(line.slice(at, end));
          at = end + 1;
          continue;
        }
        inside = true;
        cell = "";
        at++;
      }
      const end = line.indexOf('"', at);
      if (end < 0) { cell += `${line.slice(at)}\n`; break; }
      cell += line.slice(at, end);
      at = end + 1;
      if (line[at] === '"') { cell += '"'; at++; continue; }
      if (at < line.length && line[at] !== separator) throw refuse(`'${separator}' expected after '"'`);
      cells.push(cell);
      inside = false;
      at++;
    }
    if (!inside) push(i + 1);
  });
  if (inside) throw refuse("unexpected end of data");
  return grid;
}

/** Rows of one cell -> the cells between blanks; two blanks or more where single ones are part of a name. */
function blanks(grid) {
  const [single, several] = [ONE, TWO].map(gap => grid.map(([line, cells]) => [line, cells.length ? cells[0].split(gap) : []]));
  return !even(single) && even(several) && several.some(([, cells]) => cells.some(isNumber)) ? several : single;
}

/** Has every row that is not blank as many cells? */
const even = grid => new Set(grid.filter(([, cells]) => cells.length).map(([, cells]) => cells.length)).size <= 1;

// --- grid -> table --------------------------------------------------------------------------------------------------

// A number with decimal point; a thousands comma must stand before every group of three digits
const POINT = /^[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+|[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\.[0-9]*)?)(?:[eE][+-]?[0-9]+)?$/;
const INFINITE = /^[+-]?(?:inf|infinity|∞)$/i, GAPS = new Set(["", "na", "n/a", "nan", "null", "-", "#n/a"]);
const minus = text => text.replace(/[\u2212\u2013]/g, "-");             // the minus and the dash of typeset text
const isGap = cell => GAPS.has(minus(cell).toLowerCase());
const isNumber = cell => !isGap(cell) && (value(cell, ".") !== null || value(cell, ",") !== null);

/** The number in a cell, NaN for a gap, null for anything else. */
function value(cell, decimal) {
  let text = minus(cell);
  if (decimal === ",") text = text.replace(/[.,]/g, sign => sign === "." ? "," : ".");
  if (POINT.test(text)) return Number(text.replaceAll(",", ""));
  return INFINITE.test(text) ? Infinity : isGap(cell) ? NaN : null;
}

/** [[line, cells]] -> table; finds the header and the decimal sign, checks every cell. */
function table(grid, decimal, remark) {
  const filled = grid.map(([, cells]) => cells.length > 0), from = filled.indexOf(true);
  grid = from < 0 ? [] : grid.slice(from, filled.lastIndexOf(true) + 1);
  if (grid.length > MAX_READ + 1) throw tooLong(grid.length, MAX_READ);
  const width = grid.length ? grid[0][1].length : 0, bad = grid.find(([, cells]) => cells.length && cells.length !== width);
  if (bad) {
    throw new InputError({ en: `Line ${bad[0]} has not as many cells (${bad[1].length}) as the first line (${width}).`,
                           id: `Banyaknya sel di baris ${bad[0]} (${bad[1].length}) tidak sama dengan baris pertama (${width}).` });
  }
  const columns = Array.from({ length: width }, (_, i) => grid.map(([, cells]) => cells[i] ?? ""));
  const hasHeader = !columns.some(column => isNumber(column[0])) &&
    columns.some(column => !isGap(column[0]) && /[\p{L}\p{Nl}\p{No}]/u.test(column[0]) && column.some(isNumber));       // a letter above numbers
  const full = columns.map(column => column.some(Boolean));
  if (hasHeader) grid.shift();
  const names = unique(columns.map(column => hasHeader ? column.shift() : "")), lines = grid.map(([line]) => line);
  const [sign, signRemark] = decimalSign(grid, decimal), numbers = new Map(), skipped = [];
  columns.forEach((cells, i) => {
    const values = cells.map(cell => value(cell, sign || "."));
    if (values.some(number => number !== null && number === number)) numbers.set(names[i], checked(names[i], values, cells, lines));
    else if (full[i]) skipped.push(names[i]);
  });
  if (!numbers.size) throw new InputError({ en: "There is no column of numbers in it.", id: "Tidak ada kolom bilangan di dalamnya." });
  if (lines.length > MAX_READ) throw tooLong(lines.length, MAX_READ);
  let gaps = 0;
  for (const column of numbers.values()) for (const number of column) if (number !== number) gaps++;
  const listed = names => { const all = [...names]; return all.slice(0, 5).map(name => cut(name, 40)).join(", ") + (all.length > 5 ? ", ..." : ""); };
  const ending = language => (skipped.length ? { en: "; left out, no numbers: ", id: "; tidak dipakai, tanpa bilangan: " }[language] + listed(skipped) : "") + signRemark[language] + remark[language] + ".";
  return { columns: numbers, lines, skipped, decimal: sign, note: {
    en: `Rows: ${lines.length}; columns: ${numbers.size} (${listed(numbers.keys())}); gaps: ${gaps}; decimal sign: ${{ ",": "comma", ".": "point" }[sign] || "none"}${ending("en")}`,
    id: `Baris: ${lines.length}; kolom: ${numbers.size} (${listed(numbers.keys())}); sel kosong: ${gaps}; tanda desimal: ${{ ",": "koma", ".": "titik" }[sign] || "tidak ada"}${ending("id")}` } };
}

export const tooLong = (rows, limit) => new InputError({ en: `${rows} rows are too many; the limit is ${limit}.`, id: `${rows} baris terlalu banyak; batasnya ${limit}.` });

/** Names in which nothing is empty (then its position) and nothing comes twice. */
function unique(names) {
  const result = [];
  names.forEach((text, i) => {
    const base = strip(text).split(ONE).join(" ") || String(i + 1);
    let name = base;
    for (let count = 2; result.includes(name); count++) name = `${base} (${count})`;
    result.push(name);
  });
  return result;
}

/** The decimal sign of a grid (null: no number has one) and a remark in both languages. */
function decimalSign(grid, decimal) {
  const proof = new Map(), maybe = new Map();           // sign -> the first cell that only it can explain, or that it may
  for (const [line, cells] of grid) {
    for (const cell of cells) {
      if (!/[.,]/.test(cell)) continue;
      const readings = [",", "."].filter(sign => value(cell, sign) !== null), found = readings.length === 1 ? proof : maybe;
      const sign = readings.length === 1 ? readings[0] : cell.includes(",") ? "," : ".";
      if (readings.length && !found.has(sign)) found.set(sign, [line, cell]);
    }
  }
  const found = proof.size ? proof : maybe;
  if (found.size && decimal) return [decimal, NOTHING];
  if (found.size === 2) {
    const [line, cell] = found.get("."), [otherLine, other] = found.get(",");
    throw new InputError({ en: `Both decimal point and comma occur: ${quoted(cell)} in line ${line}, ${quoted(other)} in line ${otherLine}; use one, or choose the decimal sign.`,
                           id: `Ada titik dan koma desimal: ${quoted(cell)} di baris ${line}, ${quoted(other)} di baris ${otherLine}; pakailah satu saja, atau pilih tanda desimal.` });
  }
  if (!found.size) return [null, NOTHING];
  const [[sign, [, cell]]] = found;
  return [sign, found === proof ? NOTHING : { en: ` (${quoted(cell)} was read as a decimal, not as thousands)`, id: ` (${quoted(cell)} dibaca sebagai desimal, bukan ribuan)` }];
}

/** The values of a column; InputError names the first cell that is no usable number. */
function checked(name, values, cells, lines) {
  const at = values.findIndex(number => number === null || Math.abs(number) > MAX_NUMBER);
  if (at < 0) return Float64Array.from(values);
  const [en, id] = values[at] === null ? ["neither a number nor a gap", "bukan bilangan dan bukan sel kosong"] : ["too large (beyond 1e+300)", "terlalu besar (di atas 1e+300)"];
  throw new InputError({ en: `Line ${lines[at]}, column ${quoted(name)}: ${quoted(cells[at])} is ${en}.`,
                         id: `Baris ${lines[at]}, kolom ${quoted(name)}: ${quoted(cells[at])} ${id}.` });
}

const cut = (text, length) => Array.from(text.slice(0, 2 * length)).slice(0, length).join("");

/** A text between quotation marks, at most so long, in which nothing is invisible: Python's repr. */
function quoted(text, length = 40) {
  const shown = cut(text, length), mark = shown.includes("'") && !shown.includes('"') ? '"' : "'";
  const known = { "\\": "\\\\", "\n": "\\n", "\r": "\\r", "\t": "\\t", [mark]: `\\${mark}` };
  const escaped = sign => {
    const code = sign.codePointAt(0), [letter, digits] = code < 256 ? ["x", 2] : code < 65536 ? ["u", 4] : ["U", 8];
    return known[sign] ?? (sign === " " ? sign : `\\${letter}${code.toString(16).padStart(digits, "0")}`);
  };
  return mark + shown.replace(/[\\'"]|[\p{C}\p{Z}]/gu, sign => sign === "'" && mark === '"' || sign === '"' ? sign : escaped(sign)) + mark;
}
