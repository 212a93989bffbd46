// An explorer on paper: what the reader has set. Its figures are painted again, in light colours and as wide
// as the paper, with the outcome and the settings in words. Without a script its picture is printed.
import { label, make } from "../drawing/make.js";
import { valueOf } from "./settings.js";
import { fieldText } from "./slider.js";
import { WORDS } from "./words.js";

const WIDTH = 640; // pixels between the margins of an A4 page
const GAP = 24; // between two figures beside each other
const LONGEST_TEXT = 60; // letters of what a reader has typed
const LAID = "on-paper"; // a class of the element: window.css

/** Until the signal, lay out what is printed before every print. */
export function printState(explorer, signal) {
  let sheet = null;
  const clear = () => {
    sheet?.remove();
    sheet = null;
    explorer.element.classList.remove(LAID);
  };
  const lay = () => {
    clear();
    sheet = sheetOf(explorer);
    explorer.element.classList.toggle(LAID, sheet !== null);
  };
  addEventListener("beforeprint", lay, { signal });
  addEventListener("afterprint", clear, { signal });
  const change = ({ matches }) => (matches ? sheet || lay() : clear()); // a preview without those events
  matchMedia("print").addEventListener("change", change, { signal });
  signal.addEventListener("abort", clear);
}

/** The explorer as it is at this moment, in its element; null: it has nothing to show. */
function sheetOf(explorer) {
  if (explorer.frame) {
    explorer.renderNow(false); // what the reader has just set
  }
  if (!explorer.r) {
    return null;
  }
  explorer.refine(Infinity);
  const { element, view, r, shown, t } = explorer;
  const figures = make("div", { className: "explorer-figures" });
  const sheet = make("div", { className: "explorer-paper" }, figures);
  sheet.dataset.theme = "light";
  element.append(sheet); // the colours are those of its place
  for (const plot of explorer.plots.filter((one) => !one.spec.visible || one.spec.visible(shown))) {
    const width = plot.spec.half ? (WIDTH - GAP) / 2 : WIDTH;
    plot.paintAlso(plot.spec.draw(r, shown, t), figures, width);
  }
  if (view.outcome) {
    sheet.append(make("p", {}, label(view.outcome(r, shown, t))));
  }
  sheet.append(make("p", { className: "explorer-settings" }, ...settings(explorer)));
  return sheet;
}

/** "Settings: R (measurement noise) = 0.05 m²; ...", as parts of a paragraph. */
function settings(explorer) {
  const { t, view, shown } = explorer;
  const said = offered(explorer).map((control) => worded(explorer, control));
  if (view.noise) {
    said.push([t.say(WORDS.noise_number), ` ${shown.seed}`]);
  }
  const words = said.filter(([, value]) => value);
  const start = make("b", { textContent: `${t.say(WORDS.settings)}: ` });
  return words.flatMap(([title, value], i) => [i > 0 ? "; " : start, label(title), value]);
}

/** The controls that count: of all groups, where the reader opens one at a time. */
function offered({ controls, shown, r }) {
  const tabs = controls.find((control) => control.tabs);
  const states = tabs ? tabs.items.map(({ set }) => ({ ...shown, ...set })) : [shown];
  const isOffered = ({ visible }) => !visible || states.some((s) => visible(s, r));
  return controls.filter((control) => isOffered(control) && !control.disabled?.(shown));
}

/** [name, value] of a control in words; no value: there is nothing to say. */
function worded({ shown, r, t }, control) {
  const { kind = "slider", symbol } = control;
  const name = t.say(control);
  const title = symbol && name ? `${symbol} (${name})` : symbol || name;
  return [title, SAID[kind]?.(control, shown, t, r)];
}

const SAID = {
  slider: (control, s, t) =>
    `${control.symbol ? " =" : ":"} ${fieldText(valueOf(control, s), t)} ${control.unit}`.trimEnd(),
  check: ({ name }, s, t) => `: ${t.say(s[name] ? WORDS.yes : WORDS.no)}`,
  select: ({ name, options }, s, t, r) => {
    const offered = typeof options === "function" ? options(s, r) : options;
    const chosen = offered.find(([value]) => String(value) === String(s[name]));
    return chosen && `: ${t.say(chosen[1])}`;
  },
  text: ({ name }, s) => s[name] && `: ${shortened(s[name])}`,
  file: ({ name }, s) => s[name]?.name && `: ${shortened(s[name].name)}`,
};

function shortened(text) {
  const line = text.trim().replace(/\s+/g, " ");
  return line.length > LONGEST_TEXT ? `${line.slice(0, LONGEST_TEXT)} …` : line;
}
