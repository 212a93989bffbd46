// Chapter 4: the speed of a model ship, AR(2). Twin of kalman_lib/papers/ship.py, and its explorer.
import { kalmanFilter, linearModel, rtsSmooth } from "../filters.js";
import { leastSquares, solve } from "../linalg.js";
import { mean, nis, rmse } from "../metrics.js";
import { generator, simulate as simulateModel } from "../random.js";
import { readFile, readText } from "../spreadsheet.js";
import { InputError, speaker } from "../words.js";

const RECIPE = [[5, 0], [6, 1.5], [14, 1.5], [6, 0], [5, 0]], DT = 0.1;        // seconds, speed at the end in m/s; s
const SPEED_UNITS = { "m/s": 1, "cm/s": 0.01, "km/h": 1 / 3.6, kn: 1852 / 3600 }, TIME_UNITS = { s: 1, ms: 0.001, min: 60 };
const FASTEST = 1e6;                    // m/s, the range of Params

/** State [speed now, speed one sample before] in m/s; the constant c enters through the input u = 1. */
export function model(p) {
  return linearModel({ F: [[p.a1, p.a2], [1, 0]], B: [[p.c], [0]], H: [[1, 0]], Q: [[p.Q, 0], [0, p.Q_copy]], R: p.R,
                       x0: [p.x0, p.x0], P0: [[p.P0, 0], [0, p.P0]] });
}

/** An AR(2) speed with known coefficients, and its measurements. */
export function simulate(p, rng, steps = 600) {
  return simulateModel(model(p), steps, rng, new Float64Array(steps).fill(1));
}

export function run(p, { z, u }, into = null) {
  return kalmanFilter(model(p), z, u, { into });
}

/** The SYNTHETIC towing run of RECIPE with white noise of sigma (m/s): {t (T) in s, x (T), z (T)}. */
export function towing_run(rng, sigma = 0.1) {
  const x = [];
  let speed = 0;
  for (const [seconds, end] of RECIPE) {
    const steps = Math.round(seconds / DT);
    for (let i = 0; i < steps; i++) x.push(speed + (end - speed) * (1 - Math.cos(Math.PI * i * DT / seconds)) / 2);
    speed = end;
  }
  return { t: Float64Array.from(x, (_, k) => DT * k), x: Float64Array.from(x), z: Float64Array.from(x, value => value + sigma * rng.normal()) };
}

/** [c, a1, a2] of z_k = c + a1 z_{k-1} + a2 z_{k-2} by least squares; rows with a gap are left out. null: they are not unique. */
export function fit(z) {
  const rows = [];
  for (let k = 2; k < z.length; k++) if (Number.isFinite(z[k] + z[k - 1] + z[k - 2])) rows.push(k);
  const column = value => Float64Array.from(rows, value);
  return leastSquares([column(() => 1), column(k => z[k - 1]), column(k => z[k - 2])], column(k => z[k]));
}

/** What `fit` finds on average if white noise of sigma (m/s) is added to the speed x (T): errors in variables. */
export function expected_fit(x, sigma) {
  const A = new Float64Array(9), b = new Float64Array(3), T = x.length;
  for (let k = 2; k < T; k++) {
    const row = [1, x[k - 1], x[k - 2]];
    for (let i = 0; i < 3; i++) {
      for (let j = 0; j < 3; j++) A[3 * i + j] += row[i] * row[j];
      b[i] += row[i] * x[k];
    }
  }
  A[4] += (T - 2) * sigma ** 2;
  A[8] += (T - 2) * sigma ** 2;
  return solve(A, b, 3, 1) ? b : null;
}

/** The two roots of p^2 - a1 p - a2 = 0 as [real, imaginary]; stable inside the unit circle. */
export function poles(a1, a2) {
  const square = a1 ** 2 / 4 + a2, root = Math.sqrt(Math.abs(square));
  return square < 0 ? [[a1 / 2, root], [a1 / 2, -root]] : [[a1 / 2 + root, 0], [a1 / 2 - root, 0]];
}

/** Words with the values filled in, {id, en}. */
const both = (words, values) => Object.fromEntries(["en", "id"].map(language => [language, speaker(language).say(words, values)]));

