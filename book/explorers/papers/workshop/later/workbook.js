// A scalar filter of the workshop as an .xlsx with live formulas, one row a step.
import { COLUMN, DATA, GAIN, INPUT, LABEL, PLAIN, POWER, RESULT, TITLE, VALUE } from "../../../files/xlsx.js";
import { formula, number, text, workbook } from "../../../files/xlsx.js";
import { gateLimit } from "../filter.js";
import { GATE } from "../estimate.js";
import { PATTERN, modelOf } from "../model.js";

const FIRST = 7; // the first row of the table
const HEIGHTS = { 3: 50, 6: 50 }; // points
const WIDTHS = [7, 14, 12, 14, 12, 14, 16, 14, 16, 12, 14, 16];
const NAMES = {
  q_: "Filter!$B$4",
  R_: "Filter!$C$4",
  x0_: "Filter!$D$4",
  P0_: "Filter!$E$4",
  gate_: "Filter!$F$4",
};
const LABELS = [
  "q\nderau proses /\nprocess noise",
  "R\nvarians ukur /\nmeasurement var.",
  "x0\ntebakan awal /\ninitial guess",
  "P0\nvarians x0 /\nvariance of x0",
  "batas y²/S /\nlimit of y²/S\n(gate)",
];
const HEAD = [
  "No",
  "Waktu /\nTime\nt",
  "Langkah /\nStep\ndt",
  "Terukur /\nMeasured\nz",
  "Masukan /\nInput\nu",
  "Prediksi /\nPrediction\nx_pred",
  "Varians /\nVariance\nP_pred",
  "Inovasi /\nInnovation\ny",
  "Varians /\nVariance\nS",
  "Penguatan /\nGain\nK",
  "Terfilter /\nFiltered\nx",
  "Varians /\nVariance\nP",
];

/** The workbook as bytes: r is what the workshop shows, of a model with one state and one sensor. */
export function writeWorkbook(r) {
  const rows = [...topRows(r), ...Array.from(r.data.t.keys(), (k) => [FIRST + k, stepRow(r, k)])];
  const sheet = { title: "Filter", rows, widths: WIDTHS, heights: HEIGHTS, first: FIRST };
  return workbook({ sheets: [sheet], names: NAMES });
}

function texts(words, row, letters, look) {
  return words.map((word, i) => text(`${letters[i]}${row}`, word, look)).join("");
}

function topRows({ p, data }) {
  const { x0, P0 } = modelOf(p, data);
  const settings = [
    number("B4", p.pattern === PATTERN.CONSTANT ? 0 : p.q, INPUT),
    number("C4", p.R, INPUT),
    number("D4", x0[0], INPUT),
    number("E4", P0[0], INPUT),
    number("F4", p.gate ? gateLimit(GATE) : NaN, INPUT),
  ];
  const instruction =
    "Ubah sel kuning; semua rumus menghitung ulang. / Change the yellow cells; every formula follows.";
  return [
    [1, text("A1", "Filter Kalman skalar / Scalar Kalman filter", TITLE)],
    [2, text("A2", instruction)],
    [3, texts(LABELS, 3, "BCDEF", LABEL)],
    [4, settings.join("")],
    [6, texts(HEAD, 6, "ABCDEFGHIJKL", COLUMN)],
  ];
}

/** Step k: the equations as formulas, beside the values that the page has. */
function stepRow({ data, result, p }, k) {
  const { x_pred, P_pred, S, K, x, P } = result;
  const i = FIRST + k;
  const x_before = k === 0 ? "x0_" : `K${i - 1}`;
  const P_before = k === 0 ? "P0_" : `L${i - 1}`;
  const innovation = data.z[k] - x_pred[k]; // the gate shows only in the gain
  const closed = `AND(ISNUMBER(gate_),H${i}^2>gate_*I${i})`;
  return [
    number(`A${i}`, k + 1, PLAIN),
    number(`B${i}`, data.t[k], VALUE),
    number(`C${i}`, data.dt?.[k] ?? p.dt, DATA),
    number(`D${i}`, data.z[k], DATA),
    number(`E${i}`, data.u?.[k] ?? NaN, DATA),
    formula(`F${i}`, `${x_before}+C${i}*E${i}`, x_pred[k], VALUE),
    formula(`G${i}`, `${P_before}+q_*C${i}`, P_pred[k], POWER),
    formula(`H${i}`, `IF(ISNUMBER(D${i}),D${i}-F${i},"")`, innovation, VALUE),
    formula(`I${i}`, `G${i}+R_`, S[k], POWER),
    formula(`J${i}`, `IF(ISNUMBER(H${i}),IF(${closed},0,G${i}/I${i}),0)`, K[k], GAIN),
    formula(`K${i}`, `IF(ISNUMBER(H${i}),F${i}+J${i}*H${i},F${i})`, x[k], RESULT),
    formula(`L${i}`, `IF(J${i}>0,J${i}*R_,G${i})`, P[k], POWER),
  ].join("");
}
