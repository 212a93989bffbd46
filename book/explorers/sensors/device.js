// The sensors of the device that shows this page. What their numbers mean stands in units.js.
import { InputError } from "../language/input.js";
import { headingOf, readingOf, signOf, upOf } from "./units.js";
import { REFUSED } from "./words.js";

const SILENCE = 4000; // ms without a reading: there is no sensor
const MAG_RATE = 10; // a second: so many are allowed (W3C, Magnetometer)
const PATIENCE = 10; // readings that may pass until the device's angles tell the sign of its force
const ANGLES = ["deviceorientation", "deviceorientationabsolute"];

/**
 * Hand every reading to hear({t ms, gyr, acc, heading, mag}), or null when the page is hidden and no more
 * will come. allowed: a promise of the browser's answers about its events (own/phone.js asks in the reader's
 * tap). Returns what ends it; InputError: there is no sensor, or no permission.
 */
export async function listen(hear, allowed) {
  if (!window.isSecureContext) {
    throw new InputError(REFUSED.insecure);
  }
  if (!("DeviceMotionEvent" in window)) {
    throw new InputError(REFUSED.none);
  }
  const [motion] = await allowed;
  if (motion.value !== "granted") {
    throw new InputError(REFUSED.denied);
  }
  const end = new AbortController();
  await firstReading(hear, end);
  keepAwake(end.signal);
  document.addEventListener("visibilitychange", () => document.hidden && hear(null), { signal: end.signal });
  return () => end.abort();
}

/** Begin to listen; done when the first reading is there, InputError if none comes. */
function firstReading(hear, end) {
  const { signal } = end;
  return new Promise((done, fail) => {
    const give_up = () => {
      end.abort();
      fail(new InputError(REFUSED.none));
    };
    const timer = setTimeout(give_up, SILENCE);
    const angles = followAngles(signal);
    const field = followField(signal);
    let sign = null;
    let waited = 0;
    const take = (event) => {
      const reading = readingOf(event);
      if (!reading || (!angles.up && waited++ < PATIENCE)) {
        return;
      }
      sign ??= signOf(reading.acc, angles.up, navigator.vendor ?? "");
      clearTimeout(timer);
      done();
      const acc = reading.acc.map((value) => sign * value);
      hear({ ...reading, acc, heading: angles.heading, mag: field.mag });
    };
    addEventListener("devicemotion", take, { signal });
  });
}

/** The latest angles of the device: {up, heading}. */
function followAngles(signal) {
  const angles = { up: null, heading: NaN };
  const take = (event) => {
    angles.up = upOf(event) ?? angles.up;
    const heading = headingOf(event);
    if (!Number.isNaN(heading)) {
      angles.heading = heading;
    }
  };
  for (const name of ANGLES) {
    addEventListener(name, take, { signal });
  }
  return angles;
}

/** The latest field of the magnetometer, where the browser has one for pages: {mag}, NaN without. */
function followField(signal) {
  const field = { mag: [NaN, NaN, NaN] };
  try {
    const sensor = new window.Magnetometer({ frequency: MAG_RATE });
    sensor.onreading = () => {
      field.mag = [sensor.x, sensor.y, sensor.z];
    };
    sensor.start();
    signal.addEventListener("abort", () => sensor.stop());
  } catch {
    // most browsers have none
  }
  return field;
}

/** A screen that goes dark ends the readings: keep it on, where the browser can. */
async function keepAwake(signal) {
  try {
    const lock = await navigator.wakeLock.request("screen");
    signal.addEventListener("abort", () => lock.release());
    if (signal.aborted) {
      lock.release();
    }
  } catch {
    // then the reader must touch it now and then
  }
}
