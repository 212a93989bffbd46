// The address after #: "gyro:sigma_w=1,sigma_v=2;theory:z=3" keeps the settings of every explorer of the
// page.
import { InputError, number } from "../language/input.js";
import { tell } from "./messages.js";
import { accepted, isData } from "./settings.js";
import { WORDS } from "./words.js";

const PART = /^[a-z]+(\.[a-z]+)?:/; // other anchors are none of our business
const LARGEST_SEED = 1e9;
const LONGEST_QUOTE = 60; // letters of an address in a message

/** Map {"gyro" -> "sigma_w=1,sigma_v=2", ...}; or null. */
function readHash() {
  const text = location.hash.slice(1);
  if (!PART.test(text)) {
    return null;
  }
  return new Map(text.split(";").map((part) => cutAt(part, ":")));
}

/** "a:b:c" -> ["a", "b:c"] */
function cutAt(text, sign) {
  const at = text.indexOf(sign);
  return [text.slice(0, at), text.slice(at + 1)];
}

function writeHash(key, text) {
  const parts = readHash() || new Map();
  if (text === "" && !parts.has(key)) {
    return;
  }
  if (text === "") {
    parts.delete(key);
  } else {
    parts.set(key, text);
  }
  const hash = [...parts].map(([name, value]) => `${name}:${value}`).join(";");
  const address = hash ? `#${hash}` : location.pathname + location.search;
  try {
    history.replaceState(history.state, "", address);
  } catch {
    // the browser allows only so many changes a minute: the next one will do
  }
}

/** The controls that the address may hold, by name. */
function addressed(controls) {
  const kept = controls.filter((control) => {
    const isText = control.kind === "text" && !control.kept;
    const isFree = isText || isData(control) || typeof control.options === "function";
    return control.name && !isFree;
  });
  const seed = { name: "seed", min: 0, max: LARGEST_SEED, unit: "" };
  return new Map([["seed", seed], ...kept.map((control) => [control.name, control])]);
}

/** Write the settings that differ from the defaults into the address. */
export function settingsToAddress({ key, controls, s, defaults }) {
  const kept = addressed(controls);
  const changed = [...kept.keys()].filter((name) => s[name] !== defaults[name] && s[name] !== null);
  const written = (name) => (kept.get(name).kind === "text" ? encodeURIComponent(s[name]) : s[name]);
  writeHash(key, changed.map((name) => `${name}=${written(name)}`).join(","));
}

/** An address that leads to this explorer with its settings. */
export function linkTo(key) {
  return readHash()?.get(key) === undefined ? `${location.href.split("#")[0]}#${key}:` : location.href;
}

/** Take the settings from the address; true if there were any. What makes no sense is refused as a whole. */
export function takeAddress(explorer) {
  const part = readHash()?.get(explorer.key);
  if (part === undefined) {
    return false;
  }
  explorer.asked = null; // what there is to say belongs to no control
  try {
    const values = settingsOf(part, explorer.controls, explorer.t);
    explorer.s = { ...explorer.defaults, ...values };
    tell(explorer, null);
  } catch (error) {
    tell(explorer, error);
    return false;
  }
  const isFirst = readHash().keys().next().value === explorer.key;
  if (isFirst && window.parent === window) {
    // in a frame it stands at the top anyway, and the page around the frame would be scrolled, too
    requestAnimationFrame(() => explorer.element.scrollIntoView({ block: "start" }));
  }
  return true;
}

/** "sigma_w=1,sigma_v=2" -> {sigma_w: 1, ...}; an InputError where it makes no sense. */
function settingsOf(part, controls, t) {
  const known = addressed(controls);
  const values = {};
  for (const piece of part.split(",").filter(Boolean)) {
    const text = decoded(piece);
    const [name, value] = text === null ? [null, ""] : cutAt(text, "=");
    const control = known.get(name);
    const setting = control ? settingOf(control, value, t) : undefined;
    if (setting === undefined) {
      const shown = (text ?? piece).slice(0, LONGEST_QUOTE);
      throw new InputError({ [t.language]: t.say(WORDS.hash, { text: shown }) });
    }
    values[name] = setting;
  }
  return values;
}

function decoded(piece) {
  try {
    return decodeURIComponent(piece);
  } catch {
    return null;
  }
}

/** The value of one control, undefined if the text is none; InputError: a number outside its range. */
function settingOf(control, text, t) {
  if (control.kind === "check") {
    const isBoolean = text === "true" || text === "false";
    return isBoolean ? text === "true" : undefined;
  }
  if (control.kind === "text") {
    return text;
  }
  if (control.kind === "select") {
    const option = control.options.find(([value]) => String(value) === text);
    return option?.[0];
  }
  const value = numberOrNothing(text);
  return value === undefined ? undefined : accepted(control, value, t);
}

function numberOrNothing(text) {
  try {
    return number(text);
  } catch (error) {
    if (error instanceof InputError) {
      return undefined;
    }
    throw error;
  }
}
