// Draws curves, dots, bands and ellipses on a canvas, in the colours and marks of kalman_lib/plots.py. This file and
// explorer.js alone touch the document. Why no library: uPlot is 24 of the 60 kB gzip that all explorers share and knows
// neither ellipses nor a plane of two states; this file is 4 kB.
//
// A drawing is {xlim, ylim, layers}; a limit that is missing is found from the layers. A layer is one of
//   {look, x, y, label}              a curve (or dots, if the look has dots); NaN leaves a gap
//   {look: "band", x, low, high, label}
//   {look, ellipse: {x: [a, b], P: [aa, ab, bb]}, label}    two standard deviations, with its centre
//   {look, mark: [a, b], sign, label}        one large mark: a dot, or the sign, such as "+"
//   {look, at: a, label} / {look, level: b, label}          a line across, upright / level
//   {text: "t", at: [a, b], look}    a word beside a point
//   {paint(ctx, X, Y, colours)}      anything else; X and Y turn values into pixels
// A label is {id, en}, or one text for both, in which "_" makes what follows an index: "x_true", "σ_w".

import { sheetFor } from "./painter.js";

export const LOOKS = {
  truth: { width: 1.2 },
  measurement: { dots: 2.4 },
  estimate: { width: 2.2 },
  prediction: { width: 1.8, dash: [6, 3] },
  rival: { width: 1.8, dash: [7, 2.5, 2, 2.5] },
  smooth: { width: 1.8, dash: [12, 4] },
  band: { band: true },
  quiet: { width: 1, dash: [2, 3] },
};

const MARGIN = { left: 50, right: 12, top: 8, bottom: 34 }, BARE = { left: 1, right: 6, top: 4, bottom: 4 };

const HERE = document.currentScript?.src || "";         // the page's font lies beside this script; a thread of a file:// page may not load it
const FONT = HERE.startsWith("http") ? ["Plus Jakarta Sans", `url("${new URL("../fonts/plus-jakarta-sans-latin-wght-normal.woff2", HERE)}")`, { weight: "200 800" }] : null;

let colours = null;             // what the style sheet says for the theme of the page
const restyled = new Set();     // who draws again when colours or fonts have changed

function readColours() {
  const style = getComputedStyle(document.documentElement);
  const names = [...Object.keys(LOOKS), "grid", "axis", "words"];
  colours = Object.fromEntries(names.map(name => [name, style.getPropertyValue(`--explorer-${name}`).trim()]));
  colours.font = style.getPropertyValue("--sans").trim() || "sans-serif";
}

const restyle = () => { colours = null; for (const again of restyled) again(); };

/** Call `again` when the colours or the fonts of the page have changed. */
export function onThemeChange(again) {
  if (restyled.add(again).size > 1) return;
  new MutationObserver(restyle).observe(document.documentElement, { attributeFilter: ["data-theme"] });
  document.fonts?.ready.then(restyle);
}

/** An index in a label as an element: "x_true" -> x with a lowered "true". */
export function label(text) {
  const parts = document.createDocumentFragment();
  text.split(/(_\p{L}+\p{N}*|_\p{N}+)/u).forEach((part, i) => {
    if (!part) return;
    const element = document.createElement(i % 2 ? "sub" : "span");
    element.textContent = i % 2 ? part.slice(1) : part;
    parts.append(element);
  });
  return parts;
}

/** Whole steps of 1, 2 or 5 between low and high: at most about `count`. */
export function ticks(low, high, count) {
  if (!(high > low)) return [];
  const rough = (high - low) / Math.max(count, 1), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(factor => factor * power >= rough * 0.999);
  const first = Math.ceil(low / step - 1e-9), out = [];
  for (let i = first; i * step <= high + 1e-9 * step; i++) out.push(i * step);
  return out;
}

const powers = (low, high, count) => {
  if (high / low < 30) return [1, 2, 5].flatMap(digit => [-1, 0, 1].map(i => digit * 10 ** (Math.floor(Math.log10(low)) + i))).filter(value => value >= low * 0.999 && value <= high * 1.001);
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const skip = Math.max(1, Math.ceil((last - first) / count)), out = [];
  for (let i = first; i <= last; i += skip) out.push(10 ** i);
  return out;
};

/** One pair of axes with a legend above it. `spec` is the paper's description of the plot (see explorer.js); redraw() asks for a drawing. */
export class Plot {
  constructor(spec, speaker, redraw) {
    Object.assign(this, { spec, speaker, legend: "" });
    this.element = make("div", { className: `explorer-plot ${spec.half ? "half" : ""}` });
    this.words = make("div", { className: "explorer-legend" });
    this.canvas = make("canvas", { role: "img" });
    this.canvas.style.height = `calc(${spec.height || 190}px * var(--explorer-height, 1))`;
    this.canvas.setAttribute("aria-label", speaker.say(spec.alt));
    this.title = make("span", { className: "explorer-title" });
    this.title.append(label(speaker.say(spec.title)));
    this.keys = make("span", { className: "explorer-keys" });
    this.words.append(this.title, this.keys);
    this.element.append(this.words, this.canvas);
    sheetFor(this.canvas, FONT).then(sheet => { this.sheet = sheet; this.ctx = sheet.ctx; redraw(); });
  }

