// The hand check of the toy paper: the gain of the first step.
import { ask } from "../../language/question.js";

export function question(r, s, t) {
  const P_pred = 0.01 + s.sigma_flow ** 2;
  const R = s.sigma_scale ** 2;
  const about = {
    text: { id: "P_pred = {P_pred} dan R = {R}. Berapa K?", en: "P_pred = {P_pred} and R = {R}. What is K?" },
    answer: P_pred / (P_pred + R),
    tolerance: 0.01,
    hint: () => ({ id: "K = P_pred / (P_pred + R).", en: "K = P_pred / (P_pred + R)." }),
  };
  return ask(about, { P_pred: t.decimal(P_pred, 4), R: t.decimal(R, 4) }, t);
}
