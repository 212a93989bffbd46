// What the explorer of chapter 4 says.

export const NAME = {
  id: "Kecepatan kapal: pencocokan, kutub, dan filter",
  en: "The ship's speed: fit, poles and filter",
};

export const RECORDING = {
  one_column: {
    id: "Diperlukan dua kolom bilangan, waktu dan kecepatan; hanya satu yang ditemukan.",
    en: "Two columns of numbers are needed, time and speed; only one was found.",
  },
  no_time: {
    id: "Tidak ada kolom waktu yang dikenali: pilihlah kolom waktu.",
    en: "No column of times was found: choose the time column.",
  },
  taken: {
    id: "Waktu dari kolom {time}, kecepatan dari kolom {value} dalam {unit}.",
    en: "Time from column {time}, speed from column {value} in {unit}.",
  },
  assumed: {
    id: "Satuan {name} tidak tertulis, jadi dianggap m/s.",
    en: "The unit of {name} is not written, so m/s was assumed.",
  },
  same: {
    id: "Waktu dan kecepatan harus dua kolom yang berbeda.",
    en: "Time and speed must be two different columns.",
  },
  too_fast: {
    id: "Baris {line}: kecepatan {z} m/s terlalu besar, batasnya {most} m/s.",
    en: "Line {line}: a speed of {z} m/s is too large, the limit is {most} m/s.",
  },
  gaps: {
    id: "Kecepatan kosong: {gaps}; di sana filter hanya memprediksi.",
    en: "Missing speeds: {gaps}; there the filter only predicts.",
  },
  no_fit: {
    id:
      "c, a1, dan a2 memerlukan sedikitnya lima kecepatan berurutan " +
      "yang tidak terletak pada satu garis lurus atau satu eksponensial.",
    en: "c, a1 and a2 need at least five speeds in a row " + "that do not lie on a line or one exponential.",
  },
};

export const OUTCOME = {
  result: {
    id: "Kuadrat terkecil: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Kutub: {poles}.",
    en: "Least squares: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Poles: {poles}.",
  },
  still: { id: "Tanpa derau kutubnya {still}.", en: "Without noise the poles would be {still}." },
  unstable: {
    id: "Ada kutub di luar lingkaran: model ini tidak stabil.",
    en: "A pole lies outside the circle: this model is unstable.",
  },
  rmse: {
    id: "RMSE: pengukuran {z} m/s, estimasi {x} m/s.",
    en: "RMSE: measurements {z} m/s, estimate {x} m/s.",
  },
  nis: {
    id: "Rata-rata NIS = {nis} (seharusnya sekitar 1).",
    en: "Mean NIS = {nis} (it should be about 1).",
  },
};

export const FACTS = {
  fit: { id: "hasil pencocokan", en: "fit" },
  average: { id: "rata-rata pada derau ini", en: "on average at this noise" },
  still: { id: "tanpa derau", en: "without noise" },
  poles: { id: "kutub λ", en: "poles λ" },
};

export const CONTROLS = {
  noise: { id: "Derau baru", en: "New noise" },
  smooth: { id: "penghalus (maju, lalu mundur)", en: "smoother (forwards, then backwards)" },
  first: { id: "mulai dari pengukuran pertama", en: "start at the first measurement" },
  text: {
    id: "Data sendiri (tetap di perangkat ini): tempelkan waktu dan kecepatan, misalnya dari lembar kerja",
    en: "Data of your own (it stays on this device): paste times and speeds, say from a spreadsheet",
  },
  placeholder: { id: "0,0\t0,12\n0,1\t0,15", en: "0.0\t0.12\n0.1\t0.15" },
  value: { id: "Kolom kecepatan", en: "Speed column" },
  from_header: { id: "dari judul kolom", en: "from the header" },
  time_unit: { id: "Satuan waktu", en: "Unit of time" },
  speed_unit: { id: "Satuan kecepatan", en: "Unit of speed" },
  km_h: { id: "km/jam", en: "km/h" },
  knots: { id: "knot", en: "knots" },
  back: { id: "Kembali ke uji penarikan sintetis", en: "Back to the synthetic towing run" },
};

export const SPEED = {
  title: { id: "Kecepatan (m/s)", en: "Speed (m/s)" },
  alt: {
    id:
      "Grafik kecepatan kapal terhadap waktu: titik pengukuran, garis sebenarnya bila diketahui, " +
      "dan estimasi dengan pitanya.",
    en:
      "Plot of the ship's speed against time: measured dots, the true line where it is known, " +
      "and the estimate with its band.",
  },
};

export const POLES = {
  title: { id: "Kutub λ", en: "Poles λ" },
  alt: {
    id: "Kutub model di bidang kompleks dengan lingkaran satuan.",
    en: "The model's poles in the complex plane with the unit circle.",
  },
};

