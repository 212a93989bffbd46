// Words and numbers in the reader's language, and the mistakes a reader can make. Pure: no document here.

/** A mistake in what the reader typed, pasted or loaded: one sentence in both languages. */
export class InputError extends Error {
  constructor({ id, en }) {
    super(en ?? id);
    Object.assign(this, { id, en });
  }
}

/** What was typed, with decimal comma or point, as a finite number; InputError if it is none. */
export function number(text) {
  const plain = text.trim().replace(",", ".").replace(/^\u2212/, "-");
  const value = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
  if (!Number.isFinite(value)) {
    const shown = text.trim().slice(0, 40);
    if (shown === "") throw new InputError({ id: "Isilah sebuah bilangan.", en: "Type a number." });
    throw new InputError({ id: `“${shown}” bukan bilangan.`, en: `“${shown}” is not a number.` });
  }
  return value;
}

/** A number with so many significant digits and without needless zeros, as Python's format "g" shows it. */
export function short(value, digits = 3) {
  if (!Number.isFinite(value)) return String(value);
  const power = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(Number(value.toPrecision(digits)))));
  if (power >= -4 && power < Math.max(digits, 6)) return String(Number(value.toPrecision(digits)));
  const [head, tail] = value.toExponential(digits - 1).split("e");
  return `${Number(head)}e${Number(tail)}`;
}

/**
 * The speaker of one language ("id" or "en"): t.say({id, en} or one text for both, values) and t.decimal(value, digits). A page
 * holds the words of its own language alone; in the other one it says nothing.
 */
export function speaker(language) {
  const decimal = (value, digits = 3) => {
    if (Number.isNaN(value)) return "–";
    let text = short(value, digits).replace("Infinity", "∞").replace(/-/g, "\u2212");
    text = text.replace(/e(.*)$/, (_, power) => " × 10" + [...power].map(sign => SUPERSCRIPT[sign]).join(""));
    return language === "id" ? text.replace(".", ",") : text;
  };
  const say = (words, values = {}, digits = 3) => (words[language] ?? (typeof words === "string" ? words : "")).replace(/\{(\w+)\}/g, (_, name) =>
    typeof values[name] === "number" ? decimal(values[name], digits) : String(values[name]));
  return { language, decimal, say };
}

const SUPERSCRIPT = { "\u2212": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
