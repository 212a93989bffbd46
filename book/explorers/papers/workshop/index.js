// Chapter 7: what the page needs of it.
import { builder } from "./view.js";

export { csvText, filterpyCode, kalmanCode } from "./later/code.js"; // for the tests
export { mostLikely } from "./estimate.js";
export { whiteness } from "./judge.js";
export { readMatrices } from "./matrices.js";
export * from "./model.js";
export { writeWorkbook } from "./later/workbook.js";
export const views = { builder };
