// Chapter 1: what the page needs of it.
import { steps } from "./view.js";

export * from "./model.js";
export const views = { steps };
