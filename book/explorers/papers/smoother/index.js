// Chapter 2: what the page needs of it.
import { cover } from "./cover.js";
import { drawing } from "./draw.js";
import { online } from "./online.js";
import { form } from "./view.js";

export { seriesOf } from "../../files/series.js"; // these three for the tests
export { readTable } from "../../files/table.js";
export { opened } from "../../files/workbook.js";
export * from "./model.js";
export { path_of } from "./paths.js";
export { writeWorkbook } from "./workbook.js";
export const views = { form, draw: drawing, online, cover };
