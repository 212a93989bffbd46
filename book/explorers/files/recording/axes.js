// The sensors' own axes -> the body's: forward, right, down. Twin of kalman_lib/data/axes.py.
import { AXES_NAMES, say, wrong } from "./notes.js";

const AXES = { phone: "y x -z", flu: "x -y -z", frd: "x y z" }; // those that point forward, right and down
const KINDS = ["gyr", "acc", "mag"];
const UP = 5; // m/s2 along z at the start: it points up
const LOOKED_AT = 10; // rows

/** What `readRecording` accepts as axes -> {kind: [[place, sign], ...]}; null stays null. */
export function bodyAxes(axes) {
  if (axes === null) {
    return null;
  }
  const of = (kind) => turnOf(typeof axes === "string" ? axes : axes[kind]);
  return Object.fromEntries(KINDS.map((kind) => [kind, of(kind)]));
}

/** "flu" or "x -y -z" -> [[place, sign], ...] for forward, right and down. */
function turnOf(axes) {
  const parts = (AXES[axes] ?? String(axes)).split(" ").filter(Boolean);
  const turn = parts.map((part) => ["xyz".indexOf(part.replace(/^[+-]/, "")), part[0] === "-" ? -1 : 1]);
  if (parts.some((part) => !/^[+-]?[xyz]$/.test(part)) || determinant(turn) !== 1) {
    throw wrong(
      `The axes ${axes} are no right-handed frame; write for example phone, flu, frd or y x -z.`,
      `Sumbu ${axes} bukan kerangka tangan kanan; tuliskan misalnya phone, flu, frd, atau y x -z.`,
    );
  }
  return turn;
}

/** Of the matrix that such a turn is; 0: it is none. */
function determinant(turn) {
  const order = turn.map(([place]) => place).join("");
  const parity = { "012": 1, 120: 1, 201: 1, "021": -1, 102: -1, 210: -1 }[order] ?? 0;
  return turn.reduce((product, [, sign]) => product * sign, parity);
}

/** Values (3 T) in the sensor's axes -> in the body frame. */
export function turned(values, turn) {
  return values.map((_, at) => {
    const [place, sign] = turn[at % 3];
    return sign * values[at - (at % 3) + place];
  });
}

/** The axes where the reader has named none. */
export function usualAxes({ gyr, acc }, notes) {
  if (gyr.source !== "plain") {
    return "phone";
  }
  const first = Array.from({ length: Math.min(LOOKED_AT, acc.t.length) }, (_, k) => acc.values[3 * k + 2]);
  if (first.reduce((sum, value) => sum + value, 0) / first.length <= UP) {
    return "frd";
  }
  say(
    notes,
    "az is positive at the start, so z is taken to point up; if the device began upside down, " +
      "choose the axes frd.",
    "az positif pada awalnya, jadi sumbu z dianggap mengarah ke atas; jika alat mulai dalam " +
      "keadaan terbalik, pilihlah sumbu frd.",
  );
  return "flu";
}

export function tellAxes(axes, notes) {
  const isOne = typeof axes === "string";
  const pairs = isOne ? [] : Object.entries(axes).map((pair) => pair.join(" "));
  const shown = isOne ? axes : pairs.join(", ");
  const en = `forward, right, down = ${shown}`;
  const known = (isOne && AXES_NAMES[axes]) || { en, id: `depan, kanan, bawah = ${shown}` };
  say(notes, `Axes taken: ${known.en}.`, `Sumbu yang dipakai: ${known.id}.`);
}
