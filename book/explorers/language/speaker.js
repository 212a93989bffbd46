// Words and numbers in the reader's language.

const SUPERSCRIPT = {
  "\u2212": "⁻",
  0: "⁰",
  1: "¹",
  2: "²",
  3: "³",
  4: "⁴",
  5: "⁵",
  6: "⁶",
  7: "⁷",
  8: "⁸",
  9: "⁹",
};

/** A number with so many significant digits and without needless zeros, as Python's format "g" shows it. */
export function short(value, digits = 3) {
  if (!Number.isFinite(value)) {
    return String(value);
  }
  const rounded = Number(value.toPrecision(digits));
  const power = value === 0 ? 0 : Math.floor(Math.log10(Math.abs(rounded)));
  if (power >= -4 && power < Math.max(digits, 6)) {
    return String(rounded);
  }
  const [head, tail] = value.toExponential(digits - 1).split("e");
  return `${Number(head)}e${Number(tail)}`;
}

/**
 * The speaker of one language ("id" or "en"): t.say({id, en} or one text for both, values), in which {name}
 * stands for values.name, t.decimal(value, digits), and t.unbroken(value, digits), one word of an equation,
 * which has no spaces. A page holds the words of its own language alone; in
 * the other one it says nothing.
 */
export function speaker(language) {
  const decimal = (value, digits = 3) => {
    if (Number.isNaN(value)) {
      return "–";
    }
    const text = short(value, digits).replace("Infinity", "∞").replace(/-/g, "\u2212");
    const shown = text.replace(/e(.*)$/, (_, power) => ` × 10${raised(power)}`);
    return language === "id" ? shown.replace(".", ",") : shown;
  };
  const unbroken = (value, digits) => decimal(value, digits).replace(/ × 10(.*)/, "·10$1");
  const say = (words, values = {}, digits = 3) => {
    const sentence = typeof words === "string" ? words : (words[language] ?? "");
    return sentence.replace(/\{(\w+)\}/g, (_, name) => {
      const value = values[name];
      return typeof value === "number" ? decimal(value, digits) : String(value);
    });
  };
  return { language, decimal, unbroken, say };
}

/** "−5" -> "⁻⁵" */
function raised(power) {
  return Array.from(power, (sign) => SUPERSCRIPT[sign]).join("");
}

/** Words with the values filled in, in both languages: {id, en}. */
export function inBoth(words, values, digits = 3) {
  return {
    en: speaker("en").say(words, values, digits),
    id: speaker("id").say(words, values, digits),
  };
}
