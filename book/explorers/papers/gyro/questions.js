// The hand checks of chapter 3: questions about the first steps, and about a filter that believes wrong
// sigmas.
import { ask, isNear } from "../../language/question.js";
import { steps } from "./model.js";

const NEAR = 0.02; // so near to a wrong answer, and we know the mistake

export function question(r, s, t, random) {
  const p = r.believed;
  const step = {
    p,
    Q: (p.sigma_w * p.T) ** 2,
    R: p.sigma_v ** 2,
    x_pred: r.filter.x_pred[0],
    z: r.flight.z[0],
    K: r.filter.K[0],
    x: r.filter.x[0],
    P: r.filter.P[0],
  };
  const shown = { w: p.sigma_w, v: p.sigma_v, T: p.T, pred: step.x_pred, true_w: s.sigma_w, ...step };
  const given = {};
  for (const name of ["w", "v", "T", "z", "pred", "K", "R", "Q", "P", "true_w"]) {
    given[name] = t.decimal(shown[name], 4);
  }
  given.k = String(steps(s));
  const kinds = [aboutGain, aboutUpdate, aboutPrediction, aboutVariance, aboutDrift];
  const kind = kinds[random.whole(kinds.length)];
  return ask(kind(step, s), given, t);
}

function aboutGain({ p, Q, R }) {
  const without_squares = (p.sigma_w * p.T) / (p.sigma_w * p.T + p.sigma_v);
  const without_T = p.sigma_w ** 2 / (p.sigma_w ** 2 + R);
  return {
    text: {
      id:
        "Sudut awalnya diketahui (P₀ = 0). Dengan σ_w = {w} rad/s, T = {T} s, " +
        "dan σ_v = {v} rad menurut filter, " +
        "berapa penguatan K pada langkah pertama?",
      en:
        "The first angle is known (P₀ = 0). With σ_w = {w} rad/s, " +
        "T = {T} s and σ_v = {v} rad as the filter has them, " +
        "what is the gain K of the first step?",
    },
    answer: Q / (Q + R),
    hint(value) {
      if (isNear(value, R / (Q + R), NEAR)) {
        return { id: "Itu bagian untuk prediksi, 1 − K.", en: "That is the share of the prediction, 1 − K." };
      }
      if (isNear(value, without_squares, NEAR)) {
        return {
          id: "Kuadratkan dahulu simpangan bakunya: Q = (σ_w T)², R = σ_v².",
          en: "Square the standard deviations first: Q = (σ_w T)², R = σ_v².",
        };
      }
      if (isNear(value, without_T, NEAR)) {
        return { id: "Jangan lupa T: Q = (σ_w T)².", en: "Do not forget T: Q = (σ_w T)²." };
      }
      return {
        id: "P_pred = P₀ + Q = (σ_w T)² = {Q} rad², lalu K = P_pred / (P_pred + R) dengan R = σ_v².",
        en: "P_pred = P₀ + Q = (σ_w T)² = {Q} rad², then K = P_pred / (P_pred + R) with R = σ_v².",
      };
    },
  };
}

function aboutUpdate({ x_pred, z, K, x }) {
  return {
    text: {
      id: "Langkah pertama: x_pred = {pred} rad, z = {z} rad, K = {K}. Berapa x (rad)?",
      en: "First step: x_pred = {pred} rad, z = {z} rad, K = {K}. What is x (rad)?",
    },
    answer: x,
    tolerance: 0.02,
    hint(value) {
      if (isNear(value, (1 - K) * z + K * x_pred, NEAR)) {
        return {
          id: "K mengalikan inovasi z − x_pred, bukan prediksinya.",
          en: "K multiplies the innovation z − x_pred, not the prediction.",
        };
      }
      if (isNear(value, K * (z - x_pred), NEAR)) {
        return {
          id: "Itu baru koreksinya K y; tambahkan x_pred.",
          en: "That is only the correction K y; add x_pred.",
        };
      }
      return { id: "x = x_pred + K (z − x_pred).", en: "x = x_pred + K (z − x_pred)." };
    },
  };
}

function aboutPrediction({ P, Q }) {
  return {
    text: {
      id: "Sesudah langkah pertama P = {P} rad², dan Q = {Q} rad². Berapa P_pred pada langkah kedua (rad²)?",
      en: "After the first step P = {P} rad², and Q = {Q} rad². What is P_pred of the second step (rad²)?",
    },
    answer: P + Q,
    hint(value) {
      if (isNear(value, P, NEAR)) {
        return {
          id: "Prediksi menambah ketidakpastian: tambahkan Q.",
          en: "A prediction adds uncertainty: add Q.",
        };
      }
      return { id: "F = 1, jadi P_pred = P + Q.", en: "F = 1, so P_pred = P + Q." };
    },
  };
}

