// Straight lines between moments, as NumPy's interp draws them.

/** values (size n) at times (n) -> at t (T): (size T). Before the first and after the last they stay. */
export function interpolated(t, times, values, size) {
  const found = new Float64Array(size * t.length);
  let k = 0;
  for (let j = 0; j < t.length; j++) {
    while (k < times.length - 2 && times[k + 1] <= t[j]) {
      k++;
    }
    const share = Math.min(Math.max((t[j] - times[k]) / (times[k + 1] - times[k]), 0), 1);
    for (let i = 0; i < size; i++) {
      const before = values[size * k + i];
      found[size * j + i] =
        share === 1 ? values[size * (k + 1) + i] : before + share * (values[size * (k + 1) + i] - before);
    }
  }
  return found;
}
