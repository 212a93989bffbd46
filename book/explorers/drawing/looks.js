// How a truth, a measurement, an estimate look, everywhere in the book: the marks stand here, the colours in
// colours.css, and both are those of kalman_lib's plots.

export const LOOKS = {
  truth: { width: 1.2 },
  measurement: { dots: 2.4 },
  estimate: { width: 2.2 },
  prediction: { width: 1.8, dash: [6, 3] },
  rival: { width: 1.8, dash: [7, 2.5, 2, 2.5] },
  smooth: { width: 1.8, dash: [12, 4] },
  band: { band: true },
  quiet: { width: 1, dash: [2, 3] },
};

// The page's font lies beside this script; a thread of a file:// page may not load it
const HERE = document.currentScript?.src || "";
const FONT_FILE = "../fonts/plus-jakarta-sans-latin-wght-normal.woff2";

/** [family, address, more] of the page's font for the painter, or null. */
export const FONT = HERE.startsWith("http")
  ? ["Plus Jakarta Sans", `url("${new URL(FONT_FILE, HERE)}")`, { weight: "200 800" }]
  : null;

const colours = new WeakMap(); // {themed element: its colours}, until its theme changes

/** {estimate: "#1f6fb4", ..., grid, axis, words, font}: colours and font around the canvas at this moment. */
export function coloursFor(canvas) {
  const themed = canvas.closest("[data-theme]") ?? document.documentElement;
  if (!colours.has(themed)) {
    colours.set(themed, readColours(canvas));
  }
  return colours.get(themed);
}

function readColours(canvas) {
  const style = getComputedStyle(canvas);
  const names = [...Object.keys(LOOKS), "grid", "axis", "words"];
  const found = {};
  for (const name of names) {
    found[name] = style.getPropertyValue(`--explorer-${name}`).trim();
  }
  found.font = style.getPropertyValue("--sans").trim() || "sans-serif";
  return found;
}

/** Call `again` when the colours of `themed` or the fonts have changed; returns a function that ends it. */
export function onThemeChange(themed, again) {
  let is_followed = true;
  const restyle = () => {
    if (is_followed) {
      colours.delete(themed);
      again();
    }
  };
  const observer = new MutationObserver(restyle);
  observer.observe(themed, { attributeFilter: ["data-theme"] });
  document.fonts?.ready.then(restyle);
  return () => {
    is_followed = false;
    observer.disconnect();
  };
}
