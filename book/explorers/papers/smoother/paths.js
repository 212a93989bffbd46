// Ready-made paths for the race: corners (step, height), straight between them.

const PATH_STEPS = 120;

export const PATHS = {
  mixed: [
    [1, 2],
    [25, 2],
    [55, 7.5],
    [80, 7.5],
    [81, 4],
    [120, 4],
  ],
  step: [
    [1, 3],
    [45, 3],
    [46, 7],
    [120, 7],
  ],
  ramp: [
    [1, 2],
    [25, 2],
    [95, 8],
    [120, 8],
  ],
  zigzag: [
    [1, 2],
    [30, 8],
    [60, 2],
    [90, 8],
    [120, 2],
  ],
};

/** The height at each of the steps 1 to 120: (T). */
export function path_of(name) {
  const corners = PATHS[name];
  return new Float64Array(PATH_STEPS).map((_, i) => {
    const next = Math.max(
      corners.findIndex(([k]) => k >= i + 1),
      1,
    );
    const [[k_0, x_0], [k_1, x_1]] = [corners[next - 1], corners[next]];
    return x_0 + ((x_1 - x_0) * (i + 1 - k_0)) / (k_1 - k_0);
  });
}
