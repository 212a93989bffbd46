// Chapter 4: what the page needs of it.
import { view } from "./view.js";

export * from "./model.js";
export const views = { run: view };
