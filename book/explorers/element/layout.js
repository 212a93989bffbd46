// The parts of an explorer in the page, in the order in which they are read, and what happens when the window
// changes.
import { onThemeChange } from "../drawing/looks.js";
import { make } from "../drawing/make.js";
import { watchSize } from "./fit.js";
import { makeButton } from "./messages.js";
import { watchTouch } from "./still.js";
import { WORDS } from "./words.js";

/** Put the parts of the explorer into its element; explorer.plots, .parts and .check are there already. */
export function arrange(explorer) {
  const { view, t, plots } = explorer;
  explorer.first = figures(
    "first",
    plots.filter((plot) => !plot.spec.after),
  );
  explorer.more = figures("more", []); // the first ones that find no room above the sliders
  const after = figures(
    "",
    plots.filter((plot) => plot.spec.after),
  );
  explorer.outcome = make("p", { className: "explorer-outcome" });
  explorer.live = make("p", { className: "explorer-live", role: "status", "aria-live": "polite" });
  explorer.message = make("p", {
    className: "explorer-message",
    id: `${explorer.id}-message`,
    role: "alert",
    hidden: true,
  });
  explorer.equations = scrolling("explorer-equations", t.say(WORDS.equations));
  explorer.equations.hidden = !view.equations;
  explorer.facts = make("table", { className: "explorer-facts", hidden: !view.facts });
  const numbers = numbersBelow(explorer);
  const said = [explorer.outcome, explorer.live, explorer.message];
  explorer.side = make("div", { className: "explorer-side" }, ...said, controls(explorer), buttons(explorer));
  explorer.stage = make("div", { className: "explorer-stage" }, explorer.first, explorer.side);
  const check = explorer.check ? [explorer.check.element] : [];
  const about = { className: "explorer", id: explorer.id, role: "region", "aria-label": t.say(view.name) };
  const parts = [explorer.stage, explorer.more, explorer.equations, explorer.facts, after, ...check, numbers];
  explorer.section = make("div", about, ...parts);
  enter(explorer);
  watchTouch(explorer);
  explorer.stopFitting = watchSize(explorer);
  watchSight(explorer);
  explorer.forgetTheme = onThemeChange(explorer.host.themed, () => explorer.drawAgain());
}

function figures(name, plots) {
  const halves = plots.some((plot) => plot.spec.half) ? "halves" : "";
  const elements = plots.map((plot) => plot.element);
  return make("div", { className: `explorer-figures ${name} ${halves}` }, ...elements);
}

/** A part that scrolls by itself if it is too wide, also with the keyboard. */
function scrolling(className, name) {
  return make("div", { className, tabIndex: 0, role: "region", "aria-label": name });
}

function controls({ parts, t }) {
  const isCheck = (i) => parts[i]?.control.kind === "check";
  parts.forEach((part, i) => {
    const beside = isCheck(i) && (isCheck(i - 1) || isCheck(i + 1));
    part.element.classList.toggle("beside", beside);
  });
  const elements = parts.map((part) => part.element);
  const name = t.say(WORDS.controls);
  return make("div", { className: "explorer-controls", role: "group", "aria-label": name }, ...elements);
}

function buttons(explorer) {
  const { view, t } = explorer;
  const row = make("div", { className: "explorer-buttons" });
  if (view.noise) {
    row.append(
      makeButton(explorer, t.say(WORDS.noise), () => explorer.change({ seed: explorer.s.seed + 1 })),
    );
  }
  row.append(makeButton(explorer, t.say(WORDS.reset), () => explorer.reset()));
  if (explorer.host.link) {
    row.append(makeButton(explorer, t.say(WORDS.link), () => explorer.host.link(explorer)));
  }
  return row;
}

/** "Show the numbers": filled when it is opened. */
function numbersBelow(explorer) {
  const { t, view } = explorer;
  const name = t.say(WORDS.numbers);
  explorer.table = scrolling("explorer-table", `${name}: ${t.say(view.name)}`);
  const summary = make("summary", { textContent: name });
  explorer.details = make("details", { className: "explorer-numbers" }, summary, explorer.table);
  explorer.details.addEventListener("toggle", () => explorer.fillNumbers());
  return explorer.details;
}

/** Into the page, in the place of the picture. */
function enter({ element, section }) {
  element.append(section);
  element.classList.add("live");
}

/** Only the plots in sight are drawn. */
function watchSight(explorer) {
  explorer.sights = new IntersectionObserver((entries) => {
    for (const entry of entries) {
      const plot = explorer.plots.find(({ element }) => element === entry.target);
      plot.seen = entry.isIntersecting;
    }
    if (explorer.r) {
      explorer.draw();
      explorer.words();
    }
  });
  for (const plot of explorer.plots) {
    explorer.sights.observe(plot.element);
  }
}
