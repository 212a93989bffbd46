// Files and archives of a recording in, [[name, bytes], ...] of its tables out. Twin of
// kalman_lib/data/archives.py; the browser unpacks.
import { quoted } from "../cells.js";
import { bytesOfPart, directoryOf, isDamage } from "../unzip.js";
import { wrong } from "./notes.js";

const MAX_BYTES = 60000000; // of all files together: an hour of three sensors at 100 Hz
const MAX_PARTS = 1000; // of an archive
const MEGABYTE = 1e6;
const LONGEST_NAME = 60;
export const TEXTS = [".csv", ".txt", ".tsv"];
const READABLE = [...TEXTS, ".xlsx", ".xls"];
const NOT_DATA = ["meta", "__macosx"]; // folders that phyphox and macOS add

export function endsWith(name, endings) {
  return endings.some((ending) => name.toLowerCase().endsWith(ending));
}

export function isPacked(bytes) {
  return bytes[0] === 0x50 && bytes[1] === 0x4b;
}

/** [{name, bytes}, ...] -> a promise of the tables in them. */
export async function openFiles(files) {
  const tables = new Map();
  for (const { name, bytes } of files) {
    const isArchive = isPacked(bytes) && !name.toLowerCase().endsWith(".xlsx");
    const found = isArchive ? await unpack(name, bytes, sizeOf(tables)) : [[name, bytes]];
    found.forEach(([path, content]) => tables.set(path, content));
    checkSize(sizeOf(tables));
  }
  if (tables.size === 0) {
    throw wrong(
      "There is no table in the files; a .csv, .zip or .xlsx export is needed.",
      "Tidak ada tabel dalam berkas; diperlukan ekspor .csv, .zip atau .xlsx.",
    );
  }
  return [...tables];
}

/** [[name/part, bytes], ...] of the tables in an archive. */
async function unpack(name, bytes, before) {
  try {
    const parts = [...directoryOf(bytes)].filter(([path]) => endsWith(path, READABLE) && isData(path));
    if (parts.length > MAX_PARTS) {
      throw tooMany(name, parts.length);
    }
    checkSize(parts.reduce((sum, [, { size }]) => sum + size, before)); // before unpacking
    const tables = [];
    let size = before;
    for (const [path, part] of parts) {
      const tooLarge = () => tooMuch(before + MAX_BYTES); // its size may be a lie
      const content = await bytesOfPart(bytes, part, tooLarge, MAX_BYTES);
      size += content.length;
      checkSize(size);
      tables.push([`${name}/${path}`, content]);
    }
    return tables;
  } catch (error) {
    throw isDamage(error) ? damaged(name) : error;
  }
}

function short(name) {
  const letters = Array.from(name);
  return quoted(letters.length <= LONGEST_NAME ? name : `...${letters.slice(-57).join("")}`, LONGEST_NAME);
}

function damaged(name) {
  return wrong(
    `The archive ${short(name)} cannot be unpacked: it is damaged or locked; export it again.`,
    `Arsip ${short(name)} tidak dapat dibuka: rusak atau terkunci; eksporlah sekali lagi.`,
  );
}

function tooMany(name, parts) {
  return wrong(
    `The archive ${short(name)} holds ${parts} tables; the limit is ${MAX_PARTS}.`,
    `Arsip ${short(name)} berisi ${parts} tabel; batasnya ${MAX_PARTS}.`,
  );
}

/** Does a part of an archive lie outside the folders that apps add? */
function isData(path) {
  const folders = path.toLowerCase().replaceAll("\\", "/").split("/").slice(0, -1);
  return !folders.some((folder) => NOT_DATA.includes(folder));
}

function sizeOf(tables) {
  return [...tables.values()].reduce((sum, { length }) => sum + length, 0);
}

function checkSize(size) {
  if (size > MAX_BYTES) {
    throw tooMuch(size);
  }
}

function tooMuch(size) {
  const megabytes = Math.floor(size / MEGABYTE);
  const most = MAX_BYTES / MEGABYTE;
  return wrong(
    `The files hold ${megabytes} MB; the limit is ${most} MB.`,
    `Berkas berisi ${megabytes} MB; batasnya ${most} MB.`,
  );
}
