// What of an explorer stays in sight while its sliders move, and how large it is. On a narrow page the first
// figures stick to the upper edge and take at most two fifths of the window; beside the sliders they may take
// as much of its area. Figures get lower first; one that would get too low follows below the sliders.
import { holdStill } from "./still.js";

const SHARE = 0.4; // of the window, for what stays in sight
const LEAST = 96; // pixels: a lower figure tells nothing
const LEAST_BARE = 0.5; // of the height of a figure without axes
const BESIDE = 16; // pixels below a figure that stands beside the sliders
const HIGHER = 1.3; // so much may it grow there

/** Fit the figures now and whenever the window, the text or the legends change; returns what ends that. */
export function watchSize(explorer) {
  let before = "";
  const fit = () => {
    const { section, outcome } = explorer;
    const now = sizes(explorer);
    const isNew = now.key !== before;
    if (isNew && now.width !== explorer.width) {
      outcome.style.minHeight = "";
      explorer.width = now.width;
    }
    if (isNew && now.width > 0) {
      before = now.key;
      holdStill(explorer, () => fitFigures(explorer, now));
      explorer.plots.forEach((plot) => plot.forgetSize());
      explorer.drawAgain();
    }
    if (section.offsetHeight > 0) {
      outcome.style.minHeight = `${outcome.offsetHeight}px`; // it only grows: nothing jumps back and forth
    }
  };
  fit();
  const observer = new ResizeObserver(fit);
  for (const element of [explorer.section, ...explorer.plots.map((plot) => plot.words)]) {
    observer.observe(element);
  }
  const left = new AbortController();
  addEventListener("resize", fit, { signal: left.signal });
  return () => {
    observer.disconnect();
    left.abort();
  };
}

/** What the fit depends on; key changes when any of it does. */
function sizes({ section, stage, plots }) {
  const style = getComputedStyle(stage);
  const width = section.clientWidth;
  const height = document.documentElement.clientHeight; // the bars of a phone come and go without changing it
  const beside = style.display === "grid";
  const legends = plots.map((plot) => (plot.element.hidden ? -1 : plot.words.offsetHeight));
  const given = style.getPropertyValue("--slide-figures"); // on a slide: book/slides/slides.js
  const around = [document.documentElement.clientWidth, height, given];
  const key = [width, ...around, beside, style.fontSize, ...legends].join(" ");
  return { width, height, beside, key };
}

function fitFigures(explorer, { height, beside }) {
  const { first, more } = explorer;
  const all = explorer.plots.filter((plot) => !plot.spec.after);
  const shown = all.filter((plot) => !plot.element.hidden);
  first.classList.add("stays");
  const room = roomFor(first, height, beside);
  for (let count = shown.length; count > 0; count--) {
    const kept = all.slice(0, all.indexOf(shown[count - 1]) + 1);
    place(first, kept);
    place(more, all.slice(kept.length));
    const factor = Math.min(factorFor(first, shown.slice(0, count), room), beside ? HIGHER : 1);
    first.style.setProperty("--explorer-height", factor || 1);
    if (factor > 0) {
      return;
    }
  }
  first.classList.remove("stays"); // not even one would be high enough
  place(first, all);
}

/** Pixels that the figures may be high. */
function roomFor(first, height, beside) {
  if (!beside) {
    return SHARE * height;
  }
  const top = parseFloat(getComputedStyle(first).top) || 0;
  const by_area = (SHARE * height * document.documentElement.clientWidth) / first.offsetWidth;
  return Math.min(by_area, height - top - BESIDE);
}

/** The share of their height with which the figures fit, or 0 if one of them would get too low. */
function factorFor(first, plots, room) {
  const heightWith = (factor) => {
    first.style.setProperty("--explorer-height", factor);
    return first.offsetHeight;
  };
  const half = heightWith(0.5);
  const whole = heightWith(1);
  const heights = plots.map((plot) => plot.canvas.offsetHeight);
  const factor = 1 - (whole - room) / (2 * (whole - half)); // the height is linear in it
  const isTooLow = ({ spec }, i) => {
    if (spec.fixed) {
      return false;
    }
    const least = spec.bare ? LEAST_BARE * heights[i] : Math.min(LEAST, heights[i]);
    return factor * heights[i] < least;
  };
  return plots.some(isTooLow) ? 0 : Math.floor(1000 * factor) / 1000;
}

/** Put the plots into a group, unless they are there already. */
function place(group, plots) {
  const elements = plots.map((plot) => plot.element);
  const isThere =
    elements.length === group.children.length && elements.every((e, i) => e === group.children[i]);
  if (!isThere) {
    group.replaceChildren(...elements);
  }
  group.classList.toggle(
    "halves",
    plots.some((plot) => plot.spec.half),
  );
  group.hidden = elements.length === 0;
}
