// What a phone's motion sensors say, in one unit, one sign and one set of axes. Pure: events come in, numbers
// go out. The facts, each with where it stands:
//   axes       x to the right edge of the screen, y to its top, z out of it; they stay with the device when
//              the picture turns. W3C, Device Orientation and Motion, 3.1
//              (https://www.w3.org/TR/orientation-event/)
//   rates      rotationRate in degrees a second, right-handed: alpha about x, beta about y, gamma about z
//              (ibid., 4.3.2). Drafts until 2017 had alpha about z; no browser did it so, and the text was
//              changed (https://github.com/w3c/deviceorientation/issues/44).
//   force      accelerationIncludingGravity in m/s2; lying face up it shows +9.8 on z (ibid., 1, 4.3.1).
//   Apple      WebKit hands on CoreMotion's sum of acceleration and gravity, so lying face up it shows -9.8
//              on z (WebKit, Source/WebCore/platform/ios/WebCoreMotionManager.mm, sendMotionData)
//   precision  0.1 degrees a second and 0.1 m/s2 (W3C, 4.3.3, against fingerprinting)
//   time       the event's timeStamp, in ms (DOM Standard, 2.2). Its interval is not used: milliseconds by
//              the specification, seconds in older WebKit (DeviceMotionClientIOS.mm hands on 1/60).
//   compass    deviceorientationabsolute: alpha, beta, gamma turn about z, then x, then y, from a frame of
//              east, north, up (W3C, 3.1.1). WebKit has webkitCompassHeading, degrees clockwise from
//              magnetic north (Apple, Safari DOM Additions, DeviceOrientationEvent).
const DEG = Math.PI / 180; // rad
const AGREES = 0.5; // a cosine: so much of gravity must lie along the vertical to tell its sign

/** [x, y, z] of an acceleration or of a rotation rate; null where one of the three is missing. */
function three(values) {
  return values.every((value) => Number.isFinite(value)) ? values : null;
}

/** What a devicemotion event says: {t ms, gyr (3) degrees a second, acc (3) m/s2}; null: it knows nothing. */
export function readingOf({ timeStamp, rotationRate, accelerationIncludingGravity }) {
  const { alpha, beta, gamma } = rotationRate ?? {};
  const { x, y, z } = accelerationIncludingGravity ?? {};
  const gyr = three([alpha, beta, gamma]);
  const acc = three([x, y, z]);
  return gyr && acc ? { t: timeStamp, gyr, acc } : null;
}

/** Up in the device's axes, as the angles of a deviceorientation event have it; null without angles. */
export function upOf({ beta, gamma }) {
  if (!Number.isFinite(beta) || !Number.isFinite(gamma)) {
    return null;
  }
  const level = Math.cos(beta * DEG);
  return [-level * Math.sin(gamma * DEG), Math.sin(beta * DEG), level * Math.cos(gamma * DEG)];
}

/**
 * +1 where the force is that of the specification, -1 where it is turned round. The device's own angles
 * decide, if it has any and it is not shaken; else the maker of the browser.
 */
export function signOf(acc, up, vendor) {
  const size = Math.hypot(...acc);
  const cosine = up ? (acc[0] * up[0] + acc[1] * up[1] + acc[2] * up[2]) / size : 0;
  if (Math.abs(cosine) >= AGREES) {
    return Math.sign(cosine);
  }
  return vendor.startsWith("Apple") ? -1 : 1;
}

/** Where the top edge points, degrees clockwise from magnetic north; NaN where the event does not know. */
export function headingOf({ alpha, beta, gamma, absolute, webkitCompassHeading }) {
  if (Number.isFinite(webkitCompassHeading)) {
    return webkitCompassHeading >= 0 ? webkitCompassHeading : NaN; // negative: it is not known
  }
  if (!absolute || ![alpha, beta, gamma].every(Number.isFinite)) {
    return NaN;
  }
  const ahead = Math.cos(beta * DEG); // the part of y that is level; gamma turns about y itself
  const east = -Math.sin(alpha * DEG) * ahead;
  const north = Math.cos(alpha * DEG) * ahead;
  return (Math.atan2(east, north) / DEG + 360) % 360;
}
