// Which way of parting the lines of a text is right? Each gives a grid; the best one wins. Twin of
// kalman_lib/data/readings.py. A good one leaves the longest table, with a header that fits, and no cell in
// which a number hides among other things ("10:00 21" beside "5": the comma was a decimal one).
import { InputError } from "../language/input.js";
import { behindLast, strip, words } from "./blanks.js";
import { longestRun } from "./block.js";
import { isGap, isNumber, isValue, numberIn, quoted, toNumber } from "./cells.js";
import { headerOf } from "./header.js";
import { isUnit } from "./units.js";

const ONE_SIGN = ["tab", "semicolon"];
const THREE_DIGITS = /^0[0-9]{2}(?:[.,][0-9]*)?$/;
export const TIGHT_COMMA = /[0-9],[0-9]/;
const LONGEST = 200; // letters of a cell in which numbers may hide

/** [name of the best way, remark {en, id} or null]; ways: Map of name -> grid. */
export function bestOf(ways, decimal) {
  const readings = new Map();
  for (const [name, grid] of ways) {
    const reading = weighed(name, grid, decimal);
    if (reading !== null) {
      readings.set(name, reading);
    }
  }
  if (readings.size === 0) {
    return [[...ways.keys()][0], null];
  }
  for (const name of ONE_SIGN) {
    if (readings.get(name)?.rows[0].length === 1 && readings.size > 1) {
      readings.delete(name); // that sign stands elsewhere in the text
    }
  }
  const [first, ...others] = readings.values(); // of equal ones the first
  const best = others.reduce((one, other) => (compared(other, one) > 0 ? other : one), first);
  return betweenCommas(best, readings, decimal);
}

/** Positive if the first one is better. */
function compared({ score }, other, length = score.length) {
  const at = score.slice(0, length).findIndex((value, i) => value !== other.score[i]);
  return at < 0 ? 0 : score[at] - other.score[at];
}

/**
 * {name, rows, lines, score} of a grid, null if it cannot be meant. score: rows without two numbers in one
 * cell; is there a header as wide as the table; minus the cells in which a number stands beside words; minus
 * the cells of words.
 */
function weighed(name, grid, decimal) {
  const run = longestRun(grid);
  if (run === null) {
    return null;
  }
  const [start, stop] = run;
  const run_rows = grid.slice(start, stop).filter(([, cells]) => cells.length > 0);
  const rows = run_rows.map(([, cells]) => cells);
  if (!isPossible(name, rows, decimal)) {
    return null;
  }
  const [head, , first] = headerOf(grid, start, stop);
  const header = head === null ? [] : grid[head][1];
  const body = first > start ? rows.slice(1) : rows;
  const lines = run_rows.slice(-body.length).map(([line]) => line);
  const texts = body.flat().filter((cell) => !isGap(cell) && !isValue(cell));
  let beside = texts.filter(holdsOne).length;
  if (name === "blank") {
    beside += body.flatMap((row) => row.slice(1)).filter((cell) => THREE_DIGITS.test(cell)).length; // 1 000
  }
  const fits = header.length === rows[0].length && isName(name, header);
  return {
    name,
    rows: body,
    lines,
    score: [rows.length - crowdedIn(name, body), Number(fits), -beside, -texts.length],
  };
}

/** How many rows have two numbers in one cell? */
function crowdedIn(name, body) {
  let crowded = body.filter((row) => row.some(holdsTwo)).length;
  if (name === "comma" || name === "comma and blank") {
    const isGrouped = (cell) => cell.includes(" ") && isNumber(cell); // no blanks part thousands there
    crowded += body.filter((row) => row.some(isGrouped)).length;
  }
  return crowded;
}

