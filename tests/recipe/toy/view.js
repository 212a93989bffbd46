// What the explorer of the toy paper shows: the mass over time, and one question.
import { generator } from "../../numerics/random.js";
import { run, simulate } from "./model.js";
import { question } from "./questions.js";
import { CONTROLS, HEAD, LABELS, NAME, OUTCOME, PLOT } from "./words.js";

function compute(s) {
  const data = simulate(s, generator(s.seed));
  return { data, result: run(s, data), t: data.z.map((_, k) => k + 1) };
}

function draw({ data, result, t }) {
  const sigma = result.P.map(Math.sqrt);
  return {
    layers: [
      {
        look: "band",
        x: t,
        low: result.x.map((x, k) => x - 2 * sigma[k]),
        high: result.x.map((x, k) => x + 2 * sigma[k]),
      },
      { look: "truth", x: t, y: data.x, label: LABELS.truth },
      { look: "measurement", x: t, y: data.z, label: LABELS.z },
      { look: "estimate", x: t, y: result.x, label: LABELS.x },
    ],
  };
}

function outcome({ result, t }, s, words) {
  const last = t.length - 1;
  return words.say(OUTCOME, { mass: result.x[last], sigma: Math.sqrt(result.P[last]) });
}

function numbers({ data, result, t }, s, words) {
  const rows = Array.from(t, (time, k) => {
    const values = [data.z[k], result.x[k], result.K[k]];
    return [String(time), ...values.map((value) => words.decimal(value, 4))];
  });
  return { head: HEAD, rows };
}

export const bottle = {
  name: NAME,
  controls: [
    { name: "flow", symbol: "u", ...CONTROLS.flow },
    { name: "sigma_flow", symbol: "σ_u" },
    { name: "sigma_scale", symbol: "σ_z" },
  ],
  noise: true,
  compute,
  plots: [{ ...PLOT, xlabel: "t (s)", height: 240, draw }],
  outcome,
  numbers,
  question,
};
