// The top view: across, the way along the edge of the sink (cm); upwards, the distance from it.
import { LABELS } from "./words.js";
import { SECONDS } from "./walk.js";

const EVERYWHERE = 1e4; // pixels: beyond the canvas
const STEEPEST = 1.5; // rad: nearly along the edge
const RING = 15; // pixels

export function scene(r, s) {
  const view = viewOf(r, s);
  return {
    xlim: view.xlim,
    ylim: view.ylim,
    layers: [
      { look: "quiet", paint: paintSink },
      { look: "quiet", level: 0, label: LABELS.edge },
      { look: "band", label: "d ± 2σ_d, θ ± 2σ_θ", paint: paintBelief(view, r, s) },
      { look: "truth", x: [0, view.along], y: [s.d0, view.distance] },
      r.k > 0 && { look: "measurement", label: "z", paint: paintMeasurement(view, r, s) },
      { look: "truth", label: LABELS.beetle, paint: paintBeetle(view, s) },
      s.bearing && { look: "estimate", ellipse: { x: view.estimate, P: view.P } },
      { look: "estimate", label: "x", paint: paintRing(view) },
    ],
  };
}

/**
 * Where everything is, cm: the beetle at this moment, the filter's place for it, and what the picture must
 * hold.
 */
function viewOf(r, s) {
  const away = s.v * Math.cos(s.theta); // cm/s
  const sideways = s.v * Math.sin(s.theta);
  const end = { along: SECONDS * sideways, distance: s.d0 + SECONDS * away };
  const limits = limitsOf(r, s, end);
  const { k, n } = r;
  const estimated_d = r.d.x[k];
  const height = limits.ylim[1] - limits.ylim[0];
  const reach = Math.max(estimated_d - s.d0, 0.12 * height); // of the fan, so that it is seen from the start
  const from_theta = sidewaysOf(r.theta.x[k], estimated_d - s.d0);
  return {
    ...limits,
    along: s.moment * sideways,
    distance: s.d0 + s.moment * away,
    reach,
    fan: [sidewaysOf(r.theta.low[k], reach), sidewaysOf(r.theta.high[k], reach)],
    estimate: [s.bearing ? r.x[k * n + 3] : from_theta, estimated_d],
    P: [r.P[k * 16 + 15], r.P[k * 16 + 3], r.P[k * 16]], // of l and d, with the bearing
  };
}

/** The whole walk, and the fan at its end as far as that is sensible. */
function limitsOf(r, s, end) {
  const far = 24 * s.v + 5;
  const fan = [r.theta.low[r.T], r.theta.high[r.T]].map((theta) => {
    return Math.min(Math.max(sidewaysOf(theta, end.distance - s.d0), -far), far);
  });
  const room = 0.06 * (end.distance + 10);
  return {
    xlim: [Math.min(0, end.along, ...fan) - room, Math.max(0, end.along, ...fan) + room],
    ylim: [-room, end.distance + 1.5 * room],
  };
}

/** How far a walk in this direction leads along the edge while it leads so far away from it. */
function sidewaysOf(theta, away) {
  return away * Math.tan(Math.min(Math.max(theta, -STEEPEST), STEEPEST));
}

// --- painting ----------------------------------------------------------------------------------------------

export function paintSink(ctx, X, Y) {
  ctx.globalAlpha = 0.2;
  ctx.fillRect(0, Y(0), EVERYWHERE, EVERYWHERE);
  ctx.globalAlpha = 1;
}

/** The direction that the filter believes in as a fan, the distance as a band. */
function paintBelief({ fan, reach }, r, s) {
  const { low, high } = r.d;
  return (ctx, X, Y, colours) => {
    ctx.beginPath();
    ctx.moveTo(X(fan[0]), Y(s.d0 + reach));
    ctx.lineTo(X(0), Y(s.d0));
    ctx.lineTo(X(fan[1]), Y(s.d0 + reach));
    ctx.fill();
    const height = Math.max(Y(low[r.k]) - Y(high[r.k]), 3);
    ctx.fillRect(0, Y(high[r.k]), EVERYWHERE, height);
    ctx.strokeStyle = colours.estimate;
    ctx.lineWidth = 1;
    ctx.stroke();
  };
}

/** The measured distance from the edge, and the measured bearing from the start. */
function paintMeasurement({ along }, r, s) {
  const z = r.walk.z[(r.k - 1) * r.m];
  const bearing = r.walk.z[(r.k - 1) * r.m + 1];
  return (ctx, X, Y) => {
    ctx.setLineDash([2, 4]);
    ctx.beginPath();
    ctx.moveTo(X(along), Y(0));
    ctx.lineTo(X(along), Y(z));
    if (s.bearing) {
      ctx.moveTo(X(0), Y(0));
      ctx.lineTo(X(z * Math.tan(bearing)), Y(z));
    }
    ctx.stroke();
  };
}

/** A ring around the place where the filter has the beetle. */
function paintRing({ estimate }) {
  return (ctx, X, Y) => {
    ctx.beginPath();
    ctx.arc(X(estimate[0]), Y(estimate[1]), RING, 0, 7);
    ctx.stroke();
  };
}

/**
 * A beetle of a few strokes, seen from above, its head towards theta; its legs move with the way it has gone.
 */
export function paintBeetle({ along, distance }, s) {
  const way = s.moment * s.v;
  return (ctx, X, Y) => {
    ctx.save();
    ctx.translate(X(along), Y(distance));
    ctx.rotate(s.theta);
    paintLegs(ctx, way);
    paintBody(ctx);
    ctx.restore();
  };
}

/** Three legs and a feeler on each side. */
function paintLegs(ctx, way) {
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  for (const side of [-1, 1]) {
    for (const leg of [-1, 0, 1]) {
      const swing = 2.5 * Math.sin(3 * way + ((leg + side) * Math.PI) / 2);
      ctx.moveTo(side * 3, 3.5 * leg);
      ctx.lineTo(side * 8, 5 * leg + swing);
      ctx.lineTo(side * 10, 6.5 * leg + swing + 1);
    }
    ctx.moveTo(side, -10);
    ctx.quadraticCurveTo(side * 2, -14, side * 4.5, -14.5);
  }
  ctx.stroke();
}

/** Head and wings, with a gap between the wings. */
function paintBody(ctx) {
  ctx.beginPath();
  ctx.arc(0, -8.5, 3, 0, 7);
  ctx.ellipse(0, 0, 5, 7.5, 0, 0, 7);
  ctx.fill();
  ctx.globalCompositeOperation = "destination-out";
  ctx.lineWidth = 1;
  ctx.beginPath();
  ctx.moveTo(0, -6);
  ctx.lineTo(0, 7.5);
  ctx.stroke();
}
