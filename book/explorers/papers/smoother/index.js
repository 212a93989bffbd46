// Chapter 2: what the page needs of it.
import { cover } from "./cover.js";
import { drawing } from "./draw.js";
import { online } from "./online.js";
import { form } from "./view.js";

export { readFile, readText } from "../../files/table.js"; // for the tests
export * from "./model.js";
export { path_of } from "./paths.js";
export { writeWorkbook } from "./workbook.js";
export const views = { form, draw: drawing, online, cover };
