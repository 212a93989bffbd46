// Data of the reader's own in an explorer: the controls with which it is brought and read, and the table that
// it is. A view adds `ownControls` to its own; `broughtTable(s)` reads what the state holds.
import { readTable } from "../files/table.js";
import { opened } from "../files/workbook.js";
import { InputError, number } from "../language/input.js";
import { NotYet } from "../language/later.js";
import { inBoth } from "../language/speaker.js";
import { OWN } from "./words.js";

const LARGEST_FILE = 80000000; // bytes
const LONGEST_QUOTE = 40; // letters
const ACCEPTED = ".csv,.txt,.tsv,.dat,.xlsx,.zip";

/** Where these controls begin; what was chosen of one table is not asked of the next. */
const AS_FOUND = { sheet: "", missing: "auto", time: "", value: "" };

/** Has the reader brought data? */
export function hasBrought(s) {
  return Boolean(s.text?.trim() || s.file);
}

let last = { key: [], table: null, error: null }; // what was read last: controls need it, too

/** The table that the reader brought, read as the controls say; InputError: it cannot be understood. */
export function broughtTable(s) {
  const key = [s.text, s.file, s.sheet, s.sign, s.missing];
  if (!key.every((value, i) => value === last.key[i])) {
    const read = tried(s);
    last = { key, table: null, error: null, ...read };
  }
  if (last.error) {
    throw last.error;
  }
  return last.table;
}

function tried({ text, file, sheet, sign, missing }) {
  const options = {
    sheet: sheet || null,
    decimal: sign === "auto" ? null : sign,
    missing: missing === "auto" ? null : codesOf(missing),
  };
  try {
    return { table: readTable({ text, file }, options) };
  } catch (error) {
    if (error instanceof NotYet) {
      throw error; // what reads it is on its way
    }
    return { error };
  }
}

/** The table that was read last, null if the state holds none that can be read. */
export function knownTable(s) {
  if (!hasBrought(s)) {
    return null;
  }
  try {
    return broughtTable(s);
  } catch (error) {
    if (error instanceof InputError) {
      return null;
    }
    throw error;
  }
}

/** The columns that are used: those that the reader chose, or {time, value} of the table. */
export function chosenColumns(s, table, value = table.value) {
  const has = (name) => table.columns.has(name);
  const time = s.time === "none" ? null : table.time;
  return { time: has(s.time) ? s.time : time, value: has(s.value) ? s.value : value };
}

/** "-999 85" -> [-999, 85]; "none" -> []. */
function codesOf(text) {
  return text === "none" ? [] : text.split(" ").map(Number);
}

// --- controls ----------------------------------------------------------------------------------------------

/** What was found, as the first option of a choice. */
function foundOption(name) {
  return inBoth(OWN.found, { name: name ?? "–" });
}

function named(name) {
  return { id: name, en: name };
}

function sheetOptions(s) {
  const sheets = knownTable(s)?.sheets ?? s.file?.grids?.map(([title]) => title) ?? [];
  return [["", OWN.longest], ...sheets.map((title) => [title, named(title)])];
}

/** The codes that were found, none, and those that the reader typed. */
function codeOptions(s) {
  const found = [...(knownTable(s)?.codes.keys() ?? [])];
  const all = found.length > 0 ? found.join(" ") : null;
  const choices = [["auto", OWN.find_out], ["none", OWN.no_codes]]; // prettier-ignore
  const others = new Set([all, s.missing].filter((text) => text && text !== "auto" && text !== "none"));
  return [...choices, ...[...others].map((text) => [text, named(text.replaceAll("-", "\u2212"))])];
}

/** What was typed, "−999; 85", as the value of the choice above. */
function typedCodes(text, s, r, t) {
  const parts = text.split(/[;\s]/).filter(Boolean);
  if (parts.length === 0) {
    return { missing: "auto" };
  }
  try {
    return { missing: parts.map((part) => number(part, t.language)).join(" ") };
  } catch {
    const shown = text.trim().slice(0, LONGEST_QUOTE);
    throw new InputError(inBoth(OWN.unclear_codes, { text: shown }));
  }
}

const SIGNS = [
  ["auto", OWN.find_out],
  [",", OWN.comma],
  [".", OWN.point],
];

/** A choice of one of the columns; first: what stands before them. */
function columnControl(name, words, first, visible) {
  return {
    kind: "select",
    name,
    default: "",
    ...words,
    visible: (s) => visible(s) && (knownTable(s)?.columns.size ?? 0) > 1,
    options: (s) => {
      const table = knownTable(s);
      return table ? [...first(table, s), ...[...table.columns.keys()].map((one) => [one, named(one)])] : [];
    },
  };
}

/**
 * The controls: text, file, sheet, decimal sign, codes for missing, columns. words: other words of some of
 * them, {text, value, ...}; visible(s): whether what was brought is shown; also: what else changes when the
 * reader brings data; time: is the column of times chosen, too?; value(table): the name of the column that is
 * measured.
 */
export function ownControls({ words = {}, visible = hasBrought, also, time = false, value, rows = 3 }) {
  const all = { ...OWN, ...words };
  const measured = value ?? ((table) => table.value);
  const begin = (other) => ({ ...other, ...AS_FOUND, ...also });
  return [
    ...sourceControls(all, begin, rows),
    ...readingControls(all, visible),
    ...(time ? [columnControl("time", all.time, timeFirst, visible)] : []),
    columnControl("value", all.value, (table) => [["", foundOption(measured(table))]], visible),
  ];
}

function timeFirst(table) {
  return [["", foundOption(table.time)], ["none", OWN.no_time]]; // prettier-ignore
}

/** Where the data comes from. */
function sourceControls(all, begin, rows) {
  return [
    {
      kind: "text",
      name: "text",
      rows,
      ...all.text,
      placeholder: all.placeholder,
      also: () => begin({ file: null }),
    },
    {
      kind: "file",
      name: "file",
      ...all.file,
      accept: ACCEPTED,
      largest: LARGEST_FILE,
      open: opened,
      also: () => begin({ text: null }),
    },
  ];
}

/** How it is read. */
function readingControls(all, visible) {
  const choice = (name, first, more) => ({ kind: "select", name, default: first, ...all[name], ...more });
  return [
    choice("sheet", "", {
      visible: (s) => visible(s) && sheetOptions(s).length > 2,
      options: sheetOptions,
    }),
    choice("sign", "auto", { visible, options: SIGNS }),
    choice("missing", "auto", {
      visible: (s) => visible(s) && codeOptions(s).length > 2,
      options: codeOptions,
    }),
    {
      kind: "entry",
      key: "codes",
      ...all.other_codes,
      inputMode: "text",
      button: all.take_codes,
      enter: typedCodes,
      visible,
    },
  ];
}
