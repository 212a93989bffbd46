// A pointer that takes something in a figure along. A finger that goes up or down scrolls the page, unless it
// begins on a handle of the figure.
import { nearestStep } from "./settings.js";

const NEAR = 26; // pixels around a handle, which belong to it
const SIDEWAYS = 6; // pixels: so far a finger must go aside before it holds something

/** Let the pointer drag in this plot, as spec.drag(x, y, s, r, hand) of the paper says. */
export function makeDraggable(explorer, plot) {
  const { canvas } = plot;
  // pressed: by a finger that is undecided yet; hand: what the paper remembers while one drag lasts
  const grip = { explorer, plot, held: false, pressed: null, hand: {} };
  canvas.classList.add("draggable");
  canvas.addEventListener("pointerdown", (event) => press(grip, event));
  canvas.addEventListener("pointermove", (event) => pull(grip, event));
  canvas.addEventListener("pointerup", (event) => {
    if (grip.pressed) {
      hold(grip, event); // a tap
    }
    release(grip);
  });
  canvas.addEventListener("pointercancel", () => release(grip));
  const keepPageStill = (event) => {
    if (event.cancelable && isOnHandle(grip, event.touches[0])) {
      event.preventDefault();
    }
  };
  canvas.addEventListener("touchstart", keepPageStill, { passive: false });
}

/** Pixels of the plot from its upper left corner; a slide is shown larger or smaller than it is laid out. */
function pointIn(plot, { clientX, clientY }) {
  const box = plot.canvas.getBoundingClientRect();
  const scale = plot.canvas.clientWidth / box.width;
  return [(clientX - box.left) * scale, (clientY - box.top) * scale];
}

/** Does the finger lie on one of the handles that the paper names? */
function isOnHandle({ explorer, plot }, event) {
  if (!plot.spec.handles || !plot.place || !explorer.r) {
    return false;
  }
  const [left, top] = pointIn(plot, event);
  return plot.spec.handles(explorer.r, explorer.shown).some((handle) => {
    const [x, y] = plot.place(handle);
    return Math.hypot(left - x, top - y) <= NEAR;
  });
}

function press(grip, event) {
  if (!event.isPrimary) {
    return;
  }
  if (event.pointerType === "touch" && !isOnHandle(grip, event)) {
    grip.pressed = event;
  } else {
    hold(grip, event);
  }
}

function pull(grip, event) {
  if (grip.held) {
    move(grip, event);
  } else if (grip.pressed && Math.abs(event.clientX - grip.pressed.clientX) > SIDEWAYS) {
    hold(grip, event);
  }
}

function hold(grip, event) {
  grip.pressed = null;
  grip.hand = {};
  grip.held = move(grip, event);
  if (grip.held) {
    grip.plot.canvas.setPointerCapture(event.pointerId);
  }
}

function release(grip) {
  if (grip.held) {
    grip.explorer.settled();
  }
  grip.held = false;
  grip.pressed = null;
}

/** Change what lies under the pointer; false: there is nothing to take along. */
function move({ explorer, plot, hand }, event) {
  const [left, top] = pointIn(plot, event);
  const x = plot.x_of?.(left);
  const y = plot.y_of?.(top);
  const changes = explorer.r && plot.spec.drag(x, y, explorer.s, explorer.r, hand);
  if (!changes) {
    return false;
  }
  for (const [name, value] of Object.entries(changes)) {
    const control = explorer.controls.find((other) => other.name === name);
    if (control && typeof value === "number" && !control.log) {
      changes[name] = nearestStep(control, value);
    }
  }
  explorer.change(changes, true);
  return true;
}
