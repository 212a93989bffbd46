// What the three explorers of chapter 3 say.

export const NAMES = {
  flight: { id: "Simulasi giroskop", en: "The gyroscope simulation" },
  mismatch: { id: "Harga σ yang salah", en: "What a wrong σ costs" },
  drift: { id: "Giroskop yang diam di meja", en: "A gyroscope that lies on a table" },
};

export const OUTCOME = {
  run: {
    id:
      "Pada percobaan ini RMSE sensor {sensor} rad dan RMSE filter {rmse} rad. " +
      "Galat terbesarnya {z} rad (pengukuran) dan {x} rad (estimasi).",
    en:
      "In this experiment the RMSE of the sensor is {sensor} rad and that of the filter {rmse} rad. " +
      "The largest errors are {z} rad (measurement) and {x} rad (estimate).",
  },
  honest: {
    id: "Dalam {runs} percobaan RMSE filter {all} rad, seperti yang dinyatakan P.",
    en: "Over {runs} experiments the RMSE of the filter is {all} rad, as P states.",
  },
  sure: {
    id:
      "Dalam {runs} percobaan RMSE-nya {all} rad (yang terbaik {best} rad), " +
      "rata-rata NEES {nees} dan NIS {nis}: filter terlalu yakin, P-nya terlalu kecil.",
    en:
      "Over {runs} experiments the RMSE is {all} rad (at best {best} rad), " +
      "mean NEES {nees} and NIS {nis}: the filter is too confident, its P is too small.",
  },
  doubtful: {
    id:
      "Dalam {runs} percobaan RMSE-nya {all} rad (yang terbaik {best} rad), " +
      "rata-rata NEES {nees} dan NIS {nis}: filter terlalu hati-hati, P-nya terlalu besar.",
    en:
      "Over {runs} experiments the RMSE is {all} rad (at best {best} rad), " +
      "mean NEES {nees} and NIS {nis}: the filter is too cautious, its P is too large.",
  },
  between: {
    id:
      "Dalam {runs} percobaan RMSE-nya {all} rad (yang terbaik {best} rad), " +
      "rata-rata NEES {nees} dan NIS {nis}: P kira-kira tepat, walaupun sigma menurut filter salah.",
    en:
      "Over {runs} experiments the RMSE is {all} rad (at best {best} rad), " +
      "mean NEES {nees} and NIS {nis}: P is about right although the believed sigmas are wrong.",
  },
  seed: { id: "Data sintetis (benih acak {seed}).", en: "Synthetic data (random seed {seed})." },
};

export const FACTS = {
  first: { id: "langkah pertama", en: "first step" },
  last: { id: "langkah terakhir", en: "last step" },
  steady: { id: "keadaan tunak", en: "steady state" },
  stated: { id: "√P, galat menurut filter (rad)", en: "√P, the error as the filter states it (rad)" },
  error: { id: "galat dalam {runs} percobaan (rad)", en: "error in {runs} experiments (rad)" },
  optimum: { id: "galat terbaik (rad)", en: "best error (rad)" },
};

export const CONTROLS = {
  mems: { id: "Giroskop di cip", en: "Gyroscope on a chip" },
  other: { id: "filter mengira sigma yang lain", en: "the filter believes another sigma" },
  believed: { id: "menurut filter", en: "as the filter believes" },
  w_tenth: { id: "σ_w sepersepuluh", en: "σ_w a tenth" },
  w_ten: { id: "σ_w 10 kali", en: "σ_w 10 times" },
  v_tenth: { id: "σ_v sepersepuluh", en: "σ_v a tenth" },
  v_ten: { id: "σ_v 10 kali", en: "σ_v 10 times" },
  truth: { id: "yang benar", en: "the truth" },
  times_w: {
    id: "σ_w menurut filter dibagi yang benar",
    en: "σ_w as the filter believes it, over the true one",
  },
  times_v: {
    id: "σ_v menurut filter dibagi yang benar",
    en: "σ_v as the filter believes it, over the true one",
  },
};

