// What noise does to the fit: the real parts of both poles over the noise, by the formula and by fits to one
// run.
import { generator } from "../../numerics/random.js";
import { expected_fit, fit, poles, towing_run } from "./model.js";
import { LABELS } from "./words.js";

export const LEAST = 5e-4; // m/s, the noise on the axis
const MOST = 0.5;
const FORMULA_POINTS = 61;
const FIT_POINTS = 19;

/** The noise under the pointer, with the digits that a reader would give. */
export function noiseAt(sigma) {
  return Number(Math.min(Math.max(sigma, LEAST), MOST).toPrecision(3));
}

/** Evenly spaced on the log axis. */
function noises(count) {
  return Array.from({ length: count }, (_, i) => LEAST * (MOST / LEAST) ** (i / (count - 1)));
}

function realParts([, a1, a2]) {
  return poles(a1, a2).map(([real]) => real);
}

/** Both poles over the noise: on average, by the formula (once), and of fits to this run (for each seed). */
export function bias(s, memo) {
  memo.still_run ??= towing_run(generator(0), 0).x;
  const x = memo.still_run;
  memo.formula ??= overNoise(FORMULA_POINTS, (sigma) => expected_fit(x, sigma));
  if (memo.fits_of !== s.seed) {
    const noise = towing_run(generator(s.seed), 1).z.map((value, k) => value - x[k]);
    memo.fits = overNoise(FIT_POINTS, (sigma) => fit(x.map((value, k) => value + sigma * noise[k])));
    memo.fits_of = s.seed;
  }
  return { x, formula: memo.formula, fits: memo.fits };
}

/** {sigma, high, low}: the noise, and the larger and the smaller pole of what was fitted at it. */
function overNoise(count, fitAt) {
  const sigma = noises(count);
  const pairs = sigma.map((value) => realParts(fitAt(value)));
  return { sigma, high: pairs.map(([high]) => high), low: pairs.map(([, low]) => low) };
}

export function drawBias({ curve, poles: [first, second] }, s) {
  const at = Math.max(s.sigma, LEAST);
  const { formula, fits } = curve;
  return {
    xlim: [LEAST, MOST],
    ylim: [-0.75, 1.15],
    layers: [
      { look: "quiet", at, label: LABELS.now },
      { look: "prediction", x: formula.sigma, y: formula.high, label: LABELS.formula },
      { look: "prediction", x: formula.sigma, y: formula.low },
      { look: "measurement", x: fits.sigma, y: fits.high, label: LABELS.fits },
      { look: "measurement", x: fits.sigma, y: fits.low },
      { look: "estimate", mark: [at, first[0]] },
      { look: "estimate", mark: [at, second[0]] },
    ],
  };
}
