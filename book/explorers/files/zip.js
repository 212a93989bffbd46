// A ZIP archive whose files are stored as they are. A library that also compresses would weigh more than all
// of files/.

/** One step of the checksum for every value of a byte. */
const CRC = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; bit++) {
    value = value & 1 ? 0xedb88320 ^ (value >>> 1) : value >>> 1;
  }
  return value;
});

const LOCAL_HEADER = 0x04034b50;
const CENTRAL_HEADER = 0x02014b50;
const END_OF_DIRECTORY = 0x06054b50;
const VERSION = 20; // 2.0
const NAMES_IN_UTF8 = 0x800;
const STORED = 0; // not compressed
const TIME = 0; // 0:00
const DATE = (26 << 9) | (1 << 5) | 1; // 2006-01-01: every archive of the same numbers is the same

/** The files [[path, text], ...] as the bytes of one archive. */
export function zip(files) {
  const encoder = new TextEncoder();
  const contents = [];
  const directory = [];
  let offset = 0;
  for (const [path, text] of files) {
    const name = encoder.encode(path);
    const data = encoder.encode(text);
    const about = description(name, data);
    const local = [littleEndian([LOCAL_HEADER, 4], ...about), name, data];
    directory.push(directoryEntry(about, offset), name);
    contents.push(...local);
    offset += sizeOf(local);
  }
  const count = files.length;
  const end = littleEndian(
    [END_OF_DIRECTORY, 4],
    [0, 4], // the only volume
    [count, 2],
    [count, 2],
    [sizeOf(directory), 4],
    [offset, 4],
    [0, 2], // no comment
  );
  return joined([...contents, ...directory, end]);
}

/** What both headers of a file say: [value, number of bytes] one after the other. */
function description(name, data) {
  return [
    [VERSION, 2],
    [NAMES_IN_UTF8, 2],
    [STORED, 2],
    [TIME, 2],
    [DATE, 2],
    [checksum(data), 4],
    [data.length, 4], // as stored
    [data.length, 4], // as it was
    [name.length, 2],
    [0, 2], // nothing more
  ];
}

function directoryEntry(about, offset) {
  return littleEndian(
    [CENTRAL_HEADER, 4],
    [VERSION, 2],
    ...about,
    [0, 2], // no comment
    [0, 2], // the only volume
    [0, 2], // no attributes, inside
    [0, 4], // nor outside
    [offset, 4],
  );
}

/** CRC-32 of bytes. */
export function checksum(data) {
  let crc = -1;
  for (const byte of data) {
    crc = CRC[(crc ^ byte) & 255] ^ (crc >>> 8);
  }
  return ~crc >>> 0;
}

/** Whole numbers [value, number of bytes] as bytes, the lowest byte first. */
function littleEndian(...numbers) {
  const bytes = [];
  for (const [value, count] of numbers) {
    for (let k = 0; k < count; k++) {
      bytes.push((value >>> (8 * k)) & 255);
    }
  }
  return Uint8Array.from(bytes);
}

function sizeOf(pieces) {
  return pieces.reduce((sum, piece) => sum + piece.length, 0);
}

function joined(pieces) {
  const all = new Uint8Array(sizeOf(pieces));
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}
