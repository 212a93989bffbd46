// The view of the book's first page: a path to draw, one filter, one slider, and no letter yet.
import { rmse } from "../../numerics/metrics.js";
import { drawing, scored } from "./draw.js";
import { COVER } from "./words.js";

const [trust, , , shape] = drawing.controls;

function draw(r, s) {
  const { layers, ...frame } = drawing.plots[0].draw(r, s);
  const dots = { ...layers[0], label: COVER.dots };
  return { ...frame, layers: [dots, ...layers.slice(1)] };
}

function outcome(r, s, t) {
  const { far, late } = scored(r.result.x, r.truth);
  const dots = rmse(r.truth, r.z)[0];
  const values = { dots: t.decimal(dots, 2), far: t.decimal(far, 2), late: t.decimal(late, 2) };
  return t.say(Number.isNaN(late) ? COVER.flat : COVER.outcome, values);
}

export const cover = {
  ...drawing,
  name: COVER.name,
  start: { path: null, average: false, window: 1 },
  controls: [{ ...trust, symbol: "", ...COVER.trust }, shape],
  plots: [{ ...drawing.plots[0], alt: COVER.alt, xlabel: "t", height: 210, draw }],
  outcome,
};
