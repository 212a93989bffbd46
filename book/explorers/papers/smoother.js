// Chapter 2: the scalar filter of a spreadsheet. Twin of kalman_lib/papers/smoother.py, and its two explorers.
import nile from "data/nile.csv";
import { kalmanFilter, linearModel } from "../filters.js";
import { rmse } from "../metrics.js";
import { generator, simulate as simulateModel } from "../random.js";
import { readFile, readText, tooLong } from "../spreadsheet.js";
import { InputError, number } from "../words.js";
import { writeWorkbook } from "../xlsx.js";

const MEASURED = Float64Array.of(-0.39, -0.49, -0.48, -0.3, -0.25, -0.31, -0.33, -0.48, -0.41, -0.44, -0.38, -0.36, -0.42, -0.44, -0.51, -0.28);
const MAX_WRITE = 100000, LIKELIHOOD_POINTS = 5000, TABLE_ROWS = 500;

/** A random walk that is measured directly: x = x + w, z = x + v. */
export function model(p) {
  return linearModel({ F: 1, H: 1, Q: p.Q, R: p.R, x0: p.x0, P0: p.P0 });
}

export function simulate(p, rng, steps = 200) {
  return simulateModel(model(p), steps, rng);
}

export function run(p, { z }, into = null) {
  return kalmanFilter(model(p), z, null, { into });
}

/** The smoother of Rauch, Tung and Striebel for the random walk: x (T) and P (T). */
export function smoothed(result, Q) {
  const x = result.x.slice(), P = result.P.slice();
  for (let k = x.length - 2; k >= 0; k--) {
    const G = P[k] / (P[k] + Q);
    x[k] += G * (x[k + 1] - x[k]);
    P[k] = G * (Q + G * P[k + 1]);
  }
  return { x, P };
}

// --- the filter's rivals, and what they are worth -------------------------------------------------------------------

/** Mean of the last `window` values of z, fewer at the start; gaps left out. */
export function movingAverage(z, window) {
  return z.map((_, k) => {
    let total = 0, count = 0;
    for (let i = Math.max(0, k - window + 1); i <= k; i++) if (z[i] === z[i]) { total += z[i]; count++; }
    return count ? total / count : NaN;
  });
}

/** Exponential smoothing x = x + K (z - x), starting at the first known value of z; a gap keeps x. */
export function exponential(z, K) {
  const x = z.slice();
  for (let k = 1; k < x.length; k++) if (x[k - 1] === x[k - 1]) x[k] = z[k] === z[k] ? x[k - 1] + K * (z[k] - x[k - 1]) : x[k - 1];
  return x;
}

/** The gain K that the filter settles at, for q = Q / R. */
export const steadyGain = q => 2 * Math.sqrt(q) / (Math.sqrt(q) + Math.sqrt(q + 4));

/** The moving average that suppresses white noise as much as the steady gain K. */
export const equalWindow = K => 2 / K - 1;

/** Standard deviation without the NaN. */
function deviation(values) {
  let sum = 0, squares = 0, count = 0;
  for (const value of values) if (value === value) { sum += value; count++; }
  for (const value of values) if (value === value) squares += (value - sum / count) ** 2;
  return Math.sqrt(squares / count);
}

/** Standard deviation of the step from value to value: the smaller, the smoother. */
export const roughness = x => deviation(x.subarray(1).map((value, k) => value - x[k]));

/** How many samples x runs behind the reference: the shift with the smallest squared difference, refined by a parabola. */
export function lag(x, reference, longest = 50) {
  const n = x.length, cost = [];
  if (n < 8 || !(deviation(reference) > 0)) return NaN;
  longest = Math.min(longest, Math.floor(n / 2));
  for (let d = -1; d <= longest; d++) {
    let sum = 0, count = 0;
    for (let k = longest; k < n - 1; k++) {
      const square = (x[k] - reference[k - d]) ** 2;
      if (square === square) { sum += square; count++; }
    }
    cost.push(sum / count);
  }
  const best = cost.indexOf(Math.min(...cost));
  if (best <= 0 || best === cost.length - 1) return best - 1;
  const [left, middle, right] = cost.slice(best - 1, best + 2);
  return best - 1 + (left - right) / (2 * (left - 2 * middle + right));
}

