// Chapter 3: what the page needs of it.
import { mismatch } from "./map.js";
import { flight } from "./view.js";

export * from "./model.js";
export const views = { flight, mismatch };
