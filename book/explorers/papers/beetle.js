// Chapter 5: a beetle walks away from a sink, the extended Kalman filter. Twin of kalman_lib/papers/beetle.py, and its explorer.
import { kalmanFilter, nonlinearModel } from "../filters.js";
import { chi2Bounds, mean, nis, rmse } from "../metrics.js";
import { generator, simulate as simulateModel } from "../random.js";

const PRINTED_R = [0.001, 0.05, 0.08, 0.1], SECONDS = 20;

/** State [d cm, theta rad, v cm/s], measured: d. */
export function model(p) {
  const { dt } = p;
  return nonlinearModel({
    f(x, u, out) {
      out[0] = x[0] + dt * x[2] * Math.cos(x[1]);
      out[1] = x[1];
      out[2] = x[2];
    },
    F(x, u, out) {
      out.fill(0);
      out[0] = out[4] = out[8] = 1;
      out[1] = -dt * x[2] * Math.sin(x[1]);
      out[2] = dt * Math.cos(x[1]);
    },
    h(x, out) { out[0] = x[0]; },
    H(x, out) { out[0] = 1; out[1] = out[2] = 0; },
    Q: [[0, 0, 0], [0, p.Q_theta, 0], [0, 0, p.Q_v]], R: p.R, x0: [p.d0, p.theta0, p.v0],
    P0: [[p.sigma_d ** 2, 0, 0], [0, p.sigma_theta ** 2, 0], [0, 0, p.sigma_v ** 2]],
  });
}

/** A second sensor: state [d, theta, v, l], measured: d and the bearing atan2(l, d) of the beetle from the edge, rad. */
export function bearing_model(p) {
  const { dt } = p;
  return nonlinearModel({
    m: 2,
    f(x, u, out) {
      out[0] = x[0] + dt * x[2] * Math.cos(x[1]);
      out[1] = x[1];
      out[2] = x[2];
      out[3] = x[3] + dt * x[2] * Math.sin(x[1]);
    },
    F(x, u, out) {
      out.fill(0);
      out[0] = out[5] = out[10] = out[15] = 1;
      out[1] = -dt * x[2] * Math.sin(x[1]);
      out[2] = dt * Math.cos(x[1]);
      out[13] = dt * x[2] * Math.cos(x[1]);
      out[14] = dt * Math.sin(x[1]);
    },
    h(x, out) { out[0] = x[0]; out[1] = Math.atan2(x[3], x[0]); },
    H(x, out) {
      const r2 = x[0] ** 2 + x[3] ** 2;
      out.fill(0);
      out[0] = 1;
      out[4] = -x[3] / r2;
      out[7] = x[0] / r2;
    },
    Q: [[0, 0, 0, 0], [0, p.Q_theta, 0, 0], [0, 0, p.Q_v, 0], [0, 0, 0, 0]], R: [[p.R, 0], [0, p.R_bearing]], x0: [p.d0, p.theta0, p.v0, 0],
    P0: [[p.sigma_d ** 2, 0, 0, 0], [0, p.sigma_theta ** 2, 0, 0], [0, 0, p.sigma_v ** 2, 0], [0, 0, 0, p.sigma_d ** 2]],
  });
}

/** A walk with the true direction and speed, from d0, and its noisy distances (and bearings). */
export function simulate(p, rng, steps = 40, bearing = false) {
  const [make, x0] = bearing ? [bearing_model, [p.d0, p.theta, p.v, 0]] : [model, [p.d0, p.theta, p.v]];
  return simulateModel(make({ ...p, R: p.R_true }), steps, rng, null, x0);
}

export function run(p, { z }) {
  return kalmanFilter(model(p), z);
}

/** Standard deviation of s = v cos(theta) to first order, for x (T n), P (T n n): (T). */
export function away_sigma(x, P, n = 3) {
  return Float64Array.from({ length: x.length / n }, (_, k) => {
    const [, theta, v] = x.subarray(k * n, k * n + 3), by_theta = -v * Math.sin(theta), by_v = Math.cos(theta), at = k * n * n + n + 1;
    return Math.sqrt(by_theta ** 2 * P[at] + by_theta * by_v * (P[at + 1] + P[at + n]) + by_v ** 2 * P[at + n + 1]);
  });
}