  /** Ask the browser how large the canvas is; only when that may have changed. */
  measure() {
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    const scale = Math.min(devicePixelRatio || 1, 3);
    const [width, height] = [Math.round(this.width * scale), Math.round(this.height * scale)];
    if (this.scale !== scale || this.pixels !== `${width} ${height}`) this.sheet.resize(width, height);
    Object.assign(this, { scale, pixels: `${width} ${height}` });
  }

  draw(drawing) {
    if (!this.sheet) return;            // it comes in a moment, and asks for a drawing
    if (!colours) readColours();
    if (this.width === undefined) this.measure();
    if (!(this.width > 0)) return;
    const { ctx, spec } = this, { left, right, top, bottom } = spec.bare ? BARE : MARGIN;
    const layers = drawing.layers.filter(Boolean);
    const x0 = left, x1 = this.width - right, y0 = this.height - bottom, y1 = top;
    let [xlim, ylim] = [drawing.xlim || limits(layers, "x", spec.xlog), drawing.ylim || limits(layers, "y", spec.ylog)];
    if (spec.equal) [xlim, ylim] = equal(xlim, ylim, (x1 - x0) / (y0 - y1));
    const X = this.X = scaleOf(xlim, x0, x1, spec.xlog), Y = this.Y = scaleOf(ylim, y0, y1, spec.ylog);
    this.x_of = pixel => spec.xlog ? xlim[0] * (xlim[1] / xlim[0]) ** ((pixel - x0) / (x1 - x0)) : xlim[0] + (xlim[1] - xlim[0]) * (pixel - x0) / (x1 - x0);
    this.y_of = pixel => spec.ylog ? ylim[0] * (ylim[1] / ylim[0]) ** ((pixel - y0) / (y1 - y0)) : ylim[0] + (ylim[1] - ylim[0]) * (pixel - y0) / (y1 - y0);

    ctx.setTransform(this.scale, 0, 0, this.scale, 0, 0);
    ctx.clearRect(0, 0, this.width, this.height);
    if (!spec.bare) this.axes(xlim, ylim, x0, x1, y0, y1);
    ctx.save();
    ctx.beginPath();
    ctx.rect(x0 - 1, y1 - 4, x1 - x0 + 6, y0 - y1 + 5);
    ctx.clip();
    for (const layer of layers) this.layer(layer, X, Y, x0, x1, y0, y1);
    ctx.restore();
    this.sheet.done();
    this.layers = layers;
  }

  axes(xlim, ylim, x0, x1, y0, y1) {
    const { ctx, spec } = this;
    const marks = (of, limits, most) => { const found = of(...limits, most); return found.length > 1 ? found : of(...limits, most + 2); };
    const xs = marks(spec.xlog ? powers : ticks, xlim, Math.floor((x1 - x0) / 70)), ys = marks(spec.ylog ? powers : ticks, ylim, Math.round((y0 - y1) / 30));
    ctx.lineWidth = 1;
    ctx.setLineDash([]);
    ctx.strokeStyle = colours.grid;
    ctx.beginPath();
    for (const value of xs) { const x = Math.round(this.X(value)) + 0.5; ctx.moveTo(x, y0); ctx.lineTo(x, y1); }
    for (const value of ys) { const y = Math.round(this.Y(value)) + 0.5; ctx.moveTo(x0, y); ctx.lineTo(x1, y); }
    ctx.stroke();
    ctx.strokeStyle = colours.axis;
    ctx.beginPath();
    ctx.moveTo(x0 + 0.5, y1);
    ctx.lineTo(x0 + 0.5, y0 + 0.5);
    ctx.lineTo(x1, y0 + 0.5);
    ctx.stroke();
    ctx.fillStyle = colours.words;
    ctx.font = `500 12px ${colours.font}`;
    ctx.textAlign = "right";
    ctx.textBaseline = "middle";
    for (const value of ys) ctx.fillText(this.tick(value, ys, spec.ylog), x0 - 6, this.Y(value), x0 - 8);      // at most so wide
    ctx.textAlign = "center";
    ctx.textBaseline = "top";
    const name = spec.xlabel || "", room = ctx.measureText(name).width;
    for (const value of xs) {
      const text = this.tick(value, xs, spec.xlog), x = this.X(value), half = ctx.measureText(text).width / 2;
      ctx.fillText(text, Math.min(x, this.width - half - 1), y0 + 5);
    }
    ctx.fillText(name, Math.min((x0 + x1) / 2, this.width - room / 2), y0 + 19);
  }

