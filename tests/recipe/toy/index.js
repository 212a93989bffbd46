// The toy paper: what the page needs of it.
import { bottle } from "./view.js";

export * from "./model.js";
export const views = { bottle };
