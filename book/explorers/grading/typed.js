// A number as readers type it, with decimal comma or point. What can be read in two ways is never guessed.
import { inBoth } from "../language/speaker.js";
import { WORDS } from "./words.js";

const NUMBER = /^-?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
const MINUS = /^[-\u2212\u2013]\s*/; // of the keyboard, of typeset text, and what a phone makes of it
const SEPARATORS = /[.,]/g;
const TWO_WAYS = /^-?[1-9]\d{0,2}[.,]\d{3}$/; // "1.618" is 1.618, or sixteen hundred and eighteen
const POWER = /^(-?)(?:([\d.,]+)\s*[·×x*]\s*)?10\^\(?([-\u2212]?\d+)\)?$/; // 2·10^-5
const LONGEST = 40; // letters of what was typed are shown

/**
 * {value}; or {problem: {id, en}}; or {problem, either: [value, value]}, with a decimal sign first and with a
 * separator of thousands second. The unit may stand behind the number.
 */
export function numberIn(text, unit = "") {
  const typed = text.trim();
  const bare = withoutUnit(typed, unit).replace(MINUS, "-").replace(/^\+/, "");
  const plain = bare.replace(POWER, asExponent);
  if (plain === "") {
    return { problem: WORDS.empty };
  }
  if (TWO_WAYS.test(plain)) {
    const either = [plain.replace(SEPARATORS, "."), plain.replace(SEPARATORS, "")].map(Number);
    return { problem: sentence(WORDS.either, typed), either };
  }
  if (/^-?[\d.,]+$/.test(plain) && plain.match(SEPARATORS)?.length > 1) {
    return { problem: sentence(WORDS.groups, typed) };
  }
  const decimal = plain.replace(",", ".");
  const value = NUMBER.test(decimal) ? Number(decimal) : NaN;
  return Number.isFinite(value) ? { value } : { problem: sentence(WORDS.none, typed) };
}

function withoutUnit(typed, unit) {
  return unit !== "" && typed.endsWith(unit) ? typed.slice(0, -unit.length).trim() : typed;
}

function asExponent(_, sign, factor = "1", power) {
  return `${sign}${factor}e${power.replace("\u2212", "-")}`;
}

function sentence(words, typed) {
  return inBoth(words, { text: typed.slice(0, LONGEST) });
}
