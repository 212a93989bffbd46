// A second thread that paints the canvases, so that filling curves never keeps a slider waiting. plot.js
// draws on a Recorder (recorder.js), and the painter carries out what was recorded. Where a browser has no
// such thread, the canvas itself is drawn on.
import { METHODS, NUMBERS, Recorder, TEXTS } from "./recorder.js";

const FONT_WAIT = 1000; // ms until the painter starts without the page's font
const THREAD_WAIT = 3000; // ms until the page draws by itself

// --- what runs in the other thread; it knows nothing from outside, because it is handed over as a text -----

/** Do one thing that was recorded. */
function carryOut(ctx, name, property, values, words) {
  if (name === "lineTo" || name === "moveTo") {
    ctx[name](values[0], values[1]); // most of all that is drawn
  } else if (name === "setLineDash") {
    ctx.setLineDash(values);
  } else if (name === "fillText") {
    ctx.fillText(words[values[0]], ...values.subarray(1));
  } else if (name) {
    ctx[name](...values);
  } else {
    const isNumber = property === "lineWidth" || property === "globalAlpha";
    ctx[property] = isNumber ? values[0] : words[values[0]];
  }
}

/** The painter's program: METHODS and properties name the codes; font is [family, address, more] or null. */
function program(carry_out, methods, properties, font, font_wait) {
  const contexts = [];
  new OffscreenCanvas(1, 1).getContext("2d").save(); // a browser that cannot fails here: the page draws

  function paint({ id, canvas, width, height, strokes, words }) {
    contexts[id] ||= canvas.getContext("2d");
    const ctx = contexts[id];
    if (ctx.canvas.width !== width || ctx.canvas.height !== height) {
      Object.assign(ctx.canvas, { width, height });
    }
    let at = 0;
    while (at < strokes.length) {
      const code = strokes[at];
      const end = at + 2 + strokes[at + 1];
      const values = strokes.subarray(at + 2, end);
      carry_out(ctx, methods[code], properties[code - methods.length], values, words);
      at = end;
    }
  }

  globalThis.onmessage = ({ data: pictures }) => {
    setTimeout(postMessage, 0, "painted"); // the canvases are filled when this task ends
    pictures.forEach(paint);
  };
  const wait = new Promise((done) => setTimeout(done, font_wait));
  const load = font && new FontFace(...font).load().then((face) => fonts.add(face));
  Promise.race([wait, load])
    .catch(() => 0) // without the page's font: the device's own
    .then(() => postMessage("ready"));
}

// --- what runs in the page ---------------------------------------------------------------------------------

let starting = null; // a promise of the thread
let thread = null; // as soon as it exists
let worker = null; // the thread, when it is ready to paint
let sheets = 0; // how many there have been
let open = 0; // how many are in use
let on_its_way = 0; // messages that the painter has not finished
let queue = []; // pictures that this turn of the page has drawn
const waiting = []; // {call, left}: who waits until only so many messages are on their way

/** The painter's program as a text, which a page from file:// may run, too. */
function programText(font) {
  const given = [METHODS, [...NUMBERS, ...TEXTS], font, FONT_WAIT].map((value) => JSON.stringify(value));
  return `(${program})(${carryOut}, ${given.join(", ")})`;
}

/** The thread, or null where there is none. */
function start(font) {
  starting ||= new Promise((done) => {
    setTimeout(done, THREAD_WAIT, null);
    try {
      const address = URL.createObjectURL(new Blob([programText(font)], { type: "text/javascript" }));
      thread = new Worker(address);
      thread.onerror = () => done(null);
      thread.onmessage = ({ data }) => {
        if (data === "ready") {
          URL.revokeObjectURL(address);
          done(thread);
        }
        if (data === "painted") {
          painted();
        }
      };
    } catch {
      done(null);
    }
  });
  return starting;
}

/** A message was carried out: call those who waited for it. */
function painted() {
  on_its_way--;
  for (const { call, left } of waiting.splice(0)) {
    whenPainted(call, left);
  }
}

/**
 * What to draw on, for a canvas: {ctx, resize(width, height), done(), close()}. done() hands over what was
 * drawn.
 * font: [family, address, more] of the page's font, or null.
 */
export async function sheetFor(canvas, font) {
  open++;
  worker = canvas.transferControlToOffscreen ? await start(font) : null;
  return worker ? paintedSheet(canvas) : ownSheet(canvas);
}

/** The canvas itself. */
function ownSheet(canvas) {
  const resize = (width, height) => Object.assign(canvas, { width, height });
  return { ctx: canvas.getContext("2d"), resize, done() {}, close };
}

/** A recorder whose strokes go to the painter, the first time together with the canvas. */
function paintedSheet(canvas) {
  const ruler = new OffscreenCanvas(1, 1).getContext("2d");
  const ctx = new Recorder(ruler);
  const id = sheets++;
  const size = {};
  let given = canvas.transferControlToOffscreen();
  const resize = (width, height) => Object.assign(size, { width, height });
  const done = () => {
    queue.push({ id, canvas: given, ...size, ...ctx.take() });
    if (queue.length === 1) {
      queueMicrotask(send);
    }
    given = undefined;
  };
  return { ctx, resize, done, close };
}

/** A sheet is not needed any more; the last one ends the thread. */
function close() {
  open--;
  if (open > 0) {
    return;
  }
  thread?.terminate();
  thread = null;
  worker = null;
  starting = null;
  on_its_way = 0;
  queue = [];
  for (const { call } of waiting.splice(0)) {
    call();
  }
}

/** Everything that one turn of the page has drawn goes as one message. */
function send() {
  if (queue.length === 0) {
    return; // all sheets were closed meanwhile
  }
  on_its_way++;
  const given_away = queue.flatMap(({ canvas, strokes }) =>
    canvas ? [canvas, strokes.buffer] : [strokes.buffer],
  );
  worker.postMessage(queue, given_away);
  queue = [];
}

/** Call back when all drawings but so many have been painted: at once if they are. */
export function whenPainted(call, left = 0) {
  const queued = queue.length > 0 ? 1 : 0; // all of them will be one message
  if (on_its_way + queued > left) {
    waiting.push({ call, left });
  } else {
    call();
  }
}
