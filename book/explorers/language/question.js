// A question of the hand check: what is asked, the answer, and a hint for a wrong one.

/** Is a value so near to this one, relative to it? */
export function isNear(value, other, tolerance) {
  return Math.abs(value - other) <= tolerance * Math.abs(other);
}

/**
 * A question in the words of the page: {text, answer, tolerance, hint(value) -> sentence}. kind has text {id,
 * en}, answer, tolerance and hint(value) -> {id, en}; given fills the places such as {K}, with so many
 * digits.
 */
export function ask({ text, answer, tolerance, hint }, given, t, digits = 3) {
  return {
    text: t.say(text, given, digits),
    answer,
    tolerance,
    hint: (value) => t.say(hint(value), given, digits),
  };
}
