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

/** [RMSE (rad), mean NEES] to be expected of a filter that believes sigma_w and sigma_v while p is true; needs no data. */
export function expected(p, sigma_w, sigma_v) {
  const Q = (p.sigma_w * p.T) ** 2, R = p.sigma_v ** 2, Q_told = (sigma_w * p.T) ** 2, R_told = sigma_v ** 2, T = steps(p);
  let P = 0, V = 0, squares = 0, nees = 0;
  for (let k = 0; k < T; k++) {
    const P_pred = P + Q_told, K = P_pred / (P_pred + R_told), keep = R_told / (P_pred + R_told);
    P = K * R_told;
    V = keep * keep * (V + Q) + K * K * R;
    squares += V;
    nees += V / P;
  }
  return [Math.sqrt(squares / T), nees / T];
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
  expected: p => expected(p, p.sigma_w, p.sigma_v),
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
  run: { id: "Pada percobaan ini RMSE sensor {sensor} rad dan RMSE filter {rmse} rad; galat terbesarnya {z} rad (pengukuran) dan {x} rad (estimasi).",
         en: "In this run the RMSE of the sensor is {sensor} rad and that of the filter {rmse} rad; the largest errors are {z} rad (measurement) and {x} rad (estimate)." },
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

// --- the map of a wrong sigma ----------------------------------------------------------------------------------------

const HALF = 15, LEVELS = { cost: [1.1, 1.3, 1.6, 2, 2.5, 3], nees: [0.03, 0.1, 0.3, 1, 3, 10, 30] };
const CELLS = Array.from({ length: 2 * HALF + 1 }, (_, k) => k - HALF);
const factor = i => 10 ** (i / HALF);           // i = -HALF ... HALF: a tenth to ten times the true one

/**
 * cost(i, j) = RMSE / optimum and nees(i, j) of factor(i) sigma_w and factor(j) sigma_v, and steps: how many levels every
 * cell has passed. The gain depends on i - j only.
 */
function costs(s, memo) {
  const key = [s.sigma_w, s.sigma_v, s.T, s.duration].join();
  if (memo.map?.key !== key) {
    const rows = Array.from({ length: 4 * HALF + 1 }, (_, d) => expected(s, factor(d - 2 * HALF) * s.sigma_w, s.sigma_v)), best = rows[2 * HALF][0];
    const cost = (i, j) => rows[i - j + 2 * HALF][0] / best, nees = (i, j) => rows[i - j + 2 * HALF][1] / factor(j) ** 2;
    const passed = (value, levels) => CELLS.map(j => CELLS.map(i => levels.filter(level => value(i, j) >= level).length));
    memo.map = { key, best, cost, nees, steps: { cost: passed(cost, LEVELS.cost), nees: passed(nees, LEVELS.nees) } };
  }
  return memo.map;
}

function compare(s, memo) {
  const believed = { other: true, believed_w: s.times_w * s.sigma_w, believed_v: s.times_v * s.sigma_v };
  return { ...compute({ ...s, ...believed }, memo), ...costs(s, memo), wrong: expected(s, believed.believed_w, believed.believed_v) };
}

/** Where value(place) crosses the level between two whole places from..to, or null. */
function crossing(value, level, from, to) {
  for (let i = from; i < to; i++) {
    const a = Math.log(value(i) / level), b = Math.log(value(i + 1) / level);
    if (a * b <= 0 && a !== b) return i + a / (a - b);
  }
  return null;
}

/** A map in steps, each with its number: how dark a cell is tells between which levels its value lies. */
function map(title, name, places, alt) {
  return { title, xlabel: "rad/s", height: 260, half: true, xlog: true, ylog: true, alt,
    drag: (x, y, s) => ({ times_w: near(x / s.sigma_w), times_v: near(y / s.sigma_v) }),
    draw(r, s, t) {
      const w = i => s.sigma_w * factor(i), v = j => s.sigma_v * factor(j), levels = LEVELS[name], steps = r.steps[name];
      const paint = (ctx, X, Y, colours) => {
        const edge = (place, size) => [-HALF, ...CELLS.map(i => i + 1)].map(i => Math.round(place(size(i - 0.5)))), lefts = edge(X, w), bottoms = edge(Y, v);      // or seams would show
        steps.forEach((row, j) => {
          for (let i = 0, from = 0; i < row.length; i++) {
            if (row[i] === row[i + 1]) continue;
            ctx.globalAlpha = 0.1 * row[i];
            ctx.fillRect(lefts[from], bottoms[j + 1], lefts[i + 1] - lefts[from], bottoms[j] - bottoms[j + 1]);
            from = i + 1;
          }
        });
        ctx.globalAlpha = 1;
        ctx.fillStyle = colours.words;
        ctx.font = `600 11px ${colours.font}`;
        ctx.textAlign = "center";
        ctx.textBaseline = "middle";
        for (const { value, at, from, to } of places(r)) {
          let last = [-99, -99];
          for (const level of levels) {
            const place = crossing(value, level, from, to), here = place === null ? last : at(place).map((i, axis) => axis ? Y(v(i)) : X(w(i)));
            if (Math.hypot(here[0] - last[0], here[1] - last[1]) < 14) continue;                // no number upon another
            ctx.fillText(t.decimal(level), ...here);
            last = here;
          }
        }
      };
      return { xlim: [w(-HALF - 0.5), w(HALF + 0.5)], ylim: [v(-HALF - 0.5), v(HALF + 0.5)], layers: [{ look: "estimate", paint },
        { look: "truth", mark: [s.sigma_w, s.sigma_v], sign: "+", label: { id: "yang benar", en: "the truth" } },
        { look: "measurement", mark: [s.times_w * s.sigma_w, s.times_v * s.sigma_v], label: { id: "yang dipercayai filter", en: "what the filter believes" } }] };
    } };
}

const near = times => Number(Math.min(Math.max(times, 0.1), 10).toPrecision(3));
const across = r => [[-HALF, 0], [0, HALF]].map(([from, to]) => ({ value: i => r.cost(i, -i), at: i => [i, -i], from, to }));       // over the valley
const along = r => [{ value: i => r.nees(i + 3, i - 3), at: i => [i + 3, i - 3], from: 3 - HALF, to: HALF - 3 }];             // beside the marks

const VERDICT = {
  map: { id: "Filter percaya σ_w = {w} rad/s dan σ_v = {v} rad, padahal yang benar {true_w} dan {true_v}. RMSE-nya {rmse} rad, {cost} kali yang terbaik ({best} rad), dan NEES-nya {nees}: {word}.",
         en: "The filter believes σ_w = {w} rad/s and σ_v = {v} rad; the truth is {true_w} and {true_v}. Its RMSE is {rmse} rad, {cost} times the best ({best} rad), and its NEES {nees}: {word}." },
  runs: { id: "Dari {runs} percobaan sintetis (benih acak {seed}): RMSE {all} rad, NEES {mean}.", en: "From {runs} synthetic runs (random seed {seed}): RMSE {all} rad, NEES {mean}." },
  sure: { id: "terlalu yakin", en: "too sure" }, doubtful: { id: "terlalu ragu", en: "too doubtful" }, honest: { id: "P-nya jujur", en: "its P is honest" },
};

const MAP = {
  outcome(r, s, t) {
    const all = study(r), [rmse, nees] = r.wrong, word = VERDICT[nees > 1.1 ? "sure" : nees < 0.9 ? "doubtful" : "honest"];
    return [t.say(VERDICT.map, { w: r.believed.sigma_w, v: r.believed.sigma_v, true_w: s.sigma_w, true_v: s.sigma_v, rmse, cost: rmse / r.best, best: r.best, nees, word: t.say(word) }),
            t.say(VERDICT.runs, { runs: String(r.runs.count), seed: String(s.seed), all: all.rmse, mean: all.nees })].join(" ");
  },
  numbers(r, s, t) {
    const places = [-HALF, -HALF / 2, 0, HALF / 2, HALF].map(Math.round), show = value => t.decimal(value);
    return { head: ["σ_w (rad/s)", "σ_v (rad)", t.say({ id: "RMSE / terbaik", en: "RMSE / best" }), "NEES"],
             rows: places.flatMap(j => places.map(i => [s.sigma_w * factor(i), s.sigma_v * factor(j), r.cost(i, j), r.nees(i, j)].map(show))) };
  },
  question(r, s, t, random) {
    const c = [0.2, 0.5, 2, 5][random.whole(4)], [K_w, K_v] = [[3, 1], [1, 2], [2, 1]][random.whole(3)], q = (s.sigma_w * s.T / s.sigma_v) ** 2, close = (a, b) => Math.abs(a - b) <= 0.02 * Math.abs(b);
    const given = { c: t.decimal(c), w: t.decimal(K_w), v: t.decimal(K_v), q: t.decimal(q, 4) };
    const kinds = [
      { text: { id: "Sebuah filter percaya {c} σ_w dan {c} σ_v. Dengan pasangan yang benar NEES-nya 1. Berapa NEES-nya sekarang?", en: "A filter believes {c} σ_w and {c} σ_v. With the true pair its NEES is 1. What is it now?" },
        answer: 1 / c ** 2,
        hint: value => close(value, c ** 2) ? { id: "Terbalik: P menjadi c² kali, dan NEES dibagi P.", en: "The other way round: P becomes c² times as large, and NEES is divided by P." } : close(value, 1 / c) ? { id: "P berisi kuadrat simpangan baku: kuadratkan c.", en: "P holds squares of standard deviations: square c." }
          : { id: "K tidak berubah, jadi galatnya juga tidak; P menjadi c² kali.", en: "K does not change, so neither does the error; P becomes c² times as large." } },
      { text: { id: "Sebuah filter percaya {w} σ_w dan {v} σ_v. Dengan yang benar q = Q/R = {q}. Berapa q menurut filter itu?", en: "A filter believes {w} σ_w and {v} σ_v. The true q = Q/R is {q}. What is q as the filter has it?" },
        answer: q * (K_w / K_v) ** 2, tolerance: 0.02,
        hint: value => close(value, q * K_w / K_v) ? { id: "q berisi kuadrat kedua simpangan baku.", en: "q holds the squares of both standard deviations." } : { id: "q = (σ_w T)² / σ_v²: kalikan dengan ({w} / {v})².", en: "q = (σ_w T)² / σ_v²: multiply by ({w} / {v})²." } },
    ];
    const kind = kinds[random.whole(kinds.length)];
    return { text: t.say(kind.text, given), answer: kind.answer, tolerance: kind.tolerance, hint: value => t.say(kind.hint(value), given) };
  },
};

// --- the views ------------------------------------------------------------------------------------------------------

const settings = ([sigma_w, sigma_v]) => ({ duration: 20, T: 0.1, sigma_w, sigma_v });
const is = values => s => Object.entries(values).every(([name, value]) => s[name] === value);
const MEMS = { duration: 2, T: 0.01, sigma_w: Number((0.1 * DEGREE).toPrecision(3)), sigma_v: Number(DEGREE.toPrecision(3)) };
const believed = { min: 1e-4, max: 100, step: 0.1, log: true, default: null };
const times = { min: 0.1, max: 10, step: 0.1, log: true, default: 1, unit: "" };

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
  mismatch: {
    name: { id: "Harga σ yang salah", en: "What a wrong σ costs" },
    noise: true,
    controls: [
      { kind: "buttons", items: [
        { id: "σ_w sepersepuluh", en: "σ_w a tenth", set: { times_w: 0.1, times_v: 1 } }, { id: "σ_w 10 kali", en: "σ_w 10 times", set: { times_w: 10, times_v: 1 } },
        { id: "σ_v sepersepuluh", en: "σ_v a tenth", set: { times_w: 1, times_v: 0.1 } }, { id: "σ_v 10 kali", en: "σ_v 10 times", set: { times_w: 1, times_v: 10 } },
        { id: "yang benar", en: "the truth", set: { times_w: 1, times_v: 1 } }].map(item => ({ ...item, pressed: is(item.set) })) },
      { ...times, name: "times_w", symbol: "c_w", id: "σ_w menurut filter dibagi yang benar", en: "σ_w as the filter believes it, over the true one" },
      { ...times, name: "times_v", symbol: "c_v", id: "σ_v menurut filter dibagi yang benar", en: "σ_v as the filter believes it, over the true one" },
      { name: "sigma_w", symbol: "σ_w" },
      { name: "sigma_v", symbol: "σ_v" },
      { name: "duration", symbol: "t" },
      { name: "T", symbol: "T" },
    ],
    compute: compare,
    *refine(r, s) { yield* errors(r, s, r.memo); },
    plots: [
      map({ id: "RMSE / terbaik: σ_w mendatar, σ_v (rad) tegak", en: "RMSE / best: σ_w across, σ_v (rad) upwards" }, "cost", across,
        { id: "Peta RMSE relatif: lembah lurus sejajar diagonal, naik ke sudut kiri atas dan kanan bawah.", en: "Map of the relative RMSE: a straight valley along the diagonal, rising to the top left and bottom right corners." }),
      map({ id: "NEES: σ_w mendatar, σ_v (rad) tegak", en: "NEES: σ_w across, σ_v (rad) upwards" }, "nees", along,
        { id: "Peta rata-rata NEES: besar di kiri dan di bawah, kecil di sudut kanan atas.", en: "Map of the mean NEES: large at the left and at the bottom, small in the top right corner." }),
    ],
    ...MAP,
  },
};
