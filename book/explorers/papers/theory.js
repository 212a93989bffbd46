// Chapter 1: a car on a line whose position is measured. Twin of kalman_lib/papers/theory.py, and its explorer.
import { kalmanFilter, linearModel } from "../filters.js";
import { generator, simulate as simulateModel } from "../random.js";

/** State [position m, velocity m/s], input the acceleration m/s2, measured: the position m. */
export function model(p) {
  return linearModel({ F: [[1, p.dt], [0, 1]], B: [[0], [p.dt]], H: [[1, 0]], Q: [[p.Q, 0], [0, p.Q]], R: p.R,
                       x0: [p.position, p.velocity], P0: [[p.P_position, 0], [0, p.P_velocity]] });
}

/** A drive with the constant input p.u. */
export function simulate(p, rng, steps = 10) {
  return simulateModel(model(p), steps, rng, new Float64Array(steps).fill(p.u));
}

export function run(p, { z, u }) {
  return kalmanFilter(model(p), z, u);
}

// --- the moments: 0 the start, 1 the prediction of step 1, 2 its update, 3, 4, ... -------------------------------------

const COUNT = 5, LAST = 2 * COUNT;
const stepOf = moment => Math.max(1, Math.ceil(moment / 2 - 1e-9));
const kindOf = moment => moment === 0 ? 0 : Math.ceil(moment) % 2 ? 1 : 2;
const zName = k => k === 1 ? "z" : `z${k}`;

/** The measurements of steps 2 to 5 that nobody chose: synthetic, with one digit, from the drive after the own start. */
function given(s) {
  const { z } = simulate(s, generator(s.seed), COUNT);
  return Array.from(z, value => Math.min(Math.max(Math.round(10 * value) / 10, -50), 50));
}

function compute(s) {
  const made = given(s), z = Float64Array.from({ length: COUNT }, (_, i) => s[zName(i + 1)] ?? made[i]);
  const result = run(s, { z, u: new Float64Array(COUNT).fill(s.u) }), m = model(s);
  const belief = (x, P, k) => ({ x: Array.from(x.subarray(2 * k, 2 * k + 2)), P: [0, 1, 3].map(i => P[4 * k + i]) });
  const beliefs = [{ x: Array.from(m.x0), P: [m.P0[0], m.P0[1], m.P0[3]] }];
  for (let k = 0; k < COUNT; k++) beliefs.push(belief(result.x_pred, result.P_pred, k), belief(result.x, result.P, k));
  const moment = Math.min(Math.max(s.moment, 0), LAST), before = Math.floor(moment), after = Math.ceil(moment), share = moment - before;
  const mix = (a, b) => a.map((value, i) => value + share * (b[i] - value));
  const now = { x: mix(beliefs[before].x, beliefs[after].x), P: mix(beliefs[before].P, beliefs[after].P) };
  return { moment, k: stepOf(moment), kind: kindOf(moment), z, result, model: m, beliefs, now, limits: limits(beliefs, z) };
}

/** What holds every belief and measurement, in whole steps, so that the axes rest while things move. */
function limits(beliefs, z) {
  const span = (i, step) => {
    const reach = beliefs.map(({ P }) => 2.5 * Math.sqrt(P[2 * i])), extra = i === 0 ? Array.from(z, value => value) : [];
    const low = Math.min(...beliefs.map(({ x }, j) => x[i] - reach[j]), ...extra.map(value => value - 0.5));
    const high = Math.max(...beliefs.map(({ x }, j) => x[i] + reach[j]), ...extra.map(value => value + 0.5));
    return [step * Math.floor(low / step), step * Math.ceil(high / step)];
  };
  return { x: span(0, 2), v: span(1, 2) };
}

