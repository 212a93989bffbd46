// The hand check of chapter 6: four questions about one of the small filters, and a hint for each likely
// mistake.
import { ask, isNear } from "../../language/question.js";
import { AXES, DEG, GRAVITY, galat_of } from "./model.js";

const NEAR = 0.02; // so near to a wrong answer, and we know the mistake
const FACTORS = [0.16, 10, 100]; // m

export function question(r, s, t, random) {
  const axis = random.whole(2); // roll or pitch
  const variances = variancesAt(r, 3 * r.k + axis);
  const m = FACTORS[random.whole(FACTORS.length)];
  const yaw = { ahead: between(171, 179, random), z: -between(170, 179, random) }; // degrees, beside 180
  const means = meansOf(r, axis);
  const rest = atRest(random);
  const given = {
    axis: AXES[axis],
    time: t.decimal(r.flight.t[r.k], 4),
    P: t.decimal(variances.P_pred),
    R: t.decimal(variances.R),
    times: t.decimal(m),
    ahead: String(yaw.ahead),
    z: t.decimal(yaw.z),
    reference: t.decimal(means.reference, 4),
    estimate: t.decimal(means.estimate, 4),
    ax: t.decimal(rest.ax),
    az: t.decimal(rest.az),
  };
  const questions = [aboutGain({ ...variances, m }), aboutInnovation(yaw), aboutTilt(rest)];
  if (r.flight.reference === "truth") {
    questions.splice(2, 0, aboutError(means));
  }
  return ask(questions[random.whole(questions.length)], given, t);
}

/** P_pred and R at one place of the series, degrees squared. */
function variancesAt({ result }, at) {
  const R = result.R[at] / DEG ** 2;
  const P = result.P[at] / DEG ** 2;
  if (Number.isNaN(result.y[at])) {
    return { P_pred: P, R }; // no update in this step
  }
  const P_pred = P < R ? (P * R) / (R - P) : P; // P = P_pred R / (P_pred + R), turned round
  return { P_pred, R };
}

/** Means of the true angle and of the filter's, degrees. */
function meansOf(r, axis) {
  const { truth, mean } = r.measures();
  return { reference: truth[axis] / DEG, estimate: mean[axis] / DEG };
}

/** What an accelerometer shows that stands still with some pitch: {pitch degrees, ax, az m/s2}. */
function atRest(random) {
  const size = between(4, 30, random);
  const pitch = random.whole(2) === 1 ? size : -size;
  const ax = Number((GRAVITY * Math.sin(pitch * DEG)).toFixed(2));
  const az = -Number((GRAVITY * Math.cos(pitch * DEG)).toFixed(2));
  return { pitch, ax, az };
}

function between(low, high, random) {
  return low + random.whole(high - low + 1);
}

function aboutGain({ P_pred, R, m }) {
  return {
    text: {
      id:
        "Pada t = {time} s, untuk {axis}, P_pred = {P} deg² dan R = {R} deg². " +
        "Seandainya quadrotor dinamis dan m = {times}, berapa penguatan K sudutnya?",
      en:
        "At t = {time} s, for the {axis}, P_pred = {P} deg² and R = {R} deg². " +
        "If the quadrotor were dynamic and m = {times}, what would be the gain K of the angle?",
    },
    answer: P_pred / (P_pred + m * R),
    tolerance: 0.02,
    hint(value) {
      if (isNear(value, P_pred / (P_pred + R), NEAR)) {
        return { id: "Itu K tanpa m. Pakailah m R.", en: "That is K without m. Use m R." };
      }
      return {
        id: "K = P_pred / (P_pred + m R): m di bawah 1 memperbesar K.",
        en: "K = P_pred / (P_pred + m R): an m below 1 raises K.",
      };
    },
  };
}

function aboutInnovation({ ahead, z }) {
  return {
    text: {
      id: "Prediksi yaw {ahead}°, pengukurannya {z}°. Berapa inovasinya, dalam derajat?",
      en: "The predicted yaw is {ahead}°, the measured one {z}°. What is the innovation, in degrees?",
    },
    answer: 360 + z - ahead,
    hint(value) {
      if (isNear(value, z - ahead, NEAR)) {
        return { id: "Itu jalan yang jauh: tambahkan 360°.", en: "That is the long way round: add 360°." };
      }
      return {
        id: "Hitung z − x_pred, lalu tambahkan 360° supaya hasilnya antara −180° dan 180°.",
        en: "Take z − x_pred, then add 360° to bring it between −180° and 180°.",
      };
    },
  };
}

