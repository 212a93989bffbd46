// Chapter 3: an angle from a gyroscope and an angle sensor. Twin of kalman_lib/papers/gyro.py, and its explorer.
import { kalmanFilter, linearModel } from "../filters.js";
import { chi2Bounds, mean, rmse } from "../metrics.js";
import { generator } from "../random.js";

const CASES = { 4: [10, 10], 5: [10, 1], 6: [1, 10], 7: [1, 1] };       // figure -> [sigma_w rad/s, sigma_v rad]
const DEGREE = Math.PI / 180, RUNS = 500;

/** x = x + T u + w, z = x + v; Q = sigma_w^2 T^2, R = sigma_v^2; the first angle is known. */
export function model(p) {
  return linearModel({ F: 1, B: p.T, H: 1, Q: (p.sigma_w * p.T) ** 2, R: p.sigma_v ** 2, x0: 0, P0: 0 });
}

/** The whole number of steps nearest to the duration; a half goes to the even one, as in Python. */
export function steps(p) {
  const exact = p.duration / p.T, low = Math.floor(exact);
  return exact - low === 0.5 ? low + low % 2 : Math.round(exact);
}

/** A synthetic turn at the constant rate u. The noise of a step does not depend on how many there are. */
export function simulate(p, rng) {
  const T = steps(p), x = new Float64Array(T), z = new Float64Array(T);
  let angle = 0;
  for (let k = 0; k < T; k++) {
    angle += p.T * (p.u + p.sigma_w * rng.normal());
    x[k] = angle;
    z[k] = angle + p.sigma_v * rng.normal();
  }
  return { T, x, z, u: new Float64Array(T).fill(p.u) };
}

export function run(p, { z, u }, into = null) {
  return kalmanFilter(model(p), z, u, { into });
}

/** The gain K at which the filter settles and the standard deviation sqrt(K R) of its error, rad. */
export function steady(p) {
  const q = (p.sigma_w * p.T / p.sigma_v) ** 2, K = 2 / (1 + Math.sqrt(1 + 4 / q));
  return [K, Math.sqrt(K) * p.sigma_v];
}

/** Standard deviation (rad) of the settled error if the gain is K, whatever the filter believes. */
export function error_with_gain(p, K) {
  const Q = (p.sigma_w * p.T) ** 2, R = p.sigma_v ** 2;
  return Math.sqrt(((1 - K) ** 2 * Q + K ** 2 * R) / (1 - (1 - K) ** 2));
}

/** Largest |x_true - z| and |x_true - x|, rad. */
function maxima(flight, result) {
  let of_z = 0, of_x = 0;
  for (let k = 0; k < flight.T; k++) {
    of_z = Math.max(of_z, Math.abs(flight.x[k] - flight.z[k]));
    of_x = Math.max(of_x, Math.abs(flight.x[k] - result.x[k]));
  }
  return [of_z, of_x];
}

export const twins = {
  steady: p => steady(p),
  maxima: (p, data, result) => maxima(data, result),
  error_with_gain: (p, data, result) => error_with_gain(p, result.K[0]),        // Python gets the first gain as K, too
};

// --- many runs at once ----------------------------------------------------------------------------------------------

/** Standard normal numbers, the same ones while the seed stays, as many as asked for. */
function pool(memo, seed, count) {
  if (memo.seed !== seed) Object.assign(memo, { seed, rng: generator(seed + 1000), filled: 0 });
  if (!memo.noise || memo.noise.length < count) {
    const wider = new Float32Array(count);
    if (memo.noise) wider.set(memo.noise.subarray(0, memo.filled));
    memo.noise = wider;
  }
  while (memo.filled < count) memo.noise[memo.filled++] = memo.rng.normal();
  return memo.noise;
}

/**
 * Runs of the error alone, which needs no angle: e_pred = e + w, y = e_pred + v, e = e_pred - K y. Adds up e^2 of the
 * filter as it is and of the one that knows both sigmas, and y^2; yields now and then.
 */
function* errors(r, s, memo) {
  const { T, filter, optimum, runs } = r, a = s.sigma_w * s.T, b = s.sigma_v;
  const rows = Math.max(1, Math.floor(20000 / T));
  while (runs.count < RUNS) {
    const until = Math.min(runs.count + rows, RUNS), noise = pool(memo, s.seed, until * 2 * T);
    for (let run = runs.count; run < until; run++) {
      let e = 0, best = 0, at = 2 * T * run;
      for (let k = 0; k < T; k++) {
        const w = a * noise[at++], v = b * noise[at++], y = e + w + v;          // y = e_pred + v
        e += w - filter.K[k] * y;
        runs.e2[k] += e * e;
        runs.y2[k] += y * y;
        if (filter === optimum) continue;
        best += w - optimum.K[k] * (best + w + v);
        runs.best2[k] += best * best;
      }
    }
    runs.count = until;
    yield;
  }
}

