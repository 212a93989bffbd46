// The hand check of chapter 1: four questions about what is shown, in each view, and a hint for each likely
// mistake.
import { ask, isNear } from "../../language/question.js";
import { COUNT } from "./steps.js";

const TOLERANCE = 0.01; // of the answer
const NEAR = 0.012; // so near to a wrong answer, and we know the mistake

export function question(r, s, t, random) {
  const k = Math.max(1, r.moment > 0 ? r.k : 1 + random.whole(COUNT));
  const step = {
    before: r.beliefs[2 * k - 2],
    predicted: r.beliefs[2 * k - 1],
    updated: r.beliefs[2 * k],
    K: r.result.K[2 * k - 2], // of the position
    S: r.result.S[k - 1],
    z: r.z[k - 1],
  };
  const { before, predicted, K, S, z } = step;
  const given = {
    k: String(k),
    p: before.x[0],
    v: before.x[1],
    dt: s.dt,
    u: s.u,
    pred: predicted.x[0],
    P: predicted.P[0],
    R: s.R,
    z,
    K,
    S,
    a: before.P[0],
    b: before.P[1],
    c: before.P[2],
    Q: s.Q,
  };
  const kinds = [aboutGain, aboutPrediction, aboutUpdate, aboutVariance];
  const kind = kinds[random.whole(kinds.length)];
  return ask({ tolerance: TOLERANCE, ...kind(step, s) }, given, t, 4);
}

