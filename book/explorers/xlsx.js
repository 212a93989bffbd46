// Numbers out: the form of Rudiyanto, Setiawan and Saptomo (2006) as an .xlsx with live formulas, cell for cell the sheets
// Filter and RTS that kalman_lib/spreadsheet.py writes (its charts and notes are left out).

const FIRST = 7;                                        // the first row of both tables
const NAME = "Filter Kalman, Makalah demi Makalah / The Kalman Filter, Paper by Paper";
const HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n', MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships", PACKAGE = "http://schemas.openxmlformats.org/package/2006";
const [PLAIN, TITLE, LABEL, INPUT, COLUMN, VALUE, POWER, GAIN, DATA, RESULT, TEXT] = Array(11).keys();     // the styles, in the order of STYLES

const STYLES = (() => {
  // [number format, font, fill, alignment]; formats: 164 gains, 165 values; 166 variances, 49 text
  const wrap = '<alignment horizontal="center" vertical="center" wrapText="1"/>', looks = [[0, 0, 0], [0, 1, 0], [0, 0, 2, wrap], [0, 2, 3, wrap], [0, 3, 4, wrap], [165, 0, 0], [166, 0, 0],
    [164, 0, 0], [165, 0, 3], [165, 0, 5], [49, 2, 0]];
  const fill = colour => `<fill><patternFill patternType="solid"><fgColor rgb="FF${colour}"/></patternFill></fill>`, font = (size, rest) => `<font>${rest}<sz val="${size}"/><name val="Calibri"/></font>`;
  return `<styleSheet xmlns="${MAIN}"><numFmts count="3"><numFmt numFmtId="164" formatCode="[=0]0;[&lt;0.001]0.000000E+00;0.000000"/><numFmt numFmtId="165" formatCode="0.000000"/>` +
    `<numFmt numFmtId="166" formatCode="0.000000E+00"/></numFmts><fonts count="4">${font(11, "")}${font(15, "<b/>")}${font(11, "<b/>")}<font><b/><sz val="11"/><color rgb="FFFFFFFF"/><name val="Calibri"/></font></fonts>` +
    `<fills count="6"><fill><patternFill patternType="none"/></fill><fill><patternFill patternType="gray125"/></fill>${["DCE6F1", "FFF2CC", "1F3A5F", "E2F0D9"].map(fill).join("")}</fills>` +
    `<borders count="1"><border/></borders><cellStyleXfs count="1"><xf/></cellStyleXfs><cellXfs count="11">` +
    looks.map(([format, letter, ground, inner = ""], i) => `<xf numFmtId="${format}" fontId="${letter}" fillId="${ground}" xfId="0" applyNumberFormat="1" applyFont="1" applyFill="1" applyAlignment="1"${i === TEXT ? ' quotePrefix="1"' : ""}>${inner}</xf>`).join("") +
    '</cellXfs><cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles></styleSheet>';
})();

