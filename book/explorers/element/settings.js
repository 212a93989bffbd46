// The settings of an explorer: which controls there are, where they start, and what they accept.
import { InputError } from "../language/input.js";
import { WORDS } from "./words.js";

export const SEED = 2;

/** The controls of a view; ranges and words that it does not give come from the table of the Params. */
export function completeControls(view, table) {
  return view.controls.map((control) => {
    const field = table[control.name];
    return { ...field, unit: field?.unit || "", ...control };
  });
}

/** {name: value}: where every field of the Params and every control starts. */
export function defaultsOf(view, controls, table) {
  const defaults = { seed: SEED };
  for (const [name, field] of Object.entries(table)) {
    defaults[name] = field.default;
  }
  for (const control of controls) {
    const isNew = control.name && !(control.name in defaults);
    if (isNew || (control.name && "default" in control)) {
      defaults[control.name] = control.default ?? null;
    }
  }
  return { ...defaults, ...view.start };
}

/** Does it hold what the reader has brought or recorded? Neither an address nor Python keeps that. */
export function isData({ kind }) {
  return kind === "file" || kind === "sensor";
}

/** The value of a control that is a number; one that nobody chose may follow the others. */
export function valueOf(control, s) {
  return s[control.name] ?? control.auto?.(s) ?? 0;
}

/** The nearest value that a slider without a log scale can have. */
export function nearestStep(control, value) {
  return Math.min(Math.max(toStep(control, value, Math.round), control.min), control.max);
}

/**
 * A value in whole steps of the control, without the dust of binary fractions; round: Math.round or another.
 */
export function toStep({ step }, value, round) {
  return Number((round(value / step) * step).toPrecision(12));
}

/** The value, if it lies in the range of the control; else an InputError that tells the range. */
export function accepted(control, value, t) {
  if (value >= control.min && value <= control.max) {
    return value;
  }
  const words = {
    name: control.symbol || t.say(control) || control.name,
    value: t.decimal(value, 12),
    min: t.decimal(control.min, 12),
    max: t.decimal(control.max, 12),
    unit: control.unit ? ` ${control.unit}` : "",
  };
  throw new InputError({ [t.language]: t.say(WORDS.range, words) });
}
