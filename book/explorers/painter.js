// A second thread that paints the canvases, so that filling curves never keeps a slider waiting. plot.js draws on a Recorder,
// which has the methods of a canvas and only writes down what was called; the painter carries it out. Where a browser has no
// such thread, the canvas itself is drawn on. No document here.

const METHODS = ["lineTo", "moveTo", "beginPath", "stroke", "fill", "arc", "rect", "clearRect", "fillRect", "ellipse", "quadraticCurveTo", "clip", "save",
                 "restore", "translate", "rotate", "setTransform", "setLineDash", "fillText"];
const NUMBERS = ["lineWidth", "globalAlpha"], TEXTS = ["strokeStyle", "fillStyle", "lineJoin", "font", "textAlign", "textBaseline", "globalCompositeOperation"];

/** The painter's whole program; it knows nothing from outside. strokes holds [code, how many values, the values] again and again. */
function program(METHODS, NUMBERS, TEXTS, font) {
  const contexts = [], PROPERTIES = [...NUMBERS, ...TEXTS];
  new OffscreenCanvas(1, 1).getContext("2d").save();            // a browser that cannot fails here, and draws in the page
  onmessage = ({ data: pictures }) => {
    setTimeout(postMessage, 0, "painted");      // the canvases are filled when this task ends
    for (const { id, canvas, width, height, strokes, words } of pictures) {
      const ctx = contexts[id] ||= canvas.getContext("2d");
      if (ctx.canvas.width !== width || ctx.canvas.height !== height) Object.assign(ctx.canvas, { width, height });
      for (let i = 0; i < strokes.length;) {
        const code = strokes[i], name = METHODS[code], values = strokes.subarray(i + 2, i += 2 + strokes[i + 1]);
        if (code < 2) ctx[name](values[0], values[1]);
        else if (name === "setLineDash") ctx.setLineDash(values);
        else if (name === "fillText") ctx.fillText(words[values[0]], ...values.subarray(1));
        else if (name) ctx[name](...values);
        else { const property = PROPERTIES[code - METHODS.length]; ctx[property] = NUMBERS.includes(property) ? values[0] : words[values[0]]; }
      }
    }
  };
  const wait = new Promise(done => setTimeout(done, 1000)), load = font && new FontFace(...font).load().then(face => fonts.add(face));
  Promise.race([wait, load]).catch(() => 0).then(() => postMessage("ready"));           // without the page's font: the device's own
}

/** What is called on it, as numbers; texts by their place in words. */
class Recorder {
  strokes = new Float64Array(2048);
  count = 0;
  words = [];

  constructor(ruler) { this.ruler = ruler; }

  measureText(text) { return this.ruler.measureText(text); }

  write(code, values) {
    if (this.count + values.length + 2 > this.strokes.length) {
      const wider = new Float64Array(2 * this.strokes.length + values.length);
      wider.set(this.strokes);
      this.strokes = wider;
    }
    const { strokes } = this;
    let at = this.count;
    strokes[at++] = code;
    strokes[at++] = values.length;
    for (let i = 0; i < values.length; i++) strokes[at++] = typeof values[i] === "string" ? this.words.push(values[i]) - 1 : values[i];
    this.count = at;
  }

  /** What was written so far; a clean sheet. */
  take() {
    const taken = { strokes: this.strokes.slice(0, this.count), words: this.words };
    this.count = 0;
    this.words = [];
    return taken;
  }
}
METHODS.forEach((name, code) => { Recorder.prototype[name] = name === "setLineDash" ? function (values) { this.write(code, values); } : function (...values) { this.write(code, values); }; });
[...NUMBERS, ...TEXTS].forEach((name, i) => Object.defineProperty(Recorder.prototype, name, { set(value) {
  if (name === "font") this.ruler.font = value;
  this.write(METHODS.length + i, [value]);
} }));

let starting = null, worker = null, sheets = 0, onItsWay = 0, queue = [], waiting = [];

/** The thread, or null where there is none. font: [family, address, more] of the page's font, or null. */
function start(font) {
  return starting ||= new Promise(done => {
    setTimeout(done, 3000, null);
    try {
      const address = URL.createObjectURL(new Blob([`(${program})(${[METHODS, NUMBERS, TEXTS, font].map(list => JSON.stringify(list))})`], { type: "text/javascript" }));
      const thread = new Worker(address);
      thread.onerror = () => done(null);
      thread.onmessage = ({ data }) => {
        if (data === "ready") { URL.revokeObjectURL(address); done(thread); }
        if (data === "painted") {
          onItsWay--;
          for (const { call, left } of waiting.splice(0)) whenPainted(call, left);
        }
      };
    } catch { done(null); }
  });
}

/** What to draw on, for a canvas: {ctx, resize(width, height), done()}. done() hands over what was drawn. */
export async function sheetFor(canvas, font) {
  worker = canvas.transferControlToOffscreen ? await start(font) : null;
  if (!worker) return { ctx: canvas.getContext("2d"), resize(width, height) { Object.assign(canvas, { width, height }); }, done() {} };
  const ctx = new Recorder(new OffscreenCanvas(1, 1).getContext("2d")), id = sheets++, size = {};
  let given = canvas.transferControlToOffscreen();
  return { ctx, resize(width, height) { Object.assign(size, { width, height }); }, done() {
    if (queue.push({ id, canvas: given, ...size, ...ctx.take() }) === 1) queueMicrotask(send);
    given = undefined;
  } };
}

/** Everything that one turn of the page has drawn goes as one message. */
function send() {
  onItsWay++;
  worker.postMessage(queue, queue.flatMap(({ canvas, strokes }) => canvas ? [canvas, strokes.buffer] : [strokes.buffer]));
  queue = [];
}

/** Call back when all drawings but so many have been painted: at once if they are. */
export function whenPainted(call, left = 0) {
  if (onItsWay + Math.min(queue.length, 1) > left) waiting.push({ call, left }); else call();
}
