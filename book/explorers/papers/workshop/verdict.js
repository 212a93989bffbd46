// What the judgement of a filter means, in words.
import { FACTORS, NOISES, VERDICT } from "./words.js";

const LEAST = 8; // innovations
const TELLING = 1.5; // a noise so many times too small or too large is named
const HUGE = 1000;
const SHUT = 0.15; // the share of measurements that are no outliers any more if the gate leaves them out

/** The sentences about the filter of r: does it fit, and if not, why? */
export function verdict(r, s, t) {
  const { judged, found } = r;
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
    return [t.say(s.likely ? VERDICT.likely_fits : VERDICT.fits, values)];
  }
  return [t.say(whatIsWrong(judged), values), ...causes(r, s, t), found ? "" : t.say(VERDICT.searching)];
}

function whatIsWrong({ nis, bounds }) {
  if (nis > bounds[1]) {
    return VERDICT.larger;
  }
  return nis < bounds[0] ? VERDICT.smaller : VERDICT.not_white;
}

function causes({ judged, found, p }, s, t) {
  if (judged.far > 0 && !s.gate) {
    return [t.say(VERDICT.outliers, { count: String(judged.far) })];
  }
  const said = [];
  for (const [name, likely] of Object.entries(found?.values ?? {})) {
    said.push(aboutNoise(name, likely / p[name], found.none.includes(name), t));
  }
  if (found && !found.judged.fits && said.filter(Boolean).length === 0) {
    said.push(t.say(s.likely ? VERDICT.pattern_at_best : VERDICT.pattern));
  }
  return said.filter(Boolean);
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