// --- what is shown --------------------------------------------------------------------------------------------------

function compute(s, memo) {
  const believed = s.other ? { ...s, sigma_w: s.believed_w ?? s.sigma_w, sigma_v: s.believed_v ?? s.sigma_v } : s;
  const flight = simulate(s, generator(s.seed)), { T } = flight;
  memo.filter = run(believed, flight, memo.filter);
  memo.optimum = s.other ? run(s, flight, memo.optimum) : memo.filter;
  const { filter, optimum } = memo;
  if (memo.t?.length !== T) for (const name of ["t", "error", "measured", "low", "high", "root", "spread", "nees", "nis", "e2", "y2", "best2", "band_low", "band_high", "minus"]) memo[name] = new Float64Array(T);
  const { t, error, measured, low, high, root, band_low, band_high } = memo;
  for (let k = 0; k < T; k++) {
    t[k] = s.T * (k + 1);
    error[k] = flight.x[k] - filter.x[k];
    measured[k] = flight.x[k] - flight.z[k];
    root[k] = Math.sqrt(filter.P[k]);
    low[k] = filter.x[k] - 2 * root[k];
    high[k] = filter.x[k] + 2 * root[k];
    band_low[k] = -2 * root[k];
    band_high[k] = 2 * root[k];
  }
  for (const name of ["e2", "y2", "best2"]) memo[name].fill(0);
  const { e2, y2 } = memo, best2 = s.other ? memo.best2 : e2;
  return { T, flight, filter, optimum, believed, memo, t, error, measured, low, high, root, band_low, band_high,
           runs: { e2, y2, best2, count: 0 } };
}

/** Over the runs so far: RMSE of filter and optimum (rad), mean NEES and NIS. */
function study({ T, runs, filter }) {
  let e2 = 0, best2 = 0, nees = 0, nis = 0;
  for (let k = 0; k < T; k++) {
    e2 += runs.e2[k];
    best2 += runs.best2[k];
    nees += runs.e2[k] / filter.P[k];
    nis += runs.y2[k] / filter.S[k];
  }
  const all = runs.count * T;
  return { rmse: Math.sqrt(e2 / all), optimum: Math.sqrt(best2 / all), nees: nees / all, nis: nis / all };
}

/** +-2 times the standard deviation of the runs' errors at every time, and the means of NEES and NIS at every time. */
function spread({ T, runs, filter, memo }) {
  for (let k = 0; k < T; k++) {
    memo.spread[k] = 2 * Math.sqrt(runs.e2[k] / runs.count);
    memo.minus[k] = -memo.spread[k];
    memo.nees[k] = runs.e2[k] / runs.count / filter.P[k];
    memo.nis[k] = runs.y2[k] / runs.count / filter.S[k];
  }
  return memo;
}

const OUTCOME = {
  run: { id: "Pada percobaan ini filter menurunkan RMSE dari {sensor} rad (sensor) menjadi {rmse} rad; galat terbesarnya {z} rad (pengukuran) dan {x} rad (estimasi).",
         en: "In this run the filter lowers the RMSE from {sensor} rad (sensor) to {rmse} rad; the largest errors are {z} rad (measurement) and {x} rad (estimate)." },
  honest: { id: "Dalam {runs} percobaan RMSE-nya {all} rad, rata-rata NEES {nees} dan NIS {nis}: sesuai dengan P.",
            en: "Over {runs} runs the RMSE is {all} rad, mean NEES {nees} and NIS {nis}: as P says." },
  sure: { id: "Dalam {runs} percobaan RMSE-nya {all} rad (optimum {best} rad), rata-rata NEES {nees} dan NIS {nis}: filter terlalu yakin, P-nya terlalu kecil.",
          en: "Over {runs} runs the RMSE is {all} rad (optimum {best} rad), mean NEES {nees} and NIS {nis}: the filter is overconfident, its P is too small." },
  doubtful: { id: "Dalam {runs} percobaan RMSE-nya {all} rad (optimum {best} rad), rata-rata NEES {nees} dan NIS {nis}: filter terlalu ragu, P-nya terlalu besar.",
              en: "Over {runs} runs the RMSE is {all} rad (optimum {best} rad), mean NEES {nees} and NIS {nis}: the filter is too doubtful, its P is too large." },
  between: { id: "Dalam {runs} percobaan RMSE-nya {all} rad (optimum {best} rad), rata-rata NEES {nees} dan NIS {nis}: P kira-kira tepat, walaupun sigma yang dipercayai filter salah.",
             en: "Over {runs} runs the RMSE is {all} rad (optimum {best} rad), mean NEES {nees} and NIS {nis}: P is about right although the believed sigmas are wrong." },
  seed: { id: "Data sintetis (benih acak {seed}).", en: "Synthetic data (random seed {seed})." },
};

