// Chapter 5: what the page needs of it.
import { banana } from "./banana.js";
import { walk } from "./view.js";

export * from "./model.js";
export const views = { walk, banana };
