// The reader's own phone in the view "drift": its rate added up, alone or together with the angle that its
// tilt or its compass shows. In degrees and seconds; the steps T are those of the readings.
const DEG = Math.PI / 180; // rad
export const REST = 5; // s at the start, in which it should lie still
const ROUNDING = 0.1 / Math.sqrt(12); // degrees a second: browsers round to 0.1, so no sigma is smaller
const LARGEST = 5; // degrees a second: more is a phone that was moved
const REACHES = [1, 2, 5, 10, 20, 50, 100, 200, 500]; // degrees up and down
const SPANS = [10, 20, 60, 120]; // s

/** The ways to turn it: about which axis (sensors/units.js), and what else tells the angle. */
export const TURNS = {
  roll: { axis: 1, angle: ({ acc }, k) => Math.atan2(-acc[3 * k], acc[3 * k + 2]) / DEG },
  pitch: { axis: 0, angle: ({ acc }, k) => Math.atan2(acc[3 * k + 1], acc[3 * k + 2]) / DEG },
  yaw: { axis: 2, angle: ({ heading }, k) => -heading[k] },
};

/** An angle between -180 and 180 degrees. */
function wrap(angle) {
  return angle - 360 * Math.floor((angle + 180) / 360);
}

/** The rate u (T) about the axis and the other angle z (T), from its mean over the first readings at rest. */
export function readingsOf(motion, turn) {
  const { axis, angle } = TURNS[turn];
  const { T, t, gyr } = motion;
  const u = Float64Array.from({ length: T }, (_, k) => gyr[3 * k + axis]);
  const z = Float64Array.from({ length: T }, (_, k) => angle(motion, k));
  const rest = t.findLastIndex((time) => time <= REST) + 1;
  const first = z.find((value) => !Number.isNaN(value)) ?? NaN;
  const middle = first + meanOf(z.subarray(0, rest).map((value) => wrap(value - first)));
  return { u, z: z.map((value) => wrap(value - middle)), rest };
}

/** Mean of the known values; 0 without any. */
function meanOf(values) {
  const known = values.filter((value) => !Number.isNaN(value));
  return known.length > 0 ? known.reduce((sum, value) => sum + value, 0) / known.length : 0;
}

/** What the gyroscope says at rest: its mean and its standard deviation, degrees a second. */
export function atRest(motion, turn) {
  const { u, rest } = readingsOf(motion, turn);
  const still = u.subarray(0, rest);
  const mean = meanOf(still);
  const sigma = Math.sqrt(meanOf(still.map((rate) => (rate - mean) ** 2)));
  return { mean, sigma: Math.max(sigma, ROUNDING) };
}

/** The sigma that the reader has set, or that of the phone at rest. */
export function sigmaOf(s) {
  if (!s.motion) {
    return 1;
  }
  return s.sigma ?? Math.min(Number(atRest(s.motion, s.turn).sigma.toPrecision(2)), LARGEST);
}

/**
 * The angle of the phone: {t, u, z, alone, fan, filter: {x, P, K}, x, band, at_rest}. fan: two standard
 * deviations of the sum; a mean that was subtracted is itself known from the readings at rest alone.
 */
export function follow(s) {
  const { motion, turn } = s;
  const { t, T } = motion;
  const { u, z, rest } = readingsOf(motion, turn);
  const at_rest = atRest(motion, turn);
  const sigma_w = sigmaOf(s);
  const bias = s.centred ? at_rest.mean : 0;
  const alone = new Float64Array(T);
  const fan = new Float64Array(T);
  let squares = 0; // of the steps
  for (let k = 1; k < T; k++) {
    const step = t[k] - t[k - 1];
    alone[k] = alone[k - 1] + step * (u[k] - bias);
    squares += step ** 2;
    const of_mean = s.centred ? (t[k] ** 2 - 2 * t[k] * t[Math.min(k, rest - 1)]) / rest : 0;
    fan[k] = 2 * sigma_w * Math.sqrt(Math.max(squares + of_mean, 0));
  }
  const filter = filtered({ t, u, z, bias }, sigma_w, s.noise_v);
  const band = s.sensor ? filter.P.map((P) => 2 * Math.sqrt(P)) : fan;
  return { t, u, z, alone, fan, filter, at_rest, band, x: s.sensor ? filter.x : alone };
}

/** The filter of the chapter with steps of any length; z that is NaN is no measurement. */
function filtered({ t, u, z, bias }, sigma_w, sigma_v) {
  const R = sigma_v ** 2;
  const [x, P, K] = [0, 1, 2].map(() => new Float64Array(t.length));
  for (let k = 1; k < t.length; k++) {
    const step = t[k] - t[k - 1];
    const x_pred = x[k - 1] + step * (u[k] - bias);
    const P_pred = P[k - 1] + (sigma_w * step) ** 2;
    const isKnown = !Number.isNaN(z[k]);
    K[k] = isKnown ? P_pred / (P_pred + R) : 0;
    x[k] = x_pred + (isKnown ? K[k] * wrap(z[k] - x_pred) : 0);
    P[k] = (1 - K[k]) * P_pred;
  }
  return { x, P, K };
}

// --- figures -----------------------------------------------------------------------------------------------

/** The limits of the figure, in steps, so that it does not tremble while it grows. */
export function limitsOf({ t, alone, fan, x }) {
  const last = t[t.length - 1];
  const most = (values) => values.reduce((size, value) => Math.max(size, Math.abs(value)), 0);
  const size = Math.max(most(alone), most(fan), most(x));
  const reach = REACHES.find((value) => value >= size) ?? size;
  return { xlim: [0, SPANS.find((value) => value >= last) ?? last], ylim: [-reach, reach] };
}

/** The phone at the last reading, as gyroscope alone, other angle and filter have it. */
export function ghosts({ alone, z, x }, s, labels) {
  const last = alone.length - 1;
  const paint = (angle) => paintPhone(s.turn, angle);
  return {
    xlim: [-1.6, 1.6],
    ylim: [-1.1, 1.1],
    layers: [
      { look: "quiet", paint: paintPhone(s.turn, 0) },
      s.sensor && { look: "measurement", paint: paint(z[last]), label: "z" },
      s.sensor && { look: "rival", paint: paint(alone[last]), label: labels.alone },
      { look: "estimate", paint: paint(x[last]), label: "x" },
    ],
  };
}

/** Its outline: from the lower edge (roll), from the left (pitch), from above (yaw). */
function paintPhone(turn, angle) {
  const [width, height] = turn === "yaw" ? [0.5, 1] : [1, 0.08];
  const sine = Math.sin(angle * DEG) * (turn === "roll" ? 1 : -1);
  const cosine = Math.cos(angle * DEG);
  const corners = [
    [-width, -height],
    [width, -height],
    [width, height],
    [-width, height],
    [-width, -height],
  ];
  return (ctx, X, Y) => {
    ctx.beginPath();
    for (const [along, up] of corners) {
      ctx.lineTo(X(along * cosine + up * sine), Y(up * cosine - along * sine));
    }
    ctx.stroke();
  };
}