  tick(value, all, log) {
    if (log) return this.speaker.decimal(value, 2);
    const step = all.length > 1 ? all[1] - all[0] : 1, size = Math.max(...all.map(Math.abs));
    if (size >= 1e5 || size < 1e-3) return this.speaker.decimal(Math.abs(value) < step / 1e6 ? 0 : value, 3);
    const text = value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))).replace(/^-(0(\.0*)?)$/, "$1").replace("-", "\u2212");
    return this.speaker.language === "id" ? text.replace(".", ",") : text;
  }

  layer(layer, X, Y, x0, x1, y0, y1) {
    const { ctx } = this, look = LOOKS[layer.look] || {}, colour = colours[layer.look];
    ctx.strokeStyle = ctx.fillStyle = colour;
    ctx.lineWidth = look.width || 1.6;
    ctx.setLineDash(look.dash || []);
    if (layer.paint) {
      layer.paint(ctx, X, Y, colours);
    } else if (look.band) {
      const { x, low, high } = layer, skip = Math.max(1, Math.floor(x.length / (x1 - x0)));
      ctx.beginPath();
      for (let i = 0; i < x.length; i += skip) ctx.lineTo(X(x[i]), clamp(Y(high[i])));
      for (let i = x.length - 1 - (x.length - 1) % skip; i >= 0; i -= skip) ctx.lineTo(X(x[i]), clamp(Y(low[i])));
      ctx.fill();
    } else if (layer.ellipse) {
      this.ellipse(layer, X, Y, colour);
    } else if (layer.sign) {
      ctx.font = `600 22px ${colours.font}`;
      ctx.textAlign = "center";
      ctx.textBaseline = "alphabetic";
      const { actualBoundingBoxAscent: above, actualBoundingBoxDescent: below } = ctx.measureText(layer.sign);
      ctx.fillText(layer.sign, X(layer.mark[0]), Y(layer.mark[1]) + (above - below) / 2);
    } else if (layer.mark) {
      dot(ctx, X(layer.mark[0]), Y(layer.mark[1]), 5);
    } else if (layer.text) {
      ctx.font = `600 12px ${colours.font}`;
      ctx.textAlign = layer.align || "left";
      ctx.textBaseline = "middle";
      ctx.fillText(layer.text, X(layer.at[0]) + (layer.align === "right" ? -6 : 6), Y(layer.at[1]));
    } else if (layer.at !== undefined) {
      line(ctx, X(layer.at), y0, X(layer.at), y1);
    } else if (layer.level !== undefined) {
      line(ctx, x0, Y(layer.level), x1, Y(layer.level));
    } else if (look.dots) {
      const { x, y } = layer, size = x.length < 300 ? look.dots : 1.2, skip = Math.max(1, Math.floor(x.length / (4 * (x1 - x0))));
      ctx.beginPath();
      for (let i = 0; i < x.length; i += skip) {
        const a = X(x[i]), b = Y(y[i]);
        if (size < 2) ctx.rect(a - size, b - size, 2 * size, 2 * size);
        else { ctx.moveTo(a + size, b); ctx.arc(a, b, size, 0, 7); }
      }
      ctx.fill();
    } else {
      this.curve(layer.x, layer.y, X, Y, x1 - x0);
    }
  }

  /** A curve; of very many points the lowest and the highest of every pixel column. */
  curve(x, y, X, Y, width) {
    const { ctx } = this, chunk = Math.floor(x.length / (2 * width));
    let pen = false;
    const to = (a, b) => {
      if (b !== b) { pen = false; return; }
      if (pen) ctx.lineTo(X(a), clamp(Y(b))); else ctx.moveTo(X(a), clamp(Y(b)));
      pen = true;
    };
    ctx.lineJoin = x.length > width ? "bevel" : "round";        // no eye tells them apart there, and round ones take longer
    ctx.beginPath();
    if (chunk < 2) {
      for (let i = 0; i < x.length; i++) to(x[i], y[i]);
    } else {
      for (let i = 0; i < x.length; i += chunk) {
        let low = i, high = i;
        for (let j = i + 1; j < Math.min(i + chunk, x.length); j++) { if (y[j] < y[low]) low = j; if (y[j] > y[high]) high = j; }
        to(x[Math.min(low, high)], y[Math.min(low, high)]);
        to(x[Math.max(low, high)], y[Math.max(low, high)]);
      }
    }
    ctx.stroke();
  }

  ellipse({ ellipse: { x, P }, sigmas = 2, faint = false }, X, Y, colour) {
    const { ctx } = this, [a, b, d] = P, first = Math.sqrt(Math.max(a, 0)), tilt = first > 0 ? b / first : 0;
    const rest = Math.sqrt(Math.max(d - tilt * tilt, 0));
    ctx.beginPath();
    for (let i = 0; i <= 72; i++) {
      const turn = i * Math.PI / 36, c = sigmas * Math.cos(turn), s = sigmas * Math.sin(turn);
      ctx.lineTo(X(x[0] + first * c), Y(x[1] + tilt * c + rest * s));
    }
    ctx.stroke();
    ctx.globalAlpha = faint ? 0.05 : 0.14;
    ctx.fill();
    ctx.globalAlpha = 1;
    ctx.setLineDash([]);
    dot(ctx, X(x[0]), Y(x[1]), 3.5);
  }

  /** The legend is text of the page, so that it grows with it and can be read aloud. */
  renewLegend() {
    const named = (this.layers || []).filter(layer => layer.label), key = named.map(layer => layer.look + this.speaker.say(layer.label)).join("|");
    if (key === this.legend) return;
    this.legend = key;
    this.keys.replaceChildren(...named.map(layer => {
      const item = make("span", { className: "explorer-key" }), look = LOOKS[layer.look];
      const kind = layer.sign ? "sign" : layer.mark || look.dots ? "dots" : look.band ? "filled" : layer.look;
      const swatch = make("i", { className: `explorer-swatch ${kind}`, textContent: layer.sign || "" });
      swatch.style.setProperty("--colour", `var(--explorer-${layer.look})`);
      item.append(swatch, make("span", {}, label(this.speaker.say(layer.label))));
      return item;
    }));
  }
}

