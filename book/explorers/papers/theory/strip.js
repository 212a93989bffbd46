// A strip of the figure: the equations of the position with the numbers of this moment, which stay in sight
// while a slider moves. All equations stand below, as text.
import { PREDICTION, START } from "./steps.js";

const LINE = 21; // pixels from one line to the next
const BARE = { xlim: [0, 1], ylim: [0, 1] };

export function strip(r, s, t) {
  const number = (value) => t.decimal(value, 3);
  const signed = (value) => (value < 0 ? `(${number(value)})` : number(value));
  const lines = linesOf(r, s, number, signed);
  const paint = (ctx, X, Y, colours) => {
    ctx.font = `600 13px ${colours.font}`;
    ctx.textAlign = "left";
    ctx.textBaseline = "alphabetic";
    lines.forEach((text, i) => ctx.fillText(text, X(0) + 2, Y(1) + 14 + LINE * i));
  };
  return { ...BARE, layers: [{ look: "words", paint }] };
}

function linesOf({ k, kind, beliefs, result, model, z }, s, number, signed) {
  if (kind === START) {
    const { x, P } = beliefs[0];
    return [`p = ${number(x[0])} m`, `P₁₁ = ${number(P[0])} m²`, `v = ${number(x[1])} m/s`];
  }
  const before = beliefs[2 * k - 2];
  const predicted = beliefs[2 * k - 1];
  if (kind === PREDICTION) {
    const { x, P } = before;
    const parts = [P[0], 2 * s.dt * P[1], s.dt ** 2 * P[2], s.Q].map(number);
    return [
      `p = ${number(x[0])} + ${number(s.dt)} · ${signed(x[1])} = ${number(predicted.x[0])} m`,
      `P₁₁ = ${parts.join(" + ")}`,
      `      = ${number(predicted.P[0])} m²`,
    ];
  }
  const [P_pred, R] = [predicted.P[0], model.R[0]];
  const [K, K_v] = result.K.subarray(2 * k - 2, 2 * k);
  const y = z[k - 1] - predicted.x[0];
  return [
    `K = ${number(P_pred)} / (${number(P_pred)} + ${number(R)}) = ${number(K)}`,
    `p = ${number(predicted.x[0])} + ${number(K)} · ${signed(y)} = ${number(beliefs[2 * k].x[0])} m`,
    `v = ${number(predicted.x[1])} + ${number(K_v)} · ${signed(y)} = ${number(beliefs[2 * k].x[1])} m/s`,
  ];
}
