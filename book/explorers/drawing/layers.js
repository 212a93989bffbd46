// Draws one layer of a figure. A layer is one of
//   {look, x, y, label}              a curve (or dots, if the look has dots); NaN leaves a gap
//   {look: "band", x, low, high, label}
//   {look, ellipse: {x: [a, b], P: [aa, ab, bb]}, label}    two standard deviations, with its centre
//   {look, mark: [a, b], sign, label}        one large mark: a dot, or the sign, such as "+"
//   {look, at: a, label} / {look, level: b, label}          a line across, upright / level
//   {text: "t", at: [a, b], look}    a word beside a point
//   {paint(ctx, X, Y, colours, size)}  anything else; X and Y turn values into pixels, size is that of text
// A label is {id, en}, or one text for both, in which "_" makes what follows an index: "x_true", "σ_w".
import { LOOKS } from "./looks.js";

const FULL_TURN = 2 * Math.PI;
const FEW_DOTS = 300; // more than these are small
const SMALL_DOT = 1.2; // pixels
const FAR_OUTSIDE = 1e4; // pixels: beyond, a browser draws nonsense

/** frame: {X, Y, colours, box: {left, right, top, bottom} in pixels}. */
export function drawLayer(ctx, layer, frame) {
  const look = LOOKS[layer.look] || {};
  const colour = frame.colours[layer.look];
  ctx.fillStyle = colour;
  ctx.strokeStyle = colour;
  ctx.lineWidth = look.width || 1.6;
  ctx.setLineDash(look.dash || []);
  const draw = kindOf(layer, look);
  draw(ctx, layer, frame, look);
}

/** The function that draws this kind of layer. */
function kindOf(layer, look) {
  if (layer.paint) {
    return drawPaint;
  }
  if (look.band) {
    return drawBand;
  }
  if (layer.ellipse) {
    return drawEllipse;
  }
  if (layer.mark) {
    return layer.sign ? drawSign : drawMark;
  }
  if (layer.text) {
    return drawText;
  }
  if ("at" in layer || "level" in layer) {
    return drawLine;
  }
  return look.dots ? drawDots : drawCurve;
}

function drawPaint(ctx, layer, { X, Y, colours, size }) {
  layer.paint(ctx, X, Y, colours, size);
}

/** The area between low and high; of very many points some, as many as there are pixels. */
function drawBand(ctx, { x, low, high }, { X, Y, box }) {
  const skip = Math.max(1, Math.floor(x.length / (box.right - box.left)));
  const last = x.length - 1 - ((x.length - 1) % skip);
  ctx.beginPath();
  for (let i = 0; i < x.length; i += skip) {
    ctx.lineTo(X(x[i]), clamp(Y(high[i])));
  }
  for (let i = last; i >= 0; i -= skip) {
    ctx.lineTo(X(x[i]), clamp(Y(low[i])));
  }
  ctx.fill();
}

/** Where x' P^-1 x is sigmas^2: a circle, stretched and tilted by the Cholesky factor of P. */
function drawEllipse(ctx, { ellipse: { x, P }, sigmas = 2, faint = false }, { X, Y }) {
  const [aa, ab, bb] = P;
  const first = Math.sqrt(Math.max(aa, 0));
  const tilt = first > 0 ? ab / first : 0;
  const rest = Math.sqrt(Math.max(bb - tilt * tilt, 0));
  ctx.beginPath();
  for (let i = 0; i <= 72; i++) {
    const turn = (i * FULL_TURN) / 72;
    const cosine = sigmas * Math.cos(turn);
    const sine = sigmas * Math.sin(turn);
    ctx.lineTo(X(x[0] + first * cosine), Y(x[1] + tilt * cosine + rest * sine));
  }
  ctx.stroke();
  ctx.globalAlpha = faint ? 0.05 : 0.14;
  ctx.fill();
  ctx.globalAlpha = 1;
  ctx.setLineDash([]);
  drawDot(ctx, X(x[0]), Y(x[1]), 3.5);
}