const clamp = pixel => pixel < -1e4 ? -1e4 : pixel > 1e4 ? 1e4 : pixel;

function scaleOf([low, high], from, to, log) {
  if (log) {
    const slope = (to - from) / Math.log(high / low);
    return value => from + slope * Math.log(value / low);
  }
  const slope = (to - from) / (high - low);
  return value => from + slope * (value - low);
}

/** The limits that hold all layers, widened to whole ticks. */
function limits(layers, axis, log) {
  let low = Infinity, high = -Infinity;
  const take = values => {
    for (let i = 0; i < values.length; i++) {
      const value = values[i];
      if (value < low && (!log || value > 0)) low = value;
      if (value > high) high = value;
    }
  };
  for (const layer of layers) {
    if (axis === "x" && layer.x) take(layer.x);
    if (axis === "y" && layer.y) take(layer.y);
    if (axis === "y" && layer.low) { take(layer.low); take(layer.high); }
    if (layer.mark) take([layer.mark[axis === "x" ? 0 : 1]]);
    if (axis === "y" && layer.level !== undefined) take([layer.level]);
    if (layer.ellipse) {
      const i = axis === "x" ? 0 : 1, reach = (layer.sigmas || 2) * Math.sqrt(Math.max(layer.ellipse.P[2 * i], 0));
      take([layer.ellipse.x[i] - reach, layer.ellipse.x[i] + reach]);
    }
  }
  if (!(low <= high) || !Number.isFinite(high - low)) [low, high] = log ? [0.1, 10] : [0, 1];
  if (log) return [10 ** Math.floor(Math.log10(low)), 10 ** Math.ceil(Math.log10(high) + 1e-9)];
  if (axis === "x") return low < high ? [low, high] : [low - 0.5, low + 0.5];
  if (high - low < 1e-12 * Math.max(Math.abs(low), Math.abs(high), 1e-300)) [low, high] = [low - Math.max(Math.abs(low), 1) / 2, high + Math.max(Math.abs(low), 1) / 2];
  const steps = ticks(low, high, 4), step = steps.length > 1 ? steps[1] - steps[0] : high - low;
  return [step / 2 * Math.floor(2 * low / step + 1e-9), step / 2 * Math.ceil(2 * high / step - 1e-9)];
}

/** Widen one of the two so that a circle is round. */
function equal([a, b], [c, d], ratio) {
  const wide = Math.max(b - a, (d - c) * ratio), high = wide / ratio, x = (a + b) / 2, y = (c + d) / 2;
  return [[x - wide / 2, x + wide / 2], [y - high / 2, y + high / 2]];
}

function line(ctx, a, b, c, d) {
  ctx.beginPath();
  ctx.moveTo(a, b);
  ctx.lineTo(c, d);
  ctx.stroke();
}

function dot(ctx, x, y, size) {
  ctx.beginPath();
  ctx.arc(x, y, size, 0, 7);
  ctx.fill();
}

/** A new element with these properties and attributes; text only ever through textContent. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element && name !== "role" && name !== "list") element[name] = value; else element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}
