// A workbook (.xlsx) of sheets with texts, numbers and live formulas. What stands in them is decided
// elsewhere.
import { zip } from "./zip.js";

const AUTHOR = "Filter Kalman, Makalah demi Makalah / The Kalman Filter, Paper by Paper";
const XML = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n';
const MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main";
const OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
const PACKAGE = "http://schemas.openxmlformats.org/package/2006";
const CONTENT = "application/vnd.openxmlformats";

// --- how a cell looks: numbers of the styles below ---------------------------------------------------------

export const PLAIN = 0;
export const TITLE = 1;
export const LABEL = 2;
export const INPUT = 3; // yellow: to be changed
export const COLUMN = 4; // the head of a column
export const VALUE = 5; // six decimals
export const POWER = 6; // with a power of ten: variances
export const GAIN = 7;
export const DATA = 8; // yellow, six decimals
export const RESULT = 9; // green, six decimals
export const TEXT = 10; // a text, whatever it begins with

const GENERAL_FORMAT = 0;
const TEXT_FORMAT = 49;
const GAIN_FORMAT = 164;
const VALUE_FORMAT = 165;
const POWER_FORMAT = 166;
const WRAPPED = '<alignment horizontal="center" vertical="center" wrapText="1"/>';

// [number format, font, fill, alignment] in the order of the numbers above
const LOOKS = [
  [GENERAL_FORMAT, 0, 0, ""],
  [GENERAL_FORMAT, 1, 0, ""],
  [GENERAL_FORMAT, 0, 2, WRAPPED],
  [GENERAL_FORMAT, 2, 3, WRAPPED],
  [GENERAL_FORMAT, 3, 4, WRAPPED],
  [VALUE_FORMAT, 0, 0, ""],
  [POWER_FORMAT, 0, 0, ""],
  [GAIN_FORMAT, 0, 0, ""],
  [VALUE_FORMAT, 0, 3, ""],
  [VALUE_FORMAT, 0, 5, ""],
  [TEXT_FORMAT, 2, 0, ""],
];
const FILLS = ["DCE6F1", "FFF2CC", "1F3A5F", "E2F0D9"]; // 2 to 5; 0 and 1 are given
const FONTS = [
  '<font><sz val="11"/><name val="Calibri"/></font>',
  '<font><b/><sz val="15"/><name val="Calibri"/></font>',
  '<font><b/><sz val="11"/><name val="Calibri"/></font>',
  '<font><b/><sz val="11"/><color rgb="FFFFFFFF"/><name val="Calibri"/></font>',
];

function fill(colour) {
  const solid = `<patternFill patternType="solid"><fgColor rgb="FF${colour}"/></patternFill>`;
  return `<fill>${solid}</fill>`;
}

function style([format, font, ground, alignment], number) {
  const applied = 'applyNumberFormat="1" applyFont="1" applyFill="1" applyAlignment="1"';
  const quote = number === TEXT ? ' quotePrefix="1"' : "";
  const ids = `numFmtId="${format}" fontId="${font}" fillId="${ground}" xfId="0"`;
  return `<xf ${ids} ${applied}${quote}>${alignment}</xf>`;
}

function stylesXml() {
  return [
    `<styleSheet xmlns="${MAIN}"><numFmts count="3">`,
    `<numFmt numFmtId="${GAIN_FORMAT}" formatCode="[=0]0;[&lt;0.001]0.000000E+00;0.000000"/>`,
    `<numFmt numFmtId="${VALUE_FORMAT}" formatCode="0.000000"/>`,
    `<numFmt numFmtId="${POWER_FORMAT}" formatCode="0.000000E+00"/></numFmts>`,
    `<fonts count="${FONTS.length}">${FONTS.join("")}</fonts>`,
    '<fills count="6"><fill><patternFill patternType="none"/></fill>',
    `<fill><patternFill patternType="gray125"/></fill>${FILLS.map(fill).join("")}</fills>`,
    '<borders count="1"><border/></borders><cellStyleXfs count="1"><xf/></cellStyleXfs>',
    `<cellXfs count="${LOOKS.length}">${LOOKS.map(style).join("")}</cellXfs>`,
    '<cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles></styleSheet>',
  ].join("");
}

// --- cells -------------------------------------------------------------------------------------------------

const ENTITIES = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const NOT_XML = /[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]/g;

