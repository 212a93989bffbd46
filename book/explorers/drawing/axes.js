// A pair of axes: what they show, where a value lies on the canvas, and the lines and numbers along them.

const TICK_WIDTH = 70; // pixels that a number below the axis needs
const TICK_HEIGHT = 30;
const FONT_SIZE = 12; // at the usual size of the text

// --- where the axes end ------------------------------------------------------------------------------------

/** The limits that hold all layers, widened to whole ticks; axis: "x" or "y". */
export function limits(layers, axis, log) {
  let [low, high] = range(layers, axis, log);
  if (!(low <= high) || !Number.isFinite(high - low)) {
    [low, high] = log ? [0.1, 10] : [0, 1]; // there is nothing to show
  }
  if (log) {
    return wholeDecades(low, high);
  }
  if (axis === "x") {
    return low < high ? [low, high] : [low - 0.5, low + 0.5];
  }
  return halfTicks(low, high);
}

function wholeDecades(low, high) {
  return [10 ** Math.floor(Math.log10(low)), 10 ** Math.ceil(Math.log10(high) + 1e-9)];
}

/** Widened to half a tick; a constant gets room around it. */
function halfTicks(low, high) {
  const size = Math.max(Math.abs(low), Math.abs(high), 1e-300);
  if (high - low < 1e-12 * size) {
    const room = Math.max(Math.abs(low), 1) / 2;
    return halfTicks(low - room, high + room);
  }
  const steps = ticks(low, high, 4);
  const step = steps.length > 1 ? steps[1] - steps[0] : high - low;
  return [(step / 2) * Math.floor((2 * low) / step + 1e-9), (step / 2) * Math.ceil((2 * high) / step - 1e-9)];
}

/** The least and the largest value of all layers; on a log axis what is not positive counts for nothing. */
function range(layers, axis, log) {
  let low = Infinity;
  let high = -Infinity;
  for (const values of layers.flatMap((layer) => valuesOf(layer, axis))) {
    for (let i = 0; i < values.length; i++) {
      const value = values[i];
      if (value < low && (!log || value > 0)) {
        low = value;
      }
      if (value > high) {
        high = value;
      }
    }
  }
  return [low, high];
}

/** The lists of numbers of one layer that an axis must hold. */
function valuesOf(layer, axis) {
  const i = axis === "x" ? 0 : 1;
  const found = axis === "x" ? [layer.x] : [layer.y, layer.low, layer.high];
  if (layer.mark) {
    found.push([layer.mark[i]]);
  }
  if (axis === "y" && layer.level !== undefined) {
    found.push([layer.level]);
  }
  if (layer.ellipse) {
    const { x, P } = layer.ellipse;
    const reach = (layer.sigmas || 2) * Math.sqrt(Math.max(P[2 * i], 0)); // P is [aa, ab, bb]
    found.push([x[i] - reach, x[i] + reach]);
  }
  return found.filter(Boolean);
}

/** Widen one of the two so that a circle is round; ratio: width of the figure by its height. */
export function equal([a, b], [c, d], ratio) {
  const wide = Math.max(b - a, (d - c) * ratio);
  const high = wide / ratio;
  const x = (a + b) / 2;
  const y = (c + d) / 2;
  return [
    [x - wide / 2, x + wide / 2],
    [y - high / 2, y + high / 2],
  ];
}

// --- from values to pixels and back ------------------------------------------------------------------------

/** A function that turns a value into a pixel. */
export function scaleOf([low, high], from, to, log) {
  if (log) {
    const slope = (to - from) / Math.log(high / low);
    return (value) => from + slope * Math.log(value / low);
  }
  const slope = (to - from) / (high - low);
  return (value) => from + slope * (value - low);
}

/** A function that turns a pixel into a value. */
export function inverseScaleOf([low, high], from, to, log) {
  if (log) {
    return (pixel) => low * (high / low) ** ((pixel - from) / (to - from));
  }
  return (pixel) => low + ((high - low) * (pixel - from)) / (to - from);
}

// --- ticks -------------------------------------------------------------------------------------------------

/** Whole steps of 1, 2 or 5 between low and high: at most about `count`. */
export function ticks(low, high, count) {
  if (!(high > low)) {
    return [];
  }
  const rough = (high - low) / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999);
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) {
    found.push(i * step);
  }
  return found;
}

