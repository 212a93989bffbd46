// What stands around an explorer in a notebook: a cell (see element/host.js). The settings go to the kernel
// while the reader moves something, and come from it when Python sets them. No address is read or written.
import { isData } from "../element/settings.js";

const EVERY = 100; // ms between two messages to the kernel

/** settings: the whole state, files too, of the explorer that was in this place before, if there was one. */
export function cellHost(model, wrapper, kernel, settings) {
  let bridge;
  return {
    language: model.get("language"),
    themed: wrapper,
    start: fromPython(model.get("start"), {}),
    state: settings ?? fromPython(model.get("state"), {}),
    kernel,
    link: null,
    enter(explorer) {
      bridge = bridgeTo(model, explorer);
    },
    drawn(explorer) {
      bridge.tellSoon(explorer.dragging ? EVERY : 0);
    },
    settled() {},
    leave: () => bridge.leave(),
  };
}

/** Keeps the state of the explorer and that of Python the same: {tellSoon(milliseconds), leave()}. */
function bridgeTo(model, explorer) {
  let timer = 0;
  const tell = () => {
    timer = 0;
    const state = plain(explorer);
    if (!isSame(state, model.get("state"))) {
      model.set("state", state);
      model.save_changes();
    }
  };
  const follow = () => {
    const state = model.get("state");
    if (!isSame(state, plain(explorer))) {
      explorer.change(fromPython(state, explorer.s));
    }
  };
  const tellSoon = (milliseconds) => {
    timer ||= setTimeout(tell, milliseconds);
  };
  const leave = () => {
    clearTimeout(timer);
    model.off("change:state", follow);
  };
  model.on("change:state", follow);
  return { tellSoon, leave };
}

/** What of the state Python can hold: no files, no recordings; NaN becomes null. */
function plain({ s, controls }) {
  const files = new Set(controls.filter(isData).map(({ name }) => name));
  const kept = Object.entries(s).filter(([name]) => !files.has(name));
  return JSON.parse(JSON.stringify(Object.fromEntries(kept)));
}

/** Do two states say the same, in whatever order? */
function isSame(a, b) {
  const names = new Set([...Object.keys(a), ...Object.keys(b)]);
  return [...names].every((name) => JSON.stringify(a[name]) === JSON.stringify(b[name]));
}

/** A state from Python: gaps in lists are NaN again; another text takes the place of a file. */
function fromPython(state, before) {
  const values = { ...state };
  for (const [name, value] of Object.entries(state)) {
    if (Array.isArray(value)) {
      values[name] = value.map((item) => item ?? NaN);
    }
  }
  if (before.file && state.text && state.text !== before.text) {
    values.file = null;
  }
  return values;
}
