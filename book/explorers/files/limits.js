// How much is read, and the sentences for what is more: twin of kalman_lib/data/limits.py.
import { InputError } from "../language/input.js";

export const MAX_READ = 200000; // rows of a table
export const MAX_BYTES = 16000000; // of a text
export const MAX_CELLS = 1000000; // of a table
export const MAX_COLUMNS = 1000;
export const MAX_NUMBER = 1e300;
const MEGABYTE = 1e6;

export function tooLong(rows, limit = MAX_READ) {
  return new InputError({
    en: `${rows} rows are too many; the limit is ${limit}.`,
    id: `${rows} baris terlalu banyak; batasnya ${limit}.`,
  });
}

export function tooWide(columns, limit = MAX_COLUMNS) {
  return new InputError({
    en: `${columns} columns are too many; the limit is ${limit}.`,
    id: `${columns} kolom terlalu banyak; batasnya ${limit}.`,
  });
}

export function tooLarge(size, limit = MAX_BYTES) {
  const megabytes = Math.ceil(size / MEGABYTE);
  const most = limit / MEGABYTE;
  return new InputError({
    en: `${megabytes} MB are too much; the limit is ${most} MB.`,
    id: `${megabytes} MB terlalu besar; batasnya ${most} MB.`,
  });
}

export function tooManyCells(cells, limit = MAX_CELLS) {
  return new InputError({
    en: `${cells} cells are too many; the limit is ${limit}.`,
    id: `${cells} sel terlalu banyak; batasnya ${limit}.`,
  });
}
