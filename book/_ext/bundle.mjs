// Makes the scripts and the style sheet of the explorers for one language: reads {host, sources, data,
// language, papers} as JSON from stdin, writes {files: {name: text}, views: {paper: [name]}} to stdout.
// Started by explorers.py.
//
// host "cell": for a notebook one ES module with all papers in both languages, and where every view starts.
// host "exercises": what a page with exercises loads, a classic script and its style sheet.
// host "page":
// A browser refuses ES modules from file://, so every bundle is one classic script. The core (core.js) holds
// the rooms that all papers use; the bundle of a paper takes them from there, so that a page loads them once.
// What only some readers need (`rooms`) is one script a room: a paper calls it through the core, which
// fetches it then (element/rooms.js).
// The words of the other language are left out. What is wrong with the sources is told in one sentence on
// stderr.
import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { readFile, readdir } from "node:fs/promises";
import path from "node:path";
import { build } from "esbuild";
import { Mistake, constantsOf, exportsOf, nameOf, treeOf, viewsOf, wordsOf } from "./modules.mjs";

const IN_THE_CORE = /"\.\/((?:numerics|language)\/\w+\.js)"/g; // modules that papers take from there

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

/** Functions of a room that is fetched when one of them is called, and its plain constants. */
function calledLater(text, file, room) {
  const tree = treeOf(text, file);
  const constants = constantsOf(tree, text);
  const calls = exportsOf(tree)
    .filter((name) => !constants.has(name))
    .map((name) => {
      const call = `KalmanExplorers.roomOf("${room}").${path.basename(file, ".js")}.${name}`;
      return `export const ${name} = (...given) => ${call}(...given);`;
    });
  return [...constants.values(), ...calls].join("\n");
}

/** For esbuild: a paper takes from the core what is there, and calls the rooms that are fetched later. */
function fromOthers(sources, rooms) {
  const places = new Map(Object.entries(rooms).map(([room, folder]) => [path.join(sources, folder), room]));
  const core = readFileSync(path.join(sources, "core.js"), "utf8");
  const shared = new Set([...core.matchAll(IN_THE_CORE)].map(([, name]) => path.join(sources, name)));
  return {
    name: "from-others",
    setup(steps) {
      steps.onResolve({ filter: /\.js$/ }, ({ path: name, resolveDir }) => {
        const file = path.resolve(resolveDir, name);
        const isOther = shared.has(file) || places.has(path.dirname(file));
        return isOther ? { path: file, namespace: "others" } : undefined;
      });
      steps.onLoad({ filter: /.*/, namespace: "others" }, async ({ path: file }) => {
        const text = await readFile(file, "utf8");
        const room = places.get(path.dirname(file));
        if (room) {
          return { contents: calledLater(text, file, room) };
        }
        const names = exportsOf(treeOf(text, file));
        const place = path.basename(file, ".js");
        return { contents: `export const { ${names.join(", ")} } = KalmanExplorers.${place};` };
      });
    },
  };
}

/** The modules of a room that papers import, or what their readers bring their own data with. */
async function usedModules(sources, folder_of_room, papers) {
  const found = new Set();
  const wanted = new RegExp(`"(?:\\.\\.?/)+${path.basename(folder_of_room)}/(\\w+)\\.js"`, "g");
  const folders = papers.map((paper) => path.join(sources, "papers", paper));
  for (const folder of [path.join(sources, "own"), ...folders]) {
    const names = await readdir(folder, { recursive: true });
    for (const name of names.filter((one) => one.endsWith(".js"))) {
      const text = await readFile(path.join(folder, name), "utf8");
      [...text.matchAll(wanted)].forEach(([, module]) => found.add(module));
    }
  }
  return [...found].sort();
}

/** The module that makes a room known to the papers. */
function entryOfRoom(room, folder, modules) {
  const imports = modules.map((name) => `import * as ${name} from "./${folder}/${name}.js";`);
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
      const controls = completeControls(view, table);
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

/** Another text has another address, so that no browser takes an older one for it. */
function fingerprint(text) {
  return createHash("sha256").update(text).digest("hex").slice(0, 8);
}

/** What a page of the book loads. */
async function forPage({ sources, data, language, papers, rooms }) {
  const words = oneLanguage(language);
  const core = path.join(sources, "core");
  const files = { "core.css": await bundle({ entryPoints: [`${core}.css`] }, []) };
  const addresses = {};
  for (const [room, folder] of Object.entries(rooms)) {
    const [, owner] = folder.split("/"); // of papers/<paper>/later
    const users = owner ? [owner] : Object.keys(papers);
    const contents = entryOfRoom(room, folder, await usedModules(sources, folder, users));
    const stdin = { contents, resolveDir: sources, sourcefile: `${room}.js` };
    const others = Object.entries(rooms).filter(([other]) => other !== room);
    const text = await bundle({ stdin }, [fromOthers(sources, Object.fromEntries(others)), words]);
    files[`${room}.js`] = text;
    addresses[room] = `${room}.js?v=${fingerprint(text)}`;
  }
  const footer = { js: `KalmanExplorers.knowRooms(${JSON.stringify(addresses)});` };
  const options = { entryPoints: [`${core}.js`], globalName: "KalmanExplorers", footer };
  files["core.js"] = await bundle(options, [words]);
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