/** Are the times t (T) in s evenly spaced? {dt, uneven, en, id}: the median step in s, and the sentence that tells it. */
export function sampling(t, tolerance = 0.05) {
  if (t.length < 5 || !t.every(Number.isFinite)) {
    throw new InputError({ en: "The time column must hold at least five times and no gap.", id: "Kolom waktu harus berisi sedikitnya lima waktu tanpa sel kosong." });
  }
  const steps = t.subarray(1).map((value, k) => value - t[k]), row = steps.findIndex(step => !(step > 0)) + 1;
  if (row) {
    throw new InputError(both({ en: "The time does not increase at row {row} of the data ({now} s after {before} s).", id: "Waktu tidak bertambah di baris data ke-{row} ({now} s setelah {before} s)." },
                             { row: String(row + 1), now: t[row], before: t[row - 1] }));
  }
  const sorted = steps.slice().sort(), half = steps.length >> 1, dt = steps.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
  let odd = 0;
  for (const step of steps) if (Math.abs(step - dt) > tolerance * dt) odd++;
  const values = { low: sorted[0], high: sorted.at(-1), dt, odd: String(odd), all: String(steps.length) };
  return { dt, uneven: odd > 0, ...both(odd ? {
    en: "The samples are unevenly spaced ({low} to {high} s; {odd} of {all} steps are not about the median {dt} s), but AR(2) takes them as even: resample them first.",
    id: "Jarak antarsampel tidak seragam ({low} sampai {high} s; {odd} dari {all} langkah tidak sekitar median {dt} s), padahal AR(2) menganggapnya seragam: seragamkan dahulu." }
    : { en: "The samples are evenly spaced, {dt} s apart.", id: "Jarak antarsampel seragam, {dt} s." }, values) };
}

export const twins = {
  fit: (p, { z }) => fit(z) ?? [NaN],
  poles: p => poles(p.a1, p.a2).flat(),
};

// --- the data: the towing run, or the reader's own ------------------------------------------------------------------

const own = s => Boolean(s.file || s.text?.trim());

/** Two columns of a table in the units that the reader chose: {t, z, truth: null, note}. */
function recording({ columns, lines, note }, s) {
  if (columns.size < 2) throw new InputError({ id: "Diperlukan dua kolom bilangan, waktu dan kecepatan; hanya satu yang ditemukan.", en: "Two columns of numbers are needed, time and speed; only one was found." });
  const [time, speed] = columns.values(), t = time.map(value => value * TIME_UNITS[s.time_unit]), z = speed.map(value => value * SPEED_UNITS[s.speed_unit]);
  const sampled = sampling(t), far = z.findIndex(value => Math.abs(value) > FASTEST), gaps = z.filter(Number.isNaN).length;
  if (far >= 0) {
    throw new InputError(both({ id: "Baris {line}: kecepatan {z} m/s terlalu besar, batasnya {most} m/s.", en: "Line {line}: a speed of {z} m/s is too large, the limit is {most} m/s." },
                              { line: String(lines[far]), z: z[far], most: FASTEST }));
  }
  const missing = both({ id: "Kecepatan kosong: {gaps}; di sana filter hanya memprediksi.", en: "Missing speeds: {gaps}; there the filter only predicts." }, { gaps: String(gaps) });
  const tell = language => [note[language], sampled[language], ...(gaps ? [missing[language]] : [])].join(" ");
  return { t, z, truth: null, note: { id: tell("id"), en: tell("en") } };
}

