// What the explorer of chapter 1 says.

export const NAME = { id: "Filter selangkah demi selangkah", en: "The filter, one step at a time" };

/** By the kind of a moment: start, prediction, update. */
export const TITLES = [
  { id: "Awal.", en: "Start." },
  {
    id: "Saat {moment} dari {of}, langkah {k}: prediksi.",
    en: "Moment {moment} of {of}, step {k}: prediction.",
  },
  {
    id: "Saat {moment} dari {of}, langkah {k}: pembaruan.",
    en: "Moment {moment} of {of}, step {k}: update.",
  },
];

/** By the kind of a moment, too. */
export const TEXTS = [
  {
    id:
      "Sebelum pengukuran pertama, mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s; " +
      "simpangan bakunya {sx} m dan {sv} m/s.",
    en:
      "Before the first measurement the car is believed to be at {x} m with a velocity of {v} m/s; " +
      "the standard deviations are {sx} m and {sv} m/s.",
  },
  {
    id:
      "{dt} s kemudian mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s. " +
      "Simpangan baku posisi berubah dari {before} m menjadi {sx} m.",
    en:
      "{dt} s later the car is expected at {x} m with a velocity of {v} m/s. " +
      "The standard deviation of the position goes from {before} m to {sx} m.",
  },
  {
    id:
      "K = {K}: {percent}% dari selisih {y} m antara pengukuran dan prediksi diterima. " +
      "Simpangan baku posisi berubah dari {before} m menjadi {sx} m. {origin}",
    en:
      "K = {K}: {percent}% of the difference of {y} m between measurement and prediction is accepted. " +
      "The standard deviation of the position goes from {before} m to {sx} m. {origin}",
  },
];

export const ORIGINS = {
  source: {
    id: "Pengukuran ini dari contoh soal.",
    en: "This measurement is the one in the worked example.",
  },
  synthetic: {
    id: "Pengukuran ini sintetis (benih acak {seed}).",
    en: "This measurement is synthetic (random seed {seed}).",
  },
  yours: { id: "Pengukuran ini pilihan Anda.", en: "This measurement is your choice." },
};

export const CONTROLS = {
  previous: { id: "Sebelumnya", en: "Previous" },
  next: { id: "Berikutnya", en: "Next" },
  moment: {
    id: "saat (0 awal, 1 prediksi, 2 pembaruan, ...)",
    en: "moment (0 start, 1 prediction, 2 update, ...)",
  },
  measured: { id: "posisi terukur", en: "measured position" },
  example: { id: "Contoh", en: "Example" },
  worked: { id: "contoh soal", en: "the worked example" },
  own: { id: "contoh sendiri", en: "an example of my own" },
};

export const PLANE = {
  title: { id: "Posisi dan kecepatan (m/s)", en: "Position and velocity (m/s)" },
  alt: {
    id:
      "Elips kovarians (dua simpangan baku) di bidang posisi dan kecepatan, " +
      "sebelum dan sesudah langkah ini.",
    en:
      "Covariance ellipses (two standard deviations) in the plane of position and velocity, " +
      "before and after this step.",
  },
};

export const GAIN = {
  title: { id: "Penguatan dan posisi, dengan angka", en: "Gain and position, in numbers" },
  alt: {
    id: "Persamaan langkah ini untuk posisi, diisi dengan angka.",
    en: "The equations of this step for the position, filled with numbers.",
  },
};

/** The view "bells". */
export const RULERS = {
  name: { id: "Seret kedua lonceng", en: "Drag the two bells" },
  title: { id: "Seret titik atau lingkaran", en: "Drag a dot or a ring" },
  alt: {
    id:
      "Tiga kurva lonceng di atas skala sentimeter: penggaris a, penggaris b, dan gabungannya x. " +
      "Di bawahnya sebuah jungkat-jungkit dari a ke b yang bertumpu di x; bebannya satu per varians.",
    en:
      "Three bell curves above a scale in centimetres: ruler a, ruler b, and x, both together. " +
      "Below them a see-saw from a to b that rests on x; its weights are one over the variance.",
  },
  first: { id: "penggaris pertama", en: "first ruler" },
  second: { id: "penggaris kedua", en: "second ruler" },
  width: { id: "simpangan bakunya", en: "its standard deviation" },
  outcome: {
    id:
      "Dari a = {a} cm kita bergeser {percent}% menuju b = {b} cm: K = {K}. " +
      "Hasilnya x = {x} cm, simpangan baku {sigma} cm.",
    en:
      "From a = {a} cm we go {percent}% of the way to b = {b} cm: K = {K}. " +
      "The result is x = {x} cm, with a standard deviation of {sigma} cm.",
  },
  rare: {
    id:
      "Awas: bacaannya berselisih {gap} cm, padahal biasanya sekitar {expected} cm. " +
      "Lonceng biru tidak tahu itu.",
    en:
      "Mind: the readings differ by {gap} cm where about {expected} cm is usual. " +
      "The blue bell does not know.",
  },
};
