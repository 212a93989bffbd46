// Which kind of file is it, and is it one that we read? Twin of kalman_lib/data/sources.py.
import { InputError } from "../language/input.js";
import { quoted } from "./cells.js";
import { decode } from "./grid.js";
import { MAX_BYTES, tooLarge } from "./limits.js";

const ARCHIVE = [0x50, 0x4b, 0x03, 0x04];
const COMPOUND = [0xd0, 0xcf, 0x11, 0xe0];
const ENCRYPTED = "EncryptedPackage";
const LOOKED_AT = 2e6; // bytes
const LONGEST_NAME = 60;

function beginsWith(bytes, signs) {
  return signs.every((sign, i) => bytes[i] === sign);
}

/** Is it an archive, as workbooks are? */
export function isArchive(bytes) {
  return beginsWith(bytes, ARCHIVE);
}

/** The text of a file; InputError: another kind of file. */
export function textOf({ name, bytes }) {
  if (beginsWith(bytes, COMPOUND)) {
    throw oldOrLocked(name, bytes);
  }
  if (bytes.length > MAX_BYTES) {
    throw tooLarge(bytes.length);
  }
  const text = decode(bytes);
  if (text === null) {
    throw unreadable(name);
  }
  return text;
}

function unreadable(name) {
  const shown = quoted(name, LONGEST_NAME);
  return new InputError({
    en: `${shown} is not a text file (.csv, .txt, .tsv) nor an Excel file (.xlsx); save it as one of these.`,
    id:
      `${shown} bukan berkas teks (.csv, .txt, .tsv) dan bukan berkas Excel (.xlsx); ` +
      "simpanlah sebagai salah satunya.",
  });
}

function oldOrLocked(name, bytes) {
  const shown = quoted(name, LONGEST_NAME);
  const text = new TextDecoder("latin1").decode(bytes.subarray(0, LOOKED_AT));
  if (text.includes(Array.from(ENCRYPTED).join("\0"))) {
    return new InputError({
      en: `${shown} is protected by a password; save it without one.`,
      id: `${shown} dikunci dengan kata sandi; simpanlah tanpa kata sandi.`,
    });
  }
  return new InputError({
    en: `${shown} is an old Excel file (.xls); open it and save it as .xlsx or .csv.`,
    id: `${shown} berkas Excel lama (.xls); bukalah lalu simpan sebagai .xlsx atau .csv.`,
  });
}