export const twins = { away_sigma: (p, data, result) => away_sigma(result.x, result.P) };

// --- what is shown --------------------------------------------------------------------------------------------------

/** Everything over time, from the initial guess (k = 0) to the last step (k = T). */
function compute(s, memo) {
  const T = Math.round(SECONDS / s.dt), n = s.bearing ? 4 : 3, m = s.bearing ? 2 : 1;
  const walk = simulate(s, generator(s.seed), T, s.bearing), start = (s.bearing ? bearing_model : model)(s);
  const result = memo.result = kalmanFilter(start, walk.z, null, { into: memo.result });
  const joined = (first, rest) => { const all = new Float64Array(first.length + rest.length); all.set(first); all.set(rest, first.length); return all; };
  const x = joined(start.x0, result.x), P = joined(start.P0, result.P);
  const over = value => Float64Array.from({ length: T + 1 }, (_, k) => value(k));
  const state = i => {
    const sigma = over(k => Math.sqrt(Math.max(P[(k * n + i) * n + i], 0))), value = over(k => x[k * n + i]);
    return { x: value, sigma, low: over(k => value[k] - 2 * sigma[k]), high: over(k => value[k] + 2 * sigma[k]), share: over(k => sigma[k] / sigma[0]) };
  };
  const [d, theta, v] = [0, 1, 2].map(state), sigma = away_sigma(x, P, n);
  const s_away = { x: over(k => v.x[k] * Math.cos(theta.x[k])), sigma, share: over(k => sigma[k] / sigma[0]) };
  const true_d = over(k => s.d0 + k * s.dt * s.v * Math.cos(s.theta));         // direction and speed of the walk stay: Q is 0
  const of_z = over(k => k ? true_d[k] - walk.z[(k - 1) * m] : NaN), of_x = over(k => true_d[k] - d.x[k]);
  const band = over(k => 2 * d.sigma[k]), minus = band.map(value => -value);
  return { T, n, m, k: Math.min(Math.floor(s.moment / s.dt + 1e-9), T), walk, result, start, x, P, t: over(k => k * s.dt), d, theta, v, s: s_away, true_d, of_z, of_x, band, minus,
           rmse: rmse(true_d.subarray(1), d.x.subarray(1))[0], nis: mean(nis(result.y, result.S, m)) };
}

/** A beetle of a few strokes, seen from above, its head towards theta; its legs move with the way it has gone. */
function drawBeetle(ctx, a, b, theta, way) {
  ctx.save();
  ctx.translate(a, b);
  ctx.rotate(theta);
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  for (const side of [-1, 1]) {
    for (const leg of [-1, 0, 1]) {
      const swing = 2.5 * Math.sin(3 * way + (leg + side) * Math.PI / 2);
      ctx.moveTo(side * 3, 3.5 * leg);
      ctx.lineTo(side * 8, 5 * leg + swing);
      ctx.lineTo(side * 10, 6.5 * leg + swing + 1);
    }
    ctx.moveTo(side, -10);
    ctx.quadraticCurveTo(side * 2, -14, side * 4.5, -14.5);
  }
  ctx.stroke();
  ctx.beginPath();
  ctx.arc(0, -8.5, 3, 0, 7);
  ctx.ellipse(0, 0, 5, 7.5, 0, 0, 7);
  ctx.fill();
  ctx.globalCompositeOperation = "destination-out";
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(0, -6);
  ctx.lineTo(0, 7.5);
  ctx.stroke();
  ctx.restore();
}