export const ANGLE = {
  title: { id: "Sudut (rad)", en: "Angle (rad)" },
  alt: {
    id:
      "Grafik sudut terhadap waktu: titik pengukuran, garis sebenarnya, " + "dan garis estimasi dengan pita.",
    en:
      "Plot of the angle against time: measured dots, the true line, " +
      "and the estimated line with its band.",
  },
};

export const ERROR = {
  title: { id: "Galat (rad)", en: "Error (rad)" },
  alt: {
    id:
      "Grafik galat terhadap waktu: galat pengukuran, galat estimasi, pita menurut filter, " +
      "dan pita dari banyak percobaan.",
    en:
      "Plot of the errors against time: of the measurement, of the estimate, " +
      "the band that the filter states, " +
      "and the band of many experiments.",
  },
};

export const GAIN = {
  title: { id: "Penguatan K", en: "Gain K" },
  alt: {
    id: "Grafik penguatan terhadap waktu dan nilainya pada keadaan tunak.",
    en: "Plot of the gain against time and its steady value.",
  },
};

export const CONSISTENCY = {
  title: { id: "Konsistensi", en: "Consistency" },
  alt: {
    id: "Grafik rata-rata NEES dan NIS dari semua percobaan terhadap waktu, dengan pita 95% khi-kuadrat.",
    en: "Plot of the mean NEES and NIS of all experiments against time, with the 95% chi-square band.",
  },
};

export const LABELS = {
  steady: { id: "tunak", en: "steady" },
  chi_square: { id: "selang 95% khi-kuadrat", en: "95% chi-square interval" },
  alone: { id: "giroskop saja", en: "gyroscope alone" },
  others: { id: "11 giroskop lain", en: "11 other gyroscopes" },
  truth: { id: "yang benar", en: "the truth" },
  belief: { id: "menurut filter", en: "as the filter believes" },
};

// --- a gyroscope at rest -----------------------------------------------------------------------------------

export const DRIFT = {
  title: { id: "Sudut (°)", en: "Angle (°)" },
  alt: {
    id:
      "Grafik sudut selama satu menit dengan kipas ±2σ. Tanpa sensor sudut kipasnya melebar; " +
      "dengan sensor sudut pitanya tetap sempit di sekitar nol.",
    en:
      "Plot of the angle over one minute with its fan of ±2σ. Without the angle sensor it widens; " +
      "with it, the band stays narrow around zero.",
  },
  sensor: { id: "nyalakan sensor sudut", en: "switch the angle sensor on" },
  noise_w: { id: "simpangan baku derau giroskop", en: "standard deviation of the gyroscope's noise" },
  noise_v: { id: "simpangan baku sensor sudut", en: "standard deviation of the angle sensor" },
  alone: {
    id:
      "Giroskop saja: setelah 60 s sudutnya {x}°, padahal sebenarnya 0°. " +
      "Kipasnya sudah mencapai ±{fan}° dan terus melebar.",
    en:
      "The gyroscope alone: after 60 s it says {x}°, but the true angle is 0°. " +
      "The fan has reached ±{fan}° and keeps widening.",
  },
  together: {
    id:
      "Bersama sensor sudut: setelah 60 s filter menunjukkan {x}° ± {band}°. " +
      "Giroskop saja ±{fan}°, sensor saja ±{sensor}°. Penguatannya K = {K}.",
    en:
      "With the angle sensor: after 60 s the filter says {x}° ± {band}°. " +
      "The gyroscope alone ±{fan}°, the sensor alone ±{sensor}°. The gain is K = {K}.",
  },
};

// --- the reader's own phone --------------------------------------------------------------------------------