/** Log-likelihood of z for Q and R; the first known value only starts the filter (x = z, P = R). */
export function logLikelihood(z, Q, R) {
  let k = z.findIndex(value => value === value), x = z[k], P = R, total = 0, S = NaN, log = 0;
  for (k++; k < z.length; k++) {
    P += Q;
    if (z[k] !== z[k]) continue;
    if (S !== P + R) log = Math.log(2 * Math.PI * (S = P + R));
    const y = z[k] - x, K = P / S;
    total -= (log + y * y / S) / 2;
    x += K * y;
    P = K * R;
  }
  return total;
}

/** The pair [Q, R] that makes z most likely: a search on a log grid that closes in. */
export function maximumLikelihood(z, decades = 8, points = 41, rounds = 8) {
  const known = z.filter(value => value === value), steps = known.subarray(1).map((value, k) => value - known[k]);
  const scale = steps.length > 1 ? deviation(steps) ** 2 : 0, largest = steps.reduce((most, step) => Math.max(most, Math.abs(step)), 0);
  if (!(scale > 1e-24 * largest ** 2) || scale === 0) {
    throw new InputError({ en: "Q and R need at least three values that do not all change by the same amount.", id: "Q dan R memerlukan sedikitnya tiga nilai yang perubahannya tidak selalu sama." });
  }
  let centre = [Math.log10(scale), Math.log10(scale)];
  for (let round = 0, width = decades; round < rounds; round++, width /= 8) {
    const at = (i, middle) => middle - width + 2 * width * i / (points - 1);
    let best = -Infinity, next = centre;
    for (let i = 0; i < points; i++) {
      for (let j = 0; j < points; j++) {
        const pair = [at(i, centre[0]), at(j, centre[1])], L = logLikelihood(z, 10 ** pair[0], 10 ** pair[1]);
        if (L > best) [best, next] = [L, pair];
      }
    }
    centre = next;
  }
  return centre.map(power => 10 ** power);
}

export const twins = {
  moving_average: (p, data) => movingAverage(data.z, p.window),
  exponential: (p, data, result) => exponential(data.z, result.K[0]),
  equal_window: (p, data, result) => equalWindow(result.K[0] || NaN),
  roughness: (p, data, result) => roughness(result.x),
  log_likelihood: (p, data) => logLikelihood(data.z, p.Q, p.R),
};

// --- synthetic look-alikes of the paper's three recordings, whose data was never published ---------------------------

/** name -> [truth at k of n, noise, its settings in the paper]. */
export const LOOK_ALIKES = {
  silkworm_room: { steps: 288, sigma: 0.3, R: 1e-3, window: 3,
    truth: k => 26 + 1.5 * Math.sin(2 * Math.PI * (k / 12 - 9) / 24) + 0.35 * Math.sign(Math.sin(2 * Math.PI * (k / 12) / 4)) },
  cutting_force: { steps: 200, sigma: 1.5, R: 1e-3, window: 5,
    truth: k => { const s = k / 199, cut = Math.min(Math.max((s - 0.6) / 0.3, 0), 1); return 40 * Math.min(s / 0.55, 1) ** 1.5 * (1 - cut ** 2); } },
  tank_level: { steps: 240, sigma: 0.4, R: 7.7e-4, window: 2, truth: k => 50 - 4 * (1 - Math.abs(1 - Math.max(k - 60, 0) / 60 % 2)) },
};

function lookAlike(name, seed) {
  const { steps, sigma, truth: at } = LOOK_ALIKES[name], rng = generator(seed), truth = new Float64Array(steps).map((_, k) => at(k));
  return { truth, z: truth.map(value => value + sigma * rng.normal()) };
}

// --- from the data to the result ------------------------------------------------------------------------------------

