// What a module of the explorers holds: its words in two languages, the names it exports, the views of a
// paper. For bundle.mjs, which makes scripts of them.
import { readFile } from "node:fs/promises";
import path from "node:path";
import { parse } from "acorn";

const OTHER = { id: "en", en: "id" };
// Where {id, en} are words
const WORDY = /[\\/](papers|language|files|grading|exercise)[\\/]|[\\/](element|sensors|own)[\\/]words\.js$/;

export class Mistake extends Error {}

/** How a file is called in a sentence: "papers/ship/words.js". */
export function nameOf(file) {
  return file.slice(file.lastIndexOf("explorers") + "explorers/".length).replaceAll("\\", "/");
}

export function treeOf(text, file) {
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
export function wordsOf(language, text, file) {
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
export function exportsOf(tree) {
  const found = tree.body.filter(({ type, declaration }) => type === "ExportNamedDeclaration" && declaration);
  return found.flatMap(({ declaration: { id, declarations } }) => {
    return id ? [id.name] : declarations.map((declared) => declared.id.name);
  });
}

/** {name: its declaration} of the constants that are exported and need nothing else: they can be copied. */
export function constantsOf(tree, text) {
  const found = new Map();
  for (const { type, declaration } of tree.body) {
    const declared = type === "ExportNamedDeclaration" && declaration?.declarations?.[0];
    if (declared && isPlain(declared.init)) {
      found.set(declared.id.name, `export const ${text.slice(declared.start, declared.end)};`);
    }
  }
  return found;
}

const PLAIN = ["Literal", "ObjectExpression", "ArrayExpression", "Property", "BinaryExpression"];

/** Made of literals alone? The names of an object's properties are none of its values. */
function isPlain(node) {
  if (node.type === "Property") {
    return !node.computed && isPlain(node.value);
  }
  const parts = Object.values(node).flat();
  const children = parts.filter((child) => typeof child?.type === "string");
  return PLAIN.includes(node.type) && children.every(isPlain);
}

/** The names of the views of a paper: the keys of `export const views = {...}` in its index.js. */
export async function viewsOf(sources, paper) {
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
