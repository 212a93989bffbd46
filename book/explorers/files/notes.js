// What was understood, in short sentences of both languages: [{en, id}, ...]. Twin of
// kalman_lib/data/notes.py.
import { cut } from "./cells.js";

const MAX_LISTED = 5; // names of columns, stretches of lines
const LONGEST_NAME = 40;
const SIGNS = new Map([
  [",", ["comma", "koma"]],
  [".", ["point", "titik"]],
  [null, ["none", "tidak ada"]],
]);

/** One sentence of each language. */
export function oneSentence(notes) {
  const inLanguage = (language) => `${notes.map((note) => note[language]).join("; ")}.`;
  return { en: inLanguage("en"), id: inLanguage("id") };
}

/** The first notes on a table: its size, its columns, what was left out. */
export function about({ columns, units, time, value, skipped, decimal }, passed) {
  const all = [...columns.values()];
  const missing = all.reduce((sum, values) => sum + values.filter(Number.isNaN).length, 0);
  const [en, id] = SIGNS.get(decimal);
  const [rows, count] = [all[0].length, `${columns.size} (${listed([...columns.keys()])})`];
  const notes = [
    {
      en: `Rows: ${rows}; columns: ${count}; gaps: ${missing}; decimal sign: ${en}`,
      id: `Baris: ${rows}; kolom: ${count}; sel kosong: ${missing}; tanda desimal: ${id}`,
    },
  ];
  if (time) {
    const shown = withUnit(time, units);
    notes.push({ en: `time column: ${shown}`, id: `kolom waktu: ${shown}` });
  }
  if (columns.size > 1) {
    const shown = withUnit(value, units);
    notes.push({ en: `measured column: ${shown}`, id: `kolom terukur: ${shown}` });
  }
  if (skipped.length > 0) {
    const shown = listed(skipped);
    notes.push({ en: `left out, no numbers: ${shown}`, id: `tidak dipakai, tanpa bilangan: ${shown}` });
  }
  return [...notes, ...aboutLines(passed)];
}

function withUnit(name, units) {
  const unit = units[name] ?? "";
  const shown = cut(name, LONGEST_NAME);
  return !unit || name.includes(unit) ? shown : `${shown} (${unit})`;
}

function listed(names) {
  const shown = names.slice(0, MAX_LISTED).map((name) => cut(name, LONGEST_NAME));
  return shown.join(", ") + (names.length > MAX_LISTED ? ", ..." : "");
}

/** "lines 1-3, 9 were passed over". */
function aboutLines(passed) {
  if (passed.length === 0) {
    return [];
  }
  const stretches = [];
  for (const line of passed) {
    if (line === stretches.at(-1)?.[1] + 1) {
      stretches.at(-1)[1] = line;
    } else {
      stretches.push([line, line]);
    }
  }
  const texts = stretches.map(([first, last]) => (first === last ? String(first) : `${first}-${last}`));
  const shown = listed(texts);
  const en = passed.length === 1 ? `line ${shown} was passed over` : `lines ${shown} were passed over`;
  return [{ en, id: `baris ${shown} dilewati` }];
}