const SOURCES = {
  paper: { id: "16 nilai dari makalah", en: "the paper's 16 values" },
  silkworm_room: { id: "suhu ruang ulat sutra (sintetis)", en: "temperature of a silkworm room (synthetic)" },
  cutting_force: { id: "gaya potong pelepah sawit (sintetis)", en: "cutting force of oil-palm frond (synthetic)" },
  tank_level: { id: "muka air tangki ikan (sintetis)", en: "water level of a fish tank (synthetic)" },
  nile: { id: "debit Sungai Nil 1871–1970 (nyata)", en: "flow of the Nile 1871–1970 (real)" },
  own: { id: "data sendiri", en: "data of my own" },
};
const PAPER = { Q: 1e-5, R: 1e-5, x0: 0, P0: 1, window: 3 };
const brought = s => Boolean(s.text?.trim() || s.file);
const settings = (source, s) => source === "own" && brought(s) ? {} : source === "nile" ? { Q: 1469, R: 15099, x0: 1120, P0: 15099, window: 5 }
  : { ...PAPER, ...LOOK_ALIKES[source] && { R: LOOK_ALIKES[source].R, window: LOOK_ALIKES[source].window } };
const given = s => s.source === "own" && brought(s);

/** The numbers of the source and what to call them; read again only when something about them has changed. */
function load(s, memo) {
  const key = [s.source, s.seed, s.text, s.file, s.sign, s.column];
  if (memo.key?.every((value, i) => value === key[i])) return memo.data;
  const from = given(s) ? "own" : s.source === "own" ? "paper" : s.source, name = { id: "Terukur", en: "Measured" };
  let data = { z: MEASURED, truth: null, names: [], name, note: { id: `${SOURCES[from].id}.`, en: `${SOURCES[from].en}.` } };
  if (s.source === "own" && from === "paper") data.note = { id: "belum ada data sendiri, jadi masih 16 nilai dari makalah.", en: "none of your own yet, so still the paper's 16 values." };
  if (from in LOOK_ALIKES) {
    Object.assign(data, lookAlike(from, s.seed));
    for (const language in SOURCES[from]) data.note[language] = SOURCES[from][language].replace(")", language === "id" ? `, benih acak ${s.seed}).` : `, random seed ${s.seed}).`);
  } else if (from === "nile") {
    data.z = readText(nile).columns.get("volume_1e8_m3");
  } else if (from === "own") {
    const sign = s.sign === "auto" ? null : s.sign, table = s.file ? readFile(s.file.name, s.file.bytes, sign) : readText(s.text, sign);
    const names = [...table.columns.keys()], chosen = names[s.column] ?? names[0];
    data = { z: table.columns.get(chosen), truth: null, names, name: { id: chosen, en: chosen }, note: table.note };
  }
  Object.assign(memo, { key, data });
  return data;
}

const counted = T => new Float64Array(T).map((_, k) => k + 1);

function compute(s, memo) {
  const data = load(s, memo), { z, truth } = data;
  const result = memo.result = run(s, data, memo.result?.T === z.length ? memo.result : null), K = steadyGain(s.Q / s.R);
  if (memo.k?.length !== z.length) memo.k = counted(z.length);
  const smooth = smoothed(result, s.Q);
  const lines = { x: result.x, average: movingAverage(z, s.window), ...s.exponential && { exponential: exponential(z, K) }, ...s.rts && { smooth: smooth.x } };
  return { data, z, truth, result, smooth, K, lines, k: memo.k, root: result.P.map(Math.sqrt), lags: {} };
}

/** The lags, for which a long series takes a while. */
function* refine(r) {
  for (const [name, line] of Object.entries(r.lines)) {
    r.lags[name] = lag(line, r.truth ?? r.smooth.x);
    yield;
  }
}

const LINES = {
  x: { look: "estimate", id: "Filter Kalman", en: "Kalman filter", label: "x" },
  average: { look: "rival", id: "Rataan bergerak", en: "Moving average" },
  exponential: { look: "quiet", id: "Penghalusan eksponensial", en: "Exponential smoothing", label: { id: "eksponensial", en: "exponential" } },
  smooth: { look: "smooth", id: "Penghalus RTS", en: "RTS smoother", label: "x_smooth" },
};

