// The header above the numbers of a grid: which row names the columns, which one their units? Twin of the
// last part of kalman_lib/data/block.py.
import { strip } from "./blanks.js";
import { hasLetter, isGap, isValue, shownCell } from "./cells.js";
import { AGGREGATES, isUnit } from "./units.js";

const HEADER_LINES = 10; // above the numbers
const LOOKED_AT = 20; // rows that tell whether the first one is a header

export function plainUnit(cell) {
  return strip(strip(strip(shownCell(cell)), "()[]"));
}

/** [row of the names or null, row of the units or null, first row of the numbers]. */
export function headerOf(grid, start, stop) {
  const width = grid[start][1].length;
  if (namesTheNext(grid, start, stop)) {
    return [start, null, start + 1];
  }
  const above = [];
  for (let k = Math.max(0, start - HEADER_LINES); k < start; k++) {
    if (grid[k][1].length > 0) {
      above.push(k);
    }
  }
  while (above.length > 0 && areAggregates(grid[above.at(-1)][1])) {
    above.pop();
  }
  const [second, last] = [above.at(-2), above.at(-1)];
  if (last === undefined || !isHeader(grid[last][1], width)) {
    return [null, null, start];
  }
  const hasTwo = second !== undefined && isHeader(grid[second][1], width);
  return hasTwo && areUnits(grid[last][1]) ? [second, last, start] : [last, null, start];
}

/** Is the first row of the run one of names, some of which are numbers: t, 1, 2? */
function namesTheNext(grid, start, stop) {
  const rows = [];
  for (let k = start; k < stop && rows.length < LOOKED_AT; k++) {
    if (grid[k][1].length > 0) {
      rows.push(grid[k][1]);
    }
  }
  return rows.length > 1 && rows[0].some((cell, i) => namesColumn(cell, rows.slice(1), i));
}

function namesColumn(cell, rows, i) {
  const isNumber = (row) => isValue(row[i]);
  const isName = hasLetter(cell) && !isValue(cell);
  return isName && rows.some(isNumber) && rows.every((row) => isNumber(row) || isGap(row[i]));
}

/** Can this row name so many columns? */
function isHeader(cells, width) {
  if (!cells.some((cell) => hasLetter(cell) && !isGap(cell))) {
    return false;
  }
  const filled = cells.filter((cell) => cell !== "").length;
  if (width === 1) {
    return cells.length === 1;
  }
  if (cells.length === width - 1) {
    return width > 2 && filled === cells.length;
  }
  return cells.length >= width && (filled > 1 || cells[0] === "");
}

function areUnits(cells) {
  const isNone = (text) => text === "" || text === "-";
  const inBrackets = (cell) => /^[([][^()[\]]{0,20}[)\]]$/.test(shownCell(cell));
  const texts = cells.map(plainUnit);
  const areKnown = texts.every((text, i) => isNone(text) || isUnit(text) || inBrackets(cells[i]));
  return areKnown && !texts.every(isNone);
}

function areAggregates(cells) {
  const texts = cells.filter((cell) => cell !== "").map((cell) => shownCell(cell).toLowerCase());
  return texts.length > 0 && texts.every((text) => AGGREGATES.has(text));
}
