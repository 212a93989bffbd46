// The explorer inside a notebook, as an anywidget: the very element of the page, in a cell. What the reader
// moves is computed here; the kernel is told, and whatever a cell of Python sets moves the element.
import { make } from "../drawing/make.js";
import { Explorer } from "../element/explorer.js";
import { cellHost } from "./cell.js";
import { kernelOf } from "./kernel.js";
import { followTheme } from "./theme.js";

const LANGUAGES = [
  ["id", "Bahasa Indonesia"],
  ["en", "English"],
];

/** The module that anywidget wants. papers: {name: {paper, table}}, as the bundle collects them. */
export function widget(papers) {
  return { render: ({ model, el }) => show(papers, model, el) };
}

/** Show one explorer in el; returns a function that takes away whatever it has started. */
function show(papers, model, el) {
  const wrapper = make("div", { className: "explorer-cell" });
  keepKeys(wrapper);
  const element = make("kalman-explorer", { paper: model.get("paper"), view: model.get("view") });
  wrapper.append(languageButtons(model), element);
  el.append(wrapper);
  const forgetTheme = followTheme(wrapper);
  const kernel = kernelOf(model);

  /** Anew, in the language of the moment and with the settings of the moment. */
  const start = () => {
    const settings = element.explorer?.s;
    element.explorer?.destroy();
    wrapper.lang = model.get("language");
    const { paper, table } = papers[model.get("paper")];
    const host = cellHost(model, wrapper, kernel, settings);
    const key = `${model.get("paper")}.${model.get("view")}`;
    element.explorer = new Explorer(element, key, table, paper.views[model.get("view")], host);
  };
  model.on("change:language", start);
  start();
  return () => {
    model.off("change:language", start);
    element.explorer.destroy();
    element.explorer = null;
    kernel.leave();
    forgetTheme();
    wrapper.remove();
  };
}

/**
 * The arrows move a slider, not the notebook. Notebook 7 hears a key before the wrapper does, and asks the
 * element that has the focus.
 */
function keepKeys(wrapper) {
  wrapper.addEventListener("focusin", ({ target }) => {
    target.setAttribute("data-lm-suppress-shortcuts", "true");
  });
  wrapper.addEventListener("keydown", (event) => event.stopPropagation());
}

/** Two buttons, shown where the notebook has both languages or none. */
function languageButtons(model) {
  const row = make("div", { className: "explorer-languages", hidden: !model.get("choose") });
  for (const [code, textContent] of LANGUAGES) {
    const button = make("button", { type: "button", lang: code, textContent });
    button.addEventListener("click", () => {
      model.set("language", code);
      model.save_changes();
    });
    row.append(button);
  }
  return row;
}
