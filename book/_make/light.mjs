// One style sheet for all pages of a language, with the rules that its pages and scripts can use.
// stdin: {folder, sheets: [in their order], shown: [patterns of the pages and scripts that they serve]}
// stdout: the style sheet, small.
import { readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { transformSync } from "esbuild";
import { PurgeCSS } from "purgecss";

const { folder, sheets, shown } = JSON.parse(readFileSync(0, "utf8"));

/** A sheet with what it imports; its addresses count from the folder of the one that is made here. */
function whole(sheet) {
  const here = dirname(sheet);
  const css = readFileSync(join(folder, sheet), "utf8");
  const moved = css.replace(/url\(\s*(["']?)(?!data:|#|https?:)([^"')]+)\1\s*\)/g, (_, quote, address) => {
    const there = relative("_static", join(here, address)).replaceAll("\\", "/");
    return `url("${there}")`;
  });
  return moved.replace(/@import\s+["']([^"']+)["'];?/g, (_, name) => whole(join(here, name)));
}

/** A font is used where its family is named outside the rule that brings it. */
function withoutUnusedFonts(css) {
  const brings = /@font-face\s*{[^}]*}/g;
  const rules = css.replace(brings, "");
  return css.replace(brings, (rule) => {
    const [, family] = rule.match(/font-family:\s*["']?([^;"'}]+)/);
    return rules.includes(family) ? rule : "";
  });
}

const [purged] = await new PurgeCSS().purge({
  content: shown,
  css: [{ raw: sheets.map(whole).join("\n") }],
  keyframes: true,
  // what stands in a state of an element: names of attributes and their values are words of the scripts
  dynamicAttributes: ["data-theme", "data-mode", "aria-expanded", "aria-pressed", "open", "hidden"],
});
process.stdout.write(transformSync(withoutUnusedFonts(purged.css), { loader: "css", minify: true }).code);
