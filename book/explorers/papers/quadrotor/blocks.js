// The adaptive method's witnesses: a block of innovations counts once. Twin of
// kalman_lib/papers/quadrotor/blocks.py.
import { whole } from "./statistics.js";

const LOOKS_BACK = 2; // blocks, from which R is estimated

/** The innovations y of one axis since its last update, and what the latest ones tell of R. */
export function startBlock(how, step) {
  const length = Math.max(2, whole(how.block / step)); // samples
  const recent = LOOKS_BACK * length;
  return {
    how,
    length,
    gathered: 0, // y since the last update: how many, and their sum
    sum: 0,
    squares: ring(recent), // y^2
    changes: ring(recent), // (y - the y before)^2 / 2
    latest: NaN,
  };
}

/** Take one more innovation; true where it completes the block. */
export function isFullWith(block, y) {
  push(block.squares, y * y);
  if (!Number.isNaN(block.latest)) {
    push(block.changes, (y - block.latest) ** 2 / 2);
  }
  block.latest = y;
  block.sum += y;
  block.gathered++;
  return block.gathered === block.length;
}

/** The mean of the block, and its variance R; the given R is that of one sample at rest. */
export function witness({ how, length, sum, squares, changes }, P00, R) {
  const noise = Math.min(Math.max(meanOf(squares) - P00, R), how.largest * R);
  const trembles = meanOf(changes);
  const lasts = Math.max(noise - trembles, how.lasting * noise);
  return { y: sum / length, R: trembles / length + lasts };
}

/** The next block, after the update has moved the angle: later innovations are smaller by as much. */
export function startAgain(block, moved) {
  block.latest -= moved;
  block.gathered = 0;
  block.sum = 0;
}

// --- the latest values -------------------------------------------------------------------------------------

function ring(length) {
  return { values: new Float64Array(length), count: 0 };
}

function push(latest, value) {
  latest.values[latest.count % latest.values.length] = value;
  latest.count++;
}

/** Their mean, added up from the oldest to the newest, as Python does. */
function meanOf({ values, count }) {
  const used = Math.min(count, values.length);
  let sum = 0;
  for (let j = count - used; j < count; j++) {
    sum += values[j % values.length];
  }
  return sum / used;
}
