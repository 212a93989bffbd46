// The sensors of the device that shows this page. What their numbers mean stands in units.js.
import { InputError } from "../language/input.js";
import { headingOf, readingOf, signOf, upOf } from "./units.js";
import { REFUSED } from "./words.js";

const SILENCE = 2500; // ms without a reading: there is no sensor
const PATIENCE = 10; // readings that may pass until the device's angles tell the sign of its force
const ANGLES = ["deviceorientation", "deviceorientationabsolute"];

/**
 * Ask for the sensors (in the tap of the reader: iOS shows its question only then), and hand every reading to
 * hear({t ms, gyr, acc, heading}). Returns what ends it; InputError: there is no sensor, or no permission.
 */
export async function listen(hear) {
  if (!window.isSecureContext) {
    throw new InputError(REFUSED.insecure);
  }
  if (!("DeviceMotionEvent" in window)) {
    throw new InputError(REFUSED.none);
  }
  await askPermission();
  const end = new AbortController();
  await firstReading(hear, end);
  keepAwake(end.signal);
  return () => end.abort();
}

/** One question for both events; where there is no such function, nothing needs to be asked. */
async function askPermission() {
  const asked = ["DeviceMotionEvent", "DeviceOrientationEvent"].map((name) => {
    const event = window[name];
    return event?.requestPermission ? event.requestPermission() : "granted";
  });
  const [motion] = await Promise.allSettled(asked);
  if (motion.value !== "granted") {
    throw new InputError(REFUSED.denied);
  }
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
      hear({ ...reading, acc: reading.acc.map((value) => sign * value), heading: angles.heading });
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