function aboutError({ reference, estimate }) {
  const rounded = (value) => Number(value.toPrecision(4)); // as the question shows it
  return {
    text: {
      id:
        "Rata-rata {axis} yang sebenarnya {reference}°, rata-rata filter {estimate}°. " +
        "Berapa galat menurut makalah, dalam persen?",
      en:
        "The mean of the true {axis} is {reference}°, that of the filter {estimate}°. " +
        "What is the error by the paper’s formula, in percent?",
    },
    answer: galat_of(rounded(reference), rounded(estimate)),
    tolerance: 0.02,
    hint(value) {
      if (isNear(100 * value, galat_of(reference, estimate), NEAR)) {
        return { id: "Dalam persen: kalikan 100.", en: "In percent: times 100." };
      }
      if (isNear(value, galat_of(estimate, reference), NEAR)) {
        return { id: "Bagilah dengan rata-rata yang sebenarnya.", en: "Divide by the true mean." };
      }
      return {
        id: "|rata-rata sebenarnya − rata-rata filter| / |rata-rata sebenarnya| × 100.",
        en: "|true mean − mean of the filter| / |true mean| × 100.",
      };
    },
  };
}

function aboutTilt({ pitch, ax, az }) {
  const radians = Math.atan2(ax, -az);
  return {
    text: {
      id:
        "Diam, akselerometer menunjukkan a_x = {ax}, a_y = 0, a_z = {az} m/s². " +
        "Berapa pitch, dalam derajat?",
      en:
        "At rest the accelerometer shows a_x = {ax}, a_y = 0, a_z = {az} m/s². " +
        "What is the pitch, in degrees?",
    },
    answer: radians / DEG,
    hint(value) {
      if (isNear(value, radians, NEAR)) {
        return { id: "Itu dalam radian: kalikan 180/π.", en: "That is in radians: times 180/π." };
      }
      if (isNear(value, -pitch, NEAR)) {
        return {
          id: "Hidung naik berarti pitch positif, dan a_x positif.",
          en: "Nose up means a positive pitch, and a positive a_x.",
        };
      }
      return { id: "pitch = arctan(a_x / √(a_y² + a_z²)).", en: "pitch = arctan(a_x / √(a_y² + a_z²))." };
    },
  };
}

// --- of the first explorer: one axis -----------------------------------------------------------------------

/** One update by hand, with whole numbers near those of the figure. */
export function gainQuestion(r, s, t, random) {
  const predicted = between(-5, 20, random); // degrees
  const z = predicted + between(2, 20, random);
  const K = FEW_GAINS[random.whole(FEW_GAINS.length)];
  const given = { predicted: String(predicted), z: String(z), K: t.decimal(K) };
  return ask(aboutUpdate({ predicted, z, K }), given, t);
}

const FEW_GAINS = [0.03, 0.1, 0.25];

function aboutUpdate({ predicted, z, K }) {
  return {
    text: {
      id:
        "Giroskop memprediksi {predicted}°, akselerometer menunjukkan {z}°, dan K = {K}. " +
        "Berapa estimasi sudutnya, dalam derajat?",
      en:
        "The gyroscope predicts {predicted}°, the accelerometer shows {z}°, and K = {K}. " +
        "What is the estimated angle, in degrees?",
    },
    answer: predicted + K * (z - predicted),
    hint(value) {
      if (isNear(value, K * (z - predicted), NEAR)) {
        return {
          id: "Itu koreksinya; tambahkan ke prediksi.",
          en: "That is the correction; add it to the prediction.",
        };
      }
      if (isNear(value, z - K * (z - predicted), NEAR)) {
        return { id: "Mulailah dari prediksi, bukan dari z.", en: "Start from the prediction, not from z." };
      }
      return { id: "x = x_pred + K (z − x_pred).", en: "x = x_pred + K (z − x_pred)." };
    },
  };
}
