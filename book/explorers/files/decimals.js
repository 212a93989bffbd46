// Which decimal sign do the numbers of a table have? Twin of kalman_lib/data/decimals.py.
import { InputError } from "../language/input.js";
import { numberIn, quoted } from "./cells.js";
import { CURRENCIES } from "./units.js";

const SIGNS = [",", "."];
const ROUND = /^[^0-9]*[0-9]{1,3}[.,]000[^0-9]*$/;
const LOOKED_AT = 100; // letters
const PROVES = {
  ",": /^(?:[+-]?[0-9]*,(?:[0-9]{1,2}|[0-9]{4,20})|[+-]?0,[0-9]{0,20})$/,
  ".": /^(?:[+-]?[0-9]*\.(?:[0-9]{1,2}|[0-9]{4,20})|[+-]?0\.[0-9]{0,20})$/,
}; // numbers that only this sign explains

/**
 * [the decimal sign of rows [line, cells], null if no number has one; a remark {en, id} or null]. columns:
 * the places of those that may hold numbers.
 */
export function signOf(rows, columns, decimal) {
  const { proof, maybe, isRound } = signsIn(rows, columns);
  const found = proof.size > 0 ? proof : maybe;
  if (found.size === 0 || decimal) {
    return [found.size > 0 ? decimal : null, null];
  }
  if (found.size === 2) {
    throw bothSigns(found.get("."), found.get(","));
  }
  const [[sign, [line, cell]]] = found;
  if (found === proof) {
    return [sign, null];
  }
  if (isRound) {
    throw mayBeThousand(line, cell);
  }
  const remark = {
    en: `${quoted(cell)} was read as a decimal, not as thousands`,
    id: `${quoted(cell)} dibaca sebagai desimal, bukan ribuan`,
  };
  return [sign, remark];
}

/**
 * Two maps, sign -> [line, cell]: the first cell that only this sign explains, and the first that it may; and
 * whether all of the latter are whole thousands.
 */
function signsIn(rows, columns) {
  const proof = new Map();
  const maybe = new Map();
  let isRound = true;
  const look = (line, cell) => {
    const readings = SIGNS.filter((sign) => numberIn(cell, sign)[0] !== null);
    const likely = cell.includes(",") ? "," : ".";
    if (readings.length === 1 && !proof.has(readings[0])) {
      proof.set(readings[0], [line, cell]);
    } else if (readings.length === 2 && CURRENCIES.includes(numberIn(cell, ".")[1])) {
      const sign = likely === "." ? "," : "."; // money: thousands
      proof.set(sign, proof.get(sign) ?? [line, cell]);
    } else if (readings.length === 2) {
      isRound &&= ROUND.test(cell.slice(0, LOOKED_AT));
      if (!maybe.has(likely)) {
        maybe.set(likely, [line, cell]);
      }
    }
  };
  for (const [line, cells] of rows) {
    for (const column of cells.length > 0 ? columns : []) {
      const cell = cells[column];
      if (typeof cell === "string" && /[.,]/.test(cell) && !saysTheSame(proof, cell)) {
        look(line, cell);
      }
    }
  }
  return { proof, maybe, isRound };
}

/** Does the cell prove what is proven already? */
function saysTheSame(proof, cell) {
  if (proof.size !== 1) {
    return false;
  }
  const [sign] = proof.keys();
  return PROVES[sign].test(cell);
}

function bothSigns([line, cell], [other_line, other]) {
  return new InputError({
    en:
      `Both decimal point and comma occur: ${quoted(cell)} in line ${line}, ` +
      `${quoted(other)} in line ${other_line}; use one, or choose the decimal sign.`,
    id:
      `Ada titik dan koma desimal: ${quoted(cell)} di baris ${line}, ` +
      `${quoted(other)} di baris ${other_line}; pakailah satu saja, atau pilih tanda desimal.`,
  });
}

function mayBeThousand(line, cell) {
  const [en, id] = cell.includes(".") ? ["point", "titik"] : ["comma", "koma"];
  return new InputError({
    en:
      `Line ${line}, ${quoted(cell)}: the ${en} may be a thousand or a decimal sign; ` +
      "choose the decimal sign.",
    id:
      `Baris ${line}, ${quoted(cell)}: ${id} di situ dapat berarti ribuan atau desimal; ` +
      "pilihlah tanda desimal.",
  });
}
