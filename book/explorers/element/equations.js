// Equations with their numbers: lines of words and matrices. While their shape stays, only the numbers are
// renewed, so that the page is not laid out anew for every move of a slider.
import { make, setText } from "../drawing/make.js";

const WORD = /^([^_^]+)(?:_([^^]+))?(?:\^(.+))?$/; // base_low^high
const LETTERS = /^\p{L}+$/u; // in italics

/**
 * lines: [line]; a line is a list of words "x_pred = F x" and {matrix: [[...], ...]}. A screen reader hears
 * the line.
 */
export function fillEquations(box, lines) {
  const plans = lines.map(planOf);
  const shape = plans.map(shapeOf).join("/");
  if (box.dataset.shape === shape) {
    const words = plans.flat().flatMap((part) => part.cells ?? [part]);
    box.leaves.forEach((leaf, i) => setText(leaf, words[i].base));
  } else {
    box.dataset.shape = shape;
    box.leaves = [];
    box.replaceChildren(...plans.map((plan, i) => lineElement(plan, isContinued(lines[i]), box.leaves)));
  }
  lines.forEach((line, i) => box.children[i].setAttribute("aria-label", spoken(line)));
}

/** A line as a list of words and matrices: {base, low, high} and {columns, cells: words}. */
function planOf(line) {
  return line.flatMap((part) => {
    if (part.matrix) {
      return [{ columns: part.matrix[0].length, cells: part.matrix.flat().map(wordOf) }];
    }
    return part.split(" ").filter(Boolean).map(wordOf);
  });
}

function wordOf(text) {
  const [, base, low, high] = WORD.exec(text) || [text, text];
  return { base, low, high, isLetter: LETTERS.test(base) };
}

/** What must be the same for the elements to stay: everything but the words themselves. */
function shapeOf(plan) {
  return plan
    .map((part) => (part.cells ? `[${part.columns}: ${shapeOf(part.cells)}]` : shapeOfWord(part)))
    .join(" ");
}

function shapeOfWord({ low = "", high = "", isLetter }) {
  return `${isLetter ? "i" : "span"}_${low}^${high}`;
}

/** A line that begins with "=" goes on from the one above. */
function isContinued([first]) {
  return typeof first === "string" && first.startsWith("=");
}

function lineElement(plan, continued, leaves) {
  const parts = plan.map((part) => (part.cells ? matrixElement(part, leaves) : wordElement(part, leaves)));
  return make("div", { className: `explorer-line ${continued ? "more" : ""}`, role: "img" }, ...parts);
}

function matrixElement({ columns, cells }, leaves) {
  const words = cells.map((cell) => wordElement(cell, leaves));
  const matrix = make("span", { className: "explorer-matrix" }, ...words);
  matrix.style.gridTemplateColumns = `repeat(${columns}, auto)`;
  return matrix;
}

function wordElement({ base, low, high, isLetter }, leaves) {
  const leaf = make(isLetter ? "i" : "span", { textContent: base });
  leaves.push(leaf);
  const element = make("span", {}, leaf);
  if (low) {
    element.append(make("sub", { textContent: low }));
  }
  if (high) {
    element.append(make("sup", { textContent: high }));
  }
  return element;
}

function spoken(line) {
  const words = line.map((part) => {
    const rows = part.matrix?.map((row) => row.join(" "));
    return rows ? `[${rows.join("; ")}]` : part;
  });
  return words.join(" ");
}