/** The top view: across, the way along the edge (cm); upwards, the distance from it. */
function scene(r, s) {
  const { k, n, m } = r, clock = s.moment, d = s.d0 + clock * s.v * Math.cos(s.theta), l = clock * s.v * Math.sin(s.theta);
  const end = [s.d0 + SECONDS * s.v * Math.cos(s.theta), SECONDS * s.v * Math.sin(s.theta)], far = 24 * s.v + 5;
  const toward = (angle, reach) => reach * Math.tan(Math.min(Math.max(angle, -1.5), 1.5));
  const ends = [r.theta.low[r.T], r.theta.high[r.T]].map(angle => Math.min(Math.max(toward(angle, end[0] - s.d0), -far), far)), room = 0.06 * (end[0] + 10);
  const xlim = [Math.min(0, end[1], ...ends) - room, Math.max(0, end[1], ...ends) + room], ylim = [-room, end[0] + 1.5 * room];
  const estimate = r.d.x[k], reach = Math.max(estimate - s.d0, 0.12 * (ylim[1] - ylim[0])), z = k && r.walk.z[(k - 1) * m];
  const fan = [r.theta.low[k], r.theta.high[k]].map(angle => toward(angle, reach)), across = s.bearing ? r.x[k * n + 3] : toward(r.theta.x[k], estimate - s.d0);
  return { xlim, ylim, layers: [
    { look: "quiet", paint(ctx, X, Y) { ctx.globalAlpha = 0.2; ctx.fillRect(0, Y(0), 1e4, 1e4); ctx.globalAlpha = 1; } },
    { look: "quiet", level: 0, label: { id: "tepi wastafel", en: "edge of the sink" } },
    { look: "band", label: "d ± 2σ_d, θ ± 2σ_θ", paint(ctx, X, Y, colours) {
      ctx.beginPath();
      ctx.moveTo(X(fan[0]), Y(s.d0 + reach));
      ctx.lineTo(X(0), Y(s.d0));
      ctx.lineTo(X(fan[1]), Y(s.d0 + reach));
      ctx.fill();
      ctx.fillRect(0, Y(r.d.high[k]), 1e4, Math.max(Y(r.d.low[k]) - Y(r.d.high[k]), 3));
      ctx.strokeStyle = colours.estimate;
      ctx.lineWidth = 1;
      ctx.stroke();
    } },
    { look: "truth", x: [0, l], y: [s.d0, d] },
    k > 0 && { look: "measurement", label: "z", paint(ctx, X, Y) {
      ctx.setLineDash([2, 4]);
      ctx.beginPath();
      ctx.moveTo(X(l), Y(0));
      ctx.lineTo(X(l), Y(z));
      if (s.bearing) { ctx.moveTo(X(0), Y(0)); ctx.lineTo(X(z * Math.tan(r.walk.z[(k - 1) * m + 1])), Y(z)); }
      ctx.stroke();
    } },
    { look: "truth", label: { id: "kumbang", en: "beetle" }, paint(ctx, X, Y) { drawBeetle(ctx, X(l), Y(d), s.theta, clock * s.v); } },
    s.bearing && { look: "estimate", ellipse: { x: [across, estimate], P: [r.P[k * 16 + 15], r.P[k * 16 + 3], r.P[k * 16]] } },
    { look: "estimate", label: "x", paint(ctx, X, Y) {                          // a ring around the place where the filter has it
      ctx.beginPath();
      ctx.arc(X(across), Y(estimate), 15, 0, 7);
      ctx.stroke();
    } },
  ] };
}

/** A state over time with its band, the truth, and the moment that the top view shows. */
const course = (name, truth) => (r, s) => ({ xlim: [0, SECONDS], layers: [
  { look: "band", x: r.t, low: r[name].low, high: r[name].high, label: "±2√P" },
  { look: "quiet", at: r.t[r.k] },
  { look: "truth", level: s[truth], label: "x_true" },
  { look: "estimate", x: r.t, y: r[name].x, label: "x" }] });

// --- words and numbers ----------------------------------------------------------------------------------------------

