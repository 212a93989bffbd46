// The bytes of an Excel workbook, or of an archive of texts, -> grids. The browser unpacks it, which takes a
// moment: a file control calls `opened` before it puts a file into the state. Twin of
// kalman_lib/data/sheets.py.
import { InputError } from "../language/input.js";
import { isNumber, quoted } from "./cells.js";
import { decode, split } from "./grid.js";
import { MAX_BYTES, tooLarge } from "./limits.js";
import { formatsIn, gridIn, relationsIn, sheetsIn, stringsIn } from "./openxml.js";
import { isArchive } from "./sources.js";
import { MAX_PART, bytesOfPart, directoryOf, isDamage, textOfPart } from "./unzip.js";

const MAX_PACKED = 80000000; // bytes
const MEGABYTE = 1e6;
const LONGEST_NAME = 60;
const TEXTS = [".csv", ".txt", ".tsv"];
const NOT_DATA = ["meta", "__macosx"]; // folders that phyphox and macOS add

/** {name, bytes} -> a promise of {name, bytes, grids: [[title, grid], ...]}; what is no archive stays. */
export async function opened(file) {
  if (!isArchive(file.bytes)) {
    return file;
  }
  const shown = quoted(file.name, LONGEST_NAME);
  try {
    return { ...file, grids: await gridsOf(file.bytes, shown) };
  } catch (error) {
    throw isDamage(error) ? damaged(shown) : error;
  }
}

/** The grids of the sheets with numbers, without those in skip. */
export async function gridsOfSheets({ name, bytes }, skip) {
  const shown = quoted(name, LONGEST_NAME);
  try {
    const grids = await gridsOf(bytes, shown, skip);
    return grids.filter(([, grid]) => grid.some(([, cells]) => cells.some(isNumber)));
  } catch (error) {
    throw isDamage(error) ? damaged(shown) : error;
  }
}

async function gridsOf(bytes, shown, skip = []) {
  const unpacksToMuch = () => unpacksTooLarge(shown);
  if (bytes.length > MAX_PACKED) {
    throw unpacksToMuch();
  }
  const parts = directoryOf(bytes);
  const book = [...parts.keys()].find((path) => path.endsWith("xl/workbook.xml"));
  if (!book) {
    return gridsOfTexts(bytes, parts, shown);
  }
  const folder = book.slice(0, book.lastIndexOf("/"));
  const textAt = (path) => (parts.has(path) ? textOfPart(bytes, parts.get(path), unpacksToMuch) : "");
  const { sheets, from1904 } = sheetsIn(await textAt(book));
  const targets = relationsIn(await textAt(`${folder}/_rels/workbook.xml.rels`));
  const strings = stringsIn(await textAt(`${folder}/sharedStrings.xml`));
  const formats = formatsIn(await textAt(`${folder}/styles.xml`));
  const grids = [];
  for (const [title, relation] of sheets) {
    const path = pathOf(folder, targets.get(relation) ?? "");
    if (!skip.includes(title) && parts.has(path) && path.includes("worksheet")) {
      grids.push([title, gridIn(await textAt(path), title, { strings, formats, from1904 })]);
    }
  }
  return grids;
}

/** Of an archive of texts, as phone apps export: each is a sheet of its own. */
async function gridsOfTexts(bytes, parts, shown) {
  const texts = [...parts].filter(([path]) => isText(path.toLowerCase()));
  if (texts.length === 0) {
    throw noWorkbook(shown);
  }
  const grids = [];
  let size = 0;
  for (const [path, part] of texts) {
    const content = await bytesOfPart(bytes, part, () => unpacksTooLarge(shown));
    size += content.length;
    if (size > MAX_BYTES) {
      throw tooLarge(size);
    }
    const text = decode(content);
    grids.push([path, text ? split(text.replace(/^\ufeff/, ""), null)[0] : []]);
  }
  return grids;
}

function isText(path) {
  const folders = path.split("/").slice(0, -1);
  return TEXTS.some((ending) => path.endsWith(ending)) && !folders.some((one) => NOT_DATA.includes(one));
}

/** "xl", "../xl/worksheets/sheet1.xml" -> "xl/worksheets/sheet1.xml". */
function pathOf(folder, target) {
  return new URL(target, `http://x/${folder}/`).pathname.slice(1);
}

function damaged(shown) {
  return new InputError({
    en: `${shown} is damaged: it cannot be unpacked as an .xlsx file; save it again.`,
    id: `${shown} rusak: tidak dapat dibuka sebagai .xlsx; simpanlah sekali lagi.`,
  });
}

function unpacksTooLarge(shown) {
  const most = MAX_PART / MEGABYTE;
  return new InputError({
    en: `${shown} unpacks to more than ${most} MB, the limit.`,
    id: `${shown} menjadi lebih dari ${most} MB setelah dibuka; itu batasnya.`,
  });
}

function noWorkbook(shown) {
  return new InputError({
    en: `${shown} is an archive, but not an Excel .xlsx file; open it and save it as .xlsx or .csv.`,
    id:
      `${shown} sebuah arsip, tetapi bukan berkas Excel .xlsx; ` +
      "bukalah lalu simpan sebagai .xlsx atau .csv.",
  });
}
