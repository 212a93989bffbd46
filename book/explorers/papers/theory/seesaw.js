// The figure of the two rulers: three bells above a scale in cm, and below it a see-saw. Its weights are
// 1 / variance, so it rests on the estimate; K is the share of the beam from a to x, drawn thick.

const XLIM = [10, 33]; // cm; the axes stay, whatever is dragged
const YLIM = [-0.43, 0.72]; // 1/cm
const POINTS = 161;
const SHOULDER = Math.exp(-0.5); // height of a bell one sigma from its centre, in heights of its peak
const BEAM = -0.24; // where the see-saw is drawn
const WEIGHT = 13; // pixels: radius of the weight of a ruler with sigma = 1 cm
const TICKS = [10, 15, 20, 25, 30]; // cm

// --- what is drawn -----------------------------------------------------------------------------------------

export function draw(r, s, t) {
  const bells = [bellOf("prediction", "a", s.a, s.sigma_a), bellOf("estimate", "x", r.x, r.sigma)];
  return {
    xlim: XLIM,
    ylim: YLIM,
    layers: [
      { look: "axis", paint: paintScale },
      { look: "estimate", paint: paintInside(bells[1]) },
      bells[0],
      dotted(bellOf("measurement", "b", s.b, s.sigma_b)),
      bells[1],
      { look: "prediction", paint: paintHandles(handlesOf(s).slice(0, 3)) },
      { look: "measurement", paint: paintHandles(handlesOf(s).slice(3, 6)) },
      { look: "words", paint: paintBeam(r, s, t) },
    ],
  };
}

function density(x, mean, sigma) {
  return Math.exp(-((x - mean) ** 2) / (2 * sigma ** 2)) / (sigma * Math.sqrt(2 * Math.PI));
}

function bellOf(look, label, mean, sigma) {
  const x = Array.from({ length: POINTS }, (_, i) => mean + (8 * sigma * i) / (POINTS - 1) - 4 * sigma);
  return { look, label, x, y: x.map((value) => density(value, mean, sigma)) };
}

/** Measurements are dots elsewhere; here they are a curve of dots. */
function dotted({ look, label, x, y }) {
  const paint = (ctx, X, Y) => {
    ctx.setLineDash([2, 3]);
    ctx.lineWidth = 2.6;
    path(ctx, x, y, X, Y);
    ctx.stroke();
  };
  return { look, label, paint };
}

function paintInside({ x, y }) {
  return (ctx, X, Y) => {
    path(ctx, x, y, X, Y);
    ctx.globalAlpha = 0.14;
    ctx.fill();
    ctx.globalAlpha = 1;
  };
}

function path(ctx, x, y, X, Y) {
  ctx.beginPath();
  x.forEach((value, i) => ctx.lineTo(X(value), Y(y[i])));
}

function paintScale(ctx, X, Y, colours) {
  ctx.strokeStyle = colours.axis;
  ctx.fillStyle = colours.words;
  ctx.lineWidth = 1;
  line(ctx, X(XLIM[0]), Y(0), X(XLIM[1]), Y(0));
  ctx.font = `12px ${colours.font}`;
  ctx.textAlign = "center";
  ctx.textBaseline = "alphabetic";
  for (const tick of TICKS.slice(1)) {
    line(ctx, X(tick), Y(0), X(tick), Y(0) + 4);
    ctx.fillText(String(tick), X(tick), Y(0) + 16);
  }
  ctx.fillText("cm", X(TICKS[0]) + 12, Y(0) + 16);
}

/** Full dots move the centre, rings the width. */
function paintHandles(handles) {
  return (ctx, X, Y) => {
    ctx.lineWidth = 2.4;
    ctx.setLineDash([]);
    for (const { name, x, y } of handles) {
      dot(ctx, X(x), Y(y), name.startsWith("sigma") ? 5 : 6);
      if (name.startsWith("sigma")) {
        ctx.stroke();
      } else {
        ctx.fill();
      }
    }
  };
}

function paintBeam(r, s, t) {
  return (ctx, X, Y, colours) => {
    const y = Y(BEAM);
    ctx.strokeStyle = colours.words;
    ctx.lineWidth = 3;
    line(ctx, X(s.a), y, X(s.b), y);
    ctx.strokeStyle = colours.estimate;
    ctx.fillStyle = colours.estimate;
    ctx.lineWidth = 6;
    line(ctx, X(s.a), y, X(r.x), y); // K of the beam
    triangle(ctx, X(r.x), y + 3);
    weight(ctx, X(s.a), y - 2, WEIGHT / s.sigma_a, colours.prediction);
    weight(ctx, X(s.b), y - 2, WEIGHT / s.sigma_b, colours.measurement);
    ctx.font = `600 14px ${colours.font}`;
    ctx.textAlign = "center";
    ctx.textBaseline = "alphabetic";
    ctx.fillStyle = colours.estimate;
    ctx.fillText(`K = ${t.decimal(r.K, 2)}`, X(r.x), y + 37);
  };
}

/** A ball that lies on the beam: its area is the weight. */
function weight(ctx, x, y, radius, colour) {
  ctx.fillStyle = colour;
  dot(ctx, x, y - radius - 1, radius);
  ctx.fill();
}

function triangle(ctx, x, y) {
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x - 9, y + 18);
  ctx.lineTo(x + 9, y + 18);
  ctx.fill();
}

function line(ctx, x0, y0, x1, y1) {
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  ctx.stroke();
}

function dot(ctx, x, y, radius) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 7);
}

// --- what can be dragged -----------------------------------------------------------------------------------

const PIXELS_X = 15; // of a phone for a cm
const PIXELS_Y = 230; // of a phone for 1/cm

/** Where a pointer can take something: of each ruler the peak, both shoulders; then both ends of the beam. */
function handlesOf(s) {
  const rulers = ["a", "b"];
  const onBells = rulers.flatMap((name) => {
    const sigma = s[`sigma_${name}`];
    const peak = density(0, 0, sigma);
    return [
      { name, x: s[name], y: peak },
      { name: `sigma_${name}`, x: s[name] - sigma, y: SHOULDER * peak },
      { name: `sigma_${name}`, x: s[name] + sigma, y: SHOULDER * peak },
    ];
  });
  return [...onBells, ...rulers.map((name) => ({ name, x: s[name], y: BEAM }))];
}

function distance(one, other) {
  return Math.hypot(PIXELS_X * (one.x - other.x), PIXELS_Y * (one.y - other.y));
}

/** The pointer takes along what the hand holds already, or else what is nearest. */
export function drag(x, y, s, r, hand) {
  hand.name ??= nearestHandle({ x, y }, s).name;
  if (hand.name.startsWith("sigma")) {
    const centre = s[hand.name.replace("sigma_", "")];
    return { [hand.name]: Math.abs(x - centre) };
  }
  return { [hand.name]: x };
}

function nearestHandle(pointer, s) {
  const [nearest] = handlesOf(s).sort((one, other) => distance(one, pointer) - distance(other, pointer));
  return nearest;
}
