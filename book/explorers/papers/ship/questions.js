// The hand check of chapter 4: four questions about a step in the middle, and a hint for each likely mistake.
import { ask, isNear } from "../../language/question.js";

const TOLERANCE = 0.02; // of the answer
const NEAR = 0.012; // so near to a wrong answer, and we know the mistake

export function question(r, s, t, random) {
  const { p, result, data } = r;
  const k = someStep(r, data.z, random);
  const step = {
    p,
    x_pred: result.x_pred[2 * k],
    P_pred: result.P_pred[4 * k],
    K: result.K[2 * k],
    x: result.x[2 * k],
    z: data.z[k],
    poles: r.poles,
  };
  const given = {
    k: String(k + 1),
    c: p.c,
    a1: p.a1,
    a2: p.a2,
    before: result.x[2 * k - 2],
    older: result.x[2 * k - 1],
    pred: step.x_pred,
    P: step.P_pred,
    K: step.K,
    z: step.z,
    R: p.R,
  };
  const about_poles = r.poles[0][1] > 0 ? aboutComplexPoles : aboutRealPoles;
  const kinds = [aboutPrediction, aboutGain, aboutUpdate, about_poles];
  const kind = kinds[random.whole(kinds.length)];
  return ask({ ...kind(step), tolerance: TOLERANCE }, given, t, 4);
}

/** A step between 30 and 60 % of the run whose measurement arrived. */
function someStep({ T }, z, random) {
  let k = Math.max(1, Math.floor(T * (0.3 + 0.3 * random.uniform())));
  while (k < T - 1 && Number.isNaN(z[k])) {
    k++;
  }
  return k;
}

/** The hand check of the poles by hand: one of the first forecasts. */
export function aboutForecast(r, s, t, random) {
  const k = 2 + random.whole(8);
  return nextAfter(r.s[k - 1], r.s[k - 2], [0, s.a1, s.a2], t);
}

/** The hand check of the noise: what the fitted model says after two of the measurements shown. */
export function aboutFit(r, s, t, random) {
  const k = 46 + random.whole(34);
  return nextAfter(r.z[k], r.z[k - 1], r.theta, t);
}

function nextAfter(last, before, [c, a1, a2], t) {
  const kind = {
    text: c === 0 ? NEXT.without_c : NEXT.with_c,
    answer: c + a1 * last + a2 * before,
    tolerance: TOLERANCE,
    hint: (value) => (isNear(value, c + a1 * before + a2 * last, NEAR) ? SWAPPED : SUM),
  };
  return ask(kind, { last, before, c, a1, a2 }, t, 4);
}

const NEXT = {
  without_c: {
    id:
      "a₁ = {a1}, a₂ = {a2}; kecepatan terakhir {last} m/s, sebelumnya {before} m/s. " +
      "Berikutnya (m/s, tiga angka penting)?",
    en:
      "a₁ = {a1}, a₂ = {a2}; the last speed {last} m/s, the one before {before} m/s. " +
      "What is next (m/s, three significant digits)?",
  },
  with_c: {
    id:
      "c = {c} m/s, a₁ = {a1}, a₂ = {a2}; kecepatan terakhir {last} m/s, sebelumnya {before} m/s. " +
      "Berikutnya (m/s, tiga angka penting)?",
    en:
      "c = {c} m/s, a₁ = {a1}, a₂ = {a2}; last speed {last} m/s, the one before {before} m/s. " +
      "What is next (m/s, three significant digits)?",
  },
};
const SWAPPED = {
  id: "Kedua kecepatan tertukar: a₁ milik yang terakhir.",
  en: "The two speeds are swapped: a₁ belongs to the last one.",
};
const SUM = {
  id: "c (bila ada), ditambah a₁ kali kecepatan terakhir, ditambah a₂ kali kecepatan sebelumnya.",
  en: "c (if there is one), plus a₁ times the last speed, plus a₂ times the one before.",
};

function aboutPrediction({ p, x_pred }) {
  return {
    text: {
      id:
        "Langkah {k}: c = {c} m/s, a₁ = {a1}, a₂ = {a2}; x sebelumnya = [{before}; {older}] m/s. " +
        "Berapa x_pred (m/s)?",
      en:
        "Step {k}: c = {c} m/s, a₁ = {a1}, a₂ = {a2}; x before = [{before}; {older}] m/s. " +
        "What is x_pred (m/s)?",
    },
    answer: x_pred,
    hint(value) {
      if (isNear(value, x_pred - p.c, NEAR)) {
        return { id: "Tinggal menambahkan c.", en: "Only c is missing." };
      }
      return {
        id: "x_pred = c + a₁ kali kecepatan terakhir + a₂ kali kecepatan sebelumnya.",
        en: "x_pred = c + a₁ times the last speed + a₂ times the one before.",
      };
    },
  };
}

function aboutGain({ p, P_pred }) {
  const S = P_pred + p.R;
  return {
    text: {
      id: "Langkah {k}: P_pred untuk kecepatan {P} m²/s² dan R = {R} m²/s². Berapa penguatan K?",
      en: "Step {k}: P_pred of the speed is {P} m²/s², R = {R} m²/s². What is the gain K?",
    },
    answer: P_pred / S,
    hint(value) {
      if (isNear(value, p.R / S, NEAR)) {
        return { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." };
      }
      return { id: "S = P_pred + R, lalu K = P_pred / S.", en: "S = P_pred + R, then K = P_pred / S." };
    },
  };
}

function aboutUpdate({ x_pred, z, K, x }) {
  return {
    text: {
      id:
        "Langkah {k}: x_pred = {pred} m/s, z = {z} m/s, K = {K}. " +
        "Berapa x sesudah pembaruan, sebelum penghalusan (m/s)?",
      en:
        "Step {k}: x_pred = {pred} m/s, z = {z} m/s, K = {K}. " +
        "What is x after the update, before any smoothing (m/s)?",
    },
    answer: x,
    hint(value) {
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

function aboutComplexPoles({ p }) {
  return {
    text: {
      id: "a₁ = {a1}, a₂ = {a2}: kutubnya kompleks. Berapa jauhnya dari nol, |λ|?",
      en: "a₁ = {a1}, a₂ = {a2}: the poles are complex. How far from zero are they, |λ|?",
    },
    answer: Math.sqrt(-p.a2),
    hint: () => ({
      id: "Hasil kali kedua kutub adalah −a₂, jadi |λ|² = −a₂.",
      en: "The product of both poles is −a₂, so |λ|² = −a₂.",
    }),
  };
}

function aboutRealPoles({ poles: [[largest], [other]] }) {
  return {
    text: {
      id: "a₁ = {a1}, a₂ = {a2}. Berapa kutub yang terbesar, yaitu akar terbesar λ² − a₁ λ − a₂ = 0?",
      en: "a₁ = {a1}, a₂ = {a2}. What is the largest pole, the largest root of λ² − a₁ λ − a₂ = 0?",
    },
    answer: largest,
    hint(value) {
      if (isNear(value, other, NEAR)) {
        return { id: "Itu kutub yang lain.", en: "That is the other pole." };
      }
      return { id: "λ = a₁/2 + √(a₁²/4 + a₂).", en: "λ = a₁/2 + √(a₁²/4 + a₂)." };
    },
  };
}