function isPossible(name, rows, decimal) {
  if (name === "lines") {
    return !decimal || rows.every((row) => isRead(row[0], decimal));
  }
  if (name === "comma and blank") {
    const cells = rows.flat();
    const hasDecimals = cells.some((cell) => TIGHT_COMMA.test(cell.slice(0, LONGEST)));
    const areRead = cells.every((cell) => isValue(cell) || isGap(cell));
    return decimal !== "." && hasDecimals && areRead && rows[0].length > 1;
  }
  if (name === "comma" && decimal === ",") {
    return rows.some((row) => row.some((cell) => cell.includes(","))); // between quotation marks
  }
  return true;
}

/** Is the cell understood with this decimal sign? */
function isRead(cell, decimal) {
  return !isNumber(cell) || numberIn(cell, decimal)[0] !== null;
}

/** A comma in the name of a single column stands before its unit. */
function isName(name, header) {
  return name !== "lines" || !header[0].includes(",") || isUnit(strip(behindLast(header[0], ",")));
}

/** "10:00 21", "0;1": two values in a cell that is neither. */
function holdsTwo(cell) {
  if (isValue(cell) || cell.length > LONGEST) {
    return false;
  }
  const parts = words(cell.replace(/[;\t]/g, " "));
  return parts.length > 1 && isValue(parts[0]) && isValue(parts.at(-1));
}

/** "A 21", "Sensor 1": a value beside words; "10:00,21": not parted. */
function holdsOne(cell) {
  const start = cell.slice(0, LONGEST);
  const parts = words(start);
  const isBeside = parts.length > 1 && (isValue(parts[0]) || isValue(parts.at(-1)));
  return isBeside || TIGHT_COMMA.test(start);
}

// --- a comma between two digits: of columns or of decimals? ------------------------------------------------

/** The best reading, unless commas may as well be decimal ones; then the remark says so. */
function betweenCommas(best, readings, decimal) {
  if (best.name === "comma and blank") {
    return [best.name, remarkOn(best)];
  }
  checkOpen(best, decimal);
  const [comma, lines] = [readings.get("comma"), readings.get("lines")];
  const isOfCommas = best.name === "comma" || best.name === "lines";
  if (!isOfCommas || !comma || !lines || decimal) {
    return [best.name, null];
  }
  const isOpen = compared(comma, lines, 3) === 0 && comma.rows[0].length > 1;
  if (!isOpen || !lines.rows.some((row) => row[0].includes(","))) {
    return [best.name, null];
  }
  return ["lines", remarkOn(lines)];
}

/** That commas were taken for decimal ones; InputError where that is not certain. */
function remarkOn({ rows, lines }) {
  const cells = rows.flat();
  const hasComma = (cell) => cell.includes(",");
  const at = rows.findIndex((row) => row.some(hasComma));
  const line = lines[at];
  const shown = quoted(rows[at].find(hasComma));
  if (cells.some((cell) => toNumber(cell, ",") === null && isNumber(cell))) {
    throw either(line, rows[at].find(hasComma));
  }
  return {
    en: `${shown} was read as one number with decimal comma, not as columns`,
    id: `${shown} dibaca sebagai satu bilangan dengan koma desimal, bukan beberapa kolom`,
  };
}

/** InputError if the last two columns may be one. */
function checkOpen({ name, rows, lines, score: [, fits] }, decimal) {
  if (name === "comma" && !decimal && fits === 0 && rows.every(isOpenRow)) {
    throw either(lines[0], rows[0].join(","));
  }
}

/** A time and two whole numbers: 10:00,21,5 may end with 21.5. */
function isOpenRow(row) {
  const isWhole = (cell) => /^\p{Nd}+$/u.test(cell);
  return row.length === 3 && !isNumber(row[0]) && isWhole(row[1]) && isWhole(row[2]);
}

function either(line, cell) {
  const shown = quoted(cell);
  return new InputError({
    en:
      `Line ${line}, ${shown}: the comma may separate thousands or columns; add a header line, ` +
      "use semicolons between columns, or choose the decimal sign.",
    id:
      `Baris ${line}, ${shown}: koma dapat memisahkan ribuan atau kolom; tambahkan baris judul, ` +
      "pisahkan kolom dengan titik koma, atau pilih tanda desimal.",
  });
}
