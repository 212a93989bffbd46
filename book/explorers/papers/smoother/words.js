// What both explorers of chapter 2 say.

export const NAMES = {
  form: { id: "Formulir penghalus", en: "The smoother's form" },
  draw: { id: "Gambar sebuah jalur, lalu adu keduanya", en: "Draw a path and let them race" },
  online: { id: "Filter daring", en: "The online filter" },
};

export const SOURCES = {
  paper: { id: "16 nilai dari makalah", en: "the paper's 16 values" },
  silkworm_room: { id: "suhu ruang ulat sutra (sintetis)", en: "temperature of a silkworm room (synthetic)" },
  cutting_force: {
    id: "gaya potong pelepah sawit (sintetis)",
    en: "cutting force of oil-palm frond (synthetic)",
  },
  tank_level: { id: "tinggi air tangki ikan (sintetis)", en: "water level of a fish tank (synthetic)" },
  nile: { id: "debit Sungai Nil 1871–1970 (nyata)", en: "flow of the Nile 1871–1970 (real)" },
  own: { id: "data sendiri", en: "data of my own" },
};

export const MEASURED_NAME = { id: "Terukur", en: "Measured" };

export const NO_DATA_YET = {
  id: "belum ada data sendiri, jadi masih 16 nilai dari makalah.",
  en: "none of your own yet, so still the paper's 16 values.",
};

/** The lines of the first figure: their names in tables, and their labels in the figure. */
export const LINES = {
  x: { id: "Filter Kalman", en: "Kalman filter" },
  average: { id: "Rataan bergerak", en: "Moving average" },
  exponential: { id: "Penghalusan eksponensial", en: "Exponential smoothing" },
  smooth: { id: "Penghalus RTS", en: "RTS smoother" },
};

export const LABELS = {
  exponential: { id: "eksponensial", en: "exponential" },
  steady: { id: "tunak", en: "steady" },
};

export const OUTCOME = {
  shown: { id: "N = {n}. Data yang ditampilkan: {what}", en: "N = {n}. Data shown: {what}" },
  gain: {
    id: "Penguatan menetap pada K = {K}: derau diredam seperti oleh rataan bergerak {window} data.",
    en: "The gain settles at K = {K}: noise is suppressed as by a moving average of {window} values.",
  },
  rmse: {
    id: "RMSE-nya {x}, rataan bergerak {average}, pengukuran sendiri {z}.",
    en: "Its RMSE is {x}, that of the moving average {average}, of the measurements themselves {z}.",
  },
  rough: {
    id:
      "Simpangan baku perubahan dari nilai ke nilai: {z} pada data, {x} sesudah filter, " +
      "{average} pada rataan bergerak.",
    en:
      "Standard deviation of the change from value to value: {z} in the data, {x} after the filter, " +
      "{average} in the moving average.",
  },
  first: {
    id: "Filter mulai dari pengukuran pertama, x₀ = {x0}.",
    en: "The filter starts at the first measurement, x₀ = {x0}.",
  },
  cut: { id: "Q dan R dicari dari {n} nilai pertama.", en: "Q and R were found from the first {n} values." },
};

export const FACTS = {
  method: { id: "Cara", en: "Method" },
  rough: { id: "Kekasaran σ(Δx)", en: "Roughness σ(Δx)" },
  behind_truth: { id: "Terlambat dari nilai sebenarnya (langkah)", en: "Lag behind the truth (steps)" },
  behind_smooth: { id: "Terlambat dari RTS (langkah)", en: "Lag behind RTS (steps)" },
};

export const STRETCH = {
  unclear: {
    id: "“{text}” bukan ruas: tuliskan nomor pertama dan terakhirnya, misalnya 5-16.",
    en: "“{text}” is no stretch: type its first and its last number, such as 5-16.",
  },
  too_short: {
    id: "Ruas itu berisi kurang dari dua nilai.",
    en: "That stretch holds fewer than two values.",
  },
};

export const TEXT_HEAD = {
  measured: { id: "Terukur", en: "Measured" },
  filtered: { id: "Hasil filter", en: "Filtered" },
};

export const CONTROLS = {
  source: { id: "Data", en: "Which data" },
  placeholder: { id: "Suhu\n25,1\n25,3", en: "Temperature\n25.1\n25.3" },
  first: { id: "mulai dari pengukuran pertama", en: "start at the first measurement" },
  exponential: {
    id: "penghalusan eksponensial dengan penguatan tunak",
    en: "exponential smoothing with the steady gain",
  },
  rts: { id: "penghalus maju-mundur (RTS)", en: "forward-backward smoother (RTS)" },
  noise: { id: "Derau baru", en: "New noise" },
  stretch: { id: "Ruas tenang, misalnya nomor 5-16", en: "Quiet stretch, such as numbers 5-16" },
  take_R: { id: "R dari ruas ini", en: "R from this stretch" },
  likely: { id: "Q dan R paling mungkin", en: "Most likely Q and R" },
  copy: { id: "Salin hasilnya", en: "Copy the result" },
  csv: { id: "Unduh CSV", en: "Download CSV" },
  excel: { id: "Unduh Excel dengan rumus hidup", en: "Download Excel with live formulas" },
};

export const MEASUREMENTS = {
  title: { id: "Terukur dan dihaluskan", en: "Measured and smoothed" },
  alt: {
    id: "Grafik titik pengukuran, garis hasil filter, dan garis rataan bergerak.",
    en: "Plot of the measured dots, the filtered line and the moving average.",
  },
};

