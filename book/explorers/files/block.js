// The table in a grid: the longest run of rows with numbers, its header, and what lies around. Twin of
// kalman_lib/data/block.py. A grid is a list of [line, cells]; a blank line has no cells.
import { InputError } from "../language/input.js";
import { words } from "./blanks.js";
import { hasLetter, isGap, isValue, quoted, shownCell } from "./cells.js";
import { headerOf, plainUnit } from "./header.js";

const SUMMARIES = new Set(
  [
    ["rata-rata", "rerata", "mean", "average", "avg", "total", "jumlah", "sum", "max", "min"],
    ["maksimum", "minimum", "median", "std", "sd", "simpangan baku"],
  ].flat(),
);

/**
 * {rows, names, units, passed, hasHeader} of a grid, null if there is no number; names and units are empty
 * texts where there are none, passed are the lines around. InputError: the numbers are interrupted.
 */
export function find(grid) {
  const run = longestRun(grid);
  if (run === null) {
    return null;
  }
  const [first, stop] = run;
  checkWhole(grid, first, stop);
  const width = grid[first][1].length;
  const [head, units, start] = headerOf(grid, first, stop);
  const cellsOf = (k) => (k === null ? Array(width).fill("") : fitted(grid[k][1], width));
  const passed = [];
  grid.forEach(([line, cells], k) => {
    const isUsed = k === head || k === units || (k >= start && k < stop);
    if (cells.length > 0 && !isUsed) {
      passed.push(line);
    }
  });
  return {
    rows: grid.slice(start, stop),
    names: cellsOf(head).map(plainName),
    units: cellsOf(units).map(plainUnit),
    passed,
    hasHeader: head !== null,
  };
}

function plainName(name) {
  const text = shownCell(name);
  let start = 0;
  while (text[start] === "#" || text[start] === " ") {
    start++;
  }
  return words(text.slice(start)).join(" ");
}

/** The cells of a header over so many columns; R leaves out the name of the first one. */
function fitted(cells, width) {
  if (cells.length === width - 1) {
    return ["", ...cells];
  }
  return Array.from({ length: width }, (_, i) => cells[i] ?? "");
}

// --- the run -----------------------------------------------------------------------------------------------

/** Is it a row of data: some number or time, and no sum or mean below a table? */
function holdsNumbers(cells) {
  if (typeof cells[0] === "string" && SUMMARIES.has(withoutColons(cells[0].toLowerCase()))) {
    return false;
  }
  return cells.some(isValue);
}

function withoutColons(text) {
  let end = text.length;
  while (text[end - 1] === ":") {
    end--;
  }
  return text.slice(0, end);
}

/** [start, stop] of the consecutive rows of equal width with most numbers; null: no number. */
export function longestRun(grid) {
  let best = null;
  let most = 0;
  let start = 0;
  let rows = 0;
  let places = []; // of the numbers in the first row
  let width = 0;
  grid.forEach(([, cells], k) => {
    if (cells.length === 0) {
      return;
    }
    const hasNumbers = holdsNumbers(cells);
    if (cells.length !== width || !(hasNumbers || places.every((at) => isGap(cells[at])))) {
      width = 0;
      rows = 0;
    }
    if (!hasNumbers) {
      return; // gaps belong to the run if numbers follow
    }
    if (rows === 0) {
      width = cells.length;
      start = k;
      places = [...cells.keys()].filter((at) => isValue(cells[at]));
    }
    rows++;
    if (rows * places.length > most) {
      best = [start, k + 1];
      most = rows * places.length;
    }
  });
  return best && withGaps(grid, best);
}

/** Rows of nothing but gaps directly above and below belong to the run, too. */
function withGaps(grid, [first, last]) {
  const width = grid[first][1].length;
  const isOfGaps = (k) => grid[k]?.[1].length === width && grid[k][1].every(isGap);
  let start = first;
  let stop = last;
  while (isOfGaps(start - 1)) {
    start--;
  }
  while (isOfGaps(stop)) {
    stop++;
  }
  return [start, stop];
}

