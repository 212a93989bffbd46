// One figure of an explorer: a canvas with axes, and above it a title and a legend, which are text of the
// page.
//
// A drawing is {xlim, ylim, layers}; a limit that is missing is found from the layers, which layers.js
// describes. Why no library: uPlot is 24 kB gzip and knows neither ellipses nor a plane of two states; this
// room is 5 kB.
import { drawAxes, equal, inverseScaleOf, limits, scaleOf } from "./axes.js";
import { drawLayer } from "./layers.js";
import { FONT, LOOKS, coloursFor } from "./looks.js";
import { label, make } from "./make.js";
import { sheetFor } from "./painter.js";

const MARGIN = { left: 50, right: 12, top: 8, bottom: 34 }; // pixels
const BARE_MARGIN = { left: 1, right: 6, top: 4, bottom: 4 };
const HEIGHT = 190; // pixels, where the paper says nothing
const TEXT = 16; // pixels of the text of a page as it usually is
const PAPER_SCALE = 2.5; // pixels of a printed figure for one of the page: 240 an inch
const SHARPEST = 3; // pixels of the device for one of the page

export class Plot {
  /** spec: the paper's description of the plot (see papers/README.md); redraw() asks for a drawing. */
  constructor(spec, speaker, redraw) {
    this.spec = spec;
    this.speaker = speaker;
    this.legend = "";
    this.canvas = make("canvas", { role: "img", "aria-label": speaker.say(spec.alt) });
    const factor = spec.fixed ? 1 : "var(--explorer-height, 1)";
    this.canvas.style.height = `calc(${spec.height || HEIGHT}px * ${factor})`;
    const title = make("span", { className: "explorer-title" }, label(speaker.say(spec.title)));
    this.keys = make("span", { className: "explorer-keys" });
    this.words = make("div", { className: "explorer-legend" }, title, this.keys);
    const className = `explorer-plot ${spec.half ? "half" : ""}`;
    this.element = make("div", { className }, this.words, this.canvas);
    this.coming = sheetFor(this.canvas, FONT).then((sheet) => {
      this.sheet = sheet;
      this.ctx = sheet.ctx;
      redraw();
    });
  }

  /** The plot leaves the page; its sheet is given back, also one that is still to come. */
  destroy() {
    this.coming.then(() => this.sheet.close());
  }

  /** The size of the canvas may have changed: ask for it before the next drawing. */
  forgetSize() {
    this.width = undefined;
  }

  /**
   * Was there no room although it is in sight? JupyterLab hides its whole window for part of a frame when its
   * theme changes, too short for an observer.
   */
  get isMissed() {
    return this.sheet && this.seen && !(this.width > 0);
  }

  /** Ask the browser how large the canvas is. */
  measure() {
    this.width = this.canvas.clientWidth;
    if (!(this.width > 0)) {
      return;
    }
    this.height = this.canvas.clientHeight;
    this.text = Math.max(1, parseFloat(getComputedStyle(this.canvas).fontSize) / TEXT);
    const scale = Math.min(devicePixelRatio || 1, SHARPEST);
    const width = Math.round(this.width * scale);
    const height = Math.round(this.height * scale);
    const size = `${width} ${height} ${scale}`;
    if (this.size !== size) {
      this.sheet.resize(width, height);
    }
    this.size = size;
    this.scale = scale;
  }

  draw(drawing) {
    if (!this.sheet) {
      return; // it comes in a moment, and asks for a drawing
    }
    if (!(this.width > 0)) {
      this.measure();
    }
    if (!(this.width > 0)) {
      return; // isMissed says so
    }
    const { ctx, spec, speaker, width } = this;
    const layers = drawing.layers.filter(Boolean);
    const frame = { ...this.fit(drawing, layers), colours: coloursFor(this.canvas), size: this.text };
    const { box } = frame;
    ctx.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    ctx.clearRect(0, 0, width, this.height);
    if (!spec.bare) {
      drawAxes(ctx, { ...frame, width, spec, speaker });
    }
    ctx.save();
    ctx.beginPath();
    ctx.rect(box.left - 1, box.top - 4, box.right - box.left + 6, box.bottom - box.top + 5);
    ctx.clip();
    for (const layer of layers) {
      drawLayer(ctx, layer, frame);
    }
    ctx.restore();
    this.sheet.done();
    this.layers = layers;
  }

  /** The figure and its legend once more, at the end of `around`, painted at once: for paper. */
  paintAlso(drawing, around, width) {
    const { spec, canvas: live } = this;
    const height = spec.height || HEIGHT;
    const size = { width: width * PAPER_SCALE, height: height * PAPER_SCALE };
    const canvas = make("canvas", { ...size, role: "img", "aria-label": live.getAttribute("aria-label") });
    const keys = make("span", { className: "explorer-keys" });
    const title = this.words.firstChild.cloneNode(true);
    const words = make("div", { className: "explorer-legend" }, title, keys);
    around.append(make("div", { className: this.element.className }, words, canvas));
    const twin = Object.create(this); // what it sets stays its own
    const ctx = canvas.getContext("2d");
    Object.assign(twin, { canvas, keys, ctx, width, height, text: 1, scale: PAPER_SCALE, legend: "" });
    twin.sheet = { done() {} };
    twin.draw(drawing);
    twin.renewLegend();
  }

  /** Where everything goes: {box, xlim, ylim, X, Y}; x_of and y_of turn pixels into values, place() back. */
  fit(drawing, layers) {
    const { spec } = this;
    const margin = spec.bare ? BARE_MARGIN : MARGIN;
    const size = spec.bare ? 1 : this.text;
    const box = {
      left: margin.left * size,
      right: this.width - margin.right,
      top: margin.top * size,
      bottom: this.height - margin.bottom * size,
    };
    let xlim = drawing.xlim || limits(layers, "x", spec.xlog);
    let ylim = drawing.ylim || limits(layers, "y", spec.ylog);
    if (spec.equal) {
      [xlim, ylim] = equal(xlim, ylim, (box.right - box.left) / (box.bottom - box.top));
    }
    const X = scaleOf(xlim, box.left, box.right, spec.xlog);
    const Y = scaleOf(ylim, box.bottom, box.top, spec.ylog);
    this.x_of = inverseScaleOf(xlim, box.left, box.right, spec.xlog);
    this.y_of = inverseScaleOf(ylim, box.bottom, box.top, spec.ylog);
    this.place = ([x, y]) => [X(x), Y(y)];
    return { box, xlim, ylim, X, Y };
  }

  /** The legend is text of the page, so that it grows with it and can be read aloud. */
  renewLegend() {
    const named = (this.layers || []).filter((layer) => layer.label);
    const shown = named.map((layer) => layer.look + this.speaker.say(layer.label)).join("|");
    if (shown !== this.legend) {
      this.legend = shown;
      this.keys.replaceChildren(...named.map((layer) => this.legendEntry(layer)));
    }
  }

  legendEntry(layer) {
    const className = `explorer-swatch ${swatchOf(layer)}`;
    const swatch = make("i", { className, textContent: layer.sign || "" });
    swatch.style.setProperty("--colour", `var(--explorer-${layer.look})`);
    const words = make("span", {}, label(this.speaker.say(layer.label)));
    return make("span", { className: "explorer-key" }, swatch, words);
  }
}

/** How the legend shows a layer: the name of its swatch in plot.css. */
function swatchOf(layer) {
  const look = LOOKS[layer.look];
  if (layer.sign) {
    return "sign";
  }
  if (layer.mark || look.dots) {
    return "dots";
  }
  return look.band ? "filled" : layer.look;
}