/** The data that is shown; memo keeps it, and what was put in last counts. */
function load(s, memo) {
  if (s.text !== memo.text && s.text?.trim()) memo.last = "text";
  if (s.file !== memo.file && s.file) memo.last = "file";
  Object.assign(memo, { text: s.text, file: s.file });
  const key = own(s) ? [s.text, s.sign, s.time_unit, s.speed_unit] : [s.seed, s.sigma], from = !own(s) ? null : s.file && (memo.last === "file" || !s.text?.trim()) ? s.file : "text";
  if (memo.from === from && memo.key?.every((value, i) => value === key[i])) return memo.data;
  let data;
  if (from === null) {
    const { t, x, z } = towing_run(generator(s.seed), s.sigma), { seed } = s;
    data = { t, z, truth: x, note: { id: `Data sintetis, benih acak ${seed}.`, en: `Synthetic data, random seed ${seed}.` } };
  } else {
    const sign = { comma: ",", point: "." }[s.sign] ?? null;
    data = recording(from === "text" ? readText(s.text, sign) : readFile(from.name, from.bytes, sign), s);
  }
  data.u = new Float64Array(data.z.length).fill(1);
  data.theta = fit(data.z);
  if (!data.theta) {
    throw new InputError({ en: "c, a1 and a2 need at least five speeds in a row that do not lie on a line or one exponential.",
                           id: "c, a1, dan a2 memerlukan sedikitnya lima kecepatan berurutan yang tidak terletak pada satu garis lurus atau satu eksponensial." });
  }
  return Object.assign(memo, { from, key, data }).data;
}

// --- the bias: what noise does to the fit ---------------------------------------------------------------------------

const LEAST = 5e-4, MOST = 0.5;         // m/s, the noise on the axis
const between = (count, i) => LEAST * (MOST / LEAST) ** (i / (count - 1));
const real = ([, a1, a2]) => poles(a1, a2).map(([value]) => value);

/** Real parts of both poles over the noise: on average, by the formula (once), and of fits to this run (for each seed). */
function bias(s, memo) {
  const x = memo.still ??= towing_run(generator(0), 0).x;
  memo.formula ??= Array.from({ length: 61 }, (_, i) => [between(61, i), ...real(expected_fit(x, between(61, i)))]);
  if (memo.fitsOf !== s.seed) {
    const noise = towing_run(generator(s.seed), 1).z.map((value, k) => value - x[k]);
    memo.fits = Array.from({ length: 19 }, (_, i) => [between(19, i), ...real(fit(x.map((value, k) => value + between(19, i) * noise[k])))]);
    memo.fitsOf = s.seed;
  }
  const column = (rows, i) => rows.map(row => row[i]);
  return { x, sigma: column(memo.formula, 0), high: column(memo.formula, 1), low: column(memo.formula, 2), dots: column(memo.fits, 0), dotsHigh: column(memo.fits, 1), dotsLow: column(memo.fits, 2) };
}

// --- what is shown --------------------------------------------------------------------------------------------------

function compute(s, memo) {
  const data = load(s, memo), { z, truth } = data, [c, a1, a2] = data.theta, T = z.length;
  const p = { ...s, c, a1, a2, Q_copy: s.Q };
  if (truth ? s.first : s.firstOwn) Object.assign(p, { x0: z.find(Number.isFinite), P0: s.R });
  const result = memo.result = run(p, data, memo.result), shown = s.smooth ? rtsSmooth(result) : result;
  const part = (of, step) => Float64Array.from({ length: T }, (_, k) => of[k * step]), x = part(shown.x, 2), root = part(shown.P, 4).map(Math.sqrt);
  const curve = truth && bias(s, memo);
  return { T, data, p, result, x, root, low: x.map((value, k) => value - 2 * root[k]), high: x.map((value, k) => value + 2 * root[k]), poles: poles(a1, a2), curve,
           still: curve && (memo.without ??= expected_fit(curve.x, 0)), average: curve && expected_fit(curve.x, s.sigma), nis: mean(nis(result.y, result.S)), rmse: truth && [z, x].map(values => rmse(truth, values)[0]) };
}

const WORDS = {
  result: { id: "Kuadrat terkecil: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Kutub: {poles}.", en: "Least squares: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Poles: {poles}." },
  still: { id: "Tanpa derau kutubnya {still}.", en: "Without noise the poles would be {still}." },
  unstable: { id: "Ada kutub di luar lingkaran: model ini tidak stabil.", en: "A pole lies outside the circle: this model is unstable." },
  rmse: { id: "RMSE: pengukuran {z} m/s, estimasi {x} m/s.", en: "RMSE: measurements {z} m/s, estimate {x} m/s." },
  nis: { id: "Rata-rata NIS = {nis} (seharusnya sekitar 1).", en: "Mean NIS = {nis} (it should be about 1)." },
};

