// The core: what every page with an explorer loads once, before the bundle of its paper. It becomes one
// script that defines KalmanExplorers; the papers find their numerics and their language there (see
// book/_ext/bundle.mjs). What only one paper uses of them (least squares, the smoother) goes with that paper.
export * as linalg from "./numerics/linalg.js";
export * as models from "./numerics/models.js";
export * as filters from "./numerics/filters.js";
export * as metrics from "./numerics/metrics.js";
export * as random from "./numerics/random.js";
export * as input from "./language/input.js";
export * as speaker from "./language/speaker.js";
export * as question from "./language/question.js";
export * as later from "./language/later.js";
export { papers, register, tables } from "./element/register.js";
export { knowRooms, roomOf, rooms } from "./element/rooms.js";