function figure(r, s) {
  const order = ["average", "smooth", "x", "exponential"].filter(name => r.lines[name]);
  return { layers: [
    { look: "measurement", x: r.k, y: r.z, label: "z" },
    r.truth && { look: "truth", x: r.k, y: r.truth, label: "x_true" },
    ...order.map(name => ({ look: LINES[name].look, x: r.k, y: r.lines[name], label: LINES[name].label ?? `MA(${s.window})` }))] };
}

const gains = r => ({ layers: [
  { look: "quiet", level: 0 },
  { look: "quiet", level: r.K, label: { id: "tunak", en: "steady" } },
  { look: "estimate", x: r.k, y: r.result.K, label: "K" }] });
const spreads = r => ({ layers: [{ look: "quiet", level: 0 }, { look: "estimate", x: r.k, y: r.root, label: "√P" }] });

// --- words and numbers ----------------------------------------------------------------------------------------------

const OUTCOME = {
  shown: { id: "N = {n}. Data yang ditampilkan: {what}", en: "N = {n}. Data shown: {what}" },
  gain: { id: "Penguatan menetap pada K = {K}: derau diredam seperti oleh rataan bergerak {window} data.", en: "The gain settles at K = {K}: noise is suppressed as by a moving average of {window} values." },
  rmse: { id: "RMSE-nya {x}, rataan bergerak {average}, pengukuran sendiri {z}.", en: "Its RMSE is {x}, that of the moving average {average}, of the measurements themselves {z}." },
  rough: { id: "Langkah antarnilai bersimpangan baku {z} pada data, {x} sesudah filter, dan {average} pada rataan bergerak.", en: "The steps between values have a standard deviation of {z} in the data, {x} after the filter, {average} in the moving average." },
  cut: { id: "Q dan R dicari dari {n} nilai pertama.", en: "Q and R were found from the first {n} values." },
};

function outcome(r, s, t) {
  const measure = line => r.truth ? rmse(r.truth, line)[0] : roughness(line);
  return [t.say(OUTCOME.shown, { n: String(r.z.length), what: t.say(r.data.note) }), t.say(OUTCOME.gain, { K: r.K, window: equalWindow(r.K) }),
          t.say(OUTCOME[r.truth ? "rmse" : "rough"], { z: measure(r.z), x: measure(r.lines.x), average: measure(r.lines.average) }),
          ...(r.z.length > LIKELIHOOD_POINTS && s.likely?.[0] === s.Q && s.likely[1] === s.R ? [t.say(OUTCOME.cut, { n: String(LIKELIHOOD_POINTS) })] : [])].join(" ");
}

function facts(r, s, t) {
  const against = r.truth ? { id: "Lambat dari nilai sebenarnya (sampel)", en: "Lag behind the truth (samples)" } : { id: "Lambat dari RTS (sampel)", en: "Lag behind RTS (samples)" };
  return {
    head: [t.say({ id: "Cara", en: "Method" }), t.say({ id: "Kasar: σ tiap langkah", en: "Rough: σ of the steps" }), t.say(against), ...(r.truth ? ["RMSE"] : [])],
    rows: Object.entries(r.lines).map(([name, line]) => [t.say(LINES[name]) + (name === "average" ? ` (${s.window})` : ""),
      ...[roughness(line), r.lags[name] ?? NaN, ...(r.truth ? [rmse(r.truth, line)[0]] : [])].map(value => t.decimal(value))]),
  };
}

/** The beginning and the end of a long table, with a row of dots between them. */
function shortened(T, row) {
  const rows = [];
  for (let k = 0; k < T; k++) {
    if (T <= TABLE_ROWS || k < TABLE_ROWS / 2 || k >= T - TABLE_ROWS / 2) rows.push(row(k));
    else if (k === TABLE_ROWS / 2) rows.push(row(k).map(() => "⋮"));
  }
  return rows;
}

