// What moves by itself: numbers that glide to new values, and a control that plays from its start to its end.
import { toStep, valueOf } from "./settings.js";

const STILL = 1000; // ms between two pictures for who wants no motion
const PLAY_SECONDS = 8;

/** Does the reader want no motion? */
export function calm() {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/** Take over new values; the numbers among them move there within some milliseconds. */
export function glide(explorer, changes, milliseconds) {
  const from = explorer.s;
  const start = performance.now();
  const token = {}; // another change takes explorer.moving away, and this one ends
  explorer.change(changes);
  explorer.moving = token;
  const step = (now) => {
    if (explorer.moving !== token) {
      return;
    }
    const share = Math.min((now - start) / milliseconds, 1);
    explorer.tween = share < 1 ? between(from, changes, eased(share)) : {};
    explorer.renderNow(share < 1);
    if (share < 1) {
      requestAnimationFrame(step);
    } else {
      explorer.moving = null;
    }
  };
  step(start);
}

/** Slow at the start and at the end. */
function eased(share) {
  return share * share * (3 - 2 * share);
}

/** The numbers on their way from the state to the changes. */
function between(from, changes, share) {
  const tween = {};
  for (const [name, value] of Object.entries(changes)) {
    if (typeof value === "number" && typeof from[name] === "number") {
      tween[name] = from[name] + share * (value - from[name]);
    }
  }
  return tween;
}

/** Move the control item.play to its end, or stop it. */
export function play(explorer, item) {
  if (explorer.playing === item.play) {
    explorer.stopPlaying();
    return;
  }
  const control = explorer.controls.find(({ name }) => name === item.play);
  const now = valueOf(control, explorer.s);
  const atEnd = now >= control.max;
  if (calm()) {
    explorer.change({ [item.play]: atEnd ? control.min : control.max });
    return;
  }
  explorer.playing = item.play;
  const seconds = typeof item.seconds === "function" ? item.seconds(explorer.s) : item.seconds;
  playFrom(explorer, control, atEnd ? control.min : now, seconds || PLAY_SECONDS);
}

function playFrom(explorer, control, start, seconds) {
  const speed = (control.max - control.min) / seconds; // units of the control per second
  let value = start;
  let last;
  const step = (now) => {
    if (explorer.playing !== control.name || !explorer.element.isConnected) {
      return;
    }
    last ??= now;
    if (calm() && now - last < STILL) {
      requestAnimationFrame(step); // the reader has just asked for less motion
      return;
    }
    value = Math.min(value + (speed * (now - last)) / 1000, control.max);
    last = now;
    if (value >= control.max) {
      explorer.playing = null;
    }
    const shown = control.step ? toStep(control, value, (steps) => Math.floor(steps + 1e-9)) : value;
    explorer.change({ [control.name]: shown }, explorer.playing !== null);
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