function escaped(text) {
  return text.replace(NOT_XML, " ").replace(/[&<>"]/g, (sign) => ENTITIES[sign]);
}

/** A text stays a text, whatever it begins with. */
export function text(at, words, look = PLAIN) {
  const inner = `<is><t xml:space="preserve">${escaped(words)}</t></is>`;
  return `<c r="${at}" s="${look}" t="inlineStr">${inner}</c>`;
}

/** A number; NaN is an empty cell. */
export function number(at, value, look) {
  return Number.isNaN(value) ? `<c r="${at}" s="${look}"/>` : `<c r="${at}" s="${look}"><v>${value}</v></c>`;
}

/** A formula and the result that a program shows until it has calculated; NaN is the empty text "". */
export function formula(at, words, value, look) {
  const empty = Number.isNaN(value);
  const type = empty ? ' t="str"' : "";
  const result = empty ? "" : value;
  return `<c r="${at}" s="${look}"${type}><f>${escaped(words)}</f><v>${result}</v></c>`;
}

// --- sheets ------------------------------------------------------------------------------------------------

/**
 * A sheet: rows [[number, cells], ...] with the cells as text, widths of the columns in letters, heights
 * {row: points}, first: the row below which the sheet scrolls.
 */
function sheetXml({ rows, widths, heights, first }) {
  const columns = widths.map((width, i) => {
    return `<col min="${i + 1}" max="${i + 1}" width="${width}" customWidth="1"/>`;
  });
  const lines = rows.map(([row, cells]) => {
    const height = heights[row] ? ` ht="${heights[row]}" customHeight="1"` : "";
    return `<row r="${row}"${height}>${cells}</row>`;
  });
  const frozen =
    `<pane ySplit="${first - 1}" topLeftCell="A${first}" ` + 'activePane="bottomLeft" state="frozen"/>';
  return [
    `<worksheet xmlns="${MAIN}"><sheetViews><sheetView workbookViewId="0">${frozen}</sheetView></sheetViews>`,
    `<cols>${columns.join("")}</cols><sheetData>${lines.join("")}</sheetData></worksheet>`,
  ].join("");
}

// --- the workbook ------------------------------------------------------------------------------------------

/**
 * sheets: [{title, rows, widths, heights, first}, ...]; names: {name: "Sheet!$A$1"} -> the bytes of the file.
 */
export function workbook({ sheets, names }) {
  const paths = sheets.map((_, i) => `worksheets/sheet${i + 1}.xml`);
  const parts = [
    ["[Content_Types].xml", contentTypesXml(paths)],
    ["_rels/.rels", packageRelationsXml()],
    ["docProps/core.xml", propertiesXml()],
    ["xl/_rels/workbook.xml.rels", workbookRelationsXml(paths)],
    ["xl/workbook.xml", workbookXml(sheets, names)],
    ["xl/styles.xml", stylesXml()],
    ...sheets.map((sheet, i) => [`xl/${paths[i]}`, sheetXml(sheet)]),
  ];
  return zip(parts.map(([path, xml]) => [path, XML + xml]));
}

function contentTypesXml(paths) {
  const type = (part, kind) => `<Override PartName="/${part}" ContentType="${CONTENT}-${kind}+xml"/>`;
  return [
    `<Types xmlns="${PACKAGE}/content-types">`,
    `<Default Extension="rels" ContentType="${CONTENT}-package.relationships+xml"/>`,
    '<Default Extension="xml" ContentType="application/xml"/>',
    type("xl/workbook.xml", "officedocument.spreadsheetml.sheet.main"),
    ...paths.map((path) => type(`xl/${path}`, "officedocument.spreadsheetml.worksheet")),
    type("xl/styles.xml", "officedocument.spreadsheetml.styles"),
    type("docProps/core.xml", "package.core-properties"),
    "</Types>",
  ].join("");
}

/** Which part belongs to which: [[kind, target], ...]. */
function relations(list) {
  const entries = list.map(([kind, target], i) => {
    return `<Relationship Id="rId${i + 1}" Type="${kind}" Target="${target}"/>`;
  });
  return `<Relationships xmlns="${PACKAGE}/relationships">${entries.join("")}</Relationships>`;
}

function packageRelationsXml() {
  return relations([
    [`${OFFICE}/officeDocument`, "xl/workbook.xml"],
    [`${PACKAGE}/relationships/metadata/core-properties`, "docProps/core.xml"],
  ]);
}

function workbookRelationsXml(paths) {
  const sheets = paths.map((path) => [`${OFFICE}/worksheet`, path]);
  return relations([...sheets, [`${OFFICE}/styles`, "styles.xml"]]);
}

function propertiesXml() {
  const spaces =
    `xmlns:cp="${PACKAGE}/metadata/core-properties" ` + 'xmlns:dc="http://purl.org/dc/elements/1.1/"';
  return `<cp:coreProperties ${spaces}><dc:creator>${AUTHOR}</dc:creator></cp:coreProperties>`;
}

function workbookXml(sheets, names) {
  const entries = sheets.map(({ title }, i) => {
    return `<sheet name="${title}" sheetId="${i + 1}" r:id="rId${i + 1}"/>`;
  });
  const defined = Object.entries(names).map(([name, place]) => {
    return `<definedName name="${name}">${place}</definedName>`;
  });
  return [
    `<workbook xmlns="${MAIN}" xmlns:r="${OFFICE}"><sheets>${entries.join("")}</sheets>`,
    `<definedNames>${defined.join("")}</definedNames>`,
    '<calcPr calcId="191029" fullCalcOnLoad="1"/></workbook>',
  ].join("");
}