function aboutVariance({ K, R }) {
  return {
    text: {
      id: "Penguatan langkah pertama K = {K} dan R = {R} rad². Berapa P sesudah langkah itu (rad²)?",
      en: "The first gain is K = {K} and R = {R} rad². What is P after that step (rad²)?",
    },
    answer: K * R,
    hint(value) {
      if (isNear(value, (1 - K) * R, NEAR)) {
        return { id: "(1 − K) mengalikan P_pred, bukan R.", en: "(1 − K) multiplies P_pred, not R." };
      }
      return {
        id: "Untuk satu bilangan P = (1 − K) P_pred = K R.",
        en: "For a single number P = (1 − K) P_pred = K R.",
      };
    },
  };
}

/** Without the angle sensor: the standard deviation after all steps. */
function aboutDrift(step, s) {
  const variance = steps(s) * (s.sigma_w * s.T) ** 2;
  return {
    text: {
      id:
        "Giroskop saja, tanpa sensor sudut: σ_w = {true_w} rad/s, T = {T} s. " +
        "Pada awalnya sudut diketahui. Berapa simpangan bakunya (rad) setelah {k} langkah?",
      en:
        "The gyroscope alone, without the angle sensor: σ_w = {true_w} rad/s, T = {T} s. " +
        "At first the angle is known. What is its standard deviation (rad) after {k} steps?",
    },
    answer: Math.sqrt(variance),
    tolerance: 0.02,
    hint: (value) => driftHint(value, variance, s),
  };
}

function driftHint(value, variance, s) {
  if (isNear(value, variance, NEAR) || isNear(value, steps(s) * s.sigma_w * s.T, NEAR)) {
    return {
      id: "Varianslah yang dijumlahkan; simpangan baku adalah akar jumlah itu.",
      en: "It is the variances that add up; the standard deviation is the root of that sum.",
    };
  }
  if (isNear(value, s.sigma_w * Math.sqrt(steps(s)), NEAR)) {
    return {
      id: "Jangan lupa T: satu langkah menggeser sudut sebesar σ_w T.",
      en: "Do not forget T: a step moves the angle by σ_w T.",
    };
  }
  return {
    id: "Varians satu langkah (σ_w T)². Kalikan dengan {k} langkah, lalu ambil akarnya.",
    en: "One step has the variance (σ_w T)². Multiply by {k} steps, then take the root.",
  };
}

// --- about the map -----------------------------------------------------------------------------------------

const BOTH_TIMES = [0.2, 0.5, 2, 5]; // both sigmas wrong by the same factor
const PAIRS = [
  [3, 1],
  [1, 2],
  [2, 1],
]; // [times sigma_w, times sigma_v]

export function mapQuestion(r, s, t, random) {
  const c = BOTH_TIMES[random.whole(BOTH_TIMES.length)];
  const [times_w, times_v] = PAIRS[random.whole(PAIRS.length)];
  const q = ((s.sigma_w * s.T) / s.sigma_v) ** 2; // Q / R
  const given = { c: t.decimal(c), w: t.decimal(times_w), v: t.decimal(times_v), q: t.decimal(q, 4) };
  const kinds = [aboutNees, aboutRatio];
  const kind = kinds[random.whole(kinds.length)];
  return ask(kind({ c, ratio: times_w / times_v, q }), given, t);
}

function aboutNees({ c }) {
  return {
    text: {
      id:
        "Sebuah filter mengira {c} σ_w dan {c} σ_v. Dengan pasangan yang benar NEES-nya 1. " +
        "Berapa NEES-nya sekarang?",
      en: "A filter believes {c} σ_w and {c} σ_v. With the true pair its NEES is 1. What is it now?",
    },
    answer: 1 / c ** 2,
    hint(value) {
      if (isNear(value, c ** 2, NEAR)) {
        return {
          id: "Terbalik: P menjadi c² kali, dan NEES dibagi P.",
          en: "The other way round: P becomes c² times as large, and NEES is divided by P.",
        };
      }
      if (isNear(value, 1 / c, NEAR)) {
        return {
          id: "P berisi kuadrat simpangan baku: kuadratkan c.",
          en: "P holds squares of standard deviations: square c.",
        };
      }
      return {
        id: "K tidak berubah, jadi galatnya juga tidak; P menjadi c² kali.",
        en: "K does not change, so neither does the error; P becomes c² times as large.",
      };
    },
  };
}

function aboutRatio({ ratio, q }) {
  return {
    text: {
      id:
        "Sebuah filter mengira {w} σ_w dan {v} σ_v. Dengan yang benar q = Q/R = {q}. " +
        "Berapa q menurut filter itu?",
      en: "A filter believes {w} σ_w and {v} σ_v. The true q = Q/R is {q}. What is q as the filter has it?",
    },
    answer: q * ratio ** 2,
    tolerance: 0.02,
    hint(value) {
      if (isNear(value, q * ratio, NEAR)) {
        return {
          id: "q berisi kuadrat kedua simpangan baku.",
          en: "q holds the squares of both standard deviations.",
        };
      }
      return {
        id: "q = (σ_w T)² / σ_v²: kalikan dengan ({w} / {v})².",
        en: "q = (σ_w T)² / σ_v²: multiply by ({w} / {v})².",
      };
    },
  };
}