export const PHONE = {
  turn: { id: "Cara memutarnya", en: "How it is turned" },
  roll: { id: "rebah ke kanan (sensor sudut: kemiringan)", en: "onto its right side (angle sensor: tilt)" },
  pitch: { id: "tepi atas naik (sensor sudut: kemiringan)", en: "top edge up (angle sensor: tilt)" },
  yaw: { id: "berputar di meja (sensor sudut: kompas)", en: "round on the table (angle sensor: compass)" },
  centred: {
    id: "kurangi bacaan dengan rata-ratanya selama 5 s pertama",
    en: "subtract the mean reading of the first 5 s",
  },
  rest: {
    id:
      "Ponsel ini, selama {rest} s pertama: rata-rata bacaan giroskop {mean} °/s, " +
      "simpangan bakunya {sigma} °/s.",
    en:
      "This phone, in its first {rest} s: mean reading of the gyroscope {mean} °/s, " +
      "standard deviation {sigma} °/s.",
  },
  moved: {
    id: "Ponsel bergerak selama {rest} s pertama (simpangan baku {sigma} °/s): letakkan, lalu mulai lagi.",
    en:
      "The phone moved in its first {rest} s (standard deviation {sigma} °/s): " +
      "lay it down and start again.",
  },
  alone: {
    id: "Setelah {time} s giroskop saja menunjukkan {alone}°; kipasnya ±{fan}°.",
    en: "After {time} s the gyroscope alone says {alone}°; the fan is ±{fan}°.",
  },
  together: {
    id: "Bersama sensor sudut: {x}° ± {band}°.",
    en: "With the angle sensor: {x}° ± {band}°.",
  },
  ghosts: {
    title: { id: "Ponsel ini", en: "This phone" },
    alt: {
      id:
        "Ponsel pada bacaan terakhir menurut giroskop saja, sensor sudut, dan filter; " +
        "tipis: cara ia diletakkan.",
      en:
        "The phone at the last reading by the gyroscope alone, the angle sensor and the filter; " +
        "thin: how it was laid down.",
    },
  },
};

// --- the map of a wrong sigma ------------------------------------------------------------------------------

export const VERDICT = {
  map: {
    id:
      "Filter mengira σ_w = {w} rad/s dan σ_v = {v} rad, padahal yang benar {true_w} dan {true_v}. " +
      "RMSE-nya {rmse} rad, {cost} kali yang terbaik ({best} rad), dan NEES-nya {nees}: {word}.",
    en:
      "The filter believes σ_w = {w} rad/s and σ_v = {v} rad; the truth is {true_w} and {true_v}. " +
      "Its RMSE is {rmse} rad, {cost} times the best ({best} rad), and its NEES {nees}: {word}.",
  },
  runs: {
    id: "Dari {runs} percobaan sintetis (benih acak {seed}): RMSE {all} rad, NEES {mean}.",
    en: "From {runs} synthetic experiments (random seed {seed}): RMSE {all} rad, NEES {mean}.",
  },
  sure: { id: "terlalu yakin", en: "too confident" },
  doubtful: { id: "terlalu hati-hati", en: "too cautious" },
  honest: { id: "P-nya jujur", en: "its P is honest" },
};

export const COST_MAP = {
  title: {
    id: "RMSE / terbaik: σ_w mendatar, σ_v (rad) tegak",
    en: "RMSE / best: σ_w across, σ_v (rad) upwards",
  },
  alt: {
    id: "Peta RMSE relatif: lembah lurus sejajar diagonal, naik ke pojok kiri atas dan kanan bawah.",
    en:
      "Map of the relative RMSE: a straight valley along the diagonal, " +
      "rising to the top left and bottom right corners.",
  },
};

export const NEES_MAP = {
  title: { id: "NEES: σ_w mendatar, σ_v (rad) tegak", en: "NEES: σ_w across, σ_v (rad) upwards" },
  alt: {
    id: "Peta rata-rata NEES: besar di kiri dan di bawah, kecil di pojok kanan atas.",
    en: "Map of the mean NEES: large at the left and at the bottom, small in the top right corner.",
  },
};

export const COST_HEAD = { id: "RMSE / terbaik", en: "RMSE / best" };
