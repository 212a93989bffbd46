// What a reader of chapter 7 takes along: the filter as a program, its numbers, and a workbook.
import { tooLong } from "../../files/limits.js";
import { CSV_NAME, csvText, filterpyCode, kalmanCode, ready } from "./later/code.js";
import { writeWorkbook } from "./later/workbook.js";
import { TAKE } from "./words.js";

const MAX_WRITE = 100000; // rows
const XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";
const PYTHON = "text/x-python;charset=utf-8";

/** A clipboard takes what a tap brings at once: the programs are at hand when their buttons are shown. */
export const readyToTake = ready;

function saveCode(name, code) {
  return (r, s, t) => ({ name, type: PYTHON, content: code(r, s, t) });
}

function saveCsv(r) {
  return { name: CSV_NAME, type: "text/csv;charset=utf-8", content: csvText(r) };
}

function saveWorkbook(r) {
  if (r.T > MAX_WRITE) {
    throw tooLong(r.T, MAX_WRITE);
  }
  return { name: "workshop.xlsx", type: XLSX, content: writeWorkbook(r) };
}

export const takeAway = [
  { ...TAKE.copy, copy: kalmanCode },
  { ...TAKE.kalman_lib, save: saveCode("workshop.py", kalmanCode) },
  { ...TAKE.filterpy, save: saveCode("workshop_filterpy.py", filterpyCode) },
  { ...TAKE.csv, save: saveCsv },
];

export const takeWorkbook = { ...TAKE.excel, save: saveWorkbook };
