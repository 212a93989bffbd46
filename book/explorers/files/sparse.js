// The cells of a sheet, few among many empty ones -> its grid.
import { InputError } from "../language/input.js";
import { cut, quoted } from "./cells.js";
import { MAX_CELLS, MAX_READ, tooLong, tooManyCells } from "./limits.js";

export const MORE_ROWS = 1000; // of text around a table

export function uncalculated(place, title) {
  const shown = quoted(cut(title, 40));
  return new InputError({
    en:
      `Cell ${place} of sheet ${shown} holds a formula that was never calculated; open and save the file ` +
      "once in Excel or LibreOffice.",
    id:
      `Sel ${place} di lembar ${shown} berisi rumus yang belum pernah dihitung; buka dan simpan berkas itu ` +
      "sekali di Excel atau LibreOffice.",
  });
}

/** Sparse rows -> a grid without the columns in which nothing stands. */
export function filled(found) {
  const rows = found.filter(([, cells]) => cells.size > 0);
  if (rows.length === 0) {
    return [];
  }
  const [first, last] = [rows[0][0], rows.at(-1)[0]];
  if (last - first > MAX_READ + MORE_ROWS) {
    throw tooLong(last - first + 1);
  }
  const used = [...new Set(rows.flatMap(([, cells]) => [...cells.keys()]))].sort((a, b) => a - b);
  if (used.length * rows.length > 2 * MAX_CELLS) {
    throw tooManyCells(used.length * rows.length);
  }
  const grid = [];
  let line = first;
  for (const [number, cells] of rows) {
    for (; line < number; line++) {
      grid.push([line, []]);
    }
    grid.push([number, used.map((column) => cells.get(column) ?? "")]);
    line = number + 1;
  }
  return grid;
}