export const BIAS = {
  title: { id: "Kutub terhadap derau: Re λ", en: "Poles over the noise: Re λ" },
  alt: {
    id:
      "Grafik bagian real kedua kutub terhadap derau: rata-rata menurut rumus " +
      "dan hasil pencocokan pada data ini.",
    en:
      "Plot of the real parts of both poles against the noise: their mean by the formula " +
      "and fits to this data.",
  },
};

export const LABELS = {
  fitted: { id: "hasil pencocokan", en: "fitted" },
  still: { id: "tanpa derau", en: "without noise" },
  with_noise: { id: "dengan derau", en: "with noise" },
  now: { id: "derau sekarang", en: "noise now" },
  given: { id: "diketahui", en: "known" },
  forecast: { id: "ramalan", en: "forecast" },
  formula: { id: "rumus", en: "formula" },
  fits: { id: "hasil pencocokan", en: "fits" },
};

// --- poles by hand, and poles that noise moves -------------------------------------------------------------

export const BY_HAND = {
  name: {
    id: "Menggeser kutub: dua kecepatan diteruskan",
    en: "Dragging poles: two speeds are continued",
  },
  line_preset: { id: "Terus lurus", en: "Straight on" },
  mean_preset: { id: "Rata-rata keduanya", en: "Mean of both" },
  poles: { id: "Kutub: {poles}.", en: "Poles: {poles}." },
  swing_in: {
    id: "Jaraknya dari pusat {size}: ramalan berayun, satu putaran dalam {turn} langkah, dan meluruh.",
    en: "They lie {size} from the centre: the forecast swings, one turn in {turn} steps, and decays.",
  },
  swing: {
    id: "Keduanya pada lingkaran: ramalan berayun terus, satu putaran dalam {turn} langkah.",
    en: "They lie on the circle: the forecast swings for ever, one turn in {turn} steps.",
  },
  swing_out: {
    id: "Jaraknya dari pusat {size}: ramalan berayun makin besar, satu putaran dalam {turn} langkah.",
    en: "They lie {size} from the centre: the forecast swings ever wider, one turn in {turn} steps.",
  },
  line: {
    id: "Keduanya di 1: ramalan meneruskan garis lurus.",
    en: "Both lie at 1: the forecast continues the straight line.",
  },
  stay: {
    id: "Satu kutub di 1: ramalan menuju nilai yang tetap.",
    en: "One pole lies at 1: the forecast settles at a constant value.",
  },
  flip: {
    id: "Satu kutub di −1: ramalan bolak-balik terus.",
    en: "One pole lies at −1: the forecast flips to and fro for ever.",
  },
  decay: {
    id: "Kutub terjauh berjarak {size} dari pusat: ramalan meluruh ke nol.",
    en: "The farthest pole lies {size} from the centre: the forecast decays to zero.",
  },
  grow: {
    id: "Ada kutub di luar lingkaran: ramalan membesar tanpa batas.",
    en: "A pole lies outside the circle: the forecast grows without limit.",
  },
  zigzag: {
    id: "Bagian dari kutub negatif berganti tanda setiap langkah.",
    en: "The part of the negative pole changes its sign at every step.",
  },
};

export const HAND_POLES = {
  title: { id: "Kutub λ", en: "Poles λ" },
  alt: {
    id: "Bidang kompleks dengan lingkaran satuan dan kedua kutub model.",
    en: "The complex plane with the unit circle and both poles of the model.",
  },
};

export const CONTINUED = {
  title: { id: "Kecepatan (m/s)", en: "Speed (m/s)" },
  alt: {
    id: "Grafik ramalan: dua kecepatan diketahui, lalu nilai yang diteruskan model.",
    en: "Plot of the forecast: two known speeds, then the values that the model continues with.",
  },
};

export const MOVED = {
  name: { id: "Derau memindahkan kutub", en: "Noise moves the poles" },
  result: {
    id: "Derau {sigma} m/s. Kuadrat terkecil: a₁ = {a1}, a₂ = {a2}, kutub {poles}.",
    en: "Noise {sigma} m/s. Least squares: a₁ = {a1}, a₂ = {a2}, poles {poles}.",
  },
};

export const FROM_TWO = {
  title: { id: "Ramalan (m/s)", en: "Forecast (m/s)" },
  alt: {
    id:
      "Grafik kecepatan saat kapal dipercepat: titik pengukuran sampai detik 8, " +
      "lalu ramalan dua model dan nilai sebenarnya.",
    en:
      "Plot of the speed while the ship accelerates: measured dots up to t = 8 s, " +
      "then the forecasts of two models and the true value.",
  },
};