function said([first, second], t) {
  return first[1] > 0 ? `${t.decimal(first[0])} ± ${t.decimal(first[1])} i` : `${t.decimal(first[0])} ; ${t.decimal(second[0])}`;
}

function outcome(r, s, t) {
  const { c, a1, a2 } = r.p;
  return [t.say(WORDS.result, { c, a1, a2, poles: said(r.poles, t) }), r.still && s.sigma > 0 && t.say(WORDS.still, { still: said(poles(r.still[1], r.still[2]), t) }),
          r.poles.some(([a, b]) => Math.hypot(a, b) > 1) && t.say(WORDS.unstable), r.rmse && t.say(WORDS.rmse, { z: r.rmse[0], x: r.rmse[1] }),
          t.say(WORDS.nis, { nis: r.nis }), t.say(r.data.note)].filter(Boolean).join(" ");
}

function facts(r, s, t) {
  const fits = [r.data.theta, ...(r.still ? [r.average, r.still] : [])];
  const head = [{ id: "pencocokan", en: "fit" }, { id: "rata-rata pada derau ini", en: "on average at this noise" }, { id: "tanpa derau", en: "without noise" }];
  return { head: ["AR(2)", ...head.slice(0, fits.length).map(words => t.say(words))],
           rows: [...["c (m/s)", "a_1", "a_2"].map((name, i) => [name, ...fits.map(theta => t.decimal(theta[i], 4))]),
                  [t.say({ id: "kutub p", en: "poles p" }), ...fits.map(theta => said(poles(theta[1], theta[2]), t))]] };
}

function numbers(r, s, t) {
  const { data, result } = r, skip = Math.max(1, Math.ceil(r.T / 500)), rows = [];
  for (let k = 0; k < r.T; k += skip) {
    rows.push([String(k + 1), ...[data.t[k], ...(data.truth ? [data.truth[k]] : []), data.z[k], result.x_pred[2 * k], result.y[k], result.S[k], result.K[2 * k], r.x[k], r.root[k]].map(value => t.decimal(value, 4))]);
  }
  return { head: ["k", "t (s)", ...(data.truth ? ["x_true (m/s)"] : []), "z (m/s)", "x_pred (m/s)", "y (m/s)", "S (m²/s²)", "K_1", s.smooth ? "x_s (m/s)" : "x (m/s)", "√P (m/s)"], rows };
}

// --- the hand check -------------------------------------------------------------------------------------------------

