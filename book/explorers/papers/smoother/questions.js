// The hand check of chapter 2: two questions about the steady state, three about one of the first steps.
import { ask, isNear } from "../../language/question.js";
import { equal_window, steady_gain } from "./model.js";

const TOLERANCE = 0.005; // of the answer
const NEAR = 0.005; // so near to a wrong answer, and we know the mistake
const FIRST_VALUES = 400; // among them the steps are looked for
const FIRST_KNOWN = 8; // and one of so many is asked about
const DIGITS = 7;

export function question(r, s, t, random) {
  const k = someStep(r.z, random);
  const q = s.Q / s.R;
  const steady = { K: steady_gain(q) };
  const given = { q, steady: steady.K, Q: s.Q, R: s.R };
  const questions = [aboutSteadyGain(steady), aboutWindow(steady)];
  if (k !== null) {
    const step = stepOf(r, s, k);
    Object.assign(given, { P: step.P_before, K: step.K, pred: step.x_pred, z: step.z });
    questions.push(aboutGain(step), aboutUpdate(step), aboutVariance(step));
  }
  const words = { k: String((k ?? -1) + 1) };
  for (const [name, value] of Object.entries(given)) {
    words[name] = t.decimal(value, DIGITS);
  }
  const chosen = questions[random.whole(questions.length)];
  return ask({ tolerance: TOLERANCE, ...chosen }, words, t);
}

/** One of the first steps whose measurement arrived; null: there is none. */
function someStep(z, random) {
  const first = Array.from(z.subarray(0, FIRST_VALUES).keys());
  const known = first.filter((k) => !Number.isNaN(z[k]));
  return known.length > 0 ? known[random.whole(Math.min(known.length, FIRST_KNOWN))] : null;
}

function stepOf(r, s, k) {
  const { z, result } = r;
  return {
    R: s.R,
    P_before: k > 0 ? result.P[k - 1] : (r.p ?? s).P0, // the online view has no p
    x_pred: result.x_pred[k],
    z: z[k],
    y: result.y[k],
    K: result.K[k],
    x: result.x[k],
    P: result.P[k],
  };
}

function aboutSteadyGain({ K }) {
  return {
    text: {
      id: "Pada keadaan tunak K² + q K − q = 0, dengan q = Q / R = {q}. Berapa K?",
      en: "In the steady state K² + q K − q = 0, with q = Q / R = {q}. What is K?",
    },
    answer: K,
    hint: () => ({
      id: "Ambil akar yang positif: K = (−q + √(q² + 4 q)) / 2.",
      en: "Take the positive root: K = (−q + √(q² + 4 q)) / 2.",
    }),
  };
}

function aboutWindow({ K }) {
  return {
    text: {
      id: "K = {steady}. Rataan bergerak berapa data yang meredam derau putih sekuat itu?",
      en: "K = {steady}. A moving average of how many values suppresses white noise as much?",
    },
    answer: equal_window(K),
    hint(value) {
      if (isNear(value, 2 / K, NEAR)) {
        return { id: "Tinggal dikurangi satu.", en: "Only minus one is missing." };
      }
      return { id: "n = 2 / K − 1.", en: "n = 2 / K − 1." };
    },
  };
}

function aboutGain({ P_before, R, K }) {
  return {
    text: {
      id: "Langkah {k}: P sebelumnya {P}, Q = {Q}, R = {R}. Berapa K?",
      en: "Step {k}: the P before it is {P}, Q = {Q}, R = {R}. What is K?",
    },
    answer: K,
    hint(value) {
      if (isNear(value, P_before / (P_before + R), NEAR)) {
        return { id: "Prediksi dahulu: P_pred = P + Q.", en: "Predict first: P_pred = P + Q." };
      }
      if (isNear(value, 1 - K, NEAR)) {
        return { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." };
      }
      return {
        id: "P_pred = P + Q, lalu K = P_pred / (P_pred + R).",
        en: "P_pred = P + Q, then K = P_pred / (P_pred + R).",
      };
    },
  };
}

function aboutUpdate({ x_pred, z, y, K, x }) {
  // x may be a small difference of large numbers: then the digits shown leave more open
  const cancellation = (Math.abs(x_pred) + Math.abs(z)) / Math.max(Math.abs(x), 1e-300);
  return {
    text: {
      id: "Langkah {k}: x_pred = {pred}, z = {z}, K = {K}. Berapa x?",
      en: "Step {k}: x_pred = {pred}, z = {z}, K = {K}. What is x?",
    },
    answer: x,
    tolerance: 1e-3 * (1 + cancellation / 100),
    hint(value) {
      if (isNear(value, K * y, NEAR)) {
        return {
          id: "Itu baru koreksinya K y; tambahkan x_pred.",
          en: "That is only the correction K y; add x_pred.",
        };
      }
      return { id: "x = x_pred + K (z − x_pred).", en: "x = x_pred + K (z − x_pred)." };
    },
  };
}

function aboutVariance({ K, R, P }) {
  return {
    text: {
      id: "Langkah {k}: K = {K} dan R = {R}. Berapa P sesudah pembaruan?",
      en: "Step {k}: K = {K} and R = {R}. What is P after the update?",
    },
    answer: P,
    hint(value) {
      if (isNear(value, (1 - K) * R, NEAR)) {
        return { id: "(1 − K) mengalikan P_pred, bukan R.", en: "(1 − K) multiplies P_pred, not R." };
      }
      return { id: "P = (1 − K) P_pred = K R.", en: "P = (1 − K) P_pred = K R." };
    },
  };
}