const escaped = text => text.replace(/[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]/g, " ").replace(/[&<>"]/g, sign => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[sign]);

/** A text stays a text, whatever it begins with. */
const text = (at, words, style = PLAIN) => `<c r="${at}" s="${style}" t="inlineStr"><is><t xml:space="preserve">${escaped(words)}</t></is></c>`;
const number = (at, value, style) => value === value ? `<c r="${at}" s="${style}"><v>${value}</v></c>` : `<c r="${at}" s="${style}"/>`;
/** A formula and the result that a program shows until it has calculated; NaN is the empty text "". */
const formula = (at, words, value, style) => `<c r="${at}" s="${style}"${value === value ? "" : ' t="str"'}><f>${escaped(words)}</f><v>${value === value ? value : ""}</v></c>`;

function sheet(rows, widths) {
  const heights = { 3: 50, 6: 50 };
  return `<worksheet xmlns="${MAIN}"><sheetViews><sheetView workbookViewId="0"><pane ySplit="${FIRST - 1}" topLeftCell="A${FIRST}" activePane="bottomLeft" state="frozen"/></sheetView></sheetViews>` +
    `<cols>${widths.map((width, i) => `<col min="${i + 1}" max="${i + 1}" width="${width}" customWidth="1"/>`).join("")}</cols><sheetData>` +
    rows.map(([row, cells]) => `<row r="${row}"${heights[row] ? ` ht="${heights[row]}" customHeight="1"` : ""}>${cells}</row>`).join("") + "</sheetData></worksheet>";
}

const heads = words => words.map((head, i) => text(`${"ABCDEFGH"[i]}6`, head, COLUMN)).join("");

/**
 * The workbook as bytes. z (T), NaN = gap; p {Q, R, x0, P0}; the result of the filter and the smoother's x and P, only so
 * that programs that do not calculate show numbers, too; name: what was measured, always a text.
 */
export function writeWorkbook({ z, p, result, smooth, name }) {
  const T = z.length, rows = [], rts = [];
  rows.push([1, text("A1", "Filter Kalman skalar / Scalar Kalman filter", TITLE)], [2, text("A2", "Ubah sel kuning; semua rumus menghitung ulang. / Change the yellow cells; every formula follows.")]);
  const labels = ["Q\nvarians proses /\nprocess var.", "R\nvarians ukur /\nmeasurement var.", "x0\ntebakan awal /\ninitial guess", "P0\nvarians x0 /\nvariance of x0", "N\njumlah data /\nhow many", "Data\nnama kolom /\ncolumn name"];
  rows.push([3, labels.map((label, i) => text(`${"BCDEFG"[i]}3`, label, LABEL)).join("")]);
  let known = 0;
  for (let k = 0; k < T; k++) if (z[k] === z[k]) known++;
  rows.push([4, ["Q", "R", "x0", "P0"].map((letter, i) => number(`${"BCDE"[i]}4`, p[letter], INPUT)).join("") + formula("F4", `COUNT(B${FIRST}:B1048576)`, known, PLAIN) +
    text("G4", Array.from(name.replace(/\s+/g, " ").trim()).slice(0, 100).join(""), TEXT)]);
  rows.push([6, heads(["No", "Terukur /\nMeasured\nz", "Prediksi /\nPrediction\nx_pred", "Varians prediksi /\nIts variance\nP_pred", "Inovasi /\nInnovation\ny", "Penguatan /\nGain\nK", "Terfilter /\nFiltered\nx", "Varians /\nVariance\nP"])]);
  rts.push([1, text("A1", "Penghalus RTS / RTS smoother", TITLE)], [2, text("A2", "Berjalan mundur: setiap nilai juga mengenal pengukuran sesudahnya. / Runs backwards: every value knows the later measurements too.")],
    [3, text("A3", "G = P / P_pred'     x_smooth = x + G (x_smooth' - x)     P_smooth = G (Q + G P_smooth')     ' = baris berikutnya / the next row")]);
  rts.push([6, heads(["No", "Terfilter /\nFiltered\nx", "Varians /\nVariance\nP", "P_pred berikutnya /\nnext P_pred", "Penguatan /\nGain\nG", "Terhaluskan /\nSmoothed\nx_smooth", "Varians /\nVariance\nP_smooth"])]);
  for (let k = 0; k < T; k++) {
    const r = FIRST + k, x = result.x[k], P = result.P[k], next = k + 1 < T ? result.P_pred[k + 1] : NaN, is = `IF(ISNUMBER(B${r}),`, after = `IF(ISNUMBER(E${r}),`;
    rows.push([r, number(`A${r}`, k + 1, PLAIN) + number(`B${r}`, z[k], DATA) + formula(`C${r}`, k ? `G${r - 1}` : "x0_", result.x_pred[k], VALUE) +
      formula(`D${r}`, k ? `H${r - 1}+Q_` : "P0_+Q_", result.P_pred[k], POWER) + formula(`E${r}`, `${is}B${r}-C${r},"")`, result.y[k], VALUE) +
      formula(`F${r}`, `${is}D${r}/(D${r}+R_),0)`, result.K[k], GAIN) + formula(`G${r}`, `${is}C${r}+F${r}*E${r},C${r})`, x, RESULT) + formula(`H${r}`, `${is}F${r}*R_,D${r})`, P, POWER)]);
    rts.push([r, formula(`A${r}`, `Filter!A${r}`, k + 1, PLAIN) + formula(`B${r}`, `Filter!G${r}`, x, VALUE) + formula(`C${r}`, `Filter!H${r}`, P, POWER) +
      formula(`D${r}`, `IF(ISNUMBER(Filter!D${r + 1}),Filter!D${r + 1},"")`, next, POWER) + formula(`E${r}`, `IF(ISNUMBER(D${r}),IF(D${r}=0,0,C${r}/D${r}),"")`, next === 0 ? 0 : P / next, GAIN) +
      formula(`F${r}`, `${after}B${r}+E${r}*(F${r + 1}-B${r}),B${r})`, smooth.x[k], RESULT) + formula(`G${r}`, `${after}E${r}*(Q_+E${r}*G${r + 1}),C${r})`, smooth.P[k], POWER)]);
  }
  const relations = list => `<Relationships xmlns="${PACKAGE}/relationships">${list.map(([kind, target], i) => `<Relationship Id="rId${i + 1}" Type="${kind}" Target="${target}"/>`).join("")}</Relationships>`;
  const type = (part, kind) => `<Override PartName="/${part}" ContentType="application/vnd.openxmlformats-${kind}+xml"/>`, sheets = ["Filter", "RTS"];
  const parts = {
    "[Content_Types].xml": `<Types xmlns="${PACKAGE}/content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="xml" ContentType="application/xml"/>` +
      type("xl/workbook.xml", "officedocument.spreadsheetml.sheet.main") + sheets.map((_, i) => type(`xl/worksheets/sheet${i + 1}.xml`, "officedocument.spreadsheetml.worksheet")).join("") +
      type("xl/styles.xml", "officedocument.spreadsheetml.styles") + type("docProps/core.xml", "package.core-properties") + "</Types>",
    "_rels/.rels": relations([[`${OFFICE}/officeDocument`, "xl/workbook.xml"], [`${PACKAGE}/relationships/metadata/core-properties`, "docProps/core.xml"]]),
    "docProps/core.xml": `<cp:coreProperties xmlns:cp="${PACKAGE}/metadata/core-properties" xmlns:dc="http://purl.org/dc/elements/1.1/"><dc:creator>${NAME}</dc:creator></cp:coreProperties>`,
    "xl/_rels/workbook.xml.rels": relations([...sheets.map((_, i) => [`${OFFICE}/worksheet`, `worksheets/sheet${i + 1}.xml`]), [`${OFFICE}/styles`, "styles.xml"]]),
    "xl/workbook.xml": `<workbook xmlns="${MAIN}" xmlns:r="${OFFICE}"><sheets>${sheets.map((title, i) => `<sheet name="${title}" sheetId="${i + 1}" r:id="rId${i + 1}"/>`).join("")}</sheets>` +
      `<definedNames>${["P0", "Q", "R", "x0"].map(letter => `<definedName name="${letter}_">Filter!$${{ Q: "B", R: "C", x0: "D", P0: "E" }[letter]}$4</definedName>`).join("")}</definedNames><calcPr calcId="191029" fullCalcOnLoad="1"/></workbook>`,
    "xl/styles.xml": STYLES,
    "xl/worksheets/sheet1.xml": sheet(rows, [7, 16, 17, 17, 16, 16, 16, 16]),
    "xl/worksheets/sheet2.xml": sheet(rts, [7, 16, 16, 20, 16, 16, 16]),
  };
  return zip(Object.entries(parts).map(([path, words]) => [path, HEAD + words]));
}

// --- the container: a ZIP archive whose files are stored as they are. A library that also compresses would take 4 of the
// --- 60 kB that all explorers together may weigh.

const CRC = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; k++) n = n & 1 ? 0xEDB88320 ^ n >>> 1 : n >>> 1;
  return n;
});

