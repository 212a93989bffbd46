// The hand check of chapter 5: four questions about the initial guess, and a hint for each likely mistake.
import { ask, isNear } from "../../language/question.js";

const TOLERANCE = 0.01; // of the answer
const NEAR = 0.012; // so near to a wrong answer, and we know the mistake

export function question(r, s, t, random) {
  const cosine = Math.cos(s.theta0);
  const sine = Math.sin(s.theta0);
  const other = 0.1 * (2 + random.whole(9)); // rad, the direction of another beetle
  const guess = {
    away: s.v0 * cosine, // cm/s
    other_cosine: Math.cos(other),
    P_pred: firstVariance(s, sine, cosine),
  };
  const given = {
    d: s.d0,
    theta: s.theta0,
    v: s.v0,
    dt: s.dt,
    c: cosine,
    n: sine,
    P: guess.P_pred,
    R: s.R,
    s: guess.away,
    other,
    co: guess.other_cosine,
    sd: s.sigma_d,
    st: s.sigma_theta,
    sv: s.sigma_v,
  };
  const kinds = [aboutPrediction, aboutOther, aboutVariance, aboutGain];
  const kind = kinds[random.whole(kinds.length)];
  return ask({ ...kind(guess, s), tolerance: TOLERANCE }, given, t, 4);
}

/** About two beetles that move away equally fast, s = `away` cm/s. */
export function questionOfOthers(away, t, random) {
  const other = 0.1 * (2 + random.whole(9)); // rad
  const co = Math.cos(other);
  const given = { s: away, other, co, speed: away / co };
  const kinds = [aboutAway, aboutOther];
  const kind = kinds[random.whole(kinds.length)];
  return ask({ ...kind({ away, other_cosine: co }), tolerance: TOLERANCE }, given, t, 4);
}

/**
 * P_pred of d in the first step, cm^2: the first row of F, times the initial standard deviations, squared.
 */
function firstVariance(s, sine, cosine) {
  const by_theta = s.dt * s.v0 * sine * s.sigma_theta;
  const by_v = s.dt * cosine * s.sigma_v;
  return s.sigma_d ** 2 + by_theta ** 2 + by_v ** 2;
}

function aboutPrediction({ away }, s) {
  return {
    text: {
      id:
        "Tebakan awal: d = {d} cm, θ = {theta} rad (cos θ = {c}), v = {v} cm/s; Δt = {dt} s. " +
        "Berapa d_pred (cm)?",
      en:
        "Initial guess: d = {d} cm, θ = {theta} rad (cos θ = {c}), v = {v} cm/s; Δt = {dt} s. " +
        "What is d_pred (cm)?",
    },
    answer: s.d0 + s.dt * away,
    hint(value) {
      if (isNear(value, s.d0 + s.dt * s.v0, NEAR)) {
        return {
          id: "Hanya bagian cos θ dari jalannya yang menambah jarak.",
          en: "Only the share cos θ of the walk adds to the distance.",
        };
      }
      return { id: "d_pred = d + Δt v cos θ.", en: "d_pred = d + Δt v cos θ." };
    },
  };
}

function aboutAway({ away, other_cosine }) {
  const speed = away / other_cosine;
  return {
    text: {
      id:
        "Seekor kumbang berjalan {speed} cm/s ke arah θ = {other} rad (cos θ = {co}). " +
        "Berapa cm/s jaraknya dari tepi bertambah?",
      en:
        "A beetle walks at {speed} cm/s in the direction θ = {other} rad (cos θ = {co}). " +
        "By how many cm/s does its distance from the edge grow?",
    },
    answer: away,
    hint(value) {
      if (isNear(value, speed, NEAR)) {
        return {
          id: "Itu seluruh jalannya; hanya bagian cos θ yang menambah jarak.",
          en: "That is all of its walk; only the share cos θ adds to the distance.",
        };
      }
      return { id: "Kalikan v dengan cos θ.", en: "Multiply v by cos θ." };
    },
  };
}

function aboutOther({ away, other_cosine }) {
  return {
    text: {
      id:
        "Seekor kumbang menjauh dengan s = v cos θ = {s} cm/s. " +
        "Kumbang lain berjalan ke arah θ = {other} rad (cos θ = {co}) dan menjauh sama cepatnya. " +
        "Berapa lajunya (cm/s)?",
      en:
        "A beetle moves away with s = v cos θ = {s} cm/s. " +
        "Another one walks at θ = {other} rad (cos θ = {co}) and moves away equally fast. " +
        "What is its speed (cm/s)?",
    },
    answer: away / other_cosine,
    hint(value) {
      if (isNear(value, away * other_cosine, NEAR)) {
        return {
          id: "Bagilah dengan cos θ; yang berjalan serong harus lebih cepat.",
          en: "Divide by cos θ; who walks at a slant must be faster.",
        };
      }
      return {
        id: "v = s / cos θ. Dari jarak saja kedua kumbang itu tidak dapat dibedakan.",
        en: "v = s / cos θ. From the distance alone the two cannot be told apart.",
      };
    },
  };
}

function aboutVariance({ P_pred }, s) {
  return {
    text: {
      id:
        "Langkah pertama: Δt = {dt} s, v = {v} cm/s, sin θ = {n}, cos θ = {c}; " +
        "simpangan baku awal {sd} cm, {st} rad, {sv} cm/s. Berapa P_pred untuk d (cm²)?",
      en:
        "First step: Δt = {dt} s, v = {v} cm/s, sin θ = {n}, cos θ = {c}; " +
        "initial standard deviations {sd} cm, {st} rad, {sv} cm/s. What is P_pred of d (cm²)?",
    },
    answer: P_pred,
    hint(value) {
      if (isNear(value, s.sigma_d ** 2, NEAR)) {
        return {
          id: "Ketidakpastian θ dan v ikut terbawa.",
          en: "The uncertainty of θ and v comes along.",
        };
      }
      return {
        id:
          "Baris pertama F adalah [1, −Δt v sin θ, Δt cos θ]; " +
          "kuadratkan setiap hasil kalinya dengan simpangan bakunya, lalu jumlahkan.",
        en:
          "The first row of F is [1, −Δt v sin θ, Δt cos θ]; " +
          "square each product with its standard deviation, then add up.",
      };
    },
  };
}

function aboutGain({ P_pred }, s) {
  const S = P_pred + s.R;
  return {
    text: {
      id:
        "Langkah pertama: P_pred untuk d = {P} cm² dan R = {R} cm². " +
        "Berapa penguatan K untuk d, hanya dari pengukuran jarak?",
      en:
        "First step: P_pred of d = {P} cm², R = {R} cm². " +
        "What is the gain K of d, from the distance alone?",
    },
    answer: P_pred / S,
    hint(value) {
      if (isNear(value, s.R / S, NEAR)) {
        return { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." };
      }
      return { id: "S = P_pred + R, lalu K = P_pred / S.", en: "S = P_pred + R, then K = P_pred / S." };
    },
  };
}