function numbers(r, s, t) {
  const { x_pred, P_pred, y, K, x, P } = r.result, others = Object.entries(r.lines || {}).filter(([name]) => name !== "x");
  return { head: ["k", "z", "x_pred", "P_pred", "y", "K", "x", "P", ...others.map(([name]) => t.say(LINES[name].label ?? `MA(${s.window})`))],
           rows: shortened(r.z.length, k => [String(k + 1), ...[r.z, x_pred, P_pred, y, K, x, P, ...others.map(([, line]) => line)].map(column => t.decimal(column[k], 6))]) };
}

// --- copy and download ----------------------------------------------------------------------------------------------

/** The result as lines of text: No, Measured, Filtered, K, P and the rivals; every digit there is. */
function asText(r, s, t, separator, decimal) {
  const others = Object.entries(r.lines).filter(([name]) => name !== "x"), columns = [r.z, r.result.x, r.result.K, r.result.P, ...others.map(([, line]) => line)];
  const head = ["No", t.say({ id: "Terukur", en: "Measured" }), t.say({ id: "Hasil filter", en: "Filtered" }), "K", "P", ...others.map(([name]) => name === "average" ? `MA${s.window}` : t.say(LINES[name]))];
  const lines = [head.join(separator)];
  r.z.forEach((_, k) => lines.push([k + 1, ...columns.map(column => column[k] === column[k] ? String(column[k]).replace(".", decimal) : "")].join(separator)));
  return lines.join("\r\n") + "\r\n";
}

function workbook(r, s, t) {
  if (r.z.length > MAX_WRITE) throw tooLong(r.z.length, MAX_WRITE);
  return writeWorkbook({ z: r.z, p: s, result: r.result, smooth: r.smooth, name: t.say(r.data.name) });
}

const files = [
  { id: "Salin hasilnya", en: "Copy the result", copy: (r, s, t) => asText(r, s, t, "\t", t.language === "id" ? "," : ".") },
  { id: "Unduh CSV", en: "Download CSV", save: (r, s, t) => ({ name: "kalman.csv", type: "text/csv;charset=utf-8", content: asText(r, s, t, ",", ".") }) },
  { id: "Unduh Excel dengan rumus hidup", en: "Download Excel with live formulas",
    save: (r, s, t) => ({ name: "kalman.xlsx", type: "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet", content: workbook(r, s, t) }) },
];

// --- the hand check -------------------------------------------------------------------------------------------------