function question(r, s, t, random) {
  const { p, result, data } = r, near = (a, b) => Math.abs(a - b) <= 0.012 * Math.abs(b);
  let k = Math.max(1, Math.floor(r.T * (0.3 + 0.3 * random.uniform())));
  while (k < r.T - 1 && Number.isNaN(data.z[k])) k++;
  const before = result.x[2 * k - 2], older = result.x[2 * k - 1], pred = result.x_pred[2 * k], P = result.P_pred[4 * k], K = result.K[2 * k], z = data.z[k], complex = r.poles[0][1] > 0;
  const given = { k: String(k + 1), c: p.c, a1: p.a1, a2: p.a2, before, older, pred, P, K, z, R: p.R };
  const kinds = [
    { text: { id: "Langkah {k}: c = {c} m/s, a₁ = {a1}, a₂ = {a2}; x sebelumnya = [{before}; {older}] m/s. Berapa x_pred (m/s)?", en: "Step {k}: c = {c} m/s, a₁ = {a1}, a₂ = {a2}; x before = [{before}; {older}] m/s. What is x_pred (m/s)?" },
      answer: pred, hint: value => near(value, pred - p.c) ? { id: "Tinggal menambahkan c.", en: "Only c is missing." } : { id: "x_pred = c + a₁ kali kecepatan terakhir + a₂ kali kecepatan sebelumnya.", en: "x_pred = c + a₁ times the last speed + a₂ times the one before." } },
    { text: { id: "Langkah {k}: P_pred untuk kecepatan {P} m²/s² dan R = {R} m²/s². Berapa penguatan K?", en: "Step {k}: P_pred of the speed is {P} m²/s², R = {R} m²/s². What is the gain K?" },
      answer: P / (P + p.R), hint: value => near(value, p.R / (P + p.R)) ? { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." } : { id: "S = P_pred + R, lalu K = P_pred / S.", en: "S = P_pred + R, then K = P_pred / S." } },
    { text: { id: "Langkah {k}: x_pred = {pred} m/s, z = {z} m/s, K = {K}. Berapa x sesudah pembaruan, sebelum penghalusan (m/s)?", en: "Step {k}: x_pred = {pred} m/s, z = {z} m/s, K = {K}. What is x after the update, before any smoothing (m/s)?" },
      answer: result.x[2 * k], hint: value => near(value, K * (z - pred)) ? { id: "Itu baru koreksinya K y; tambahkan x_pred.", en: "That is only the correction K y; add x_pred." } : { id: "x = x_pred + K (z − x_pred).", en: "x = x_pred + K (z − x_pred)." } },
    { text: complex ? { id: "a₁ = {a1}, a₂ = {a2}: kutubnya kompleks. Berapa jauhnya dari nol, |p|?", en: "a₁ = {a1}, a₂ = {a2}: the poles are complex. How far from zero are they, |p|?" }
        : { id: "a₁ = {a1}, a₂ = {a2}. Berapa kutub yang terbesar, yaitu akar terbesar p² − a₁ p − a₂ = 0?", en: "a₁ = {a1}, a₂ = {a2}. What is the largest pole, the largest root of p² − a₁ p − a₂ = 0?" },
      answer: complex ? Math.sqrt(-p.a2) : r.poles[0][0],
      hint: value => !complex && near(value, r.poles[1][0]) ? { id: "Itu kutub yang lain.", en: "That is the other pole." } : complex ? { id: "Hasil kali kedua kutub adalah −a₂, jadi |p|² = −a₂.", en: "The product of both poles is −a₂, so |p|² = −a₂." }
        : { id: "p = a₁/2 + √(a₁²/4 + a₂).", en: "p = a₁/2 + √(a₁²/4 + a₂)." } },
  ];
  const kind = kinds[random.whole(kinds.length)];
  return { text: t.say(kind.text, given, 4), answer: kind.answer, tolerance: 0.02, hint: value => t.say(kind.hint(value), given, 4) };
}

// --- the view -------------------------------------------------------------------------------------------------------

const synthetic = s => !own(s);

export const views = {
  run: {
    name: { id: "Kecepatan kapal: pencocokan, kutub, dan filter", en: "The ship's speed: fit, poles and filter" },
    controls: [
      { name: "sigma", symbol: "σ", log: true, low: LEAST, visible: synthetic },
      { name: "Q", symbol: "Q" }, { name: "R", symbol: "R" },
      { kind: "buttons", items: [{ id: "Derau baru", en: "New noise", set: s => ({ seed: s.seed + 1 }) }], visible: synthetic },
      { kind: "check", name: "smooth", default: false, id: "penghalus (maju, lalu mundur)", en: "smoother (forwards, then backwards)" },
      { kind: "check", name: "first", default: false, id: "mulai dari pengukuran pertama", en: "start at the first measurement", visible: synthetic },
      { kind: "check", name: "firstOwn", default: true, id: "mulai dari pengukuran pertama", en: "start at the first measurement", visible: own },
      { kind: "text", name: "text", rows: 4, id: "Data sendiri (tetap di perangkat ini): tempelkan dua kolom, waktu lalu kecepatan", en: "Data of your own (it stays on this device): paste two columns, time then speed",
        placeholder: { id: "0,0\t0,12\n0,1\t0,15", en: "0.0\t0.12\n0.1\t0.15" } },
      { kind: "file", name: "file", accept: ".csv,.txt,.tsv", id: "atau buka berkas CSV", en: "or open a CSV file" },
      { kind: "select", name: "time_unit", default: "s", id: "Satuan waktu", en: "Unit of time", options: Object.keys(TIME_UNITS).map(unit => [unit, unit]), visible: own },
      { kind: "select", name: "speed_unit", default: "m/s", id: "Satuan kecepatan", en: "Unit of speed", visible: own,
        options: Object.keys(SPEED_UNITS).map(unit => [unit, { "km/h": { id: "km/jam", en: "km/h" }, kn: { id: "knot", en: "knots" } }[unit] ?? unit]) },
      { kind: "select", name: "sign", default: "auto", id: "Tanda desimal", en: "Decimal sign", visible: own,
        options: [["auto", { id: "kenali sendiri", en: "find out" }], ["comma", { id: "koma", en: "comma" }], ["point", { id: "titik", en: "point" }]] },
      { kind: "buttons", items: [{ id: "Kembali ke uji tarik sintetis", en: "Back to the synthetic towing run", set: { text: null, file: null } }], visible: own },
    ],
    compute,
    plots: [
      { title: { id: "Kecepatan (m/s)", en: "Speed (m/s)" }, xlabel: "t (s)", height: 240,
        alt: { id: "Grafik kecepatan kapal terhadap waktu: titik pengukuran, garis sebenarnya bila diketahui, dan estimasi dengan pitanya.", en: "Plot of the ship's speed against time: measured dots, the true line where it is known, and the estimate with its band." },
        draw: ({ data, x, low, high, T }, s) => ({ xlim: [data.t[0], data.t[T - 1]], layers: [
          { look: "band", x: data.t, low, high, label: "±2√P" },
          { look: "measurement", x: data.t, y: data.z, label: "z" },
          data.truth && { look: "truth", x: data.t, y: data.truth, label: "x_true" },
          { look: "estimate", x: data.t, y: x, label: s.smooth ? "x_s" : "x" }] }) },
      { title: { id: "Kutub p", en: "Poles p" }, xlabel: "Re p", height: 230, half: true, after: true, equal: true,
        alt: { id: "Kutub model di bidang kompleks dengan lingkaran satuan.", en: "The model's poles in the complex plane with the unit circle." },
        draw: r => {
          const still = r.still ? poles(r.still[1], r.still[2]) : [], reach = 1.1 * Math.max(1, ...[...r.poles, ...still].map(([a, b]) => Math.hypot(a, b)));
          const name = (i, words) => i === 0 && words;
          return { xlim: [-reach, reach], ylim: [-reach, reach], layers: [
            { look: "quiet", paint(ctx, X, Y) { ctx.setLineDash([]); ctx.beginPath(); ctx.arc(X(0), Y(0), X(1) - X(0), 0, 7); ctx.stroke(); } },
            ...r.poles.map((mark, i) => ({ look: "estimate", mark, label: name(i, { id: "hasil pencocokan", en: "fitted" }) })),
            ...still.map((mark, i) => ({ look: "truth", mark, sign: "+", label: name(i, { id: "tanpa derau", en: "without noise" }) }))] };
        } },
      { title: { id: "Bias: Re p", en: "Bias: Re p" }, xlabel: "σ (m/s)", height: 230, half: true, after: true, xlog: true, visible: synthetic,
        drag: x => ({ sigma: Number(Math.min(Math.max(x, LEAST), MOST).toPrecision(3)) }),
        alt: { id: "Grafik bagian real kedua kutub terhadap derau: rata-rata menurut rumus dan hasil pencocokan pada data ini.", en: "Plot of the real parts of both poles against the noise: their mean by the formula and fits to this data." },
        draw: ({ curve, poles: [first, second] }, s) => {
          const at = Math.max(s.sigma, LEAST);
          return { xlim: [LEAST, MOST], ylim: [-0.75, 1.15], layers: [
            { look: "quiet", at, label: { id: "derau sekarang", en: "noise now" } },
            { look: "prediction", x: curve.sigma, y: curve.high, label: { id: "rumus", en: "formula" } },
            { look: "prediction", x: curve.sigma, y: curve.low },
            { look: "measurement", x: curve.dots, y: curve.dotsHigh, label: { id: "pencocokan", en: "fits" } },
            { look: "measurement", x: curve.dots, y: curve.dotsLow },
            { look: "estimate", mark: [at, first[0]] }, { look: "estimate", mark: [at, second[0]] }] };
        } },
    ],
    outcome, facts, numbers, question,
  },
};
