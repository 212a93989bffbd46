// What Python calls a blank, so that both readers part and strip alike. Every loop reads a text once.

export const BLANK = "\\t-\\r\\x1c- \\x85\\xa0\\u1680\\u2000-\\u200a\\u2028\\u2029\\u202f\\u205f\\u3000";
/** Those that part numbers; the others may part the thousands of one. */
export const BETWEEN_NUMBERS = "\\t-\\r\\x1c- \\x85\\u1680\\u2000-\\u2008\\u200a\\u2028\\u2029\\u205f\\u3000";
const BLANKS = new RegExp(`[${BLANK}]+`);
const IS_BLANK = new RegExp(`[${BLANK}]`);

/** The text without blanks, or these signs, at both ends. */
export function strip(text, signs = null) {
  const isOuter = (sign) => (signs === null ? IS_BLANK.test(sign) : signs.includes(sign));
  let start = 0;
  let stop = text.length;
  while (start < stop && isOuter(text[start])) {
    start++;
  }
  while (stop > start && isOuter(text[stop - 1])) {
    stop--;
  }
  return text.slice(start, stop);
}

/** The words of a text. */
export function words(text) {
  return text.split(BLANKS).filter(Boolean);
}

/** What stands behind the last such sign; all of it without one. */
export function behindLast(text, sign) {
  return text.slice(text.lastIndexOf(sign) + 1);
}

/** How often a sign stands in a text. */
export function count(text, sign) {
  let found = 0;
  for (let at = text.indexOf(sign); at >= 0; at = text.indexOf(sign, at + sign.length)) {
    found++;
  }
  return found;
}