/** A sign such as "+", its middle on the place. */
function drawSign(ctx, { mark, sign }, { X, Y, colours, size }) {
  ctx.font = `600 ${22 * size}px ${colours.font}`;
  ctx.textAlign = "center";
  ctx.textBaseline = "alphabetic";
  const { actualBoundingBoxAscent: above, actualBoundingBoxDescent: below } = ctx.measureText(sign);
  ctx.fillText(sign, X(mark[0]), Y(mark[1]) + (above - below) / 2);
}

function drawMark(ctx, { mark }, { X, Y }) {
  drawDot(ctx, X(mark[0]), Y(mark[1]), 5);
}

function drawText(ctx, { text, at, align }, { X, Y, colours, size }) {
  const beside = align === "right" ? -6 : 6;
  ctx.font = `600 ${12 * size}px ${colours.font}`;
  ctx.textAlign = align || "left";
  ctx.textBaseline = "middle";
  ctx.fillText(text, X(at[0]) + beside, Y(at[1]));
}

function drawLine(ctx, { at, level }, { X, Y, box }) {
  ctx.beginPath();
  if (at !== undefined) {
    ctx.moveTo(X(at), box.bottom);
    ctx.lineTo(X(at), box.top);
  } else {
    ctx.moveTo(box.left, Y(level));
    ctx.lineTo(box.right, Y(level));
  }
  ctx.stroke();
}

/** Dots; very many are small squares, which are quicker, and not all of them. */
function drawDots(ctx, { x, y }, { X, Y, box }, look) {
  const size = x.length < FEW_DOTS ? look.dots : SMALL_DOT;
  const skip = Math.max(1, Math.floor(x.length / (4 * (box.right - box.left))));
  ctx.beginPath();
  for (let i = 0; i < x.length; i += skip) {
    const a = X(x[i]);
    const b = Y(y[i]);
    if (size === SMALL_DOT) {
      ctx.rect(a - size, b - size, 2 * size, 2 * size);
    } else {
      ctx.moveTo(a + size, b);
      ctx.arc(a, b, size, 0, 7);
    }
  }
  ctx.fill();
}

/** A curve; of very many points the lowest and the highest of every pixel column. */
function drawCurve(ctx, { x, y }, { X, Y, box }) {
  const width = box.right - box.left;
  const chunk = Math.floor(x.length / (2 * width));
  ctx.lineJoin = x.length > width ? "bevel" : "round"; // round ones take longer, and no eye sees them there
  ctx.beginPath();
  let pen_is_down = false;
  const to = (i) => {
    if (Number.isNaN(y[i])) {
      pen_is_down = false;
      return;
    }
    if (pen_is_down) {
      ctx.lineTo(X(x[i]), clamp(Y(y[i])));
    } else {
      ctx.moveTo(X(x[i]), clamp(Y(y[i])));
    }
    pen_is_down = true;
  };
  if (chunk < 2) {
    for (let i = 0; i < x.length; i++) {
      to(i);
    }
  } else {
    for (let from = 0; from < x.length; from += chunk) {
      const [low, high] = extremes(y, from, Math.min(from + chunk, x.length));
      to(Math.min(low, high));
      to(Math.max(low, high));
    }
  }
  ctx.stroke();
}

/** The places of the least and the largest value from..end. */
function extremes(y, from, end) {
  let low = from;
  let high = from;
  for (let i = from + 1; i < end; i++) {
    if (y[i] < y[low]) {
      low = i;
    }
    if (y[i] > y[high]) {
      high = i;
    }
  }
  return [low, high];
}

function clamp(pixel) {
  return Math.max(-FAR_OUTSIDE, Math.min(FAR_OUTSIDE, pixel));
}

function drawDot(ctx, x, y, size) {
  ctx.beginPath();
  ctx.arc(x, y, size, 0, 7);
  ctx.fill();
}