function outcome(r, s, t) {
  const [z, x] = maxima(r.flight, r.filter), all = study(r);
  const mismatch = r.believed.sigma_w !== s.sigma_w || r.believed.sigma_v !== s.sigma_v;
  const verdict = !mismatch ? "honest" : all.nees > 1.1 ? "sure" : all.nees < 0.9 ? "doubtful" : "between";
  return [t.say(OUTCOME.run, { z, x, sensor: rmse(r.flight.x, r.flight.z)[0], rmse: rmse(r.flight.x, r.filter.x)[0] }),
          t.say(OUTCOME[verdict], { runs: r.runs.count, all: all.rmse, best: all.optimum, nees: all.nees, nis: all.nis }),
          t.say(OUTCOME.seed, { seed: String(s.seed) })].join(" ");
}

function facts(r, s, t) {
  const [K, sigma] = steady(r.believed), last = r.T - 1, d = value => t.decimal(value);
  return {
    head: ["", t.say({ id: "langkah pertama", en: "first step" }), t.say({ id: "langkah terakhir", en: "last step" }), t.say({ id: "keadaan tunak", en: "steady state" })],
    rows: [["K", d(r.filter.K[0]), d(r.filter.K[last]), d(K)],
           ["√P (rad)", d(r.root[0]), d(r.root[last]), d(sigma)],
           [t.say({ id: "galat sebenarnya (rad)", en: "true error (rad)" }), d(Math.sqrt(r.runs.e2[0] / r.runs.count)), d(Math.sqrt(r.runs.e2[last] / r.runs.count)), d(error_with_gain(s, K))],
           [t.say({ id: "optimum (rad)", en: "optimum (rad)" }), d(Math.sqrt(r.runs.best2[0] / r.runs.count)), d(Math.sqrt(r.runs.best2[last] / r.runs.count)), d(steady(s)[1])]],
  };
}

function numbers(r, s, t) {
  const skip = Math.max(1, Math.ceil(r.T / 500)), rows = [];
  for (let k = 0; k < r.T; k += skip) rows.push([String(k + 1), ...[r.t[k], r.flight.x[k], r.flight.z[k], r.filter.x_pred[k], r.filter.P_pred[k], r.filter.K[k], r.filter.x[k], r.filter.P[k]].map(value => t.decimal(value, 4))]);
  return { head: ["k", "t (s)", "x_true (rad)", "z (rad)", "x_pred (rad)", "P_pred (rad²)", "K", "x (rad)", "P (rad²)"], rows };
}

// --- the hand check -------------------------------------------------------------------------------------------------

