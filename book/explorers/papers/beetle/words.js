// What the explorer of chapter 5 says.

export const NAME = { id: "Kumbang yang menjauhi wastafel", en: "The beetle that walks away from the sink" };

export const OUTCOME = {
  left: {
    id:
      "Sesudah {t} s, menurut filter, dari simpangan baku awalnya tersisa {theta}% untuk θ dan {v}% " +
      "untuk v; " +
      "untuk s = v cos θ tersisa {s}%.",
    en:
      "After {t} s, the filter claims that {theta}% of the initial standard deviation remains for θ " +
      "and {v}% for v; for s = v cos θ {s}% remains.",
  },
  blind: {
    id: "Jarak hanya memperlihatkan s: bagaimana s terbagi menjadi θ dan v, itu dari tebakan awal.",
    en: "The distance shows only s: how s divides into θ and v comes from the initial guess.",
  },
  seen: {
    id: "Sudut pandang memperlihatkan juga gerak menyamping, jadi θ dan v ikut teramati.",
    en: "The bearing shows the sideways motion as well, so θ and v are observable, too.",
  },
  rmse: {
    id: "RMSE jarak hasil filter {rmse} cm, simpangan baku sensornya {sensor} cm.",
    en: "The RMSE of the filtered distance is {rmse} cm, the sensor's standard deviation {sensor} cm.",
  },
  high: {
    id:
      "NIS rata-rata {nis}, di atas pita 95%: filter terlalu yakin " +
      "(R-nya terlalu kecil, atau tebakan awalnya lebih buruk daripada yang dikiranya).",
    en:
      "Mean NIS {nis}, above the 95% band: the filter is too confident " +
      "(its R is too small, or its initial guess worse than it thinks).",
  },
  low: {
    id: "NIS rata-rata {nis}, di bawah pita 95%: filter terlalu hati-hati (R-nya terlalu besar).",
    en: "Mean NIS {nis}, below the 95% band: the filter is too cautious (its R is too large).",
  },
  fits: {
    id: "NIS rata-rata {nis}, di dalam pita 95%: inovasinya sesuai dengan R itu.",
    en: "Mean NIS {nis}, inside the 95% band: the innovations fit that R.",
  },
  origin: {
    id: "Jalannya kumbang sintetis (benih acak {seed}).",
    en: "The walk is synthetic (random seed {seed}).",
  },
};

export const FACTS = {
  after: { id: "Sesudah {t} s", en: "After {t} s" },
  truth: { id: "sebenarnya", en: "true" },
  filter: { id: "menurut filter", en: "filter's" },
};

export const CONTROLS = {
  play: { id: "Jalankan", en: "Play" },
  moment: { id: "saat yang ditampilkan", en: "moment that is shown" },
  printed_R: { id: "R dari sumber (cm²)", en: "R of the source (cm²)" },
  bearing: {
    id: "sensor kedua: sudut pandang dari tepi wastafel",
    en: "a second sensor: the bearing from the edge of the sink",
  },
};

export const LABELS = {
  edge: { id: "tepi wastafel", en: "edge of the sink" },
  beetle: { id: "kumbang", en: "beetle" },
};

export const SCENE = {
  title: { id: "Dari atas: jarak d dari tepi (cm)", en: "From above: distance d from the edge (cm)" },
  alt: {
    id:
      "Kumbang dari atas: jalannya dari tepi wastafel, jarak menurut filter sebagai pita, " +
      "dan arah menurut filter sebagai kipas.",
    en:
      "The beetle from above: its way from the edge of the sink, the filter's distance as a band " +
      "and its direction as a fan.",
  },
};

export const SHARES = {
  title: { id: "Simpangan baku dibagi nilai awalnya", en: "Standard deviations divided by their start" },
  alt: {
    id: "Grafik simpangan baku arah, laju, dan s terhadap waktu, dibagi nilai awalnya.",
    en: "Plot of the standard deviations of direction, speed and s against time, divided by their start.",
  },
};

export const ERRORS = {
  title: { id: "Galat jarak (cm)", en: "Error of the distance (cm)" },
  alt: {
    id: "Grafik galat jarak terhadap waktu: galat pengukuran, galat estimasi, dan pita menurut filter.",
    en:
      "Plot of the error of the distance against time: of the measurement, of the estimate, " +
      "and the filter's band.",
  },
};

export const DIRECTION = {
  title: { id: "Arah θ (rad)", en: "Direction θ (rad)" },
  alt: {
    id: "Grafik arah terhadap waktu: yang sebenarnya, estimasi, dan pitanya.",
    en: "Plot of the direction against time: the true one, the estimate, and its band.",
  },
};

export const SPEED = {
  title: { id: "Laju v (cm/s)", en: "Speed v (cm/s)" },
  alt: {
    id: "Grafik laju terhadap waktu: yang sebenarnya, estimasi, dan pitanya.",
    en: "Plot of the speed against time: the true one, the estimate, and its band.",
  },
};

export const BANANA = {
  name: { id: "Satu rekaman jarak, banyak kumbang", en: "One record of distances, many beetles" },
  above: {
    title: { id: "Dari atas: geser kumbangnya (cm)", en: "From above: drag the beetle (cm)" },
    alt: {
      id:
        "Kumbang dari atas, sesudah berjalan 20 detik; rekaman jaraknya sebagai titik-titik di kiri, " +
        "dan arah menurut filter sebagai kipas.",
      en:
        "The beetle from above after a walk of 20 seconds; its record of distances as dots on the left, " +
        "and the filter's direction as a fan.",
    },
  },
  plane: {
    title: { id: "Laju v (cm/s) terhadap arah θ", en: "Speed v (cm/s) against direction θ" },
    alt: {
      id:
        "Bidang arah dan laju: pita melengkung yang cocok dengan rekaman, elips filter, " +
        "dan kumbang sebenarnya.",
      en:
        "Plane of direction and speed: the bent band that fits the record, the filter's ellipse, " +
        "and the true beetle.",
    },
  },
  record: { id: "rekaman z", en: "record z" },
  fits: { id: "cocok dengan rekaman", en: "fits the record" },
  filter: { id: "filter ± 2σ", en: "filter ± 2σ" },
  bearing: {
    id: "sensor kedua: sudut pandang dari tepi wastafel",
    en: "a second sensor: the bearing from the edge of the sink",
  },
  truth: {
    id: "Kumbang ini berjalan {v} cm/s ke arah θ = {theta} rad.",
    en: "This beetle walks at {v} cm/s in the direction θ = {theta} rad.",
  },
  alone: {
    id:
      "Rekaman jaraknya tidak berubah, jadi jawaban filter juga tidak: " +
      "θ = {theta0} ± {a} rad, v = {v0} ± {b} cm/s.",
    en:
      "The record of its distances does not change, nor does the filter's answer: " +
      "θ = {theta0} ± {a} rad, v = {v0} ± {b} cm/s.",
  },
  with_both: {
    id: "Sudut pandang ikut diukur; jawaban filter: θ = {theta0} ± {a} rad, v = {v0} ± {b} cm/s.",
    en: "The bearing is measured, too; the filter's answer: θ = {theta0} ± {a} rad, v = {v0} ± {b} cm/s.",
  },
  inside: { id: "Kumbangnya ada di dalam elips itu.", en: "The beetle lies inside that ellipse." },
  outside: { id: "Kumbangnya ada di luar elips itu.", en: "The beetle lies outside that ellipse." },
};
