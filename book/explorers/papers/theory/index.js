// Chapter 1: what the page needs of it. The first view is the one that explore("theory") shows.
import { rulers } from "./rulers.js";
import { steps } from "./view.js";

export * from "./model.js";
export const views = { steps, bells: rulers };