/** The bell curve of a mean and a variance over the limits. */
function bell(mean, variance, [low, high]) {
  const sigma = Math.sqrt(variance), from = Math.max(low, mean - 5 * sigma), to = Math.min(high, mean + 5 * sigma), count = 121;
  const x = new Float64Array(count), y = new Float64Array(count);
  for (let i = 0; i < count; i++) {
    x[i] = from + (to - from) * i / (count - 1);
    y[i] = Math.exp(-((x[i] - mean) ** 2) / (2 * variance)) / (sigma * Math.sqrt(2 * Math.PI));
  }
  return { x, y };
}

/** The beliefs that are shown at this moment: [look, label, belief]; the last one may be on its way. */
function shown({ kind, k, beliefs, now }) {
  if (kind === 0) return [["estimate", "x_0", beliefs[0]]];
  if (kind === 1) return [["estimate", `x_${k - 1}`, beliefs[2 * k - 2]], ["prediction", "x_pred", now]];
  return [["prediction", "x_pred", beliefs[2 * k - 1]], ["estimate", `x_${k}`, now]];
}

function plane(r, s) {
  const { x, v } = r.limits, R = r.model.R[0], z = r.z[r.k - 1], deviation = 2 * Math.sqrt(R);
  return { xlim: x, ylim: v, layers: [
    ...(r.kind === 2 ? [{ look: "measurement", paint(ctx, X, Y) {
      ctx.globalAlpha = 0.14;
      ctx.fillRect(X(z - deviation), 0, X(z + deviation) - X(z - deviation), Y(v[0]));
      ctx.globalAlpha = 1;
    } }, { look: "measurement", at: z, label: "z ± 2√R" }] : []),
    ...shown(r).map(([look, label, belief]) => ({ look, label, ellipse: belief })),
  ] };
}

function bells(r) {
  const R = r.model.R[0], z = r.z[r.k - 1], known = shown(r).map(([look, label, { x, P }]) => [look, label, x[0], P[0]]);
  if (r.kind === 2) known.splice(1, 0, ["measurement", "z", z, R]);
  const { k, kind } = r, ends = kind === 0 ? [0] : kind === 1 ? [2 * k - 2, 2 * k - 1] : [2 * k - 1, 2 * k];
  const least = Math.min(kind === 2 ? R : Infinity, ...ends.map(i => r.beliefs[i].P[0]));
  const top = 2 ** Math.ceil(Math.log2(1.05 / Math.sqrt(2 * Math.PI * least)));
  return { xlim: r.limits.x, ylim: [0, top], layers: known.map(([look, label, mean, variance]) => {
    const curve = bell(mean, variance, r.limits.x);
    if (look !== "measurement") return { look, label, ...curve };
    return { look, label, paint(ctx, X, Y) {                // its dots are dots elsewhere; here it is a curve of dots
      ctx.setLineDash([2, 3]);
      ctx.lineWidth = 2.4;
      ctx.beginPath();
      curve.x.forEach((x, i) => ctx.lineTo(X(x), Y(curve.y[i])));
      ctx.stroke();
    } };
  }) };
}

/** The pointer takes the measurement of this step along. */
function drag(x, y, s, r) {
  return r.kind === 2 ? { [zName(r.k)]: x } : null;
}

// --- words and numbers ----------------------------------------------------------------------------------------------