function question(r, s, t, random) {
  const steps = [...r.z.keys()].slice(0, 400).filter(k => r.z[k] === r.z[k]), near = (a, b) => Math.abs(a - b) <= 0.005 * Math.abs(b), d = value => t.decimal(value, 7);
  const k = steps.length ? steps[random.whole(Math.min(steps.length, 8))] : -1, of = name => r.result[name][k];
  const P = k > 0 ? r.result.P[k - 1] : s.P0, q = s.Q / s.R, kinds = [
    { text: { id: "Di keadaan tunak K² + q K − q = 0, dengan q = Q / R = {q}. Berapa K?", en: "In the steady state K² + q K − q = 0, with q = Q / R = {q}. What is K?" },
      answer: steadyGain(q), hint: () => ({ id: "Ambil akar yang positif: K = (−q + √(q² + 4 q)) / 2.", en: "Take the positive root: K = (−q + √(q² + 4 q)) / 2." }) },
    { text: { id: "K = {steady}. Rataan bergerak berapa data yang meredam derau putih sekuat itu?", en: "K = {steady}. A moving average of how many values suppresses white noise as much?" },
      answer: equalWindow(steadyGain(q)), hint: value => near(value, 2 / steadyGain(q)) ? { id: "Tinggal dikurangi satu.", en: "Only minus one is missing." } : { id: "n = 2 / K − 1.", en: "n = 2 / K − 1." } }];
  if (k >= 0) kinds.push(
    { text: { id: "Langkah {k}: P sebelumnya {P}, Q = {Q}, R = {R}. Berapa K?", en: "Step {k}: the P before it is {P}, Q = {Q}, R = {R}. What is K?" }, answer: of("K"),
      hint: value => near(value, P / (P + s.R)) ? { id: "Prediksi dahulu: P_pred = P + Q.", en: "Predict first: P_pred = P + Q." } : near(value, 1 - of("K")) ? { id: "Itu 1 − K, bagian untuk prediksi.", en: "That is 1 − K, the share of the prediction." }
        : { id: "P_pred = P + Q, lalu K = P_pred / (P_pred + R).", en: "P_pred = P + Q, then K = P_pred / (P_pred + R)." } },
    { text: { id: "Langkah {k}: x_pred = {pred}, z = {z}, K = {K}. Berapa x?", en: "Step {k}: x_pred = {pred}, z = {z}, K = {K}. What is x?" }, answer: of("x"),
      tolerance: 1e-3 * (1 + (Math.abs(of("x_pred")) + Math.abs(r.z[k])) / Math.max(Math.abs(of("x")), 1e-300) / 100),
      hint: value => near(value, of("K") * of("y")) ? { id: "Itu baru koreksinya K y; tambahkan x_pred.", en: "That is only the correction K y; add x_pred." } : { id: "x = x_pred + K (z − x_pred).", en: "x = x_pred + K (z − x_pred)." } },
    { text: { id: "Langkah {k}: K = {K} dan R = {R}. Berapa P sesudah pembaruan?", en: "Step {k}: K = {K} and R = {R}. What is P after the update?" }, answer: of("P"),
      hint: value => near(value, (1 - of("K")) * s.R) ? { id: "(1 − K) mengalikan P_pred, bukan R.", en: "(1 − K) multiplies P_pred, not R." } : { id: "P = (1 − K) P_pred = K R.", en: "P = (1 − K) P_pred = K R." } });
  const kind = kinds[random.whole(kinds.length)];
  const words = { k: String(k + 1), q: d(q), steady: d(steadyGain(q)), P: d(P), Q: d(s.Q), R: d(s.R), ...(k >= 0 && { K: d(of("K")), pred: d(of("x_pred")), z: d(r.z[k]) }) };
  return { text: t.say(kind.text, words), answer: kind.answer, tolerance: kind.tolerance ?? 0.005, hint: value => t.say(kind.hint(value)) };
}

// --- one measurement at a time --------------------------------------------------------------------------------------

const STREAM = 288, RECENT = 200;

function arrive(s, memo) {
  if (memo.seed !== s.seed) Object.assign(memo, { seed: s.seed, stream: lookAlike("silkworm_room", s.seed).z });
  const z = Float64Array.of(...memo.stream.subarray(0, s.arrived), ...s.typed), T = z.length, result = run(s, { z }), from = Math.max(0, T - RECENT);
  const root = result.P.map(Math.sqrt), part = values => values.subarray(from), cut = { ...result, x: part(result.x), K: part(result.K) };
  return { z, result, K: steadyGain(s.Q / s.R), recent: { k: part(counted(T)), z: part(z), result: cut, root: part(root), K: steadyGain(s.Q / s.R), low: part(result.x.map((x, k) => x - 2 * root[k])), high: part(result.x.map((x, k) => x + 2 * root[k])) } };
}

/** The axis grows by fifty. */
const span = ({ recent: { k } }) => { const first = k.length ? k[0] - 1 : 0, last = k.length ? k.at(-1) : 1; return [first, first + 50 * Math.ceil((last - first) / 50)]; };

const ARRIVED = {
  none: { id: "Belum ada pengukuran. Isilah satu bilangan atau jalankan aliran sintetis.", en: "No measurement yet. Enter a number or play the synthetic stream." },
  one: { id: "Pengukuran ke-{k}, z = {z} ({origin}): dengan K = {K} estimasi berubah dari {pred} menjadi {x}; simpangan bakunya √P = {root}.",
         en: "Measurement {k}, z = {z} ({origin}): with K = {K} the estimate goes from {pred} to {x}; its standard deviation is √P = {root}." },
  gap: { id: "Pengukuran ke-{k} tidak datang: estimasi tetap {x}, dan √P tumbuh menjadi {root}.", en: "Measurement {k} did not arrive: the estimate stays {x}, and √P grows to {root}." },
  typed: { id: "diketik", en: "typed" },
  stream: { id: "aliran sintetis, benih acak {seed}", en: "synthetic stream, random seed {seed}" },
};

