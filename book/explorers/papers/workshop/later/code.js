// The filter that was built as a program: with kalman_lib, or with filterpy. Both read the CSV of the page.
import { gateLimit } from "../filter.js";
import { GATE } from "../estimate.js";
import { PATTERN, SECOND, continuous, hasBias, hasInput, modelOf } from "../model.js";
import { CODE } from "../words.js";

export const CSV_NAME = "workshop.csv";

/** Does nothing; who calls it has this file at hand. */
export function ready() {}

// --- what both programs say --------------------------------------------------------------------------------

function matrixCode(rows) {
  return `np.array([${rows.map((row) => `[${row.join(", ")}]`).join(", ")}])`;
}

function listCode(values) {
  return `[${Array.from(values).join(", ")}]`;
}

/** The matrix M, one row a line. */
function named(name, rows) {
  const lines = rows.map((row) => `    [${row.join(", ")}],`);
  return [`${name} = np.array([`, ...lines, "])"];
}

function rowsOf(values, width) {
  const all = Array.from(values);
  return Array.from({ length: all.length / width }, (_, i) => all.slice(i * width, (i + 1) * width));
}

/** The beginning of a program: the data. */
function dataLines({ data, p }, isTable) {
  const columns = data.m > 1 ? ["z", "z_2"] : ["z"];
  const several = `np.column_stack([${columns.map((name) => `data["${name}"]`).join(", ")}])`;
  const lines = [`data = np.genfromtxt("${CSV_NAME}", delimiter=",", names=True)`];
  lines.push(isTable || data.m > 1 ? `z = ${several}` : 'z = data["z"]');
  if (data.u) {
    lines.push('u = data["u"]');
  }
  if (p.pattern === PATTERN.OWN) {
    return lines;
  }
  const even = isTable ? `np.full(len(z), ${p.dt})` : `${p.dt}`;
  return [...lines, data.dt ? 'dt = data["dt"]' : `dt = ${even}`];
}

/** H, R, x0 and P0. */
function startLines({ made }) {
  const { n, H, R, x0 } = made;
  return [
    ...named("H", rowsOf(H, n)),
    `R = np.diag(${listCode(R)})`,
    `x0 = np.array(${listCode(Array.from(x0, asFloat))})`,
    ...startingCovariance(made),
  ];
}

/** P0: its variances, or the whole matrix where states start together. */
function startingCovariance({ n, P0 }) {
  if (P0.some((value, at) => value !== 0 && at % (n + 1) !== 0)) {
    return named("P0", rowsOf(P0, n));
  }
  return [`P0 = np.diag(${listCode(Array.from({ length: n }, (_, i) => asFloat(P0[i * (n + 1)])))})`];
}

/** NumPy makes whole numbers of "[0, 0]". */
function asFloat(value) {
  return Number.isInteger(value) && Math.abs(value) < 1e15 ? `${value}.0` : String(value);
}

function aboutOf(r) {
  const { data, p } = r;
  return { data, p, made: modelOf(p, data), gate: p.gate };
}

/** Of a model of the reader's own: F and Q of every step. */
function ownLines({ made, p }) {
  return [...named("F", rowsOf(made.F, made.n)), `Q = ${p.q} * np.eye(${made.n})`];
}

// --- kalman_lib --------------------------------------------------------------------------------------------

/** The program with kalman_lib. */
export function kalmanCode(r, s, t) {
  const about = aboutOf(r);
  const isOwn = about.p.pattern === PATTERN.OWN;
  const rooms = isOwn ? "LinearModel, kalman_filter" : "LinearModel, discretise, kalman_filter";
  const { u } = about.data;
  const more = `${u ? ", u" : ""}${about.gate ? `, gate=${GATE}` : ""}`;
  const lines = [
    ...comments(CODE.kalman_lib, t),
    "import numpy as np",
    `from kalman_lib import ${rooms}`,
    "",
    ...dataLines(about, false),
    "",
    ...(isOwn ? ownLines(about) : continuousLines(about)),
    ...startLines(about),
    "",
    `model = LinearModel(F=F, H=H, Q=Q, R=R, x0=x0, P0=P0${u ? ", B=B" : ""})`,
    `result = kalman_filter(model, z${more})`,
    "print(result.x[-1], np.sqrt(np.diag(result.P[-1])))",
  ];
  return `${lines.join("\n")}\n`;
}

function comments(words, t) {
  return t
    .say(words, { file: CSV_NAME })
    .split("\n")
    .map((line) => `# ${line}`);
}

function continuousLines({ p, data }) {
  const { A, Bc, Qc } = continuous(p);
  const lines = [...named("A", A), `Qc = np.diag(${listCode(Qc)})`];
  if (data.u) {
    lines.push(`Bc = np.array(${listCode(Bc.map((value) => `[${value}]`))})`);
    return [...lines, "F, Q, B = discretise(A, Qc, dt, Bc)"];
  }
  return [...lines, "F, Q = discretise(A, Qc, dt)"];
}

