// Light or dark as the notebook around. Every host says it in its own way, but in all of them the text of a
// dark theme is light.
const SIGNS = ["class", "style", "theme", "data-theme", "data-jp-theme-name", "data-jp-theme-light"];
const LIGHT = 140; // of 255: a text that is lighter stands on a dark ground

/** Keep the attribute data-theme of the wrapper up to date; returns a function that ends it. */
export function followTheme(wrapper) {
  let seen;
  const look = () => {
    const { color, fontFamily } = getComputedStyle(wrapper);
    const now = `${color} ${fontFamily}`;
    if (color && now !== seen) {
      seen = now;
      wrapper.dataset.theme = brightness(color) > LIGHT ? "dark" : "light";
    }
  };
  const attributes = new MutationObserver(look);
  for (const root of [document.documentElement, document.body]) {
    attributes.observe(root, { attributeFilter: [...SIGNS, "data-vscode-theme-kind"] });
  }
  const sheets = new MutationObserver(look); // a theme may come as a style sheet of its own
  sheets.observe(document.head, { childList: true });
  const size = new ResizeObserver(look); // also when the wrapper comes into the page
  size.observe(wrapper);
  const late = (event) => event.target.tagName === "LINK" && look();
  document.addEventListener("load", late, true);
  look();
  return () => {
    attributes.disconnect();
    sheets.disconnect();
    size.disconnect();
    document.removeEventListener("load", late, true);
  };
}

/** From 0 to 255, of "rgb(1, 2, 3)" or "color(srgb 0.1 0.2 0.3)". */
function brightness(color) {
  const [red, green, blue] = color.match(/[\d.]+/g).map(Number);
  return (0.3 * red + 0.59 * green + 0.11 * blue) * (color.startsWith("color") ? 255 : 1);
}
