// A Recorder has the methods of a canvas and only writes down what was called; the painter carries it out.

/** The methods of a canvas that a recorder knows; their places are the codes that it writes. */
export const METHODS = [
  "lineTo",
  "moveTo",
  "beginPath",
  "stroke",
  "fill",
  "arc",
  "rect",
  "clearRect",
  "fillRect",
  "ellipse",
  "quadraticCurveTo",
  "clip",
  "save",
  "restore",
  "translate",
  "rotate",
  "setTransform",
  "setLineDash",
  "fillText",
];

/** Its properties; their codes follow those of the methods. */
export const NUMBERS = ["lineWidth", "globalAlpha"];
export const TEXTS = [
  "strokeStyle",
  "fillStyle",
  "lineJoin",
  "font",
  "textAlign",
  "textBaseline",
  "globalCompositeOperation",
];

/**
 * What is called on it, as numbers: [code, how many values, the values] again and again; texts by their
 * place.
 */
export class Recorder {
  strokes = new Float64Array(2048);
  count = 0;
  words = [];

  /** ruler: a context on which texts can be measured. */
  constructor(ruler) {
    this.ruler = ruler;
  }

  measureText(text) {
    return this.ruler.measureText(text);
  }

  write(code, values) {
    this.makeRoom(values.length + 2);
    const { strokes } = this;
    let at = this.count;
    strokes[at++] = code;
    strokes[at++] = values.length;
    for (let i = 0; i < values.length; i++) {
      strokes[at++] = typeof values[i] === "string" ? this.words.push(values[i]) - 1 : values[i];
    }
    this.count = at;
  }

  makeRoom(more) {
    if (this.count + more > this.strokes.length) {
      const wider = new Float64Array(2 * this.strokes.length + more);
      wider.set(this.strokes);
      this.strokes = wider;
    }
  }

  /** What was written so far; a clean sheet. */
  take() {
    const taken = { strokes: this.strokes.slice(0, this.count), words: this.words };
    this.count = 0;
    this.words = [];
    return taken;
  }
}

METHODS.forEach((name, code) => {
  Recorder.prototype[name] = function record(...values) {
    this.write(code, values);
  };
});
Recorder.prototype.setLineDash = function record(lengths) {
  this.write(METHODS.indexOf("setLineDash"), lengths); // its one argument is a list
};
[...NUMBERS, ...TEXTS].forEach((name, i) => {
  Object.defineProperty(Recorder.prototype, name, {
    set(value) {
      if (name === "font") {
        this.ruler.font = value;
      }
      this.write(METHODS.length + i, [value]);
    },
  });
});
