// What a reader types, and the mistakes a reader can make.

/** A mistake in what the reader typed, pasted or loaded: one sentence in both languages. */
export class InputError extends Error {
  constructor({ id, en }) {
    super(en ?? id);
    this.id = id;
    this.en = en;
  }
}

const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const MINUS = /^\u2212/; // the sign of typeset text
const LONGEST = 40; // letters of what was typed are shown

/** What was typed, with decimal comma or point, as a finite number; InputError if it is none. */
export function number(text) {
  const typed = text.trim();
  const plain = typed.replace(",", ".").replace(MINUS, "-");
  const value = NUMBER.test(plain) ? Number(plain) : NaN;
  if (Number.isFinite(value)) {
    return value;
  }
  if (typed === "") {
    throw new InputError({ id: "Isilah sebuah bilangan.", en: "Type a number." });
  }
  const shown = typed.slice(0, LONGEST);
  throw new InputError({ id: `“${shown}” bukan bilangan.`, en: `“${shown}” is not a number.` });
}