function arrival(r, s, t) {
  const k = r.z.length - 1, { x_pred, x, P, K } = r.result;
  if (k < 0) return t.say(ARRIVED.none);
  const origin = t.say(ARRIVED[s.typed.length ? "typed" : "stream"], { seed: String(s.seed) });
  return t.say(ARRIVED[r.z[k] === r.z[k] ? "one" : "gap"], { k: String(k + 1), z: r.z[k], K: K[k], pred: x_pred[k], x: x[k], root: Math.sqrt(P[k]), origin }, 5);
}

function equations(r, s, t) {
  const k = r.z.length - 1, d = value => t.decimal(value, 5).replace(/ × 10(.*)/, "·10$1"), signed = value => value < 0 ? `( ${d(value)} )` : d(value);
  if (k < 0) return [[`x_0 = ${d(s.x0)}`], [`P_0 = ${d(s.P0)}`]];
  const { x_pred, P_pred, x, P, y, K } = r.result, before = k ? P[k - 1] : s.P0;
  const predicted = [[`x_pred = ${k ? `x_${k}` : "x_0"} = ${d(x_pred[k])}`], [`P_pred = P + Q = ${d(before)} + ${d(s.Q)} = ${d(P_pred[k])}`]];
  if (y[k] !== y[k]) return [...predicted, [`x = x_pred = ${d(x[k])}`], [`P = P_pred = ${d(P[k])}`]];
  return [...predicted, [`K = P_pred / ( P_pred + R ) = ${d(P_pred[k])} / ( ${d(P_pred[k])} + ${d(s.R)} ) = ${d(K[k])}`],
          [`x = x_pred + K ( z − x_pred ) = ${d(x_pred[k])} + ${d(K[k])} · ${signed(y[k])} = ${d(x[k])}`], [`P = ( 1 − K ) P_pred = ${d(P[k])}`]];
}

// --- the views ------------------------------------------------------------------------------------------------------

function likely(s, r) {
  const limit = (value, low, high) => Number(Math.min(Math.max(value, low), high).toPrecision(6));
  const pair = maximumLikelihood(r.z.subarray(0, LIKELIHOOD_POINTS)), Q = limit(pair[0], 1e-12, 1e6), R = limit(pair[1], 1e-12, 1e6);
  return { Q, R, x0: r.z.find(value => value === value), P0: R, likely: [Q, R] };     // the likelihood starts at the first value
}

const K_PLOT = { title: { id: "Penguatan K", en: "Gain K" }, xlabel: "k", height: 150, half: true, after: true, alt: { id: "Grafik penguatan terhadap nomor data dan nilainya pada keadaan tunak.", en: "Plot of the gain against the number of the value, and its steady value." } };
const P_PLOT = { title: "√P", xlabel: "k", height: 150, half: true, after: true, alt: { id: "Grafik simpangan baku menurut filter terhadap nomor data.", en: "Plot of the standard deviation as the filter states it against the number of the value." } };

