// The figures of chapter 6: one panel an angle, and the craft seen from the south and from above.
import { inBoth } from "../../language/speaker.js";
import { AXES, DEG } from "./model.js";
import { COMPASS, PANEL_ALT, PANEL_TITLES } from "./words.js";

const EVERYWHERE = 1e4; // pixels: beyond the canvas

/** What the thin lines are called: the truth, or the angles that the device itself gives. */
const TRUTH = { truth: "x_true", device: "x_ref" };

/** A size with two decimals, or one where it is ten or more. */
export function size(value, t) {
  return t.decimal(Number(value.toFixed(Math.abs(value) < 10 ? 2 : 1)), 6);
}

// --- angles against time -----------------------------------------------------------------------------------

/** Angle i against time, if it is chosen; the stretches where the filter uses m R are shaded. */
export function panel(i) {
  return {
    title: PANEL_TITLES[i],
    xlabel: "t (s)",
    height: 210,
    half: true,
    visible: (s) => s.shown === AXES[i] || s.shown === "all",
    alt: inBoth(PANEL_ALT, { axis: AXES[i] }),
    drag: (time) => ({ moment: time }),
    draw({ lines, result, flight, how, k }) {
      const { t, panels } = lines;
      const { x, z, truth } = panels[i];
      return {
        xlim: [0, flight.t[flight.T - 1]],
        layers: [
          how.kept ? null : { look: "band", paint: paintDynamic(flight.t, result.dynamic), label: "m R" },
          { look: "measurement", x: t, y: z, label: "z" },
          { look: "estimate", x: t, y: x, label: "x" },
          flight.reference && { look: "truth", x: t, y: truth, label: TRUTH[flight.reference] },
          { look: "quiet", at: flight.t[k] },
        ],
      };
    },
  };
}

/** A rectangle for every stretch in which the craft is dynamic. */
function paintDynamic(t, dynamic) {
  return (ctx, X, Y, colours) => {
    ctx.fillStyle = colours.band;
    let from = -1;
    for (let k = 0; k <= t.length; k++) {
      const isDynamic = k < t.length && dynamic[k];
      if (isDynamic && from < 0) {
        from = k;
      }
      if (!isDynamic && from >= 0) {
        ctx.fillRect(X(t[from]), 0, X(t[k - 1]) - X(t[from]), EVERYWHERE);
        from = -1;
      }
    }
  };
}

// --- the craft ---------------------------------------------------------------------------------------------

const CIRCLE = Array.from({ length: 33 }, (_, i) => [
  Math.cos((i * Math.PI) / 16),
  Math.sin((i * Math.PI) / 16),
  0,
]);
const FRONT_RIGHT = [0.75, 0.75, 0];
const BACK_LEFT = [-0.75, -0.75, 0];
const FRONT_LEFT = [0.75, -0.75, 0];
const BACK_RIGHT = [-0.75, 0.75, 0];
const NOSE = [
  [-0.2, 0, 0],
  [1.25, 0, 0],
  [1, 0.14, 0],
  [1.25, 0, 0],
  [1, -0.14, 0],
];
const ROTORS = [FRONT_RIGHT, BACK_LEFT, FRONT_LEFT, BACK_RIGHT].map((tip) => {
  return CIRCLE.map((point) => point.map((value, i) => tip[i] + 0.38 * value));
});

/** Lines in the axes of the body: forward, right, down. */
const SHAPE = [NOSE, [FRONT_RIGHT, BACK_LEFT], [FRONT_LEFT, BACK_RIGHT], ...ROTORS];
const HORIZON = CIRCLE.map((point) => point.map((value) => 1.75 * value));
const LEVEL = [0, 0, 0];

/** Where a point of the body is seen from the south and from above: [to the right, up]. */
function seen([x, y, z], [roll, pitch, yaw]) {
  const right = y * Math.cos(roll) - z * Math.sin(roll);
  const below = y * Math.sin(roll) + z * Math.cos(roll);
  const ahead = x * Math.cos(pitch) + below * Math.sin(pitch);
  const down = below * Math.cos(pitch) - x * Math.sin(pitch);
  const north = ahead * Math.cos(yaw) - right * Math.sin(yaw);
  const east = ahead * Math.sin(yaw) + right * Math.cos(yaw);
  return [east, 0.6 * north - 0.8 * down];
}

export function craft({ flight, result, k }, s, t) {
  const truth = flight.truth.subarray(3 * k, 3 * k + 3);
  const estimate = result.angles.subarray(3 * k, 3 * k + 3);
  const times = s.larger ? 5 : 1;
  const surroundings = (ctx, X, Y, colours) => {
    paintLine(ctx, X, Y, HORIZON, LEVEL);
    ctx.font = `600 12px ${colours.font}`;
    ctx.fillStyle = colours.words;
    ctx.textBaseline = "middle";
    paintCompass(ctx, X, Y, t);
    paintAngles(ctx, estimate, truth, t);
  };
  return {
    xlim: [-4, 2.2],
    ylim: [-1.45, 1.75],
    layers: [
      { look: "quiet", paint: surroundings },
      { look: "estimate", paint: paintCraft(estimate, times), label: "x" },
      flight.reference && {
        look: "truth",
        paint: paintCraft(truth, times),
        label: TRUTH[flight.reference],
      },
    ],
  };
}

/** The craft; times: how much larger its tilt is drawn. */
function paintCraft([roll, pitch, yaw], times) {
  const drawn = [times * roll, times * pitch, yaw];
  return (ctx, X, Y) => SHAPE.forEach((line) => paintLine(ctx, X, Y, line, drawn));
}

function paintLine(ctx, X, Y, points, angles) {
  ctx.beginPath();
  for (const point of points) {
    const [right, up] = seen(point, angles);
    ctx.lineTo(X(right), Y(up));
  }
  ctx.stroke();
}

function paintCompass(ctx, X, Y, t) {
  ctx.textAlign = "center";
  [...t.say(COMPASS)].forEach((letter, i) => {
    const [right, up] = seen([2, 0, 0], [0, 0, (i * Math.PI) / 2]);
    ctx.fillText(letter, X(right), Y(up));
  });
}

/** "roll 1.2° (1.1°)": the estimate, and the truth in brackets. */
function paintAngles(ctx, estimate, truth, t) {
  ctx.textAlign = "left";
  AXES.forEach((axis, i) => {
    const text = `${axis} ${size(estimate[i] / DEG, t)}° (${size(truth[i] / DEG, t)}°)`;
    ctx.fillText(text, 8, 14 + 17 * i);
  });
}
