// A slider with a field to type into. On a log scale the slider has STEPS places.
import { label, make } from "../drawing/make.js";
import { number } from "../language/input.js";
import { forgive, safely } from "./messages.js";
import { accepted, valueOf } from "./settings.js";
import { WORDS } from "./words.js";

const STEPS = 1000;

/** {element, place() puts the slider where the value is, show() writes the value as well}. */
export function makeSlider(explorer, control) {
  const scale = control.log ? logScale(control) : linearScale(control);
  const id = `${explorer.id}-${control.name}`;
  const range = rangeInput(explorer, control, id, scale);
  const typed = typedInput(explorer, control);
  const place = () => {
    const at = scale.placeOf(valueOf(control, explorer.s));
    if (Number(range.value) !== at) {
      range.value = at;
    }
  };
  let seen;
  const show = () => {
    if (control.end) {
      control.max = control.end(explorer.s, explorer.r);
      range.max = control.max;
    }
    const value = valueOf(control, explorer.s);
    const disabled = Boolean(control.disabled?.(explorer.s));
    place();
    if (seen === `${value} ${disabled} ${typed.value}`) {
      return;
    }
    const text = fieldText(value, explorer.t);
    const isRefused = typed.getAttribute("aria-invalid") === "true"; // it stays, the message speaks of it
    if (typed.value !== text && document.activeElement !== typed && !isRefused) {
      typed.value = text;
    }
    range.setAttribute("aria-valuetext", `${explorer.t.decimal(value)} ${control.unit}`.trim());
    range.disabled = disabled;
    typed.disabled = disabled;
    seen = `${value} ${disabled} ${typed.value}`;
  };
  return { element: arranged(explorer, control, id, range, typed), place, show };
}

/** A slider whose places are the values themselves. */
function linearScale({ min, max, step }) {
  return { min, max, step, valueAt: (place) => place, placeOf: (value) => value };
}

/** A slider whose places are evenly spaced logarithms; the lowest place is the minimum, which may be 0. */
function logScale(control) {
  const { min, max } = control;
  const low = min > 0 ? min : (control.low ?? lowestOf(control));
  const from = Math.log(low);
  const to = Math.log(max);
  const valueAt = (place) => {
    if (place === 0 || place === STEPS) {
      return place === 0 ? min : max;
    }
    const exact = Math.exp(from + ((to - from) * place) / STEPS);
    return Math.min(Math.max(Number(exact.toPrecision(3)), min), max);
  };
  const placeOf = (value) =>
    value <= low ? 0 : Math.round((STEPS * (Math.log(value) - from)) / (to - from));
  return { min: 0, max: STEPS, step: 1, valueAt, placeOf };
}

/** Where the log scale begins if the range begins at 0. */
function lowestOf(control) {
  return control.default > 0 ? control.default / 1e6 : 1e-9;
}

function rangeInput(explorer, control, id, { min, max, step, valueAt }) {
  const range = make("input", { type: "range", id, min, max, step });
  range.hidden = Boolean(control.field);
  range.addEventListener("input", () => {
    explorer.change({ [control.name]: valueAt(Number(range.value)) }, true);
  });
  range.addEventListener("change", () => explorer.settled());
  return range;
}

function typedInput(explorer, control) {
  const { t } = explorer;
  const name = `${control.symbol || ""} ${t.say(control)}`.trim().replaceAll("_", "");
  const typed = make("input", {
    type: "text",
    inputMode: "decimal",
    autocomplete: "off",
    spellcheck: false,
    className: "explorer-value",
    "aria-label": t.say(WORDS.typed, { name }),
  });
  const value = () => accepted(control, number(typed.value, t.language), t);
  typed.addEventListener("change", () => {
    safely(explorer, () => explorer.change({ [control.name]: value() }));
  });
  typed.addEventListener("input", () => {
    if (explorer.marked === typed) {
      forgive(explorer, value);
    }
  });
  return typed;
}

/** Name above, slider and field below. */
function arranged(explorer, control, id, range, typed) {
  const name = make("label", { htmlFor: id });
  if (control.symbol) {
    name.append(make("b", {}, label(control.symbol)), " ");
  }
  name.append(make("span", {}, label(explorer.t.say(control))));
  const unit = make("span", { className: "explorer-unit", textContent: control.unit });
  const field = make("span", { className: "explorer-typed" }, boxed(typed), unit);
  return make("div", {}, name, boxed(range), field);
}

/** A box of its own: a new value lays out this box, not the page. */
function boxed(input) {
  return make("span", { className: "explorer-box" }, input);
}

/** A number for a text field: no digit lost, no needless one. */
export function fieldText(value, { language }) {
  const size = Math.abs(value);
  const isExtreme = size >= 1e6 || (value !== 0 && size < 1e-4);
  const text = isExtreme ? value.toExponential().replace("e+", "e") : String(Number(value.toPrecision(12)));
  return language === "id" ? text.replace(".", ",") : text;
}