const WORDS = {
  left: { id: "Sesudah {t} s, menurut filter, dari simpangan baku awalnya tersisa {theta} % untuk θ dan {v} % untuk v; untuk s = v cos θ tersisa {s} %.",
          en: "After {t} s, the filter claims that {theta} % of the initial standard deviation remains for θ and {v} % for v; for s = v cos θ {s} % remains." },
  blind: { id: "Jarak hanya memperlihatkan s: bagaimana s terbagi menjadi θ dan v, itu dari tebakan awal.", en: "The distance shows only s: how s divides into θ and v comes from the initial guess." },
  seen: { id: "Sudut pandang memperlihatkan juga gerak menyamping, jadi θ dan v ikut teramati.", en: "The bearing shows the sideways motion as well, so θ and v are observable, too." },
  rmse: { id: "RMSE jarak hasil filter {rmse} cm, simpangan baku sensornya {sensor} cm.", en: "The RMSE of the filtered distance is {rmse} cm, the sensor's standard deviation {sensor} cm." },
  high: { id: "NIS rata-rata {nis}, di atas pita 95 %: filter terlalu yakin (R-nya terlalu kecil, atau tebakan awalnya lebih buruk daripada yang dikiranya).",
          en: "Mean NIS {nis}, above the 95 % band: the filter is overconfident (its R is too small, or its initial guess worse than it thinks)." },
  low: { id: "NIS rata-rata {nis}, di bawah pita 95 %: filter terlalu ragu (R-nya terlalu besar).", en: "Mean NIS {nis}, below the 95 % band: the filter is too doubtful (its R is too large)." },
  fits: { id: "NIS rata-rata {nis}, di dalam pita 95 %: inovasinya sesuai dengan R itu.", en: "Mean NIS {nis}, inside the 95 % band: the innovations fit that R." },
  origin: { id: "Jalannya kumbang sintetis (benih acak {seed}).", en: "The walk is synthetic (random seed {seed})." },
};

function outcome(r, s, t) {
  const { k } = r, [low, high] = chi2Bounds(r.m, r.T), left = name => t.decimal(100 * r[name].share[k]);
  return [t.say(WORDS.left, { t: r.t[k], theta: left("theta"), v: left("v"), s: left("s") }), t.say(s.bearing ? WORDS.seen : WORDS.blind),
          t.say(WORDS.rmse, { rmse: r.rmse, sensor: Math.sqrt(s.R_true) }), t.say(WORDS[r.nis > high ? "high" : r.nis < low ? "low" : "fits"], { nis: r.nis }),
          t.say(WORDS.origin, { seed: String(s.seed) })].join(" ");
}

function facts(r, s, t) {
  const truth = { d: r.true_d[r.k], s: s.v * Math.cos(s.theta), theta: s.theta, v: s.v }, units = { d: "d (cm)", s: "s (cm/s)", theta: "θ (rad)", v: "v (cm/s)" };
  return { head: [t.say({ id: "Sesudah {t} s", en: "After {t} s" }, { t: r.t[r.k] }), t.say({ id: "sebenarnya", en: "true" }), t.say({ id: "menurut filter", en: "filter's" }), "±2σ"],
           rows: Object.entries(units).map(([name, unit]) => [unit, ...[truth[name], r[name].x[r.k], 2 * r[name].sigma[r.k]].map(value => t.decimal(value))]) };
}

function numbers(r, s, t) {
  const columns = [r.t, r.true_d, r.t.map((_, k) => k ? r.walk.z[(k - 1) * r.m] : NaN), ...[r.d, r.theta, r.v, r.s].flatMap(({ x, sigma }) => [x, sigma])];
  return { head: ["k", "t (s)", "d_true (cm)", "z (cm)", "d (cm)", "σ_d (cm)", "θ (rad)", "σ_θ (rad)", "v (cm/s)", "σ_v (cm/s)", "s (cm/s)", "σ_s (cm/s)"],
           rows: Array.from(r.t, (_, k) => [String(k), ...columns.map(values => t.decimal(values[k], 4))]) };
}

// --- the hand check -------------------------------------------------------------------------------------------------

