// The form of Rudiyanto, Setiawan and Saptomo (2006) as an .xlsx with live formulas, cell for cell the sheets
// Filter and RTS that Python's write_workbook writes (its charts and notes are left out).
import {
  COLUMN,
  DATA,
  GAIN,
  INPUT,
  LABEL,
  PLAIN,
  POWER,
  RESULT,
  TEXT,
  TITLE,
  VALUE,
} from "../../files/xlsx.js";
import { formula, number, text, workbook } from "../../files/xlsx.js";

const FIRST = 7; // the first row of both tables
const HEIGHTS = { 3: 50, 6: 50 }; // points
const FILTER_WIDTHS = [7, 16, 17, 17, 16, 16, 16, 16];
const RTS_WIDTHS = [7, 16, 16, 20, 16, 16, 16];
const LONGEST_NAME = 100;
const NAMES = { P0_: "Filter!$E$4", Q_: "Filter!$B$4", R_: "Filter!$C$4", x0_: "Filter!$D$4" };

const LABELS = [
  "Q\nvarians proses /\nprocess var.",
  "R\nvarians ukur /\nmeasurement var.",
  "x0\ntebakan awal /\ninitial guess",
  "P0\nvarians x0 /\nvariance of x0",
  "N\njumlah data /\nhow many",
  "Data\nnama kolom /\ncolumn name",
];
const FILTER_HEAD = [
  "No",
  "Terukur /\nMeasured\nz",
  "Prediksi /\nPrediction\nx_pred",
  "Varians prediksi /\nIts variance\nP_pred",
  "Inovasi /\nInnovation\ny",
  "Penguatan /\nGain\nK",
  "Terfilter /\nFiltered\nx",
  "Varians /\nVariance\nP",
];
const RTS_HEAD = [
  "No",
  "Terfilter /\nFiltered\nx",
  "Varians /\nVariance\nP",
  "P_pred berikutnya /\nnext P_pred",
  "Penguatan /\nGain\nG",
  "Terhaluskan /\nSmoothed\nx_smooth",
  "Varians /\nVariance\nP_smooth",
];

/**
 * The workbook as bytes. z (T), NaN = gap; p {Q, R, x0, P0}; the result of the filter and the smoother's x
 * and P, only so that programs that do not calculate show numbers, too; name: what was measured, always a
 * text.
 */
export function writeWorkbook({ z, p, result, smooth, name }) {
  const steps = Array.from(z.keys());
  const filter = [...filterTop(z, p, name), ...steps.map((k) => [FIRST + k, filterRow(k, z, result)])];
  const rts = [...rtsTop(), ...steps.map((k) => [FIRST + k, rtsRow(k, result, smooth)])];
  const sheets = [
    { title: "Filter", rows: filter, widths: FILTER_WIDTHS, heights: HEIGHTS, first: FIRST },
    { title: "RTS", rows: rts, widths: RTS_WIDTHS, heights: HEIGHTS, first: FIRST },
  ];
  return workbook({ sheets, names: NAMES });
}

/** Texts in one row, from this column on: "B3", "C3", ... */
function texts(words, row, column, look) {
  return words.map((word, i) => text(`${"ABCDEFGH"[column + i]}${row}`, word, look)).join("");
}

/** Title, settings and heads of the columns. */
function filterTop(z, p, name) {
  const known = z.filter((value) => !Number.isNaN(value)).length;
  const shown_name = Array.from(name.replace(/\s+/g, " ").trim()).slice(0, LONGEST_NAME).join("");
  const settings = [
    number("B4", p.Q, INPUT),
    number("C4", p.R, INPUT),
    number("D4", p.x0, INPUT),
    number("E4", p.P0, INPUT),
    formula("F4", `COUNT(B${FIRST}:B1048576)`, known, PLAIN),
    text("G4", shown_name, TEXT),
  ];
  const instruction =
    "Ubah sel kuning; semua rumus menghitung ulang. / Change the yellow cells; every formula follows.";
  return [
    [1, text("A1", "Filter Kalman skalar / Scalar Kalman filter", TITLE)],
    [2, text("A2", instruction)],
    [3, texts(LABELS, 3, 1, LABEL)],
    [4, settings.join("")],
    [6, texts(FILTER_HEAD, 6, 0, COLUMN)],
  ];
}

/** Step k of the filter: the equations of the paper as formulas. */
function filterRow(k, z, { x_pred, P_pred, y, K, x, P }) {
  const r = FIRST + k;
  const before = r - 1;
  const known = `IF(ISNUMBER(B${r}),`;
  return [
    number(`A${r}`, k + 1, PLAIN),
    number(`B${r}`, z[k], DATA),
    formula(`C${r}`, k === 0 ? "x0_" : `G${before}`, x_pred[k], VALUE),
    formula(`D${r}`, k === 0 ? "P0_+Q_" : `H${before}+Q_`, P_pred[k], POWER),
    formula(`E${r}`, `${known}B${r}-C${r},"")`, y[k], VALUE),
    formula(`F${r}`, `${known}D${r}/(D${r}+R_),0)`, K[k], GAIN),
    formula(`G${r}`, `${known}C${r}+F${r}*E${r},C${r})`, x[k], RESULT),
    formula(`H${r}`, `${known}F${r}*R_,D${r})`, P[k], POWER),
  ].join("");
}

function rtsTop() {
  const instruction =
    "Berjalan mundur: setiap nilai juga mengenal pengukuran sesudahnya. / " +
    "Runs backwards: every value knows the later measurements too.";
  const equations =
    "G = P / P_pred'     x_smooth = x + G (x_smooth' - x)     P_smooth = G (Q + G P_smooth')     " +
    "' = baris berikutnya / the next row";
  return [
    [1, text("A1", "Penghalus RTS / RTS smoother", TITLE)],
    [2, text("A2", instruction)],
    [3, text("A3", equations)],
    [6, texts(RTS_HEAD, 6, 0, COLUMN)],
  ];
}

/** Step k of the smoother, which looks at the row below; the last row is the filter's. */
function rtsRow(k, { x, P, P_pred }, smooth) {
  const r = FIRST + k;
  const next = r + 1;
  const next_P_pred = P_pred[k + 1] ?? NaN;
  const G = next_P_pred === 0 ? 0 : P[k] / next_P_pred; // 0 / 0: a state known exactly
  const has_next = `IF(ISNUMBER(E${r}),`;
  return [
    formula(`A${r}`, `Filter!A${r}`, k + 1, PLAIN),
    formula(`B${r}`, `Filter!G${r}`, x[k], VALUE),
    formula(`C${r}`, `Filter!H${r}`, P[k], POWER),
    formula(`D${r}`, `IF(ISNUMBER(Filter!D${next}),Filter!D${next},"")`, next_P_pred, POWER),
    formula(`E${r}`, `IF(ISNUMBER(D${r}),IF(D${r}=0,0,C${r}/D${r}),"")`, G, GAIN),
    formula(`F${r}`, `${has_next}B${r}+E${r}*(F${next}-B${r}),B${r})`, smooth.x[k], RESULT),
    formula(`G${r}`, `${has_next}E${r}*(Q_+E${r}*G${next}),C${r})`, smooth.P[k], POWER),
  ].join("");
}
