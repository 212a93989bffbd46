// Chapter 3: what the page needs of it. The first view is the one that explore("gyro") shows.
import { drift } from "./drift.js";
import { mismatch } from "./map.js";
import { flight } from "./view.js";

export * from "./model.js";
export const views = { flight, mismatch, drift };