function question(r, s, t, random) {
  const p = r.believed, d = value => t.decimal(value, 4), Q = (p.sigma_w * p.T) ** 2, R = p.sigma_v ** 2, near = (a, b) => Math.abs(a - b) <= 0.02 * Math.abs(b);
  const given = { w: d(p.sigma_w), v: d(p.sigma_v), T: d(p.T), z: d(r.flight.z[0]), pred: d(r.filter.x_pred[0]), K: d(r.filter.K[0]), R: d(R), Q: d(Q), P: d(r.filter.P[0]) };
  const kinds = [
    { text: { id: "Sudut awalnya diketahui (P₀ = 0). Dengan σ_w = {w} rad/s, T = {T} s, dan σ_v = {v} rad menurut filter, berapa penguatan K pada langkah pertama?",
              en: "The first angle is known (P₀ = 0). With σ_w = {w} rad/s, T = {T} s and σ_v = {v} rad as the filter has them, what is the gain K of the first step?" },
      answer: Q / (Q + R),
      hint: value => near(value, R / (Q + R)) ? { id: "Itu bagian untuk prediksi, 1 − K.", en: "That is the share of the prediction, 1 − K." }
        : near(value, p.sigma_w * p.T / (p.sigma_w * p.T + p.sigma_v)) ? { id: "Kuadratkan dahulu simpangan bakunya: Q = (σ_w T)², R = σ_v².", en: "Square the standard deviations first: Q = (σ_w T)², R = σ_v²." }
        : near(value, p.sigma_w ** 2 / (p.sigma_w ** 2 + R)) ? { id: "Jangan lupa T: Q = (σ_w T)².", en: "Do not forget T: Q = (σ_w T)²." }
        : { id: "P_pred = P₀ + Q = (σ_w T)² = {Q} rad², lalu K = P_pred / (P_pred + R) dengan R = σ_v².", en: "P_pred = P₀ + Q = (σ_w T)² = {Q} rad², then K = P_pred / (P_pred + R) with R = σ_v²." } },
    { text: { id: "Langkah pertama: x_pred = {pred} rad, z = {z} rad, K = {K}. Berapa x (rad)?", en: "First step: x_pred = {pred} rad, z = {z} rad, K = {K}. What is x (rad)?" },
      answer: r.filter.x[0], tolerance: 0.02,
      hint: value => near(value, (1 - r.filter.K[0]) * r.flight.z[0] + r.filter.K[0] * r.filter.x_pred[0]) ? { id: "K mengalikan inovasi z − x_pred, bukan prediksinya.", en: "K multiplies the innovation z − x_pred, not the prediction." }
        : near(value, r.filter.K[0] * (r.flight.z[0] - r.filter.x_pred[0])) ? { id: "Itu baru koreksinya K y; tambahkan x_pred.", en: "That is only the correction K y; add x_pred." }
        : { id: "x = x_pred + K (z − x_pred).", en: "x = x_pred + K (z − x_pred)." } },
    { text: { id: "Sesudah langkah pertama P = {P} rad², dan Q = {Q} rad². Berapa P_pred pada langkah kedua (rad²)?", en: "After the first step P = {P} rad², and Q = {Q} rad². What is P_pred of the second step (rad²)?" },
      answer: r.filter.P[0] + Q,
      hint: value => near(value, r.filter.P[0]) ? { id: "Prediksi menambah ketidakpastian: tambahkan Q.", en: "A prediction adds uncertainty: add Q." } : { id: "F = 1, jadi P_pred = P + Q.", en: "F = 1, so P_pred = P + Q." } },
    { text: { id: "Penguatan langkah pertama K = {K} dan R = {R} rad². Berapa P sesudah langkah itu (rad²)?", en: "The first gain is K = {K} and R = {R} rad². What is P after that step (rad²)?" },
      answer: r.filter.K[0] * R,
      hint: value => near(value, (1 - r.filter.K[0]) * R) ? { id: "(1 − K) mengalikan P_pred, bukan R.", en: "(1 − K) multiplies P_pred, not R." } : { id: "Untuk satu bilangan P = (1 − K) P_pred = K R.", en: "For a single number P = (1 − K) P_pred = K R." } },
  ];
  const kind = kinds[random.whole(kinds.length)];
  return { text: t.say(kind.text, given), answer: kind.answer, tolerance: kind.tolerance, hint: value => t.say(kind.hint(value), given) };
}

// --- the view -------------------------------------------------------------------------------------------------------

const settings = ([sigma_w, sigma_v]) => ({ duration: 20, T: 0.1, sigma_w, sigma_v });
const is = values => s => Object.entries(values).every(([name, value]) => s[name] === value);
const MEMS = { duration: 2, T: 0.01, sigma_w: Number((0.1 * DEGREE).toPrecision(3)), sigma_v: Number(DEGREE.toPrecision(3)) };
const believed = { min: 1e-4, max: 100, step: 0.1, log: true, default: null };

