// The figures of a phone in the hand: three ghosts of it, and a level beside a compass.
import { anglesOf, dot } from "./vertical.js";
import { COMPASS, TILT } from "./words.js";

const DEG = Math.PI / 180; // rad
const LOOK_OF = { gyro: "prediction", acc: "measurement", filter: "estimate" };
const SIDES = [0.55, 1.1]; // half its width and its height
const OUTLINE = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, 1],
  [-1, -1],
];
const EARPIECE = [
  [-0.3, 0.86],
  [0.3, 0.86],
];
const CIRCLE = Array.from({ length: 41 }, (_, i) => [Math.cos(i * 9 * DEG), Math.sin(i * 9 * DEG)]);
const FULL = Math.sin(30 * DEG); // at this tilt the bubble touches the rim
const APART = 2.6; // between the middles of level and compass

/** The three phones as the hand holds them: behind is where the top edge pointed at first. */
export function drawGhosts(framesAt) {
  return (r) => {
    const frames = framesAt(r, r.k);
    const [, , yaw] = anglesOf(framesAt(r, 0).filter);
    const layers = ["acc", "gyro", "filter"].map((name) => {
      return { look: LOOK_OF[name], paint: paintPhone(frames[name], yaw), label: TILT[name] };
    });
    return { xlim: [-1.3, 1.3], ylim: [-1.15, 1.15], layers };
  };
}

function paintPhone(frame, yaw) {
  const [sine, cosine] = [Math.sin(yaw * DEG), Math.cos(yaw * DEG)];
  const seen = ([x, y]) => {
    const [east, north, up] = frame.map((axis) => dot(axis, [SIDES[0] * x, SIDES[1] * y, 0]));
    const ahead = north * cosine + east * sine;
    return [east * cosine - north * sine, 0.6 * ahead + 0.8 * up];
  };
  return (ctx, X, Y) => {
    paintLine(ctx, X, Y, OUTLINE.map(seen));
    paintLine(ctx, X, Y, EARPIECE.map(seen));
  };
}

function paintLine(ctx, X, Y, points) {
  ctx.beginPath();
  points.forEach(([right, up]) => ctx.lineTo(X(right), Y(up)));
  ctx.stroke();
}

/** A level, whose bubbles go to the side that is higher, and a compass, whose needles point north. */
export function drawInstruments(framesAt) {
  return (r, s, t) => {
    const frames = Object.entries(framesAt(r, r.k));
    const bubbles = frames.map(([name, [, , up]]) => ({ look: LOOK_OF[name], mark: bubble(up) }));
    const needles = frames
      .filter(([name]) => name !== "acc")
      .map(([name, frame]) => ({ look: LOOK_OF[name], paint: paintNeedle(anglesOf(frame)[2]) }));
    const north = anglesOf(framesAt(r, r.k).filter)[2];
    const measured = r.motion.heading[r.k];
    if (!Number.isNaN(measured)) {
      needles.unshift({ look: LOOK_OF.acc, paint: paintNeedle(measured) });
    }
    return {
      xlim: [-1.3, APART + 1.3],
      ylim: [-1.3, 1.3],
      layers: [{ look: "quiet", paint: paintRims(north, t) }, ...bubbles, ...needles],
    };
  };
}

function bubble([x, y]) {
  const far = Math.max(1, Math.hypot(x, y) / FULL);
  return [x / FULL / far, y / FULL / far];
}

function paintNeedle(heading) {
  const [right, up] = [-Math.sin(heading * DEG), Math.cos(heading * DEG)];
  return (ctx, X, Y) => {
    paintLine(ctx, X, Y, [
      [APART, 0],
      [APART + 0.85 * right, 0.85 * up],
    ]);
  };
}

/** Both rims, the middle of the level, and the letter of north where the filter has it. */
function paintRims(heading, t) {
  return (ctx, X, Y, colours, size) => {
    paintLine(ctx, X, Y, CIRCLE);
    const small = CIRCLE.map(([x, y]) => [0.25 * x, 0.25 * y]);
    paintLine(ctx, X, Y, small);
    const rim = CIRCLE.map(([x, y]) => [APART + x, y]);
    paintLine(ctx, X, Y, rim);
    ctx.font = `600 ${12 * size}px ${colours.font}`;
    ctx.fillStyle = colours.words;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    const [letter] = t.say(COMPASS);
    ctx.fillText(letter, X(APART - 1.15 * Math.sin(heading * DEG)), Y(1.15 * Math.cos(heading * DEG)));
  };
}
