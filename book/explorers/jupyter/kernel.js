// What the kernel does for an explorer: it reads the reader's recordings, old .xls too, and writes a workbook
// with chart and notes. Twin of kalman_lib/live/files.py, which answers.
import { InputError } from "../language/input.js";

/** {read(what, files, s), write(question), leave()} for an anywidget's model. */
export function kernelOf(model) {
  const { ask, leave } = questions(model);
  const read = async (what, files, { axes } = {}) => {
    const names = files.map(({ name }) => name);
    const bytes = files.map((file) => file.bytes.slice().buffer);
    const answer = await ask({ read: what, names, axes: axes ?? null }, bytes);
    return { ...READERS[what](answer), name: names[0], files, axes };
  };
  const write = async ({ arrays, ...question }) => {
    const names = Object.keys(arrays);
    const answer = await ask({ ...question, arrays: names }, Object.values(arrays).map(ownBytes));
    return { name: answer.name, type: answer.type, content: answer.buffers[0] };
  };
  return { read, write, leave };
}

/** {ask(question, buffers) -> a promise of the answer, leave()}. */
function questions(model) {
  const waiting = new Map(); // number of a question -> {done, fail}
  const hear = (answer, buffers) => {
    const asked = waiting.get(answer.number);
    waiting.delete(answer.number);
    if (answer.error) {
      asked?.fail(new InputError(answer.error));
    } else {
      asked?.done({ ...answer, buffers });
    }
  };
  model.on("msg:custom", hear);
  const ask = (question, buffers) => {
    return new Promise((done, fail) => {
      const number = Math.random(); // the element may be shown twice, and both hear every answer
      waiting.set(number, { done, fail });
      model.send({ ...question, number }, undefined, buffers);
    });
  };
  return { ask, leave: () => model.off("msg:custom", hear) };
}

const READERS = { recording: recordingOf };

/** {rest_s, note, T, t, gyr, acc, mag, truth}: Float64Arrays, all but t with three columns; null: missing. */
function recordingOf({ arrays, rest_s, note, buffers }) {
  const found = { mag: null, truth: null };
  arrays.forEach((name, i) => {
    found[name] = numbersOf(buffers[i]);
  });
  return { ...found, rest_s, note, T: found.t.length };
}

function numbersOf({ buffer, byteOffset, byteLength }) {
  return new Float64Array(buffer.slice(byteOffset, byteOffset + byteLength));
}

function ownBytes(numbers) {
  return Float64Array.from(numbers).buffer;
}
