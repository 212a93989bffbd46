// A list as programs write it -> its grid: [1.0, 2.0], np.array([...]), x = [1; 2; 3], {1, 2}. Twin of
// kalman_lib/data/lists.py.
import { BLANK, count, strip, words } from "./blanks.js";
import { MAX_CELLS, MAX_READ, tooLong } from "./limits.js";

const LONGEST_START = 80; // letters before the first bracket
const NAME = "([\\p{L}\\p{Nl}\\p{No}_][\\p{L}\\p{N}_]{0,60})";
const MAX_NAMES = 1000;
const MAX_DEPTH = 4; // brackets around a list
const NAME_AT_THE_END = new RegExp(`${NAME}[${BLANK}]{0,9}$`, "u");
const ASSIGNED_FIRST = new RegExp(`^${NAME}[${BLANK}]{0,9}=`, "u");
const HEAD = new RegExp(`^[\\p{L}\\p{N}_.=:"'${BLANK}]*$`, "u");
const ALLOWED = new RegExp(`^[0-9${BLANK}.,;eE+\\-\\u2212\\[\\](){}nNaAuUlLoOiIfF]*$`);
const DTYPE = /, {0,9}dtype {0,9}=[A-Za-z0-9_."' ]{1,20}\)$/;
const SEPARATORS = [",", " ", "\n", ";"];

/** The grid of a list, of a list of rows, or of several named lists; null if it is none. */
export function gridOfList(text) {
  const body = strip(text);
  if (!/[\])};]$/.test(body.slice(-1)) || !/[[({]/.test(body.slice(0, LONGEST_START))) {
    return null;
  }
  const statements = statementsIn(body);
  const columns = statements.map(([, inside]) => rowsOf(inside));
  if (columns.length === 0 || columns.includes(null)) {
    return null;
  }
  if (columns.length === 1) {
    return gridOfOne(statements[0][0], columns[0]);
  }
  const flat = columns.map((rows) => rows.flat());
  const length = flat[0].length;
  if (flat.some((cells) => cells.length !== length)) {
    return null;
  }
  const names = statements.map(([name], i) => name || String(i + 1));
  const rows = Array.from({ length }, (_, k) => [k + 1, flat.map((cells) => cells[k])]);
  return [[1, names], ...rows];
}

function gridOfOne(name, found) {
  const rows = found.length === 1 ? found[0].map((cell) => [cell]) : found;
  const grid = rows.map((cells, k) => [k + 1, cells]);
  const isNamed = name && rows.length > 0 && rows[0].length === 1;
  return isNamed ? [[1, [name]], ...grid] : grid;
}

/** [[name or "", what stands between the brackets], ...]; empty if something else is there. */
function statementsIn(body) {
  const starts = startsIn(body);
  if (starts.length < 2) {
    const one = statement(body);
    return one ? [one] : [];
  }
  const found = starts.map((at, i) => statement(body.slice(at, starts[i + 1])));
  return found.every(Boolean) && starts[0] === 0 ? found : [];
}

/** Where the names before signs of equality begin; none if there are too many of them. */
function startsIn(body) {
  const starts = [];
  if (count(body, "=") > MAX_NAMES) {
    return starts;
  }
  for (let at = body.indexOf("="); at >= 0; at = body.indexOf("=", at + 1)) {
    const before = body.slice(Math.max(0, at - LONGEST_START), at);
    const found = NAME_AT_THE_END.exec(before);
    if (found) {
      starts.push(at - before.length + found.index);
    }
  }
  return starts;
}

/** "z = np.array([1, 2])" -> ["z", "[1, 2]"]; null if it is none. */
function statement(whole) {
  let end = strip(whole);
  while (end.endsWith(";")) {
    end = end.slice(0, -1);
  }
  const text = strip(end).replace(DTYPE, ")");
  const at = text.slice(0, LONGEST_START).search(/[[({]/);
  if (at < 0 || !/[\])}]$/.test(text.slice(-1))) {
    return null;
  }
  const head = strip(text.slice(0, at));
  const named = ASSIGNED_FIRST.exec(head);
  if (!HEAD.test(head) || (head && !named && /^\p{N}/u.test(head))) {
    return null;
  }
  return [named ? named[1] : "", text.slice(at)];
}

/** "[[0, 21.5], [1, 21.7]]" -> [["0", "21.5"], ["1", "21.7"]]; null if it is no list. */
function rowsOf(text) {
  const inside = text.replaceAll("...\n", " "); // goes on in the next line
  if (!ALLOWED.test(inside)) {
    return null;
  }
  const most = Math.max(...SEPARATORS.map((sign) => count(inside, sign)));
  if (most > (count(inside, "[") > 2 ? MAX_CELLS : MAX_READ)) {
    throw tooLong(most);
  }
  let plain = inside.replace(/[({]/g, "[").replace(/[)}]/g, "]");
  for (let depth = 0; depth < MAX_DEPTH; depth++) {
    if (plain.startsWith("[") && plain.endsWith("]") && isAround(plain)) {
      plain = strip(plain.slice(1, -1));
    }
  }
  return partsOf(plain)
    .map(cellsOf)
    .filter((row) => row.length > 0);
}

function partsOf(plain) {
  if (plain.includes("[")) {
    const pieces = plain.split("]").filter((piece) => piece.includes("["));
    return pieces.map((piece) => piece.slice(piece.indexOf("[") + 1));
  }
  const lines = plain
    .split("\n")
    .map((line) => strip(line))
    .filter(Boolean);
  const isMatrix = plain.includes(";") || !lines.slice(0, -1).every((line) => line.endsWith(","));
  return isMatrix ? plain.split(/[;\n]/) : [lines.join(" ")];
}

/** Do the first and the last bracket belong together? */
function isAround(plain) {
  const inner = plain.slice(1, -1);
  const opening = inner.indexOf("[");
  const closing = inner.indexOf("]");
  return closing < 0 || (opening >= 0 && opening < closing);
}

function cellsOf(part) {
  if (!part.includes(",")) {
    return words(part);
  }
  const cells = part.split(",").map((cell) => strip(cell));
  return cells.at(-1) === "" ? cells.slice(0, -1) : cells;
}
