// The controls below the figures, one function a kind. Each returns {element, show()}: show() brings the
// element up to date with the state. What a paper writes for each kind stands in papers/README.md.
import { make, setAttribute, setText } from "../drawing/make.js";
import { InputError } from "../language/input.js";
import { whenThere } from "../language/later.js";
import { calm, glide, play } from "./motion.js";
import { saveFile } from "./hand-over.js";
import { copy, makeButton, safely } from "./messages.js";
import { makeSlider } from "./slider.js";
import { WORDS } from "./words.js";

const LONGEST_NAME = 60; // letters of a file's name in a message
const MEGABYTE = 1e6;

const KINDS = {
  slider: makeSlider,
  check: makeCheck,
  select: makeSelect,
  entry: makeEntry,
  text: makeText,
  file: makeFile,
  buttons: makeButtons,
};

const TOOLS = { make, makeButton, safely, saveFile, setText }; // for a control that brings what builds it

/**
 * The part of the page for one control: {control, element, show, place (sliders only), end (optional)}. A
 * kind that is not among ours brings its own build(explorer, control, tools).
 */
export function makeControl(explorer, control) {
  const kind = control.kind || "slider";
  const build = KINDS[kind] ?? control.build;
  const part = build(explorer, control, TOOLS);
  part.element.classList.add("explorer-control", kind);
  return { control, ...part };
}

function nameOf(explorer, control, id) {
  return make("label", { htmlFor: id, textContent: explorer.t.say(control) });
}

/** The reader has chosen or typed: the value, and what else changes with it. */
function choose(explorer, control, value) {
  explorer.change({ [control.name]: value, ...control.also?.(value, explorer.s) });
}

function makeCheck(explorer, control) {
  const box = make("input", { type: "checkbox" });
  box.addEventListener("change", () => explorer.change({ [control.name]: box.checked }));
  const words = make("span", { textContent: explorer.t.say(control) });
  const show = () => {
    box.checked = explorer.s[control.name];
  };
  return { element: make("label", {}, box, words), show };
}

function makeSelect(explorer, control) {
  const id = `${explorer.id}-${control.name}`;
  const box = make("select", { id });
  let shown = []; // the options in the box
  const fill = (options) => {
    if (JSON.stringify(options) === JSON.stringify(shown)) {
      return;
    }
    shown = options;
    box.replaceChildren(
      ...options.map(([value, words]) => make("option", { value, textContent: explorer.t.say(words) })),
    );
  };
  box.addEventListener("change", () => {
    const [value] = shown[box.selectedIndex];
    choose(explorer, control, value);
  });
  const show = () => {
    const { options } = control;
    fill(typeof options === "function" ? options(explorer.s, explorer.r) : options);
    box.value = explorer.s[control.name];
  };
  return { element: make("div", {}, nameOf(explorer, control, id), box), show };
}

function makeEntry(explorer, control) {
  const id = `${explorer.id}-${control.key ?? "entry"}`;
  const box = make("input", {
    type: "text",
    id,
    inputMode: control.inputMode || "decimal",
    autocomplete: "off",
    className: "explorer-value",
  });
  const enter = () => {
    explorer.change(control.enter(box.value, explorer.s, explorer.r, explorer.t));
    box.value = "";
  };
  box.addEventListener("keydown", (event) => {
    if (event.key === "Enter") {
      safely(explorer, enter);
    }
  });
  const button = makeButton(explorer, explorer.t.say(control.button), enter);
  return { element: make("div", {}, nameOf(explorer, control, id), box, button), show() {} };
}

function makeText(explorer, control) {
  const id = `${explorer.id}-${control.name}`;
  const box = make("textarea", { id, rows: control.rows || 4, spellcheck: false });
  if (control.placeholder) {
    box.placeholder = explorer.t.say(control.placeholder);
  }
  box.addEventListener("input", () => choose(explorer, control, box.value));
  const show = () => {
    const text = explorer.s[control.name] ?? "";
    if (document.activeElement !== box && box.value !== text) {
      box.value = text;
    }
  };
  return { element: make("div", {}, nameOf(explorer, control, id), box), show };
}

