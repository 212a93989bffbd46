// Chapter 6: what the page needs of it.
import { tilt } from "./tilt.js";
import { flight } from "./view.js";

export { METHODS, attitude } from "./attitude.js";
export { readRecording } from "../../files/recording.js"; // for the tests
export { simulate } from "./flight.js";
export { addUp, filterHeld, hold } from "./hand.js";
export * from "./model.js";
export { galat, rmse_deg } from "./statistics.js";
export const views = { flight, tilt };
