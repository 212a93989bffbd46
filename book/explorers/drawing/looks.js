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

let colours = null; // what the style sheet says for the theme of the page
let observer = null; // of the attribute data-theme
const restyled = new Set(); // who draws again when colours or fonts have changed

/** {estimate: "#1f6fb4", ..., grid, axis, words, font}: colours and font around the canvas at this moment. */
export function coloursFor(canvas) {
  colours ??= readColours(canvas);
  return colours;
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

function restyle() {
  colours = null;
  for (const again of restyled) {
    again();
  }
}

/** Call `again` when the colours of `themed` or the fonts have changed; returns a function that ends it. */
export function onThemeChange(themed, again) {
  restyled.add(again);
  if (!observer) {
    observer = new MutationObserver(restyle);
    observer.observe(themed, { attributeFilter: ["data-theme"] });
    document.fonts?.ready.then(restyle);
  }
  return () => {
    restyled.delete(again);
    if (restyled.size === 0) {
      observer.disconnect();
      observer = null;
    }
  };
}
