// What the explorer of chapter 7 says.

export const NAME = { id: "Bengkel filter", en: "The filter workshop" };

export const PATTERNS = {
  1: { id: "tetap", en: "constant" },
  2: { id: "jalan acak: nilainya berubah sedikit demi sedikit", en: "random walk: its value drifts" },
  3: { id: "kecepatan hampir tetap", en: "nearly constant velocity" },
  4: { id: "percepatan hampir tetap", en: "nearly constant acceleration" },
  5: { id: "F dan H sendiri", en: "F and H of my own" },
};

export const SECONDS = {
  1: { id: "tidak ada", en: "none" },
  2: { id: "sensor lain untuk besaran yang sama", en: "another sensor of the same quantity" },
  3: { id: "sensor kecepatannya", en: "a sensor of its velocity" },
  4: { id: "sensor percepatannya", en: "a sensor of its acceleration" },
  5: { id: "masukan yang diketahui (u)", en: "a known input (u)" },
};

export const NOTES = {
  made_up: { id: "Datanya sintetis.", en: "The data is synthetic." },
};

export const CONTROLS = {
  pattern: { id: "Bagaimana besaran itu berubah?", en: "How does the quantity move?" },
  second: { id: "Kolom kedua", en: "Second column" },
};

export const LABELS = { x: "x" };

export const OUTCOME = {
  nis: { id: "NIS rata-rata {nis} (seharusnya 1).", en: "The mean NIS is {nis} (it should be 1)." },
};

export const PLOTS = {
  estimate: {
    title: { id: "Estimasi dan pitanya", en: "The estimate and its band" },
    alt: {
      id: "Grafik titik pengukuran dan garis estimasi dengan pita dua simpangan baku.",
      en: "Plot of the measured dots and the line of the estimate with a band of two standard deviations.",
    },
  },
};
