// The parts of an archive, unpacked by the browser itself; their size is checked while they are.
import { InputError } from "../language/input.js";
import { checksum } from "./zip.js";

export const MAX_PART = 50000000; // bytes of one part
const MAX_PARTS = 10000;
const END_OF_DIRECTORY = 0x06054b50;
const CENTRAL_HEADER = 0x02014b50;
const LOCAL_HEADER = 0x04034b50;
const END_LENGTH = 22;
const CENTRAL_LENGTH = 46;
const LOCAL_LENGTH = 30;
const LONGEST_REMARK = 65535;
const STORED = 0;
const DEFLATED = 8;

/** What is wrong with the bytes of an archive; the reader is told in a sentence. */
export class Damaged extends Error {}

/** Map of path -> {method, locked, sum, packed, size, offset}: where the parts of an archive lie. */
export function directoryOf(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const end = endOf(view);
  const count = view.getUint16(end + 10, true);
  if (count > MAX_PARTS) {
    throw new Damaged("too many parts");
  }
  const parts = new Map();
  let at = view.getUint32(end + 16, true);
  for (let i = 0; i < count; i++) {
    need(view.getUint32(at, true) === CENTRAL_HEADER);
    const [name, extra, remark] = [28, 30, 32].map((place) => view.getUint16(at + place, true));
    const path = new TextDecoder().decode(bytes.subarray(at + CENTRAL_LENGTH, at + CENTRAL_LENGTH + name));
    parts.set(path, {
      method: view.getUint16(at + 10, true),
      locked: view.getUint16(at + 8, true) % 2 === 1,
      sum: view.getUint32(at + 16, true),
      packed: view.getUint32(at + 20, true),
      size: view.getUint32(at + 24, true),
      offset: view.getUint32(at + 42, true),
    });
    at += CENTRAL_LENGTH + name + extra + remark;
  }
  return parts;
}

function need(isRight) {
  if (!isRight) {
    throw new Damaged("not an archive");
  }
}

function endOf(view) {
  const last = view.byteLength - END_LENGTH;
  for (let at = last; at >= Math.max(0, last - LONGEST_REMARK); at--) {
    if (view.getUint32(at, true) === END_OF_DIRECTORY) {
      return at;
    }
  }
  throw new Damaged("no directory");
}

/** The text of one part; InputError while unpacking, if it is too long. */
export async function textOfPart(bytes, part, tooLarge) {
  return new TextDecoder().decode(await bytesOfPart(bytes, part, tooLarge));
}

/** The bytes of one part, at most so many; their sum must be that of the archive. */
export async function bytesOfPart(bytes, { method, locked, sum, packed, offset }, tooLarge, most = MAX_PART) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  need(
    view.getUint32(offset, true) === LOCAL_HEADER && !locked && (method === STORED || method === DEFLATED),
  );
  const start = offset + LOCAL_LENGTH + view.getUint16(offset + 26, true) + view.getUint16(offset + 28, true);
  const content = bytes.subarray(start, start + packed);
  const unpacked = method === STORED ? content : await inflated(content, tooLarge, most);
  if (unpacked.length > most) {
    throw tooLarge();
  }
  need(checksum(unpacked) === sum);
  return unpacked;
}

async function inflated(content, tooLarge, most) {
  const stream = new Blob([content]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
  const reader = stream.getReader();
  const pieces = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read().catch((error) => {
      throw new Damaged(error.message);
    });
    if (done) {
      break;
    }
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw tooLarge();
    }
    pieces.push(value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const piece of pieces) {
    all.set(piece, at);
    at += piece.length;
  }
  return all;
}

/** Is it one of ours to tell, or a mistake of the program? */
export function isDamage(error) {
  return error instanceof Damaged || (error instanceof RangeError && !(error instanceof InputError));
}
