// The rows of a text as Python's csv module reads them: [number of the row's last line, cells].

/** Row after row; skipsBlanks: a quotation mark may stand behind blanks. */
export function* rowsIn(text, separator, skipsBlanks) {
  let start = 0;
  let line = 0;
  while (start < text.length) {
    const found = text.indexOf("\n", start);
    const end = found < 0 ? text.length : found;
    const plain = text.slice(start, end);
    line++;
    if (!plain.includes('"')) {
      yield [line, plain === "" ? [] : plain.split(separator)];
      start = end + 1;
      continue;
    }
    const row = quotedRow(text, start, separator, skipsBlanks);
    line += row.lines;
    yield [line, row.cells];
    start = row.next;
  }
}

/** A row in which there are quotation marks: {cells, next, lines}; lines: how many more it takes. */
function quotedRow(text, from, separator, skipsBlanks) {
  const cells = [];
  let lines = 0;
  let at = from;
  for (;;) {
    while (skipsBlanks && text[at] === " ") {
      at++;
    }
    const cell = text[at] === '"' ? quotedCell(text, at + 1) : { words: "", next: at };
    lines += cell.words.split("\n").length - 1;
    const end = endOfCell(text, cell.next, separator);
    cells.push(cell.words + text.slice(cell.next, end));
    at = end + 1;
    if (text[end] !== separator) {
      return { cells, next: at, lines };
    }
  }
}

/** Between quotation marks; two of them stand for one. */
function quotedCell(text, from) {
  const pieces = [];
  let at = from;
  for (;;) {
    const found = text.indexOf('"', at);
    const end = found < 0 ? text.length : found;
    pieces.push(text.slice(at, end));
    if (text[end + 1] !== '"') {
      return { words: pieces.join('"'), next: Math.min(end + 1, text.length) };
    }
    at = end + 2;
  }
}

function endOfCell(text, from, separator) {
  const next = text.indexOf(separator, from);
  const line = text.indexOf("\n", from);
  const ends = [next, line].filter((at) => at >= 0);
  return ends.length > 0 ? Math.min(...ends) : text.length;
}
