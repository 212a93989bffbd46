// Chapter 4: what the page needs of it.
import { noise } from "./noise.js";
import { by_hand } from "./poles.js";
import { view } from "./view.js";

export { rtsSmooth } from "../../numerics/smoother.js"; // for the tests
export * from "./model.js";
export const views = { run: view, poles: by_hand, noise };
