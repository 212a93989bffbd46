// The complex plane with the unit circle, as all figures of this chapter show poles in it.

const BESIDE = 0.14; // how far below its axis a word stands: no pole on the axis may cover it
const TICKS = [
  ["1", 1, -BESIDE, "left"],
  ["−1", -1, -BESIDE, "right"],
  ["i", 0, 1.12, "left"],
];

/** Circle and axes; where the figure has no numbers of its own, words: true writes 1, −1 and i. */
export function circle(words = false) {
  const lines = [
    { look: "quiet", paint: paintCircle },
    { look: "quiet", level: 0 },
    { look: "quiet", at: 0 },
  ];
  return words ? [...lines, { look: "quiet", paint: paintTicks }] : lines;
}

function paintTicks(ctx, X, Y, colours, size) {
  ctx.fillStyle = colours.words;
  ctx.font = `600 ${15 * size}px ${colours.font}`;
  ctx.textBaseline = "middle";
  for (const [text, x, y, align] of TICKS) {
    ctx.textAlign = align;
    ctx.fillText(text, X(x) + (align === "left" ? 6 : -6), Y(y));
  }
}

function paintCircle(ctx, X, Y) {
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.arc(X(0), Y(0), X(1) - X(0), 0, 7);
  ctx.stroke();
}

/** A mark for each pole; the label belongs to all of them. */
export function marks(pair, look, label, sign) {
  return pair.map((mark, i) => ({ look, mark, sign, label: i === 0 && label }));
}

/** "0.9 ± 0.1 i", or both real ones. */
export function polesText([[real, imaginary], [other]], t) {
  if (imaginary > 0) {
    return `${t.decimal(real)} ± ${t.decimal(imaginary)} i`;
  }
  return `${t.decimal(real)}; ${t.decimal(other)}`;
}
