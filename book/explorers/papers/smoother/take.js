// What a reader of chapter 2 takes along: the result as text, as CSV, and as a workbook with live formulas.
import { tooLong } from "../../files/limits.js";
import { nameOf, rivals } from "./shared.js";
import { CONTROLS, TEXT_HEAD } from "./words.js";
import { writeWorkbook } from "./workbook.js";

const MAX_WRITE = 100000; // rows
const XLSX = "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet";

/** The result as lines of text: No, Measured, Filtered, K, P and the rivals; every digit there is. */
function asText(r, s, t, separator, decimal) {
  const { x, K, P } = r.result;
  const others = rivals(r);
  const columns = [r.z, x, K, P, ...others.map(([, line]) => line)];
  const names = others.map(([name]) => (name === "average" ? `MA${s.window}` : nameOf(name, t)));
  const head = ["No", t.say(TEXT_HEAD.measured), t.say(TEXT_HEAD.filtered), "K", "P", ...names];
  const cell = (value) => (Number.isNaN(value) ? "" : String(value).replace(".", decimal));
  const lines = [head];
  for (let k = 0; k < r.z.length; k++) {
    lines.push([k + 1, ...columns.map((column) => cell(column[k]))]);
  }
  return lines.map((cells) => `${cells.join(separator)}\r\n`).join("");
}

/** For a spreadsheet in the language of the page. */
function copy(r, s, t) {
  return asText(r, s, t, "\t", t.language === "id" ? "," : ".");
}

function saveCsv(r, s, t) {
  const [separator, decimal] = t.language === "id" ? [";", ","] : [",", "."]; // as Excel there expects
  const content = asText(r, s, t, separator, decimal);
  return { name: "kalman.csv", type: "text/csv;charset=utf-8", content };
}

function saveWorkbook(r, s, t) {
  if (r.z.length > MAX_WRITE) {
    throw tooLong(r.z.length, MAX_WRITE);
  }
  const name = t.say(r.data.name);
  const content = writeWorkbook({ z: r.z, p: r.p, result: r.result, smooth: r.smooth, name });
  return { name: "kalman.xlsx", type: XLSX, content };
}

/** What a kernel is asked for instead: the same workbook, with its chart and its notes. */
function askForWorkbook(r, s, t) {
  const { Q, R, x0, P0 } = r.p;
  return { write: "workbook", name: t.say(r.data.name), Q, R, x0, P0, arrays: { z: r.z } };
}

export const buttons = [
  { ...CONTROLS.copy, copy },
  { ...CONTROLS.csv, save: saveCsv },
  { ...CONTROLS.excel, save: saveWorkbook, ask: askForWorkbook },
];