// --- filterpy ----------------------------------------------------------------------------------------------

/** The program with filterpy, sensor by sensor, so that each may be silent. */
export function filterpyCode(r, s, t) {
  const about = aboutOf(r);
  const { n } = about.made;
  const isOwn = about.p.pattern === PATTERN.OWN;
  const { u } = about.data;
  const limit = about.gate ? ` & (y**2 <= ${gateLimit(GATE)} * np.diag(S))` : "";
  const lines = [
    ...comments(CODE.filterpy, t),
    "import numpy as np",
    "from filterpy.kalman import KalmanFilter",
    "",
    ...dataLines(about, true),
    "",
    ...(isOwn ? ownLines(about) : []),
    ...startLines(about),
    "",
    `f = KalmanFilter(dim_x=${n}, dim_z=1)`,
    "f.x, f.P = x0, P0",
    "x, P = [], []",
    "for k in range(len(z)):",
    ...(isOwn ? [] : stepLines(about.p)),
    `    f.predict(F=F, Q=Q${u ? ", B=B, u=u[k : k + 1]" : ""})`,
    "    y = z[k] - H @ f.x",
    ...(about.gate ? ["    S = H @ f.P @ H.T + R"] : []),
    `    heard = np.isfinite(y)${limit}`,
    "    for i in np.flatnonzero(heard):",
    "        f.update(z[k, i], R=R[i, i], H=H[i : i + 1])",
    "    x.append(f.x)",
    "    P.append(f.P)",
    "print(x[-1], np.sqrt(np.diag(P[-1])))",
  ];
  return `${lines.join("\n")}\n`;
}

/** F, Q and B of a step, by their formulas. */
function stepLines(p) {
  const { order, A } = continuous(p);
  const n = A.length;
  const each = (make) => A.map((_, i) => A.map((_, j) => make(i, j)));
  const F = each((i, j) => (j < order || i === j ? chain(j - i) : driftOf(p, order - i)));
  const Q = each((i, j) => (i < order && j < order ? noiseOf(order - 1 - i, order - 1 - j) : "0"));
  const Qc = p.pattern === PATTERN.CONSTANT ? 0 : p.q;
  const lines = ["h = dt[k]", `F = ${matrixCode(F)}`, `Q = ${Qc} * ${matrixCode(Q)}`];
  if (hasInput(p)) {
    const B = Array.from({ length: n }, (_, i) => [i < order ? chain(order - i) : "0"]);
    lines.push(`B = ${matrixCode(B)}`);
  }
  return lines.map((line) => `    ${line}`);
}

const FACTORIAL = [1, 1, 2, 6];

/** What a state does to the one so many places before it: h^k / k!. */
function chain(power) {
  if (power < 0) {
    return "0";
  }
  const divided = FACTORIAL[power] > 1 ? ` / ${FACTORIAL[power]}` : "";
  return power > 0 ? `${powerOf(power)}${divided}` : "1";
}

function powerOf(power) {
  return power === 1 ? "h" : `h**${power}`;
}

/** What the bias of a known input does. */
function driftOf(p, power) {
  return hasBias(p) && p.second === SECOND.DRIVES && power > 0 ? `-${chain(power)}` : "0";
}

/** The integral of s^a / a! s^b / b! over a step. */
function noiseOf(a, b) {
  const divisor = FACTORIAL[a] * FACTORIAL[b] * (a + b + 1);
  return divisor > 1 ? `${powerOf(a + b + 1)} / ${divisor}` : "h";
}

// --- the data ----------------------------------------------------------------------------------------------

/** What went in and what came out, every digit; gaps are empty. */
export function csvText({ data, result, p }) {
  const { n, m, T } = result;
  const entry = (values, size, i) => (k) => values[k * size + i];
  const columns = {
    k: (k) => k + 1,
    t: (k) => data.t[k],
    dt: (k) => data.dt?.[k] ?? p.dt,
    z: entry(data.z, m, 0),
    ...(m > 1 ? { z_2: entry(data.z, m, 1) } : {}),
    ...(data.u ? { u: (k) => data.u[k] } : {}),
  };
  for (let i = 0; i < n; i++) {
    columns[`x_${i + 1}`] = entry(result.x, n, i);
    columns[`P_${i + 1}`] = entry(result.P, n * n, i * n + i);
  }
  for (let i = 0; i < m; i++) {
    columns[`y_${i + 1}`] = entry(result.y, m, i);
    columns[`S_${i + 1}`] = entry(result.S, m * m, i * m + i);
  }
  const lines = [Object.keys(columns).join(",")];
  for (let k = 0; k < T; k++) {
    lines.push(
      Object.values(columns)
        .map((value) => cell(value(k)))
        .join(","),
    );
  }
  return `${lines.join("\r\n")}\r\n`;
}

function cell(value) {
  return Number.isNaN(value) ? "" : String(value);
}