export const views = {
  form: {
    name: { id: "Formulir penghalus", en: "The smoother's form" },
    start: PAPER,
    controls: [
      { kind: "select", name: "source", default: "paper", id: "Data", en: "Which data", options: Object.entries(SOURCES), also: settings },
      { kind: "text", name: "text", rows: 3, id: "Data sendiri: tempelkan satu kolom dari lembar kerja. Data tidak meninggalkan perangkat ini.", en: "Data of my own: paste a column from a spreadsheet. Nothing leaves this device.",
        placeholder: { id: "Suhu\n25,1\n25,3", en: "Temperature\n25.1\n25.3" }, also: () => ({ source: "own", file: null, column: 0 }) },
      { kind: "file", name: "file", id: "atau pilih berkas CSV", en: "or choose a CSV file", accept: ".csv,.txt,.tsv", also: () => ({ source: "own", text: null, column: 0 }) },
      { kind: "select", name: "sign", default: "auto", id: "Tanda desimal", en: "Decimal sign", visible: given,
        options: [["auto", { id: "kenali sendiri", en: "find out" }], [",", { id: "koma (1,5)", en: "comma (1,5)" }], [".", { id: "titik", en: "point (1.5)" }]] },
      { kind: "select", name: "column", default: 0, id: "Kolom", en: "Column", visible: (s, r) => given(s) && r?.data.names.length > 1, options: (s, r) => (r?.data.names ?? []).map((name, i) => [i, { id: name, en: name }]) },
      { name: "Q", symbol: "Q" },
      { name: "R", symbol: "R" },
      { name: "P0", symbol: "P_0" },
      { name: "x0", symbol: "x_0", field: true },
      { name: "window", symbol: "n", max: 50 },
      { kind: "check", name: "exponential", default: false, id: "penghalusan eksponensial dengan penguatan tunak", en: "exponential smoothing with the steady gain" },
      { kind: "check", name: "rts", default: false, id: "penghalus maju-mundur (RTS)", en: "forward-backward smoother (RTS)" },
      { kind: "buttons", visible: s => s.source in LOOK_ALIKES, items: [{ id: "Derau baru", en: "New noise", set: s => ({ seed: s.seed + 1 }) }] },
      { kind: "buttons", items: [{ id: "Q dan R paling mungkin", en: "Most likely Q and R", set: likely }, ...files] },
    ],
    compute, refine,
    plots: [
      { title: { id: "Terukur dan dihaluskan", en: "Measured and smoothed" }, xlabel: "k", height: 230, draw: figure,
        alt: { id: "Grafik titik pengukuran, garis hasil filter, dan garis rataan bergerak.", en: "Plot of the measured dots, the filtered line and the moving average." } },
      { ...K_PLOT, draw: gains },
      { ...P_PLOT, draw: spreads },
    ],
    outcome, facts, numbers, question,
  },
  online: {
    name: { id: "Filter daring", en: "The online filter" },
    start: { Q: 1e-3, R: 0.09, P0: 1000, typed: [] },
    controls: [
      { kind: "entry", id: "Pengukuran baru", en: "New measurement", button: { id: "Tambahkan", en: "Add" }, enter: (text, s) => ({ typed: [...s.typed, number(text)] }) },
      { kind: "buttons", items: [
        { id: "Tidak datang", en: "It does not arrive", set: s => ({ typed: [...s.typed, NaN] }) },
        { id: "Buang yang terakhir", en: "Drop the last one", set: s => s.typed.length ? { typed: s.typed.slice(0, -1) } : { arrived: Math.max(s.arrived - 1, 0) }, disabled: s => s.typed.length + s.arrived === 0 },
        { id: "Kosongkan", en: "Clear", set: { typed: [], arrived: 0 }, disabled: s => s.typed.length + s.arrived === 0 },
        { id: "Jalankan aliran", en: "Play the stream", play: "arrived", seconds: 60 }] },
      { name: "arrived", id: "data dari aliran sintetis (suhu ruang ulat sutra); yang diketik menyusul", en: "values from the synthetic stream (silkworm room); typed ones follow", unit: "", min: 0, max: STREAM, step: 1, log: false, default: 60 },
      { name: "Q", symbol: "Q" },
      { name: "R", symbol: "R" },
    ],
    noise: true,
    compute: arrive,
    plots: [
      { title: { id: "Pengukuran yang sudah datang", en: "What has arrived" }, xlabel: "k", height: 230,
        alt: { id: "Grafik titik pengukuran yang sudah datang dan garis estimasi dengan pita.", en: "Plot of the measurements that have arrived and the estimated line with its band." },
        draw: r => ({ xlim: span(r), layers: [
          { look: "band", x: r.recent.k, low: r.recent.low, high: r.recent.high, label: "±2√P" },
          { look: "measurement", x: r.recent.k, y: r.recent.z, label: "z" },
          { look: "estimate", x: r.recent.k, y: r.recent.result.x, label: "x" }] }) },
      { ...K_PLOT, draw: r => ({ ...gains(r.recent), xlim: span(r) }) },
      { ...P_PLOT, draw: r => ({ ...spreads(r.recent), xlim: span(r) }) },
    ],
    outcome: arrival, equations, numbers, question,
  },
};
