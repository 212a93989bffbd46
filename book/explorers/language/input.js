// What a reader types, and the mistakes a reader can make.

/** A mistake in what the reader typed, pasted or loaded: one sentence in both languages. */
export class InputError extends Error {
  constructor({ id, en }) {
    super(en ?? id);
    this.id = id;
    this.en = en;
  }
}

const NUMBER = /^[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?$/i;
const MINUS = /^\u2212/; // the sign of typeset text
const LONGEST = 40; // letters of what was typed are shown
const BLANK_GROUPS = /^[-+]?[1-9]\d{0,2}(?:[ \u00a0\u202f]\d{3})+(?:[.,]\d*)?$/; // 1 000,5
const POINT_GROUPS = /^[-+]?[1-9]\d{0,2}(?:(?:\.\d{3})+,\d*|(?:\.\d{3}){2,})$/; // 1.000,5 and 1.000.000
const COMMA_GROUPS = /^[-+]?[1-9]\d{0,2}(?:(?:,\d{3})+\.\d*|(?:,\d{3}){2,})$/; // 1,000.5 and 1,000,000
const ONE_GROUP = /^[-+]?[1-9]\d{0,2}[.,]\d{3}$/; // 1.000
const DECIMAL_SIGNS = { id: ",", en: "." };

/**
 * What was typed, with decimal comma or point, as a finite number. language: that of the reader, in which
 * "1.000" may be a thousand. InputError: it is no number, or may be two.
 */
export function number(text, language = null) {
  const typed = text.trim();
  const plain = withoutGroups(typed.replace(MINUS, "-"));
  if (language !== null && ONE_GROUP.test(plain) && !plain.includes(DECIMAL_SIGNS[language])) {
    throw mayBeTwo(typed.slice(0, LONGEST), plain);
  }
  const pointed = plain.replace(",", ".");
  const value = NUMBER.test(pointed) ? Number(pointed) : NaN;
  if (Number.isFinite(value)) {
    return value;
  }
  if (typed === "") {
    throw new InputError({ id: "Isilah sebuah bilangan.", en: "Type a number." });
  }
  const shown = typed.slice(0, LONGEST);
  throw new InputError({ id: `“${shown}” bukan bilangan.`, en: `“${shown}” is not a number.` });
}

/** The number without what parts its thousands, where that can be nothing else. */
function withoutGroups(text) {
  if (BLANK_GROUPS.test(text)) {
    return text.replace(/[ \u00a0\u202f]/g, "");
  }
  if (POINT_GROUPS.test(text)) {
    return text.replaceAll(".", "");
  }
  return COMMA_GROUPS.test(text) ? text.replaceAll(",", "") : text;
}

function mayBeTwo(shown, plain) {
  const many = plain.replace(/[.,]/, "");
  const few = plain.replace(/[.,]/, (sign) => (sign === "." ? "," : "."));
  return new InputError({
    id: `“${shown}” dapat berarti ${many} atau ${few}: tuliskan salah satunya.`,
    en: `“${shown}” may mean ${many} or ${few}: type one of them.`,
  });
}
