// One cell of a table: is it a number, a gap or a text, and how is it shown in a sentence? Twin of the same
// questions in Python's reader. Pure: what a cell says is never more than a text.

// A number with decimal point; a thousands comma must stand before every group of three digits
const WHOLE = "[0-9]+\\.?[0-9]*";
const FRACTION = "\\.[0-9]+";
const THOUSANDS = "[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\\.[0-9]*)?";
const POINT = new RegExp(`^[+-]?(?:${WHOLE}|${FRACTION}|${THOUSANDS})(?:[eE][+-]?[0-9]+)?$`);
const INFINITE = /^[+-]?(?:inf|infinity|∞)$/i;
const GAPS = new Set(["", "na", "n/a", "nan", "null", "-", "#n/a"]);

/** The minus and the dash of typeset text as the minus of a keyboard. */
function plainMinus(text) {
  return text.replace(/[\u2212\u2013]/g, "-");
}

export function isGap(cell) {
  return GAPS.has(plainMinus(cell).toLowerCase());
}

export function isNumber(cell) {
  return !isGap(cell) && (valueOf(cell, ".") !== null || valueOf(cell, ",") !== null);
}

/** The number in a cell, NaN for a gap, null for anything else; decimal: "." or ",". */
export function valueOf(cell, decimal) {
  let text = plainMinus(cell);
  if (decimal === ",") {
    text = text.replace(/[.,]/g, (sign) => (sign === "." ? "," : "."));
  }
  if (POINT.test(text)) {
    return Number(text.replaceAll(",", ""));
  }
  if (INFINITE.test(text)) {
    return Infinity;
  }
  return isGap(cell) ? NaN : null;
}

/** The first so many letters of a text; a letter of two halves is not cut in two. */
export function cut(text, length) {
  const letters = Array.from(text.slice(0, 2 * length));
  return letters.slice(0, length).join("");
}

/** A text between quotation marks, at most so long, in which nothing is invisible: Python's repr. */
export function quoted(text, length = 40) {
  const shown = cut(text, length);
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