/** Powers of ten between low and high, or where there are few: 1, 2, 5, 10, 20, ... */
function powers(low, high, count) {
  if (high / low < 30) {
    return fewPowers(low, high);
  }
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const skip = Math.max(1, Math.ceil((last - first) / count));
  const found = [];
  for (let i = first; i <= last; i += skip) {
    found.push(10 ** i);
  }
  return found;
}

function fewPowers(low, high) {
  const decade = Math.floor(Math.log10(low));
  const values = [1, 2, 5].flatMap((digit) => [-1, 0, 1].map((i) => digit * 10 ** (decade + i)));
  return values.filter((value) => value >= low * 0.999 && value <= high * 1.001);
}

/** The ticks of an axis; an axis with a single number says nothing, so then a little more often. */
function ticksOf(limits_of_axis, log, most) {
  const find = log ? powers : ticks;
  const found = find(...limits_of_axis, most);
  return found.length > 1 ? found : find(...limits_of_axis, most + 2);
}

/** The number beside a tick, in the language of the page. */
export function tickText(value, all, log, speaker) {
  if (log) {
    return speaker.decimal(value, 2);
  }
  const step = all.length > 1 ? all[1] - all[0] : 1;
  const size = Math.max(...all.map(Math.abs));
  if (size >= 1e5 || size < 1e-3) {
    return speaker.decimal(Math.abs(value) < step / 1e6 ? 0 : value, 3);
  }
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const without_minus_zero = value.toFixed(digits).replace(/^-(0(\.0*)?)$/, "$1");
  const text = without_minus_zero.replace("-", "\u2212");
  return speaker.language === "id" ? text.replace(".", ",") : text;
}

// --- drawing -----------------------------------------------------------------------------------------------

/**
 * Grid, axes and numbers. box: {left, right, top, bottom} of the axes in pixels; X, Y: scales; xlim, ylim;
 * width of the canvas; size of the text, 1 is the usual one; spec: the paper's description of the plot.
 */
export function drawAxes(ctx, { box, X, Y, xlim, ylim, width, size, spec, speaker, colours }) {
  const xs = ticksOf(xlim, spec.xlog, Math.floor((box.right - box.left) / TICK_WIDTH / size));
  const ys = ticksOf(ylim, spec.ylog, Math.round((box.bottom - box.top) / TICK_HEIGHT / size));
  ctx.lineWidth = 1;
  ctx.setLineDash([]);
  ctx.strokeStyle = colours.grid;
  ctx.beginPath();
  for (const value of xs) {
    const x = Math.round(X(value)) + 0.5; // between pixels a line would be two pixels wide
    ctx.moveTo(x, box.bottom);
    ctx.lineTo(x, box.top);
  }
  for (const value of ys) {
    const y = Math.round(Y(value)) + 0.5;
    ctx.moveTo(box.left, y);
    ctx.lineTo(box.right, y);
  }
  ctx.stroke();
  ctx.strokeStyle = colours.axis;
  ctx.beginPath();
  ctx.moveTo(box.left + 0.5, box.top);
  ctx.lineTo(box.left + 0.5, box.bottom + 0.5);
  ctx.lineTo(box.right, box.bottom + 0.5);
  ctx.stroke();
  ctx.fillStyle = colours.words;
  ctx.font = `500 ${FONT_SIZE * size}px ${colours.font}`;
  numbersBeside(ctx, ys, box, Y, (value) => tickText(value, ys, spec.ylog, speaker));
  numbersBelow(ctx, xs, { box, X, width, size }, (value) => tickText(value, xs, spec.xlog, speaker));
  nameBelow(ctx, spec.xlabel || "", { box, width, size });
}

function numbersBeside(ctx, ys, box, Y, textOf) {
  ctx.textAlign = "right";
  ctx.textBaseline = "middle";
  for (const value of ys) {
    const most = box.left - 8; // a longer one is squeezed
    ctx.fillText(textOf(value), box.left - 6, Y(value), most);
  }
}

function numbersBelow(ctx, xs, { box, X, width, size }, textOf) {
  ctx.textAlign = "center";
  ctx.textBaseline = "top";
  for (const value of xs) {
    const text = textOf(value);
    const half = ctx.measureText(text).width / 2;
    ctx.fillText(text, Math.min(X(value), width - half - 1), box.bottom + 5 * size);
  }
}

function nameBelow(ctx, name, { box, width, size }) {
  const half = ctx.measureText(name).width / 2;
  ctx.fillText(name, Math.min((box.left + box.right) / 2, width - half), box.bottom + 19 * size);
}
