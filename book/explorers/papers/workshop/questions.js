// The hand check of chapter 7: a step of the filter that the reader has built.
import { ask } from "../../language/question.js";

const FIRST_STEPS = 20; // one of them is asked about
const DIGITS = 6;

export function question(r, s, t, random) {
  const k = 1 + random.whole(Math.min(FIRST_STEPS, r.T - 1));
  const { S, n, m, P_pred } = r.result;
  const given = { k: String(k + 1), P_pred: P_pred[k * n * n], R: r.p.R };
  const about = {
    text: {
      id: "Pada k = {k}: varians prediksi besaran itu {P_pred}, dan R = {R}. Berapa S sensor 1?",
      en: "At k = {k}: the quantity's predicted variance is {P_pred}, and R = {R}. What is S of sensor 1?",
    },
    answer: S[k * m * m],
    tolerance: 0.005,
    hint: () => ({ id: "S = H P_pred Hᵀ + R.", en: "S = H P_pred Hᵀ + R." }),
  };
  return ask(about, given, t, DIGITS);
}
