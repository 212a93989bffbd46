// One cell of a table: is it a number, a gap, a time or words, and how is it shown in a sentence? Twin of
// kalman_lib/data/cells.py. Every pattern reads a cell once from left to right; nothing is tried twice.
import { strip } from "./blanks.js";
import { isTime } from "./clock.js";
import { CURRENCIES, isUnit } from "./units.js";

const LONGEST_NUMBER = 400; // letters
const LONGEST_GAP = 4;
const EXPONENT = "(?:[eE][+-]?[0-9]+)?";
const GROUPS = "\\u00a0\\u202f\\u2009 '\\u2019"; // blanks and apostrophes between groups of three digits
// A number with decimal point; whole groups of three digits where something parts the thousands
const PLAIN = new RegExp(`^[+-]?(?:[0-9]+(?:\\.[0-9]*)?|\\.[0-9]+)${EXPONENT}$`);
const WITH_COMMAS = new RegExp(`^[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\\.[0-9]*)?${EXPONENT}$`);
const WITH_GROUPS = new RegExp(`^[+-]?[1-9][0-9]{0,2}(?:[${GROUPS}][0-9]{3})+(?:\\.[0-9]*)?${EXPONENT}$`);
const GROUP_SIGNS = new RegExp(`[,${GROUPS}]`, "g");
const DIGITS_FIRST = new RegExp(`^[+-]?[0-9.,${GROUPS}]*[0-9.,]`);
const CURRENCY_PATTERN = CURRENCIES.map((name) => name.replace("$", "\\$")).join("|");
const CURRENCY = new RegExp(`^(?:${CURRENCY_PATTERN})`);
const BEGINS = new RegExp(`^(?:[+\\-\\u2212\\u2013]?[0-9.,]|${CURRENCY_PATTERN})`);
const INFINITE = /^[+-]?(?:inf|infinity|∞)$/i;
const EITHER = new RegExp(`^[+-]?[0-9]{1,30}(?:[.,][0-9]{1,30})?${EXPONENT}$`);
const GAPS = new Set(["", "na", "n/a", "nan", "null", "none", "-", "--", "---", "#n/a", "nat"]);

/** The minus and the dash of typeset text as the minus of a keyboard. */
function plainMinus(text) {
  return text.replace(/[\u2212\u2013]/g, "-");
}

/** Does the cell say that nothing was measured? */
export function isGap(cell) {
  if (typeof cell === "number" || cell.length > LONGEST_GAP) {
    return false;
  }
  return cell === "" || GAPS.has(plainMinus(cell).toLowerCase());
}

/** Is it a number, with whichever decimal sign, alone or with its unit? */
export function isNumber(cell) {
  if (typeof cell === "number" || EITHER.test(cell)) {
    return true;
  }
  if (!BEGINS.test(cell)) {
    return INFINITE.test(cell);
  }
  return numberIn(cell, ".")[0] !== null || numberIn(cell, ",")[0] !== null;
}

/** A number or a time? */
export function isValue(cell) {
  if (typeof cell === "number" || EITHER.test(cell)) {
    return true;
  }
  return isTime(cell) || isNumber(cell);
}

export function hasLetter(cell) {
  return typeof cell === "string" && /\p{L}/u.test(cell);
}

/** The number in a cell, NaN for a gap, null for anything else; decimal: "." or ",". */
export function toNumber(cell, decimal) {
  if (typeof cell === "number") {
    return cell;
  }
  if (cell.length > LONGEST_NUMBER) {
    return null;
  }
  let text = plainMinus(cell);
  if (decimal === ",") {
    text = text.replace(/[.,]/g, (sign) => (sign === "." ? "," : "."));
  }
  if (PLAIN.test(text)) {
    return Number(text);
  }
  if (WITH_COMMAS.test(text) || WITH_GROUPS.test(text)) {
    return Number(text.replace(GROUP_SIGNS, ""));
  }
  if (INFINITE.test(text)) {
    return Infinity;
  }
  return isGap(cell) ? NaN : null;
}

/** [number, unit]: as toNumber, also beside a unit or a currency, "21,5 °C", "Rp 1.500". */
export function numberIn(cell, decimal) {
  const number = toNumber(cell, decimal);
  if (number !== null) {
    return [number, ""];
  }
  const [digits, unit] = parted(cell);
  return unit ? [toNumber(digits, decimal), unit] : [null, ""];
}

/** "21,5 °C" -> ["21,5", "°C"]; the unit is "" where there is none that we know. */
function parted(cell) {
  if (cell.length > LONGEST_NUMBER) {
    return [cell, ""];
  }
  const text = plainMinus(cell);
  const currency = CURRENCY.exec(text);
  if (currency) {
    return [strip(text.slice(currency[0].length), " .\u00a0"), currency[0]];
  }
  const digits = DIGITS_FIRST.exec(text);
  const rest = digits ? strip(text.slice(digits[0].length)) : "";
  return isUnit(rest) || CURRENCIES.includes(rest) ? [digits[0], rest] : [cell, ""];
}

/** The cell as text. */
export function shownCell(cell) {
  return typeof cell === "number" ? String(Number(cell.toPrecision(15))) : cell;
}

/** The first so many letters of a text; a letter of two halves is not cut in two. */
export function cut(text, length) {
  const letters = Array.from(text.slice(0, 2 * length));
  return letters.slice(0, length).join("");
}

/** A text between quotation marks, at most so long, in which nothing is invisible: Python's repr. */
export function quoted(cell, length = 40) {
  const shown = cut(shownCell(cell), length);
  const mark = shown.includes("'") && !shown.includes('"') ? '"' : "'";
  const visible = shown.replace(/[\\']|[\p{C}\p{Z}]/gu, (sign) => {
    const harmless = sign === " " || (sign === "'" && mark === '"');
    return harmless ? sign : escaped(sign);
  });
  return mark + visible + mark;
}

const SHORT_ESCAPES = { "\\": "\\\\", "'": "\\'", "\n": "\\n", "\r": "\\r", "\t": "\\t" };

/** "\n", "\x07", "\u200b", "\U0001f600": how Python writes a sign that cannot be seen. */
function escaped(sign) {
  if (sign in SHORT_ESCAPES) {
    return SHORT_ESCAPES[sign];
  }
  const code = sign.codePointAt(0);
  if (code < 0x100) {
    return `\\x${hexadecimal(code, 2)}`;
  }
  return code < 0x10000 ? `\\u${hexadecimal(code, 4)}` : `\\U${hexadecimal(code, 8)}`;
}

function hexadecimal(code, digits) {
  return code.toString(16).padStart(digits, "0");
}