function makeFile(explorer, control) {
  const id = `${explorer.id}-${control.name}`;
  const accept = control.accept || "";
  const box = make("input", { type: "file", id, accept, multiple: Boolean(control.multiple) });
  const take = async (files) => {
    if (files.length > 0) {
      choose(explorer, control, await readFiles(explorer, control, Array.from(files)));
    }
  };
  box.addEventListener("change", () => safely(explorer, () => take(box.files)));
  box.addEventListener("click", () => {
    box.value = ""; // the same file, corrected on the disk, may be chosen again
  });
  const hint = make("span", { className: "explorer-hint", textContent: explorer.t.say(WORDS.drop) });
  const element = make("div", {}, nameOf(explorer, control, id), box, hint);
  element.addEventListener("dragover", (event) => event.preventDefault());
  element.addEventListener("drop", (event) => {
    event.preventDefault();
    safely(explorer, () => take(event.dataTransfer.files));
  });
  const show = () => {
    if (explorer.s[control.name] === null && box.value) {
      box.value = "";
    }
    readAgain(explorer, control);
  };
  return { element, show };
}

/** What a file control puts into the state: the bytes, or what they open to. */
async function readFiles(explorer, control, files) {
  const loaded = await Promise.all(files.map((file) => bytesOf(file, control, explorer.t)));
  return opened(explorer, control, control.multiple ? loaded : loaded[0]);
}

/** By the kernel, where there is one that can, or here, as soon as what reads it is there. */
function opened({ s, host }, control, brought) {
  if (host.kernel && control.reads) {
    return host.kernel.read(control.reads, brought, s);
  }
  return control.open ? whenThere(() => control.open(brought, s)) : brought;
}

/** What was opened is opened again when the reader has chosen another value of the control `follows`. */
function readAgain(explorer, control) {
  const held = explorer.s[control.name];
  const asked = explorer.s[control.follows];
  if (!control.follows || !held || held[control.follows] === asked) {
    return;
  }
  held[control.follows] = asked; // once
  const put = (again) => explorer.s[control.name] === held && explorer.change({ [control.name]: again });
  safely(explorer, () => opened(explorer, control, held.files).then(put));
}

/** {name, bytes}; InputError: it is too large, or the browser cannot read it: a folder, or it is gone. */
async function bytesOf(file, { largest = Infinity }, t) {
  const wrong = (words) => {
    const values = { name: file.name.slice(0, LONGEST_NAME), most: String(largest / MEGABYTE) };
    return new InputError({ [t.language]: t.say(words, values) });
  };
  if (file.size > largest) {
    throw wrong(WORDS.too_large);
  }
  const content = await file.arrayBuffer().catch(() => {
    throw wrong(WORDS.unreadable);
  });
  return { name: file.name, bytes: new Uint8Array(content) };
}

function makeButtons(explorer, control) {
  const { t } = explorer;
  const buttons = control.items.map((item) => makeButton(explorer, t.say(item), () => press(explorer, item)));
  const element = make("div", { role: "group" }, ...buttons);
  const name = control[t.language] ? t.say(control) : "";
  if (name) {
    element.setAttribute("aria-label", name);
    element.prepend(make("span", { className: "explorer-name", textContent: name }));
  }
  let isPrepared = !control.prepare;
  const show = () => {
    if (!isPrepared) {
      isPrepared = true;
      whenThere(control.prepare).catch(() => {}); // who presses a button is told why it fails
    }
    control.items.forEach((item, i) => showButton(explorer, item, buttons[i]));
  };
  return { element, show };
}

function showButton(explorer, item, button) {
  const { s, t, playing } = explorer;
  if (item.pressed) {
    setAttribute(button, "aria-pressed", String(Boolean(item.pressed(s))));
  }
  if (item.disabled) {
    button.disabled = Boolean(item.disabled(s));
  }
  if (item.play) {
    setText(button, t.say(playing === item.play ? WORDS.stop : item));
  }
}

/** What a button does: set values, play, copy, or save. */
async function press(explorer, item) {
  const { s, r, t } = explorer;
  if (item.set) {
    const changes = typeof item.set === "function" ? item.set(s, r) : item.set;
    if (item.glide && !calm()) {
      glide(explorer, changes, item.glide);
    } else {
      explorer.change(changes);
    }
  } else if (item.play) {
    play(explorer, item);
  } else if (item.copy) {
    await copy(explorer, item.copy(r, s, t));
  } else if (item.save) {
    const { kernel } = explorer.host;
    const file = kernel && item.ask ? await kernel.write(item.ask(r, s, t)) : item.save(r, s, t);
    saveFile(file);
  }
}
