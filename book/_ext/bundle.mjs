// Makes the scripts and the style sheet of the explorers for one language: reads {host, sources, data,
// language, papers} as JSON from stdin, writes {files: {name: text}, views: {paper: [name]}} to stdout.
// Started by explorers.py.
//
// host "cell": for a notebook one ES module with all papers in both languages, and where every view starts.
// host "exercises": what a page with exercises loads, a classic script and its style sheet.
// host "page":
// A browser refuses ES modules from file://, so every bundle is one classic script. The core (core.js) holds
// the rooms that all papers use; the bundle of a paper takes them from there, so that a page loads them once.
// The words of the other language are left out. What is wrong with the sources is told in one sentence on
// stderr.
import { readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { parse } from "acorn";
import { build } from "esbuild";

const SHARED = ["numerics", "language"]; // rooms of the core that papers use
const OTHER = { id: "en", en: "id" };
// Where {id, en} are words
const WORDY = /[\\/](papers|language|files|grading|exercise)[\\/]|[\\/](element|sensors)[\\/]words\.js$/;

class Mistake extends Error {}

/** How a file is called in a sentence: "papers/ship/words.js". */
function nameOf(file) {
  return file.slice(file.lastIndexOf("explorers") + "explorers/".length).replaceAll("\\", "/");
}

// --- reading a module --------------------------------------------------------------------------------------

function treeOf(text, file) {
  try {
    return parse(text, { ecmaVersion: 2023, sourceType: "module", locations: true });
  } catch (error) {
    throw new Mistake(`${nameOf(file)} is no JavaScript: ${error.message}.`, { cause: error });
  }
}

/** Every node of a syntax tree. */
function* nodesOf(node) {
  yield node;
  for (const value of Object.values(node)) {
    for (const child of [value].flat()) {
      if (typeof child?.type === "string") {
        yield* nodesOf(child);
      }
    }
  }
}

function propertyOf(object, name) {
  return object.properties.find(({ key }) => key?.name === name);
}

/** Objects that hold words: {id, en}. A word in one language only is a mistake. */
function pairsOf(tree, file) {
  const pairs = [];
  for (const node of nodesOf(tree)) {
    if (node.type !== "ObjectExpression") {
      continue;
    }
    const pair = { object: node, id: propertyOf(node, "id"), en: propertyOf(node, "en") };
    if (WORDY.test(file)) {
      checkPair(pair, file);
    }
    if (pair.id && pair.en) {
      pairs.push(pair);
    }
  }
  return pairs;
}

function checkPair({ object, id, en }, file) {
  for (const [there, missing, language] of [
    [id, en, "en"],
    [en, id, "id"],
  ]) {
    if (there && !isEmpty(there) && (!missing || isEmpty(missing))) {
      throw new Mistake(
        `${nameOf(file)}, line ${object.loc.start.line}: words are missing in "${language}".`,
      );
    }
  }
}

function isEmpty({ value }) {
  return value.type === "Literal" && value.value === "";
}

/** The text of a module with the words of one language; null: with both. */
function wordsOf(language, text, file) {
  const cuts = pairsOf(treeOf(text, file), file).map((pair) =>
    rangeOf(pair[OTHER[language]] ?? null, pair.object),
  );
  const kept = [];
  let at = 0;
  for (const [start, end] of cuts.filter(Boolean).sort((a, b) => a[0] - b[0])) {
    if (start >= at) {
      kept.push(text.slice(at, start));
      at = end;
    }
  }
  return kept.join("") + text.slice(at);
}

/** Where a property stands, with the comma before or after it. */
function rangeOf(property, { properties }) {
  if (property === null) {
    return null;
  }
  const i = properties.indexOf(property);
  if (i + 1 < properties.length) {
    return [property.start, properties[i + 1].start];
  }
  return [properties[i - 1].end, property.end];
}

/** The names that a module exports by declaration. */
function exportsOf(tree) {
  const found = tree.body.filter(({ type, declaration }) => type === "ExportNamedDeclaration" && declaration);
  return found.flatMap(({ declaration: { id, declarations } }) => {
    return id ? [id.name] : declarations.map((declared) => declared.id.name);
  });
}

/** The names of the views of a paper: the keys of `export const views = {...}` in its index.js. */
async function viewsOf(sources, paper) {
  const file = path.join(sources, "papers", paper, "index.js");
  const tree = treeOf(await readFile(file, "utf8"), file);
  for (const { declaration } of tree.body) {
    const declared = declaration?.declarations?.find(({ id }) => id.name === "views");
    if (declared) {
      return declared.init.properties.map(({ key }) => key.name);
    }
  }
  throw new Mistake(`book/explorers/papers/${paper}/index.js exports no views.`);
}

// --- bundling ----------------------------------------------------------------------------------------------

/** For esbuild: leave out the words of the other language. */
function oneLanguage(language) {
  return {
    name: "one-language",
    setup(steps) {
      steps.onLoad({ filter: /\.js$/, namespace: "file" }, async ({ path: file }) => {
        return { contents: wordsOf(language, await readFile(file, "utf8"), file), loader: "js" };
      });
    },
  };
}

/** For esbuild: a paper takes the shared rooms from the core. */
function fromTheCore(sources) {
  const shared = SHARED.map((room) => path.join(sources, room));
  return {
    name: "from-the-core",
    setup(steps) {
      steps.onResolve({ filter: /\.js$/ }, ({ path: name, resolveDir }) => {
        const file = path.resolve(resolveDir, name);
        return shared.includes(path.dirname(file)) ? { path: file, namespace: "core" } : undefined;
      });
      steps.onLoad({ filter: /.*/, namespace: "core" }, async ({ path: file }) => {
        const names = exportsOf(treeOf(await readFile(file, "utf8"), file));
        const room = path.basename(file, ".js");
        return { contents: `export const { ${names.join(", ")} } = KalmanExplorers.${room};` };
      });
    },
  };
}

async function bundle(options, plugins) {
  const result = await build({
    bundle: true,
    write: false,
    minify: true,
    charset: "utf8",
    target: "es2022",
    format: "iife",
    logLevel: "silent",
    plugins,
    ...options,
  });
  const [warning] = result.warnings;
  if (warning) {
    throw new Mistake(`${warning.location?.file}: ${warning.text}`);
  }
  return result.outputFiles[0].text;
}

/** The module that tells the core of a paper; its table comes from Python. */
function entryOf(paper, table) {
  const arguments_ = `${JSON.stringify(paper)}, paper, ${JSON.stringify(table)}`;
  return `import * as paper from "./papers/${paper}/index.js";\nKalmanExplorers.register(${arguments_});\n`;
}

/** Imports of all papers and {name: {paper, table}}. */
function collected(papers) {
  const names = Object.keys(papers);
  const imports = names.map((name) => `import * as ${name} from "./papers/${name}/index.js";`);
  const parts = names.map((name) => `${name}: { paper: ${name}, table: ${JSON.stringify(papers[name])} }`);
  return `${imports.join("\n")}\nconst papers = { ${parts.join(", ")} };\n`;
}

/** {paper: {view: {name: value}}}: where every control of a view starts, for Python. */
async function startsOf(papers, options) {
  const contents = `${collected(papers)}
    import { completeControls, defaultsOf, isData } from "./element/settings.js";
    const startOf = (view, table) => {
      const controls = completeControls(view, table, true);
      const files = controls.filter(isData).map(({ name }) => name);
      const starts = Object.entries(defaultsOf(view, controls, table));
      return Object.fromEntries(starts.filter(([name]) => !files.includes(name)));
    };
    const all = (values, make) =>
      Object.fromEntries(Object.entries(values).map(([name, value]) => [name, make(value)]));
    const startsOf = ({ paper, table }) => all(paper.views, (view) => startOf(view, table));
    export const starts = all(papers, startsOf);`;
  const text = await bundle({ ...options, stdin: { ...options.stdin, contents } }, [oneLanguage(null)]);
  const { starts } = await import(`data:text/javascript;base64,${Buffer.from(text).toString("base64")}`);
  return starts;
}

/** What a notebook shows: one module with everything, and its style sheet. */
async function forCell({ sources, data, papers }) {
  const stdin = { resolveDir: sources, sourcefile: "widget.js" };
  const options = { stdin, alias: { data }, loader: { ".csv": "text" }, format: "esm" };
  const contents = `${collected(papers)}
    import { widget } from "./jupyter/widget.js";
    export default widget(papers);`;
  const entry = { ...options, stdin: { ...stdin, contents } };
  const files = {
    "widget.js": await bundle(entry, [oneLanguage(null)]),
    "widget.css": await bundle({ entryPoints: [path.join(sources, "jupyter", "cell.css")] }, []),
    "starts.json": JSON.stringify(await startsOf(papers, options)),
  };
  const views = {};
  for (const paper of Object.keys(papers)) {
    views[paper] = await viewsOf(sources, paper);
  }
  return { files, views };
}

/** What a page of the book loads. */
async function forPage({ sources, data, language, papers }) {
  const words = oneLanguage(language);
  const core = path.join(sources, "core");
  const files = {
    "core.js": await bundle({ entryPoints: [`${core}.js`], globalName: "KalmanExplorers" }, [words]),
    "core.css": await bundle({ entryPoints: [`${core}.css`] }, []),
  };
  const views = {};
  for (const [paper, table] of Object.entries(papers)) {
    views[paper] = await viewsOf(sources, paper);
    const stdin = { contents: entryOf(paper, table), resolveDir: sources, sourcefile: `${paper}.js` };
    const options = { stdin, alias: { data }, loader: { ".csv": "text" } }; // for import "data/nile.csv"
    files[`${paper}.js`] = await bundle(options, [fromTheCore(sources), words]);
  }
  return { files, views };
}

/** What a page with exercises loads. */
async function forExercises({ sources, language }) {
  const room = path.join(sources, "exercise");
  const script = { entryPoints: [path.join(room, "index.js")], globalName: "KalmanExercises" };
  return {
    files: {
      "exercises.js": await bundle(script, [oneLanguage(language)]),
      "exercises.css": await bundle({ entryPoints: [path.join(room, "exercise.css")] }, []),
    },
    views: {},
  };
}

const HOSTS = { cell: forCell, exercises: forExercises, page: forPage };

async function main() {
  const question = JSON.parse(readFileSync(0, "utf8"));
  const make = HOSTS[question.host];
  process.stdout.write(JSON.stringify(await make(question)));
}

/** The sentence that stands behind esbuild's own message: one of ours, or a place and what is wrong there. */
function sentenceOf(error) {
  const [first] = error.errors ?? [];
  const cause = first?.detail ?? error;
  if (cause instanceof Mistake || !first) {
    return cause.message;
  }
  const { file = "explorers/core.js", line = 1 } = first.location ?? {};
  return `${nameOf(file)}, line ${line}: ${first.text}.`;
}

try {
  await main();
} catch (error) {
  process.stderr.write(`${sentenceOf(error)}\n`);
  process.exitCode = 1;
}
