// The core: what every page with an explorer loads once, before the bundle of its paper. It becomes one
// script that defines KalmanExplorers; the papers find their numerics and their language there (see
// book/_ext/bundle.mjs).
export * as linalg from "./numerics/linalg.js";
export * as leastsquares from "./numerics/leastsquares.js";
export * as models from "./numerics/models.js";
export * as filters from "./numerics/filters.js";
export * as smoother from "./numerics/smoother.js";
export * as metrics from "./numerics/metrics.js";
export * as random from "./numerics/random.js";
export * as input from "./language/input.js";
export * as speaker from "./language/speaker.js";
export * as question from "./language/question.js";
export { papers, register, tables } from "./element/register.js";
/** What only some papers use, each from a script of its own: {files: {table, ...}, sensors: {...}}. */
export const rooms = {};
