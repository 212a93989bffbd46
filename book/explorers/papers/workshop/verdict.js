// What the judgement of a filter means, in words.
import { FACTORS, NOISES, VERDICT } from "./words.js";

const LEAST = 8; // innovations
const TELLING = 1.5; // a noise so many times too small or too large is named
const HUGE = 1000;
const SHUT = 0.15; // the share of measurements that are no outliers any more if the gate leaves them out

/** The sentences about the filter of r: does it fit, and if not, why? */
export function verdict(r, s, t) {
  const { judged, found } = r;
  if (s.likely && !found) {
    return [t.say(VERDICT.searching_noise)];
  }
  if (r.lefts > SHUT * (r.lefts + judged.dof)) {
    return [t.say(VERDICT.shut)];
  }
  if (judged.dof < LEAST) {
    return [t.say(VERDICT.few)];
  }
  const values = { nis: judged.nis };
  if (judged.fits && r.unlikely) {
    return [t.say(VERDICT.unlikely, values), ...causes(r, s, t)];
  }
  if (judged.fits) {
    return [t.say(s.likely ? VERDICT.likely_fits : VERDICT.fits, values), aboutOutliers(r, s, t)];
  }
  return [t.say(whatIsWrong(judged), values), ...causes(r, s, t), found ? "" : t.say(VERDICT.searching)];
}

function whatIsWrong({ nis, bounds }) {
  if (nis > bounds[1]) {
    return VERDICT.larger;
  }
  return nis < bounds[0] ? VERDICT.smaller : VERDICT.not_white;
}

function causes(r, s, t) {
  const { judged, found, p } = r;
  const outliers = aboutOutliers(r, s, t);
  if (outliers) {
    return [outliers];
  }
  const isHopeless = found && !judged.fits && !found.judged.fits;
  if (isHopeless && found.judged.white.some(({ correlation }) => correlation[0] > 0)) {
    return [t.say(VERDICT.pattern)]; // late at its best: a noise would be blamed in the place of the pattern
  }
  const named = Object.entries(found?.values ?? {})
    .map(([name, likely]) => aboutNoise(name, likely / p[name], found.none.includes(name), t))
    .filter(Boolean);
  return isHopeless && named.length === 0 ? [t.say(VERDICT.pattern)] : named;
}

/** Some innovations are no part of the others, and no gate is there: a filter may pass even so. */
function aboutOutliers({ judged }, { gate }, t) {
  return judged.far > 0 && !gate ? t.say(VERDICT.outliers, { count: String(judged.far) }) : "";
}

/** "R is about three times too small", or nothing. */
function aboutNoise(name, factor, isNone, t) {
  const words = { noise: t.say(NOISES[name]), factor: factorWords(Math.max(factor, 1 / factor), t) };
  if (factor > TELLING) {
    return t.say(VERDICT.too_small, words);
  }
  if (factor < 1 / TELLING) {
    return t.say(isNone ? VERDICT.needless : VERDICT.too_large, words);
  }
  return "";
}

function factorWords(factor, t) {
  if (factor > HUGE) {
    return t.say(FACTORS.huge);
  }
  const words = FACTORS[factor < 1.75 ? 1.5 : Math.round(factor)];
  return t.say(words ?? FACTORS.other, { factor: t.decimal(factor, factor < 100 ? 2 : 1) });
}