export const views = {
  flight: {
    name: { id: "Simulasi giroskop", en: "The gyroscope simulation" },
    noise: true,
    controls: [
      { kind: "buttons", items: [
        ...Object.entries(CASES).map(([figure, pair]) => ({ id: `Kasus ${figure}`, en: `Case ${figure}`, set: settings(pair), pressed: is(settings(pair)) })),
        { id: "Giroskop MEMS", en: "MEMS gyroscope", set: MEMS, pressed: is(MEMS) }] },
      { name: "duration", symbol: "t" },
      { name: "T", symbol: "T" },
      { name: "sigma_w", symbol: "σ_w" },
      { name: "sigma_v", symbol: "σ_v" },
      { kind: "check", name: "other", default: false, id: "filter percaya pada sigma yang lain", en: "the filter believes another sigma" },
      { ...believed, name: "believed_w", symbol: "σ_w", unit: "rad/s", id: "menurut filter", en: "as the filter believes", auto: s => s.sigma_w, visible: s => s.other },
      { ...believed, name: "believed_v", symbol: "σ_v", unit: "rad", id: "menurut filter", en: "as the filter believes", auto: s => s.sigma_v, visible: s => s.other },
    ],
    compute,
    *refine(r, s) { yield* errors(r, s, r.memo); },
    plots: [
      { title: { id: "Sudut (rad)", en: "Angle (rad)" }, xlabel: "t (s)", height: 200,
        alt: { id: "Grafik sudut terhadap waktu: titik pengukuran, garis sebenarnya, dan garis estimasi dengan pita.", en: "Plot of the angle against time: measured dots, the true line, and the estimated line with its band." },
        draw: r => ({ xlim: [0, r.t[r.T - 1]], layers: [
          { look: "band", x: r.t, low: r.low, high: r.high, label: "±2√P" },
          { look: "measurement", x: r.t, y: r.flight.z, label: "z" },
          { look: "truth", x: r.t, y: r.flight.x, label: "x_true" },
          { look: "estimate", x: r.t, y: r.filter.x, label: "x" }] }) },
      { title: { id: "Galat (rad)", en: "Error (rad)" }, xlabel: "t (s)", height: 200,
        alt: { id: "Grafik galat terhadap waktu: galat pengukuran, galat estimasi, pita menurut filter, dan pita dari banyak percobaan.", en: "Plot of the errors against time: of the measurement, of the estimate, the band that the filter states, and the band of many runs." },
        draw: r => {
          const { spread: high, minus } = spread(r);
          return { xlim: [0, r.t[r.T - 1]], layers: [
            { look: "band", x: r.t, low: r.band_low, high: r.band_high, label: "±2√P" },
            { look: "measurement", x: r.t, y: r.measured, label: "x_true − z" },
            { look: "estimate", x: r.t, y: r.error, label: "x_true − x" },
            { look: "rival", x: r.t, y: high, label: { id: `±2σ dari ${r.runs.count} percobaan`, en: `±2σ of ${r.runs.count} runs` } },
            { look: "rival", x: r.t, y: minus }] };
        } },
      { title: { id: "Penguatan K", en: "Gain K" }, xlabel: "t (s)", height: 150, half: true, after: true,
        alt: { id: "Grafik penguatan terhadap waktu dan nilainya pada keadaan tunak.", en: "Plot of the gain against time and its steady value." },
        draw: r => ({ xlim: [0, r.t[r.T - 1]], layers: [
          { look: "quiet", level: 0 },
          { look: "quiet", level: steady(r.believed)[0], label: { id: "tunak", en: "steady" } },
          { look: "estimate", x: r.t, y: r.filter.K, label: "K" }] }) },
      { title: "√P (rad)", xlabel: "t (s)", height: 150, half: true, after: true,
        alt: { id: "Grafik simpangan baku menurut filter, dan dari banyak percobaan, terhadap waktu.", en: "Plot of the standard deviation as the filter states it, and of many runs, against time." },
        draw: r => {
          const actual = spread(r).spread.map(value => value / 2);
          return { xlim: [0, r.t[r.T - 1]], layers: [
            { look: "quiet", level: 0 },
            { look: "estimate", x: r.t, y: r.root, label: "√P" },
            { look: "rival", x: r.t, y: actual, label: { id: "dari percobaan", en: "of the runs" } }] };
        } },
      { title: { id: "Konsistensi", en: "Consistency" }, xlabel: "t (s)", height: 170, after: true, ylog: true,
        alt: { id: "Grafik rata-rata NEES dan NIS dari semua percobaan terhadap waktu, dengan pita 95 % khi-kuadrat.", en: "Plot of the mean NEES and NIS of all runs against time, with the 95 % chi-square band." },
        draw: r => {
          const { nees, nis } = spread(r), [low, high] = chi2Bounds(1, r.runs.count), ends = [0, r.t[r.T - 1]];
          let least = 0.5, most = 2;
          for (let k = 0; k < r.T; k++) { least = Math.min(least, nees[k], nis[k]); most = Math.max(most, nees[k], nis[k]); }
          return { xlim: ends, ylim: least < 0.5 || most > 2 ? [10 ** Math.floor(Math.log10(least)), 10 ** Math.ceil(Math.log10(most))] : [0.5, 2], layers: [
            { look: "band", x: ends, low: [low, low], high: [high, high], label: { id: "95 % khi-kuadrat", en: "95 % chi-square" } },
            { look: "estimate", x: r.t, y: nees, label: "NEES" },
            { look: "prediction", x: r.t, y: nis, label: "NIS" }] };
        } },
    ],
    outcome, facts, numbers, question,
  },
};
