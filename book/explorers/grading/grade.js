// What is right, and which hint comes next. Twin of kalman_lib/live/grading.py.
//
// An exercise is what a page knows of it: {kind, answer, mistakes: [answers], tolerance, accept, start}. A
// test puts the same answers to both twins.

const SLACK = 1 + 1e-9; // of the tolerance: what rounding to binary fractions leaves open
const TRIES = 2; // wrong answers, after which the solution may be opened

/** What a reader has tried so far; said: the names of the hints. */
export function newState() {
  return { wrong: 0, right: false, said: [] };
}

/** May the solution be opened? */
export function isOpen({ right, wrong }) {
  return right || wrong >= TRIES;
}

/**
 * value: a number, the place of a choice, or a line of code -> {right, mistake}; mistake is the place of the
 * typical one, null: another one.
 */
export function grade(exercise, value) {
  const same = sameness(exercise);
  if ([exercise.answer, ...(exercise.accept ?? [])].some((answer) => same(value, answer))) {
    return { right: true, mistake: null };
  }
  const place = exercise.mistakes.findIndex((mistake) => same(value, mistake));
  return { right: false, mistake: place < 0 ? null : place };
}

/**
 * Count an answer -> the name of the hint to say: a place among the mistakes, "hint" or "second"; null when
 * it is right. No hint is said twice while another one is left.
 */
export function take(state, { right, mistake }) {
  if (right) {
    state.right = true;
    return null;
  }
  state.wrong += 1;
  const own = mistake === null ? [] : [mistake];
  const name = [...own, "hint", "second"].find((one) => !state.said.includes(one)) ?? "second";
  state.said.push(name);
  return name;
}

/** The function (value, wanted) -> boolean of the kind of this exercise. */
function sameness({ kind, tolerance, start = "" }) {
  if (kind === "number") {
    return (value, wanted) => Math.abs(value - wanted) <= tolerance * SLACK;
  }
  if (kind === "choice") {
    return (value, wanted) => value === wanted;
  }
  return (value, wanted) => bare(value, start) === bare(wanted, start);
}

/** A line of code without white space, and without what stands before its box already. */
function bare(code, start) {
  const text = packed(code);
  const before = packed(start);
  return before !== "" && text.startsWith(before) ? text.slice(before.length) : text;
}

function packed(code) {
  return code
    .replace(/\s+/g, "")
    .replace(/\u2212/g, "-")
    .replace(/[‘’]/g, "'")
    .replace(/[“”]/g, '"');
}