function aboutGain({ K, S }) {
  return {
    text: {
      id: "Langkah {k}: P_pred untuk posisi {P} m² dan R = {R} m². Berapa penguatan K untuk posisi?",
      en: "Step {k}: P_pred of the position is {P} m², R = {R} m². What is the gain K of the position?",
    },
    answer: K,
    hint(value) {
      if (isNear(value, 1 - K, NEAR)) {
        return { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." };
      }
      if (isNear(value, S, NEAR)) {
        return { id: "Itu S. Bagilah P_pred dengan S.", en: "That is S. Divide P_pred by S." };
      }
      return { id: "S = P_pred + R, lalu K = P_pred / S.", en: "S = P_pred + R, then K = P_pred / S." };
    },
  };
}

function aboutPrediction({ before, predicted }, s) {
  const predicted_velocity = before.x[1] + s.dt * s.u;
  return {
    text: {
      id: "Langkah {k}: p = {p} m, v = {v} m/s, Δt = {dt} s. Di mana posisi mobil diprediksi (m)?",
      en: "Step {k}: p = {p} m, v = {v} m/s, Δt = {dt} s. Where is the car predicted to be (m)?",
    },
    answer: predicted.x[0],
    hint(value) {
      if (isNear(value, predicted_velocity, NEAR)) {
        return {
          id: "Itu kecepatan yang diprediksi; yang ditanyakan posisinya.",
          en: "That is the predicted velocity; the position was asked for.",
        };
      }
      return {
        id: "Baris pertama F x + B u: p + Δt v. Percepatannya baru mengubah kecepatan.",
        en: "The first row of F x + B u: p + Δt v. The acceleration changes only the velocity yet.",
      };
    },
  };
}

function aboutUpdate({ predicted, updated, K, z }) {
  const correction = K * (z - predicted.x[0]);
  return {
    text: {
      id:
        "Langkah {k}: prediksi {pred} m, pengukuran {z} m, K = {K} untuk posisi. " +
        "Berapa posisi sesudah pembaruan (m)?",
      en:
        "Step {k}: prediction {pred} m, measurement {z} m, K = {K} for the position. " +
        "What is the position after the update (m)?",
    },
    answer: updated.x[0],
    hint(value) {
      if (isNear(value, correction, NEAR)) {
        return {
          id: "Itu baru koreksinya; tambahkan prediksinya.",
          en: "That is only the correction; add the prediction.",
        };
      }
      return {
        id: "y = z − prediksi, lalu prediksi + K y.",
        en: "y = z − prediction, then prediction + K y.",
      };
    },
  };
}

function aboutVariance({ before, predicted }, s) {
  return {
    text: {
      id: "Langkah {k}: P = [{a}; {b} | {b}; {c}], Δt = {dt} s, Q = {Q}. Berapa P_pred untuk posisi (m²)?",
      en: "Step {k}: P = [{a}; {b} | {b}; {c}], Δt = {dt} s, Q = {Q}. What is P_pred of the position (m²)?",
    },
    answer: predicted.P[0],
    hint(value) {
      if (isNear(value, predicted.P[0] - s.Q, NEAR)) {
        return { id: "Tinggal menambahkan Q.", en: "Only Q is missing." };
      }
      if (isNear(value, before.P[0] + s.Q, NEAR)) {
        return {
          id: "Ketidakpastian kecepatan ikut terbawa: Δt² P₂₂ dan 2 Δt P₁₂.",
          en: "The uncertainty of the velocity comes along: Δt² P₂₂ and 2 Δt P₁₂.",
        };
      }
      return {
        id: "Kiri atas F P Fᵀ + Q: P₁₁ + 2 Δt P₁₂ + Δt² P₂₂ + Q.",
        en: "Top left of F P Fᵀ + Q: P₁₁ + 2 Δt P₁₂ + Δt² P₂₂ + Q.",
      };
    },
  };
}

// --- the view "bells" --------------------------------------------------------------------------------------

/** About the two rulers that are shown. */
export function rulerQuestion(r, s, t, random) {
  const given = { a: s.a, b: s.b, sa: s.sigma_a, sb: s.sigma_b, K: r.K };
  const kinds = [aboutShare, aboutPlace, aboutFusedVariance, aboutFusedWidth];
  const kind = kinds[random.whole(kinds.length)];
  return ask({ tolerance: TOLERANCE, ...kind(r, s) }, given, t, 4);
}

function aboutShare({ K }, { sigma_a, sigma_b }) {
  return {
    text: {
      id: "Simpangan baku a {sa} cm, b {sb} cm. Berapa K?",
      en: "The standard deviation of a is {sa} cm, that of b {sb} cm. What is K?",
    },
    answer: K,
    hint(value) {
      if (isNear(value, 1 - K, NEAR)) {
        return { id: "Itu 1 − K, bagian untuk a.", en: "That is 1 − K, the share of a." };
      }
      if (isNear(value, sigma_a / (sigma_a + sigma_b), NEAR)) {
        return {
          id: "Kuadratkan dulu: K memakai varians, bukan simpangan baku.",
          en: "Square them first: K takes variances, not standard deviations.",
        };
      }
      return { id: "K = σ_a² / (σ_a² + σ_b²).", en: "K = σ_a² / (σ_a² + σ_b²)." };
    },
  };
}

function aboutPlace({ x }, { a, b }) {
  return {
    text: {
      id: "a = {a} cm, b = {b} cm, K = {K}. Berapa x (cm)?",
      en: "a = {a} cm, b = {b} cm, K = {K}. What is x (cm)?",
    },
    answer: x,
    hint(value) {
      if (isNear(value, a + b - x, NEAR / 4)) {
        return { id: "Mulailah dari a, bukan dari b.", en: "Start from a, not from b." };
      }
      return { id: "x = a + K (b − a).", en: "x = a + K (b − a)." };
    },
  };
}

function aboutFusedVariance({ P, sigma }, { sigma_a }) {
  return {
    text: {
      id: "Simpangan baku a {sa} cm, K = {K}. Berapa varians gabungan P (cm²)?",
      en: "The standard deviation of a is {sa} cm, K = {K}. What is the fused variance P (cm²)?",
    },
    answer: P,
    hint(value) {
      if (isNear(value, sigma, NEAR)) {
        return { id: "Itu simpangan bakunya; kuadratkan.", en: "That is the standard deviation; square it." };
      }
      if (isNear(value, P / sigma_a, NEAR)) {
        return { id: "Kuadratkan dulu σ_a.", en: "Square σ_a first." };
      }
      return { id: "P = (1 − K) σ_a².", en: "P = (1 − K) σ_a²." };
    },
  };
}

function aboutFusedWidth({ P, sigma }) {
  return {
    text: {
      id: "Simpangan baku {sa} cm dan {sb} cm. Berapa simpangan baku gabungannya (cm)?",
      en: "Standard deviations of {sa} cm and {sb} cm. What is that of both together (cm)?",
    },
    answer: sigma,
    hint(value) {
      if (isNear(value, P, NEAR)) {
        return { id: "Itu variansnya; tariklah akarnya.", en: "That is the variance; take its root." };
      }
      return {
        id: "1/P = 1/σ_a² + 1/σ_b², lalu akar P.",
        en: "1/P = 1/σ_a² + 1/σ_b², then the root of P.",
      };
    },
  };
}