export const GAIN = {
  title: { id: "Penguatan K", en: "Gain K" },
  alt: {
    id: "Grafik penguatan terhadap nomor data dan nilainya pada keadaan tunak.",
    en: "Plot of the gain against the number of the value, and its steady value.",
  },
};

export const DEVIATION = {
  title: "√P",
  alt: {
    id: "Grafik simpangan baku menurut filter terhadap nomor data.",
    en: "Plot of the standard deviation as the filter states it against the number of the value.",
  },
};

// --- draw and race --------------------------------------------------------------------------------------

export const PATH_NAMES = {
  mixed: { id: "tanjakan dan lompatan", en: "a ramp and a jump" },
  step: { id: "satu lompatan", en: "one jump" },
  ramp: { id: "satu tanjakan", en: "one ramp" },
  zigzag: { id: "naik dan turun", en: "up and down" },
  own: { id: "gambar sendiri", en: "your own drawing" },
};

export const DRAW = {
  plot: {
    title: { id: "Gambarlah jalur di sini", en: "Draw a path here" },
    alt: {
      id: "Grafik jalur yang digambar, titik berderau, garis filter Kalman, garis rataan bergerak.",
      en: "Plot of the drawn path, noisy dots, the line of the Kalman filter and the moving average.",
    },
  },
  path_label: { id: "jalur", en: "path" },
  filter_label: { id: "filter Kalman", en: "Kalman filter" },
  trust: { id: "percaya prediksi ← → percaya sensor", en: "trust the prediction ← → trust the sensor" },
  average: { id: "rataan bergerak", en: "moving average" },
  window: { id: "banyaknya titik dalam rataan bergerak", en: "dots in the moving average" },
  shape: { id: "Jalur", en: "Path" },
  same: { id: "Samakan kehalusannya", en: "Make both equally smooth" },
};

/** On the first page of the book, before any letter is known. */
export const COVER = {
  name: { id: "Jalur yang kita gambar, dan filternya", en: "A path that we draw, and the filter" },
  trust: { id: "percaya prediksi ← → percaya sensor", en: "trust the prediction ← → trust the sensor" },
  dots: "sensor",
  outcome: {
    id: "Sensor biasanya meleset {dots}. Garis biru meleset {far} dan terlambat {late} langkah.",
    en: "The sensor is usually off by {dots}. The blue line is off by {far} and {late} steps late.",
  },
  flat: {
    id: "Sensor biasanya meleset {dots}. Garis biru meleset {far}.",
    en: "The sensor is usually off by {dots}. The blue line is off by {far}.",
  },
  alt: {
    id: "Grafik jalur yang digambar, titik-titik berderau di sekitarnya, dan garis filter Kalman.",
    en: "Plot of the drawn path, the noisy dots around it, and the line of the Kalman filter.",
  },
};

export const DRAWN = {
  filter: {
    id: "Filter Kalman (K = {percent}%): RMSE {far}, terlambat {late} langkah.",
    en: "Kalman filter (K = {percent}%): RMSE {far}, {late} steps late.",
  },
  filter_flat: {
    id: "Filter Kalman (K = {percent}%): RMSE {far}.",
    en: "Kalman filter (K = {percent}%): RMSE {far}.",
  },
  average: {
    id: "Rataan {n} titik: RMSE {far}, terlambat {late} langkah.",
    en: "Average of {n} dots: RMSE {far}, {late} steps late.",
  },
  average_flat: { id: "Rataan {n} titik: RMSE {far}.", en: "Average of {n} dots: RMSE {far}." },
};

// --- one measurement at a time -----------------------------------------------------------------------------

export const ARRIVED = {
  none: {
    id: "Belum ada pengukuran. Isilah satu bilangan atau jalankan aliran sintetis.",
    en: "No measurement yet. Enter a number or play the synthetic stream.",
  },
  one: {
    id:
      "Pengukuran ke-{k}, z = {z} ({origin}): dengan K = {K} estimasi berubah dari {pred} menjadi {x}; " +
      "simpangan bakunya √P = {root}.",
    en:
      "Measurement {k}, z = {z} ({origin}): with K = {K} the estimate goes from {pred} to {x}; " +
      "its standard deviation is √P = {root}.",
  },
  gap: {
    id: "Pengukuran ke-{k} tidak datang: estimasi tetap {x}, dan √P tumbuh menjadi {root}.",
    en: "Measurement {k} did not arrive: the estimate stays {x}, and √P grows to {root}.",
  },
  typed: { id: "diketik", en: "typed" },
  stream: { id: "aliran sintetis, benih acak {seed}", en: "synthetic stream, random seed {seed}" },
};

export const ONLINE_CONTROLS = {
  entry: { id: "Pengukuran baru", en: "New measurement" },
  add: { id: "Tambahkan", en: "Add" },
  missing: { id: "Tidak datang", en: "It does not arrive" },
  drop: { id: "Buang yang terakhir", en: "Drop the last one" },
  clear: { id: "Kosongkan", en: "Clear" },
  play: { id: "Jalankan aliran", en: "Play the stream" },
  arrived: {
    id: "data dari aliran sintetis (suhu ruang ulat sutra); yang diketik menyusul",
    en: "values from the synthetic stream (silkworm room); typed ones follow",
  },
};

export const ARRIVALS = {
  title: { id: "Pengukuran yang sudah datang", en: "What has arrived" },
  alt: {
    id: "Grafik titik pengukuran yang sudah datang dan garis estimasi dengan pita.",
    en: "Plot of the measurements that have arrived and the estimated line with its band.",
  },
};