function question(r, s, t, random) {
  const near = (a, b) => Math.abs(a - b) <= 0.012 * Math.abs(b), cosine = Math.cos(s.theta0), sine = Math.sin(s.theta0), away = s.v0 * cosine, other = 0.1 * (2 + random.whole(9));
  const by_theta = s.dt * s.v0 * sine * s.sigma_theta, by_v = s.dt * cosine * s.sigma_v, P = s.sigma_d ** 2 + by_theta ** 2 + by_v ** 2;
  const given = { d: s.d0, theta: s.theta0, v: s.v0, dt: s.dt, c: cosine, n: sine, P, R: s.R, s: away, other, co: Math.cos(other), sd: s.sigma_d, st: s.sigma_theta, sv: s.sigma_v };
  const kinds = [
    { text: { id: "Tebakan awal: d = {d} cm, θ = {theta} rad (cos θ = {c}), v = {v} cm/s; Δt = {dt} s. Berapa d_pred (cm)?", en: "Initial guess: d = {d} cm, θ = {theta} rad (cos θ = {c}), v = {v} cm/s; Δt = {dt} s. What is d_pred (cm)?" },
      answer: s.d0 + s.dt * away, hint: value => near(value, s.d0 + s.dt * s.v0) ? { id: "Hanya bagian cos θ dari jalannya yang menambah jarak.", en: "Only the share cos θ of the walk adds to the distance." }
        : { id: "d_pred = d + Δt v cos θ.", en: "d_pred = d + Δt v cos θ." } },
    { text: { id: "Kumbang yang dikira filter menjauh dengan s = v cos θ = {s} cm/s. Kumbang lain berjalan ke arah θ = {other} rad (cos θ = {co}) dan menjauh sama cepatnya. Berapa lajunya (cm/s)?",
              en: "The beetle that the filter believes in moves away with s = v cos θ = {s} cm/s. Another one walks at θ = {other} rad (cos θ = {co}) and moves away equally fast. What is its speed (cm/s)?" },
      answer: away / Math.cos(other), hint: value => near(value, away * Math.cos(other)) ? { id: "Bagilah dengan cos θ; yang berjalan serong harus lebih cepat.", en: "Divide by cos θ; who walks at a slant must be faster." }
        : { id: "v = s / cos θ. Dari jarak saja kedua kumbang itu tidak dapat dibedakan.", en: "v = s / cos θ. From the distance alone the two cannot be told apart." } },
    { text: { id: "Langkah pertama: Δt = {dt} s, v = {v} cm/s, sin θ = {n}, cos θ = {c}; simpangan baku awal {sd} cm, {st} rad, {sv} cm/s. Berapa P_pred untuk d (cm²)?",
              en: "First step: Δt = {dt} s, v = {v} cm/s, sin θ = {n}, cos θ = {c}; initial standard deviations {sd} cm, {st} rad, {sv} cm/s. What is P_pred of d (cm²)?" },
      answer: P, hint: value => near(value, s.sigma_d ** 2) ? { id: "Ketidakpastian θ dan v ikut terbawa.", en: "The uncertainty of θ and v comes along." }
        : { id: "Baris pertama F adalah [1, −Δt v sin θ, Δt cos θ]; kuadratkan setiap hasil kalinya dengan simpangan bakunya, lalu jumlahkan.", en: "The first row of F is [1, −Δt v sin θ, Δt cos θ]; square each product with its standard deviation, then add up." } },
    { text: { id: "Langkah pertama: P_pred untuk d = {P} cm² dan R = {R} cm². Berapa penguatan K untuk d, hanya dari pengukuran jarak?", en: "First step: P_pred of d = {P} cm², R = {R} cm². What is the gain K of d, from the distance alone?" },
      answer: P / (P + s.R), hint: value => near(value, s.R / (P + s.R)) ? { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." } : { id: "S = P_pred + R, lalu K = P_pred / S.", en: "S = P_pred + R, then K = P_pred / S." } },
  ];
  const kind = kinds[random.whole(kinds.length)];
  return { text: t.say(kind.text, given, 4), answer: kind.answer, tolerance: 0.01, hint: value => t.say(kind.hint(value), given, 4) };
}

// --- the view -------------------------------------------------------------------------------------------------------

export const views = {
  walk: {
    name: { id: "Kumbang yang menjauhi wastafel", en: "The beetle that walks away from the sink" },
    noise: true,
    controls: [
      { kind: "buttons", items: [{ id: "Jalankan", en: "Play", play: "moment", seconds: 10 }] },
      { name: "moment", symbol: "t", id: "saat yang ditampilkan", en: "moment that is shown", unit: "s", min: 0, max: SECONDS, step: 0.05, log: false, default: SECONDS },
      { kind: "buttons", id: "R dari sumber (cm²)", en: "R of the source (cm²)", items: PRINTED_R.map(R => ({ id: String(R).replace(".", ","), en: String(R), set: { R }, pressed: s => s.R === R })) },
      { name: "R", symbol: "R" }, { name: "dt", symbol: "Δt" },
      { name: "theta", symbol: "θ" }, { name: "theta0", symbol: "θ_0" }, { name: "v", symbol: "v" }, { name: "v0", symbol: "v_0" }, { name: "sigma_theta", symbol: "σ_θ" },
      { kind: "check", name: "bearing", default: false, id: "sensor kedua: sudut pandang dari tepi wastafel", en: "a second sensor: the bearing from the edge of the sink" },
      { name: "R_bearing", symbol: "R_β", visible: s => s.bearing },
    ],
    compute,
    plots: [
      { title: { id: "Dari atas: jarak d dari tepi (cm)", en: "From above: distance d from the edge (cm)" }, xlabel: "l (cm)", height: 240, equal: true, draw: scene,
        alt: { id: "Kumbang dari atas: jalannya dari tepi wastafel, jarak menurut filter sebagai pita, dan arah menurut filter sebagai kipas.", en: "The beetle from above: its way from the edge of the sink, the filter's distance as a band and its direction as a fan." } },
      { title: { id: "Simpangan baku dibagi nilai awalnya", en: "Standard deviations divided by their start" }, xlabel: "t (s)", height: 150,
        alt: { id: "Grafik simpangan baku arah, laju, dan s terhadap waktu, dibagi nilai awalnya.", en: "Plot of the standard deviations of direction, speed and s against time, divided by their start." },
        draw: r => ({ xlim: [0, SECONDS], ylim: [0, Math.max(1.1, ...r.s.share, ...r.theta.share, ...r.v.share)], layers: [
          { look: "quiet", at: r.t[r.k] },
          { look: "estimate", x: r.t, y: r.theta.share, label: "σ_θ" },
          { look: "prediction", x: r.t, y: r.v.share, label: "σ_v" },
          { look: "rival", x: r.t, y: r.s.share, label: "σ_s" }] }) },
      { title: { id: "Galat jarak (cm)", en: "Error of the distance (cm)" }, xlabel: "t (s)", height: 170, after: true,
        alt: { id: "Grafik galat jarak terhadap waktu: galat pengukuran, galat estimasi, dan pita menurut filter.", en: "Plot of the error of the distance against time: of the measurement, of the estimate, and the filter's band." },
        draw: (r, s) => {
          const reach = 3.5 * Math.sqrt(s.R_true), most = Math.max(reach, ...r.of_x.map(Math.abs));
          return { xlim: [0, SECONDS], ylim: [-most, most], layers: [
            { look: "band", x: r.t, low: r.minus, high: r.band, label: "±2√P" },
            { look: "quiet", at: r.t[r.k] },
            { look: "measurement", x: r.t, y: r.of_z, label: "d_true − z" },
            { look: "estimate", x: r.t, y: r.of_x, label: "d_true − d" }] };
        } },
      { title: { id: "Arah θ (rad)", en: "Direction θ (rad)" }, xlabel: "t (s)", height: 150, half: true, after: true, draw: course("theta", "theta"),
        alt: { id: "Grafik arah terhadap waktu: yang sebenarnya, estimasi, dan pitanya.", en: "Plot of the direction against time: the true one, the estimate, and its band." } },
      { title: { id: "Laju v (cm/s)", en: "Speed v (cm/s)" }, xlabel: "t (s)", height: 150, half: true, after: true, draw: course("v", "v"),
        alt: { id: "Grafik laju terhadap waktu: yang sebenarnya, estimasi, dan pitanya.", en: "Plot of the speed against time: the true one, the estimate, and its band." } },
    ],
    outcome, facts, numbers, question,
  },
};
