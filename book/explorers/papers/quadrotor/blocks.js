// The adaptive method's witnesses: a block of measurements counts once. Twin of
// kalman_lib/papers/quadrotor/blocks.py.
const LOOKS_BACK = 5; // blocks, from which R is estimated
const NEWEST = 0.5; // so much of the newest change counts at least
const SCARCE = 3; // fewer blocks say little of R

/** The vectors of one sensor since its last update, and what its latest innovations tell of R. */
export function startBlock(kind, axes) {
  return startAgain({ kind, latest: Array.from({ length: axes }, () => []) });
}

export function startAgain(block) {
  return Object.assign(block, { sum: [0, 0, 0], count: 0, lasts: 0 });
}

/** Take one more vector, NaN where the sensor is silent; true where it completes the block. */
export function isFullWith(block, vector, dt) {
  block.lasts += dt;
  if (!Number.isNaN(vector[0])) {
    for (let i = 0; i < 3; i++) {
      block.sum[i] += vector[i];
    }
    block.count++;
  }
  if (block.lasts < block.kind.seconds - dt / 2) {
    return false;
  }
  if (block.count === 0) {
    startAgain(block);
  }
  return block.count > 0;
}

/** The attitude is turned by a small angle (3), and what was gathered with it. */
export function turnBlock({ sum }, [x, y, z]) {
  const [a, b, c] = sum;
  sum[0] += y * c - z * b;
  sum[1] += z * a - x * c;
  sum[2] += x * b - y * a;
}

export function meanOf({ sum, count }) {
  return sum.map((value) => value / count);
}

/** R of the newest innovation y along the axis i; P its variance by the prediction. */
export function noiseOf({ kind, latest }, i, y, P) {
  latest[i] = [...latest[i], y].slice(-LOOKS_BACK);
  const count = latest[i].length;
  const mean = latest[i].reduce((sum, value) => sum + value, 0) / count;
  const squares = latest[i].reduce((sum, value) => sum + (value - mean) ** 2, 0) / count;
  const changes = Math.max(squares, NEWEST * (y - mean) ** 2);
  const R = Math.max(changes + Math.min(mean ** 2, kind.lasting) - P, kind.least);
  return count >= SCARCE ? R : Math.max(R, kind.usual);
}

/** The angle has moved: the latest innovations are smaller by as much. */
export function moveBlock({ latest }, i, by) {
  latest[i] = latest[i].map((y) => y - by);
}
