// Tables of numbers. While a table keeps its shape, only the cells that changed are written.
import { label, make } from "../drawing/make.js";

/** Put head and rows into a table; the first cell of a row names it, and "x_true" gets an index. */
export function fillTable(table, { head, rows }) {
  const shape = `${head.length} ${rows.length}`;
  if (table.dataset.shape !== shape) {
    table.dataset.shape = shape;
    table.replaceChildren(emptyHead(head), emptyBody(rows));
  }
  [head, ...rows].forEach((cells, i) => {
    cells.forEach((text, j) => fillCell(table.rows[i].cells[j], text, i === 0 || j === 0));
  });
}

function emptyHead(head) {
  const cells = head.map((text) => nameCell(text, "col"));
  return make("thead", {}, make("tr", {}, ...cells));
}

function emptyBody(rows) {
  const lines = rows.map((cells) => {
    const made = cells.map((text, j) => (j === 0 ? nameCell(text, "row") : make("td")));
    return make("tr", {}, ...made);
  });
  return make("tbody", {}, ...lines);
}

function nameCell(text, scope) {
  return text ? make("th", { scope }) : make("td");
}

function fillCell(cell, text, isName) {
  if (cell.dataset.text === text) {
    return;
  }
  cell.dataset.text = text;
  if (isName) {
    cell.replaceChildren(label(text));
  } else {
    cell.textContent = text;
  }
}