const TITLES = [{ id: "Awal.", en: "Start." }, { id: "Langkah {k} dari {of}: prediksi.", en: "Step {k} of {of}: prediction." }, { id: "Langkah {k} dari {of}: pembaruan.", en: "Step {k} of {of}: update." }];
const TEXTS = [
  { id: "Sebelum pengukuran pertama, mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s; simpangan bakunya {sx} m dan {sv} m/s.",
    en: "Before the first measurement the car is believed to be at {x} m with a velocity of {v} m/s; the standard deviations are {sx} m and {sv} m/s." },
  { id: "{dt} s kemudian mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s. Simpangan baku posisi berubah dari {before} m menjadi {sx} m.",
    en: "{dt} s later the car is expected at {x} m with a velocity of {v} m/s. The standard deviation of the position goes from {before} m to {sx} m." },
  { id: "K = {K}: {percent} % dari selisih {y} m antara pengukuran dan prediksi diterima. Simpangan baku posisi berubah dari {before} m menjadi {sx} m. {origin}",
    en: "K = {K}: {percent} % of the difference of {y} m between measurement and prediction is accepted. The standard deviation of the position goes from {before} m to {sx} m. {origin}" },
];
const ORIGINS = {
  source: { id: "Pengukuran ini dari contoh pada sumber.", en: "This measurement comes from the source." },
  synthetic: { id: "Pengukuran ini sintetis (benih acak {seed}).", en: "This measurement is synthetic (random seed {seed})." },
  yours: { id: "Pengukuran ini pilihan Anda.", en: "This measurement is your choice." },
};

function outcome(r, s, t) {
  const { k, kind, result, beliefs } = r, at = Math.ceil(r.moment), { x, P } = beliefs[at];
  const own = k > 1 ? s[zName(k)] !== null : s.z !== 2.2, origin = own ? "yours" : k === 1 ? "source" : "synthetic";
  return [t.say(TITLES[kind], { k: String(k), of: String(COUNT) }),
          t.say(TEXTS[kind], { x: x[0], v: x[1], sx: Math.sqrt(P[0]), sv: Math.sqrt(P[2]), dt: s.dt, before: Math.sqrt(beliefs[Math.max(at - 1, 0)].P[0]),
                               K: result.K[2 * k - 2], y: result.y[k - 1], percent: t.decimal(100 * result.K[2 * k - 2], 2), origin: t.say(ORIGINS[origin], { seed: String(s.seed) }) })].join(" ");
}

function equations(r, s, t) {
  const { k, kind, result, beliefs, model: m } = r, d = value => t.decimal(value, 4).replace(/ × 10(.*)/, "·10$1"), signed = value => value < 0 ? `( ${d(value)} )` : d(value);
  const column = x => ({ matrix: Array.from(x, value => [d(value)]) }), row = x => ({ matrix: [Array.from(x, d)] });
  const square = P => ({ matrix: P.length === 3 ? [[d(P[0]), d(P[1])], [d(P[1]), d(P[2])]] : [[d(P[0]), d(P[1])], [d(P[2]), d(P[3])]] });
  const before = beliefs[2 * k - 2], pred = beliefs[2 * k - 1], after = beliefs[2 * k];
  if (kind === 0) {
    return [["x_0 =", column(before.x), "P_0 =", square(before.P)], ["F =", square(m.F), "B =", column(m.B)],
            ["H =", row(m.H), "Q =", square(m.Q)], [`R = ${d(m.R[0])}`, `u = ${d(s.u)}`]];
  }
  if (kind === 1) {
    return [["x_pred = F x + B u"], ["=", square(m.F), column(before.x), "+", column(m.B), signed(s.u)], ["=", column(pred.x)],
            ["P_pred = F P F^T + Q"], ["=", square(m.F), square(before.P), square([m.F[0], m.F[2], m.F[1], m.F[3]]), "+", square(m.Q)], ["=", square(pred.P)]];
  }
  const K = result.K.subarray(2 * k - 2, 2 * k), y = result.y[k - 1], S = result.S[k - 1];
  return [[`y = z \u2212 H x_pred = ${d(r.z[k - 1])} \u2212 ${signed(pred.x[0])} = ${d(y)}`],
          [`S = H P_pred H^T + R = ${d(pred.P[0])} + ${d(m.R[0])} = ${d(S)}`],
          ["K = P_pred H^T S^\u22121 =", column([pred.P[0], pred.P[1]]), `/ ${d(S)} =`, column(K)],
          ["x = x_pred + K y =", column(pred.x), "+", column(K), `${signed(y)} =`, column(after.x)],
          ["P = ( I \u2212 K H ) P_pred"], ["=", square([1 - K[0], 0, -K[1], 1]), square(pred.P), "=", square(after.P)]];
}

