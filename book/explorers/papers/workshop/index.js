// Chapter 7: what the page needs of it.
import { builder } from "./view.js";

export * from "./model.js";
export const views = { builder };
