// A reader's table in: pasted text, .csv, .txt, .tsv, or the grids of a workbook (workbook.js). Twin of
// kalman_lib/data/table.py: the same rules, the same sentences.
import { InputError } from "../language/input.js";
import { find } from "./block.js";
import { cut, isNumber, quoted, shownCell } from "./cells.js";
import { columnsOf } from "./columns.js";
import { split } from "./grid.js";
import { MAX_BYTES, MAX_READ, tooLarge, tooLong } from "./limits.js";
import { gridOfList } from "./lists.js";
import { codesIn, withoutCodes } from "./missing.js";
import { about, oneSentence } from "./notes.js";
import { epochUnit, rolesOf } from "./roles.js";
import { textOf } from "./sources.js";

const LINES_OF_CODES = 100; // around a table are asked what -999 means
const MAX_LISTED = 5;

/**
 * What a reader brought, {text} or {file: {name, bytes, grids}}, -> a table:
 *
 * columns   Map of name -> Float64Array (NaN = gap), in the units of the source; dates and clock times in
 *           seconds since the first
 * units     {name: unit}, of those that name one
 * notes     [{en, id}, ...]: what was understood, assumed and passed over; note: as one sentence
 * time      the name of the column of times, null if there is none
 * value     the name of the column that is taken as measured
 * heads     Map of name -> text of the header
 * lines     the line or row of each in the source
 * skipped   names of columns without a number
 * decimal   "," or "."; null: no number had one
 * codes     Map of number -> how often: what was taken as a gap, and what may be one
 * sheet     the title of the sheet, null for a text; sheets: the titles of all with numbers
 *
 * sheet: a title (null: the one with the longest table); decimal: "," or "." (null: find out); missing: a
 * list of numbers that stand for a gap (null: find out, []: there are none). InputError: what cannot be
 * understood, or only in two ways.
 */
export function readTable({ text, file }, { sheet = null, decimal = null, missing = null } = {}) {
  const chosen = missing === null ? null : [missing].flat();
  if (file?.grids) {
    const grids = file.grids.filter(([, grid]) => grid.some(([, cells]) => cells.some(isNumber)));
    const [title, grid] = chosenSheet(grids, sheet);
    const remarks = grids.length > 1 ? [aboutSheet(title, grids.length)] : [];
    const table = tableOf(grid, decimal, chosen, remarks);
    return { ...table, sheet: title, sheets: grids.map(([name]) => name) };
  }
  const [grid, remarks] = gridOfText(file ? textOf(file) : text, decimal);
  return { ...tableOf(grid, decimal, chosen, remarks), sheet: null, sheets: [] };
}

function gridOfText(whole, decimal) {
  if (whole.length > MAX_BYTES) {
    throw tooLarge(whole.length);
  }
  const text = whole.startsWith("\ufeff") ? whole.slice(1) : whole;
  const list = gridOfList(text);
  if (list !== null) {
    return [list, []];
  }
  const [grid, remark] = split(text, decimal);
  return [grid, remark ? [remark] : []];
}

/** [title, grid] of the sheet that the reader chose, or of the one with the longest table. */
function chosenSheet(grids, sheet) {
  if (grids.length === 0) {
    return [null, []];
  }
  if (sheet === null) {
    const size = ([, grid]) => grid.filter(([, cells]) => cells.length > 0).length;
    return grids.reduce((best, other) => (size(other) > size(best) ? other : best));
  }
  const found = grids.find(([title], i) => title === sheet || i === sheet);
  if (found) {
    return found;
  }
  const listed = grids.slice(0, MAX_LISTED).map(([title]) => cut(title, 40));
  throw new InputError({
    en: `There is no sheet ${quoted(sheet)} with numbers; there are: ${listed.join(", ")}.`,
    id: `Tidak ada lembar ${quoted(sheet)} yang berisi bilangan; yang ada: ${listed.join(", ")}.`,
  });
}

function aboutSheet(title, count) {
  return { en: `sheet: ${cut(title, 40)} (of ${count})`, id: `lembar: ${cut(title, 40)} (dari ${count})` };
}

// --- grid -> table -----------------------------------------------------------------------------------------

/** The table of a grid. chosen: what stands for a gap, null: find out; remarks: how the grid was found. */
export function tableOf(grid, decimal, chosen, remarks) {
  const block = find(grid);
  if (block === null) {
    throw noNumbers();
  }
  if (block.rows.length > MAX_READ) {
    throw tooLong(block.rows.length);
  }
  const found = columnsOf(block, decimal);
  const heads = new Map(found.columns.map(({ name, head }) => [name, head]));
  const named = found.columns.filter(({ unit }) => unit);
  const units = Object.fromEntries(named.map(({ name, unit }) => [name, unit]));
  const all = new Map(found.columns.map(({ name, values }) => [name, values]));
  const moments = new Set(found.columns.filter((one) => one.moments).map(({ name }) => name));
  if (moments.size === all.size) {
    throw noNumbers();
  }
  const { time, value } = rolesOf(all, units, heads, moments);
  const explained = codesIn(textsAround(grid, block.passed));
  const { columns, codes, notes: told } = withoutCodes(all, { units, heads, time }, chosen, explained);
  told.push(...sinceWhen(all.get(time), time, units));
  const table = { columns, units, time, value, heads, skipped: found.skipped, decimal: found.sign, codes };
  const notes = [...about(table, block.passed), ...remarks, ...found.notes, ...told];
  return { ...table, notes, note: oneSentence(notes), lines: linesOf(block, all) };
}

/** The lines around the table that may tell what a number stands for. */
function textsAround(grid, passed) {
  const near = new Set([...passed.slice(0, LINES_OF_CODES), ...passed.slice(-LINES_OF_CODES)]);
  const rows = near.size > 0 ? grid.filter(([line]) => near.has(line)) : [];
  return rows.map(([, cells]) => cells.map(shownCell).join(" "));
}

/** Times since 1970 get their unit, and a note. */
function sinceWhen(values, time, units) {
  const unit = time !== null && !Object.hasOwn(units, time) ? epochUnit(values) : "";
  if (!unit) {
    return [];
  }
  units[time] = unit;
  return [{ en: `${time}: ${unit} since 1970`, id: `${time}: ${unit} sejak 1970` }];
}

function linesOf({ rows }, columns) {
  const [{ length }] = columns.values();
  const lines = rows.map(([line]) => line);
  return lines.length === length ? lines : Array.from({ length }, (_, k) => k + 1);
}

export function noNumbers() {
  return new InputError({
    en: "There is no column of numbers in it.",
    id: "Tidak ada kolom bilangan di dalamnya.",
  });
}