/** InputError if more of the table stands outside the run: a word or an odd row parts it. */
function checkWhole(grid, start, stop) {
  const first = grid[start][1];
  const width = first.length;
  grid.forEach(([, cells], k) => {
    const isOutside = k < start || k >= stop;
    if (isOutside && cells.length === width && areAllNumbers(cells)) {
      throw interrupted(grid, Math.min(k, start), Math.max(k, stop - 1), width);
    }
  });
  let k = stop;
  while (k < grid.length && grid[k][1].length === width && !isLike(grid[k][1], first)) {
    k++;
  }
  if (k < grid.length && grid[k][1].length === width) {
    throw interrupted(grid, stop, k, width);
  }
  checkNeighbours(grid, start, stop);
}

/** Are there numbers where they are in the first row, and words where words are? */
function isLike(cells, first) {
  return holdsNumbers(cells) && cells.every((cell, i) => isValue(cell) === isValue(first[i]));
}

function areAllNumbers(cells) {
  return cells.every((cell) => isGap(cell) || isValue(cell)) && holdsNumbers(cells);
}

function interrupted(grid, first, last, width) {
  for (const [line, cells] of grid.slice(first, last)) {
    if (cells.length > 0 && cells.length !== width) {
      return oddRow(line, cells.length, width);
    }
    const at = cells.findIndex((cell) => !isGap(cell) && !isValue(cell));
    if (at >= 0) {
      return noNumber(line, String(at + 1), cells[at]);
    }
  }
  const [line, cells] = grid[last];
  return noNumber(line, "1", cells[0]);
}

export function noNumber(line, name, cell) {
  return new InputError({
    en: `Line ${line}, column ${quoted(name)}: ${quoted(cell)} is neither a number nor a gap.`,
    id: `Baris ${line}, kolom ${quoted(name)}: ${quoted(cell)} bukan bilangan dan bukan sel kosong.`,
  });
}

function oddRow(line, cells, width) {
  return new InputError({
    en: `Line ${line} has not as many cells (${cells}) as the first line (${width}).`,
    id: `Banyaknya sel di baris ${line} (${cells}) tidak sama dengan baris pertama (${width}).`,
  });
}

/** A row of numbers beside the run that is wider or narrower; a single word below a column. */
function checkNeighbours(grid, start, stop) {
  const width = grid[start][1].length;
  const below = grid[stop]?.[1] ?? [];
  checkWidths(grid, start, below.length > 0 && areAllNumbers(below) ? stop + 1 : stop);
  checkAbove(grid, start, width);
  if (width === 1 && below.length === 1 && (isCell(shownCell(below[0])) || areDigits(below))) {
    const [head] = headerOf(grid, start, stop);
    const name = head === null ? "1" : shownCell(grid[head][1][0]);
    throw noNumber(grid[stop][0], name, below[0]);
  }
}

/** A single word or a formula: no remark below a table. */
function isCell(text) {
  return words(text).length === 1 || text.startsWith("=");
}

/** Digits, and no letter: no title. */
function areDigits(cells) {
  return cells.some((cell) => /\p{Nd}/u.test(shownCell(cell))) && !cells.some(hasLetter);
}

function checkAbove(grid, start, width) {
  const above = grid[start - 1]?.[1] ?? [];
  if (above.length === width && areDigits(above)) {
    const cell = above.find((one) => !isGap(one));
    throw noNumber(grid[start - 1][0], "1", cell);
  }
}

function checkWidths(grid, start, reach) {
  let first = start;
  while (first > 0 && grid[first - 1][1].length > 0 && areAllNumbers(grid[first - 1][1])) {
    first--;
  }
  const width = grid[first][1].length;
  const odd = grid.slice(first, reach).find(([, cells]) => cells.length > 0 && cells.length !== width);
  if (odd) {
    throw oddRow(odd[0], odd[1].length, width);
  }
}