function numbers(r, s, t) {
  const d = value => t.decimal(value, 4), rows = [];
  r.beliefs.forEach(({ x, P }, moment) => {
    const k = stepOf(moment), kind = kindOf(moment);
    rows.push([t.say(TITLES[kind], { k: String(k), of: String(COUNT) }), d(x[0]), d(x[1]), ...P.map(d), ...(kind === 2 ? [r.z[k - 1], r.result.y[k - 1], r.result.S[k - 1], r.result.K[2 * k - 2], r.result.K[2 * k - 1]].map(d) : ["", "", "", "", ""])]);
  });
  return { head: ["", "p (m)", "v (m/s)", "P_11 (m²)", "P_12 (m²/s)", "P_22 (m²/s²)", "z (m)", "y (m)", "S (m²)", "K_1", "K_2 (1/s)"], rows };
}

// --- the hand check -------------------------------------------------------------------------------------------------

function question(r, s, t, random) {
  const k = Math.max(1, r.moment > 0 ? r.k : 1 + random.whole(COUNT)), near = (a, b) => Math.abs(a - b) <= 0.012 * Math.abs(b);
  const before = r.beliefs[2 * k - 2], pred = r.beliefs[2 * k - 1], K = r.result.K[2 * k - 2], S = r.result.S[k - 1], R = s.R;
  const given = { k: String(k), p: before.x[0], v: before.x[1], dt: s.dt, u: s.u, pred: pred.x[0], P: pred.P[0], R, z: r.z[k - 1], K, S, a: before.P[0], b: before.P[1], c: before.P[2], Q: s.Q };
  const kinds = [
    { text: { id: "Langkah {k}: P_pred untuk posisi {P} m² dan R = {R} m². Berapa penguatan K untuk posisi?", en: "Step {k}: P_pred of the position is {P} m², R = {R} m². What is the gain K of the position?" },
      answer: K, hint: value => near(value, 1 - K) ? { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." } : near(value, S) ? { id: "Itu S. Bagilah P_pred dengan S.", en: "That is S. Divide P_pred by S." } : { id: "S = P_pred + R, lalu K = P_pred / S.", en: "S = P_pred + R, then K = P_pred / S." } },
    { text: { id: "Langkah {k}: p = {p} m, v = {v} m/s, Δt = {dt} s. Di mana posisi mobil diprediksi (m)?", en: "Step {k}: p = {p} m, v = {v} m/s, Δt = {dt} s. Where is the car predicted to be (m)?" },
      answer: pred.x[0], hint: value => near(value, before.x[1] + s.dt * s.u) ? { id: "Itu kecepatan yang diprediksi; yang ditanyakan posisinya.", en: "That is the predicted velocity; the position was asked for." } : { id: "Baris pertama F x + B u: p + Δt v. Percepatannya baru mengubah kecepatan.", en: "The first row of F x + B u: p + Δt v. The acceleration changes only the velocity yet." } },
    { text: { id: "Langkah {k}: prediksi {pred} m, pengukuran {z} m, K = {K} untuk posisi. Berapa posisi sesudah pembaruan (m)?", en: "Step {k}: prediction {pred} m, measurement {z} m, K = {K} for the position. What is the position after the update (m)?" },
      answer: r.beliefs[2 * k].x[0], hint: value => near(value, K * (r.z[k - 1] - pred.x[0])) ? { id: "Itu baru koreksinya; tambahkan prediksinya.", en: "That is only the correction; add the prediction." } : { id: "y = z − prediksi, lalu prediksi + K y.", en: "y = z − prediction, then prediction + K y." } },
    { text: { id: "Langkah {k}: P = [{a}; {b} | {b}; {c}], Δt = {dt} s, Q = {Q}. Berapa P_pred untuk posisi (m²)?", en: "Step {k}: P = [{a}; {b} | {b}; {c}], Δt = {dt} s, Q = {Q}. What is P_pred of the position (m²)?" },
      answer: pred.P[0], hint: value => near(value, pred.P[0] - s.Q) ? { id: "Tinggal menambahkan Q.", en: "Only Q is missing." } : near(value, before.P[0] + s.Q) ? { id: "Ketidakpastian kecepatan ikut terbawa: Δt² P₂₂ dan 2 Δt P₁₂.", en: "The uncertainty of the velocity comes along: Δt² P₂₂ and 2 Δt P₁₂." } : { id: "Kiri atas F P Fᵀ + Q: P₁₁ + 2 Δt P₁₂ + Δt² P₂₂ + Q.", en: "Top left of F P Fᵀ + Q: P₁₁ + 2 Δt P₁₂ + Δt² P₂₂ + Q." } },
  ];
  const kind = kinds[random.whole(kinds.length)];
  return { text: t.say(kind.text, given, 4), answer: kind.answer, tolerance: 0.01, hint: value => t.say(kind.hint(value), given, 4) };
}

// --- the view -------------------------------------------------------------------------------------------------------

const own = s => s.example === "own";
const move = by => s => ({ moment: Math.min(Math.max(Math.round(s.moment) + by, 0), LAST) });
const measured = k => ({
  name: zName(k), symbol: `z_${k}`, id: "posisi terukur", en: "measured position", unit: "m", min: k === 1 ? -5 : -50, max: k === 1 ? 10 : 50, step: 0.1, log: false,
  ...(k > 1 && { default: null, auto: s => given(s)[k - 1] }),
  visible: s => stepOf(s.moment) === k, disabled: s => kindOf(s.moment) !== 2,
});

export const views = {
  steps: {
    name: { id: "Filter selangkah demi selangkah", en: "The filter, one step at a time" },
    start: { moment: 2 },
    controls: [
      { kind: "buttons", items: [
        { id: "Sebelumnya", en: "Previous", set: move(-1), glide: 500, disabled: s => s.moment <= 0 },
        { id: "Berikutnya", en: "Next", set: move(1), glide: 500, disabled: s => s.moment >= LAST }] },
      { name: "moment", id: "saat: awal, prediksi, pembaruan, ...", en: "moment: start, prediction, update, ...", unit: "", min: 0, max: LAST, step: 1, log: false, default: 2 },
      ...[1, 2, 3, 4, 5].map(measured),
      { name: "Q", symbol: "Q" },
      { name: "R", symbol: "R" },
      { kind: "select", name: "example", default: "worked", id: "Contoh", en: "Example", options: [["worked", { id: "contoh pada sumber", en: "the worked example" }], ["own", { id: "contoh sendiri", en: "an example of my own" }]] },
      { name: "dt", symbol: "Δt", visible: own }, { name: "u", symbol: "u", visible: own },
      { name: "position", symbol: "p_0", visible: own }, { name: "velocity", symbol: "v_0", visible: own },
      { name: "P_position", symbol: "P_11", visible: own }, { name: "P_velocity", symbol: "P_22", visible: own },
    ],
    noise: true,
    compute,
    plots: [
      { title: { id: "Posisi dan kecepatan (m/s)", en: "Position and velocity (m/s)" }, xlabel: "p (m)", height: 250, draw: plane, drag,
        alt: { id: "Elips kovarians (dua simpangan baku) di bidang posisi dan kecepatan, sebelum dan sesudah langkah ini.", en: "Covariance ellipses (two standard deviations) in the plane of position and velocity, before and after this step." } },
      { title: { id: "Posisi saja", en: "The position alone" }, xlabel: "p (m)", height: 170, draw: bells, drag,
        alt: { id: "Kurva lonceng posisi: prediksi, pengukuran, dan estimasi.", en: "Bell curves of the position: prediction, measurement and estimate." } },
    ],
    outcome, equations, numbers, question,
  },
};