/** The files [[path, text], ...] as the bytes of one archive. */
export function zip(files) {
  const encoder = new TextEncoder(), pieces = [], directory = [];
  let offset = 0;
  const numbers = (...pairs) => Uint8Array.from(pairs.flatMap(([value, bytes]) => Array.from({ length: bytes }, (_, k) => value >>> 8 * k & 255)));
  for (const [path, text] of files) {
    const name = encoder.encode(path), data = encoder.encode(text);
    let crc = -1;
    for (const byte of data) crc = CRC[(crc ^ byte) & 255] ^ crc >>> 8;
    // version 2.0, names in UTF-8, stored, 2006-01-01 0:00, checksum, size twice, length of the name, nothing more
    const about = [[20, 2], [0x800, 2], [0, 2], [0, 2], [26 << 9 | 1 << 5 | 1, 2], [~crc, 4], [data.length, 4], [data.length, 4], [name.length, 2], [0, 2]];
    const local = [numbers([0x04034b50, 4], ...about), name, data];
    directory.push(numbers([0x02014b50, 4], [20, 2], ...about, [0, 2], [0, 2], [0, 2], [0, 4], [offset, 4]), name);
    for (const piece of local) offset += piece.length;
    pieces.push(...local);
  }
  const length = directory.reduce((sum, piece) => sum + piece.length, 0);
  pieces.push(...directory, numbers([0x06054b50, 4], [0, 4], [files.length, 2], [files.length, 2], [length, 4], [offset, 4], [0, 2]));
  const archive = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
  let at = 0;
  for (const piece of pieces) { archive.set(piece, at); at += piece.length; }
  return archive;
}
