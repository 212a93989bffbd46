// The view "bells": two rulers, each a bell curve whose centre and width can be dragged, their product, and
// a see-saw that rests on it.
import { drag, draw } from "./seesaw.js";
import { fuse } from "./model.js";
import { rulerQuestion } from "./questions.js";
import { RULERS } from "./words.js";

const CENTRE = { unit: "cm", min: 15, max: 28, step: 0.1, log: false };
const WIDTH = { unit: "cm", min: 0.8, max: 4, step: 0.1, log: false };
const RARE = 3; // standard deviations: honest rulers hardly ever lie so far apart

export function compute(s) {
  const found = fuse(s.a, s.sigma_a ** 2, s.b, s.sigma_b ** 2);
  const expected = Math.hypot(s.sigma_a, s.sigma_b); // standard deviation of b - a
  return { ...found, sigma: Math.sqrt(found.P), gap: Math.abs(s.b - s.a), expected };
}

function outcome(r, s, t) {
  const isRare = r.gap > RARE * r.expected;
  const values = {
    a: s.a,
    b: s.b,
    x: r.x,
    sigma: r.sigma,
    K: t.decimal(r.K, 2),
    percent: t.decimal(100 * r.K, 2),
    gap: r.gap,
    expected: r.expected,
  };
  return `${t.say(RULERS.outcome, values)} ${isRare ? t.say(RULERS.rare, values) : ""}`.trim();
}

function numbers(r, s, t) {
  const row = (name, centre, sigma, weight) => [name, ...[centre, sigma, sigma ** 2].map(write), weight];
  const write = (value) => t.decimal(value, 4);
  return {
    head: ["", "cm", "σ (cm)", "σ² (cm²)", "%"],
    rows: [
      row("a", s.a, s.sigma_a, write(100 * (1 - r.K))),
      row("b", s.b, s.sigma_b, write(100 * r.K)),
      row("x", r.x, r.sigma, "100"),
      row("b − a", s.b - s.a, r.expected, ""),
    ],
  };
}

export const rulers = {
  name: RULERS.name,
  controls: [
    { name: "a", symbol: "a", ...RULERS.first, ...CENTRE, default: 20 },
    { name: "sigma_a", symbol: "σ_a", ...RULERS.width, ...WIDTH, default: 2 },
    { name: "b", symbol: "b", ...RULERS.second, ...CENTRE, default: 23 },
    { name: "sigma_b", symbol: "σ_b", ...RULERS.width, ...WIDTH, default: 1 },
  ],
  compute,
  plots: [{ title: RULERS.title, alt: RULERS.alt, height: 330, bare: true, draw, drag }],
  outcome,
  numbers,
  question: rulerQuestion,
};
