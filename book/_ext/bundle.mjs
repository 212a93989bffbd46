// Makes the scripts and the style sheet of the explorers for one language: reads {host, sources, data,
// language, papers} as JSON from stdin, writes {files: {name: text}, views: {paper: [name]}} to stdout.
// Started by explorers.py.
//
// host "cell": for a notebook one ES module with all papers in both languages, and where every view starts.
// host "exercises": what a page with exercises loads, a classic script and its style sheet.
// host "page":
// A browser refuses ES modules from file://, so every bundle is one classic script. The core (core.js) holds
// the rooms that all papers use; the bundle of a paper takes them from there, so that a page loads them once.
// What only some papers use (`rooms`) is one script a room, which stands between the core and the paper.
// The words of the other language are left out. What is wrong with the sources is told in one sentence on
// stderr.
import { readFileSync } from "node:fs";
import { readFile, readdir } from "node:fs/promises";
import path from "node:path";
import { build } from "esbuild";
import { Mistake, exportsOf, nameOf, treeOf, viewsOf, wordsOf } from "./modules.mjs";

const SHARED = ["numerics", "language"]; // rooms of the core that papers use

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

/** For esbuild: a paper takes the shared rooms from the core, and some from the scripts of their own. */
function fromOthers(sources, rooms) {
  const places = new Map(SHARED.map((room) => [path.join(sources, room), ""]));
  for (const room of rooms) {
    places.set(path.join(sources, room), `rooms.${room}.`);
  }
  return {
    name: "from-others",
    setup(steps) {
      steps.onResolve({ filter: /\.js$/ }, ({ path: name, resolveDir }) => {
        const file = path.resolve(resolveDir, name);
        return places.has(path.dirname(file)) ? { path: file, namespace: "others" } : undefined;
      });
      steps.onLoad({ filter: /.*/, namespace: "others" }, async ({ path: file }) => {
        const names = exportsOf(treeOf(await readFile(file, "utf8"), file));
        const place = places.get(path.dirname(file)) + path.basename(file, ".js");
        return { contents: `export const { ${names.join(", ")} } = KalmanExplorers.${place};` };
      });
    },
  };
}

/** The modules of a room that papers import. */
async function usedModules(sources, room, papers) {
  const found = new Set();
  const wanted = new RegExp(`"\\.\\./\\.\\./${room}/(\\w+)\\.js"`, "g");
  for (const paper of papers) {
    const folder = path.join(sources, "papers", paper);
    for (const name of await readdir(folder)) {
      const text = await readFile(path.join(folder, name), "utf8");
      [...text.matchAll(wanted)].forEach(([, module]) => found.add(module));
    }
  }
  return [...found].sort();
}

/** The module that makes a room known to the papers. */
function entryOfRoom(room, modules) {
  const imports = modules.map((name) => `import * as ${name} from "./${room}/${name}.js";`);
  return `${imports.join("\n")}\nKalmanExplorers.rooms.${room} = { ${modules.join(", ")} };\n`;
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

/**
 * For Python: starts, {paper: {view: {name: value}}}, where every control of a view starts; names,
 * {paper: {view: {id, en}}}, what a view is called.
 */
async function startsAndNamesOf(papers, options) {
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
    export const starts = all(papers, startsOf);
    export const names = all(papers, ({ paper }) => all(paper.views, (view) => view.name));`;
  const text = await bundle({ ...options, stdin: { ...options.stdin, contents } }, [oneLanguage(null)]);
  return import(`data:text/javascript;base64,${Buffer.from(text).toString("base64")}`);
}

/** What a notebook shows: one module with everything, and its style sheet. */
async function forCell({ sources, data, papers }) {
  const stdin = { resolveDir: sources, sourcefile: "widget.js" };
  const options = { stdin, alias: { data }, loader: { ".csv": "text" }, format: "esm" };
  const contents = `${collected(papers)}
    import { widget } from "./jupyter/widget.js";
    export default widget(papers);`;
  const entry = { ...options, stdin: { ...stdin, contents } };
  const { starts, names } = await startsAndNamesOf(papers, options);
  const files = {
    "widget.js": await bundle(entry, [oneLanguage(null)]),
    "widget.css": await bundle({ entryPoints: [path.join(sources, "jupyter", "cell.css")] }, []),
    "starts.json": JSON.stringify(starts),
    "names.json": JSON.stringify(names),
  };
  const views = {};
  for (const paper of Object.keys(papers)) {
    views[paper] = await viewsOf(sources, paper);
  }
  return { files, views };
}

/** What a page of the book loads. */
async function forPage({ sources, data, language, papers, rooms }) {
  const words = oneLanguage(language);
  const core = path.join(sources, "core");
  const files = {
    "core.js": await bundle({ entryPoints: [`${core}.js`], globalName: "KalmanExplorers" }, [words]),
    "core.css": await bundle({ entryPoints: [`${core}.css`] }, []),
  };
  for (const room of rooms) {
    const contents = entryOfRoom(room, await usedModules(sources, room, Object.keys(papers)));
    const stdin = { contents, resolveDir: sources, sourcefile: `${room}.js` };
    files[`${room}.js`] = await bundle({ stdin }, [fromOthers(sources, []), words]);
  }
  const views = {};
  for (const [paper, table] of Object.entries(papers)) {
    views[paper] = await viewsOf(sources, paper);
    const stdin = { contents: entryOf(paper, table), resolveDir: sources, sourcefile: `${paper}.js` };
    const options = { stdin, alias: { data }, loader: { ".csv": "text" } }; // for import "data/nile.csv"
    files[`${paper}.js`] = await bundle(options, [fromOthers(sources, rooms), words]);
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
