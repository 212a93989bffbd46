// What the explorer of chapter 7 says. The words of its verdict stand here, too.

export const NAME = { id: "Bengkel filter", en: "The filter workshop" };

export const GROUPS = {
  data: { id: "1 Data", en: "1 Data" },
  motion: { id: "2 Gerak", en: "2 Motion" },
  noise: { id: "3 Derau", en: "3 Noise" },
  check: { id: "4 Periksa", en: "4 Check" },
  take: { id: "5 Simpan", en: "5 Save" },
};

export const PATTERNS = {
  1: { id: "tetap", en: "it stays constant" },
  2: { id: "jalan acak: berubah sedikit demi sedikit", en: "random walk: it drifts" },
  3: { id: "kecepatan hampir tetap", en: "nearly constant velocity" },
  4: { id: "percepatan hampir tetap", en: "nearly constant acceleration" },
  5: { id: "F dan H buatan sendiri", en: "F and H of my own" },
};

export const SECONDS = {
  1: { id: "tidak dipakai", en: "not used" },
  2: { id: "sensor kedua untuk besaran yang sama", en: "another sensor of the same quantity" },
  3: { id: "sensor kecepatannya", en: "a sensor of its velocity" },
  4: { id: "sensor percepatannya", en: "a sensor of its acceleration" },
  5: { id: "masukan yang diketahui, u", en: "a known input, u" },
};

export const NOTES = {
  made_up: {
    id: "Datanya sintetis: kecepatannya hampir tetap, q = 0,01 dan R = 9.",
    en: "The data is synthetic: its velocity is nearly constant, q = 0.01 and R = 9.",
  },
  made_up_so: {
    id: "Datanya sintetis, dibuat menurut pola itu.",
    en: "The data is synthetic, made by that pattern.",
  },
  taken: {
    id: "Yang disaring: {value}; waktunya: {time}{unit}.",
    en: "Filtered is {value}; its times are {time}{unit}.",
  },
  taken_two: {
    id: "Yang disaring: {value} dan {other}; waktunya: {time}{unit}.",
    en: "Filtered are {value} and {other}; their times are {time}{unit}.",
  },
  taken_three: {
    id: "Yang disaring: {value} dan {other}; masukannya: {input}; waktunya: {time}{unit}.",
    en: "Filtered are {value} and {other}; the input is {input}; their times are {time}{unit}.",
  },
  held: {
    id: "Masukan yang kosong (banyaknya baris: {gaps}) dianggap tidak berubah.",
    en: "Where the input is missing (number of rows: {gaps}), it is taken not to have changed.",
  },
  recorded: {
    id: "Data dari sensor perangkat ini: percepatan (acc) dalam m/s², laju putar (gyr) dalam °/s.",
    en: "Data of this device's sensors: acceleration (acc) in m/s², rate of turn (gyr) in °/s.",
  },
};

export const CONTROLS = {
  text: {
    id: "Data sendiri: tempelkan tabel dari lembar kerja. Data tidak meninggalkan perangkat ini.",
    en: "Data of my own: paste a table from a spreadsheet. Nothing leaves this device.",
  },
  placeholder: { id: "waktu\tsuhu\n0\t25,1\n60\t25,3", en: "time\ttemperature\n0\t25.1\n60\t25.3" },
  value: { id: "Kolom besaran yang diukur", en: "Column of the measured quantity" },
  axis: { id: "Kolom besaran yang diukur", en: "Column of the measured quantity" },
  first_axis: { id: "percepatan sepanjang sumbu x", en: "acceleration along the x axis" },
  value2: { id: "Kolom kedua", en: "The second column" },
  next_column: { id: "kolom berikutnya", en: "the next column" },
  factor: { id: "kolom kedua dikalikan dengan", en: "the second column is multiplied by" },
  value3: { id: "Kolom ketiga", en: "The third column" },
  factor3: { id: "kolom ketiga dikalikan dengan", en: "the third column is multiplied by" },
  third: { id: "Kolom ketiga dari data", en: "The third column of the data" },
  back: { id: "Kembali ke data sintetis", en: "Back to synthetic data" },
  new_noise: { id: "Derau baru", en: "New noise" },
  pattern: { id: "Bagaimana besaran itu berubah?", en: "How does the quantity change?" },
  F: { id: "F, satu baris per baris (keadaan berikutnya = F x)", en: "F, a row a line (next state = F x)" },
  H: { id: "H, satu baris per sensor (z = H x)", en: "H, a row for each sensor (z = H x)" },
  first_x: {
    id: "x₀, satu bilangan per keadaan (kosong: otomatis)",
    en: "x₀, a number for each state (empty: automatic)",
  },
  first_P: {
    id: "P₀, satu varians per keadaan, atau matriks (kosong: otomatis)",
    en: "P₀, a variance for each state, or a matrix (empty: automatic)",
  },
  second: { id: "Kolom kedua dari data", en: "The second column of the data" },
  bias: { id: "Bias kolom kedua", en: "Bias of the second column" },
  without_bias: { id: "tidak ada", en: "none" },
  with_bias: { id: "dicari sebagai keadaan tambahan", en: "found, as a further state" },
  likely: { id: "Besarnya derau", en: "How much noise" },
  by_hand: { id: "atur sendiri", en: "by hand" },
  most_likely: { id: "yang paling mungkin menurut data", en: "the most likely by the data" },
  keep: { id: "Ambil nilainya, lalu atur sendiri", en: "Take these values and go on by hand" },
  gate: { id: "gerbang: tolak pencilan (99,9%)", en: "gate: leave outliers out (99.9%)" },
  average: { id: "bandingkan dengan rataan bergerak", en: "compare with a moving average" },
  window: { id: "banyaknya data dalam rataan bergerak", en: "values in the moving average" },
  dirty: { id: "bubuhi data dengan pencilan", en: "put outliers into the data" },
  hole: { id: "hilangkan 20 pengukuran", en: "take 20 measurements away" },
};

export const TAKE = {
  copy: { id: "Salin kode untuk pustaka buku ini", en: "Copy the code for the book's library" },
  kalman_lib: { id: "Unduh kode itu", en: "Download that code" },
  filterpy: { id: "Unduh kode untuk filterpy", en: "Download the code for filterpy" },
  csv: { id: "Unduh data untuk kode (CSV)", en: "Download the data for the code (CSV)" },
  excel: { id: "Unduh Excel dengan rumus hidup", en: "Download Excel with live formulas" },
};

/** The first lines of a program. */
export const CODE = {
  kalman_lib: {
    id: "Filter dari bengkel buku ini, untuk kalman_lib.\nDatanya di {file}, dari halaman yang sama.",
    en: "A filter from the book's workshop, for kalman_lib.\nIts data is {file}, from the same page.",
  },
  filterpy: {
    id: "Filter dari bengkel buku ini, untuk filterpy.\nDatanya di {file}, dari halaman yang sama.",
    en: "A filter from the book's workshop, for filterpy.\nIts data is {file}, from the same page.",
  },
};

export const NOISES = {
  q: "q",
  R: "R",
  R2: "R_2",
};

export const FACTORS = {
  1.5: { id: "kira-kira satu setengah", en: "about one and a half" },
  2: { id: "kira-kira dua", en: "about two" },
  3: { id: "kira-kira tiga", en: "about three" },
  4: { id: "kira-kira empat", en: "about four" },
  5: { id: "kira-kira lima", en: "about five" },
  6: { id: "kira-kira enam", en: "about six" },
  7: { id: "kira-kira tujuh", en: "about seven" },
  8: { id: "kira-kira delapan", en: "about eight" },
  9: { id: "kira-kira sembilan", en: "about nine" },
  10: { id: "kira-kira sepuluh", en: "about ten" },
  other: { id: "kira-kira {factor}", en: "about {factor}" },
  huge: { id: "lebih dari seribu", en: "more than a thousand" },
};

export const VERDICT = {
  few: {
    id: "Pengukurannya terlalu sedikit untuk menilai filter ini.",
    en: "There are too few measurements to judge this filter.",
  },
  fits: {
    id: "Filter ini lulus: inovasinya sebesar yang dinyatakannya (NIS {nis}), dan putih.",
    en: "The filter passes: its innovations are as large as it states (NIS {nis}), and white.",
  },
  likely_fits: {
    id:
      "Dengan derau yang paling mungkin filter ini lulus: inovasinya putih. NIS-nya ({nis}) bukan bukti, " +
      "sebab derau itu dicocokkan dengan data ini juga.",
    en:
      "With the most likely noise the filter passes: its innovations are white. Its NIS ({nis}) is no " +
      "proof, as that noise was fitted to this very data.",
  },
  shut: {
    id: "Gerbang menolak terlalu banyak untuk disebut pencilan: bukalah dahulu, perbaiki pola dan deraunya.",
    en: "The gate leaves too much out to be outliers: open it first, and mend the pattern and the noise.",
  },
  unlikely: {
    id: "Kedua pemeriksaan lulus (NIS {nis}), tetapi menurut data ini ada derau yang jauh lebih mungkin.",
    en: "Both tests pass (NIS {nis}), but by this data another noise is far more likely.",
  },
  larger: {
    id: "Filter ini terlalu yakin: inovasinya lebih besar daripada yang dinyatakannya (NIS {nis}).",
    en: "The filter is too sure: its innovations are larger than it states (NIS {nis}).",
  },
  smaller: {
    id: "Filter ini terlalu ragu: inovasinya lebih kecil daripada yang dinyatakannya (NIS {nis}).",
    en: "The filter is too cautious: its innovations are smaller than it states (NIS {nis}).",
  },
  not_white: {
    id: "Inovasinya belum putih: yang satu masih meramalkan yang berikutnya (NIS {nis}).",
    en: "Its innovations are not white: one still foretells the next (NIS {nis}).",
  },
  searching_noise: {
    id: "Derau yang paling mungkin sedang dicari.",
    en: "The most likely noise is being looked for.",
  },
  searching: { id: "Sebabnya sedang dicari.", en: "The cause is being looked for." },
  too_small: {
    id: "{noise} {factor} kali terlalu kecil.",
    en: "{noise} is {factor} times too small.",
  },
  too_large: {
    id: "{noise} {factor} kali terlalu besar.",
    en: "{noise} is {factor} times too large.",
  },
  needless: {
    id: "{noise} terlalu besar: data ini boleh dijelaskan tanpanya.",
    en: "{noise} is too large: this data can do without it.",
  },
  outliers: {
    id: "{count} inovasi jauh lebih besar daripada yang lain: cobalah gerbang di bawah “4 Periksa”.",
    en: "{count} innovations are far larger than the others: try the gate below “4 Check”.",
  },
  pattern: {
    id: "Derau yang paling mungkin pun tidak menolong, jadi cobalah pola gerak yang lain.",
    en: "Even the most likely noise does not help, so try another pattern of motion.",
  },
};

export const OUTCOME = {
  left: {
    id: "Gerbang menolak {count} dari {all} pengukuran (×).",
    en: "The gate left out {count} of {all} measurements (×).",
  },
  cut: {
    id: "Derau itu dicari dari {rows} baris pertama.",
    en: "That noise was found from the first {rows} rows.",
  },
};

export const FACTS = {
  test: { id: "Pemeriksaan", en: "Test" },
  here: { id: "Di sini", en: "Here" },
  wanted: { id: "Seharusnya", en: "Wanted" },
  nis: { id: "NIS rata-rata", en: "Mean NIS" },
  between: { id: "{low} sampai {high} (99%)", en: "{low} to {high} (99%)" },
  inside: { id: "Inovasi di dalam pitanya", en: "Innovations inside their band" },
  percent: { id: "{share}%", en: "{share}%" },
  white: { id: "p inovasi putih", en: "p of white innovations" },
  white_of: { id: "p inovasi putih, sensor {i}", en: "p of white innovations, sensor {i}" },
  above: { id: "di atas 0,01", en: "above 0.01" },
  tiny: { id: "di bawah 0,001", en: "below 0.001" },
  likely: { id: "{likely} (paling mungkin)", en: "{likely} (most likely)" },
  rmse: { id: "RMSE terhadap nilai sebenarnya", en: "RMSE against the truth" },
  bias: { id: "Bias di akhir, ± 2σ", en: "The bias at the end, ± 2σ" },
  average: { id: "rataan bergerak: {far}", en: "moving average: {far}" },
  sensor: { id: "sensor saja: {far}", en: "sensor alone: {far}" },
};

export const LABELS = {
  average: { id: "rataan bergerak", en: "moving average" },
  left: { id: "ditolak", en: "left out" },
  inside: "95%",
};

export const PLOTS = {
  estimate: {
    title: { id: "Estimasi dan pitanya", en: "The estimate and its band" },
    alt: {
      id: "Grafik titik pengukuran dan garis estimasi dengan pita dua simpangan baku.",
      en: "Plot of the measured dots and the line of the estimate with a band of two standard deviations.",
    },
  },
  innovations: {
    title: { id: "Inovasi dalam simpangan bakunya", en: "Innovations in standard deviations" },
    alt: {
      id: "Grafik inovasi yang dibagi simpangan bakunya, dengan pita untuk 95 persen di antaranya.",
      en: "Plot of the innovations divided by their standard deviation, with a band for 95 percent of them.",
    },
  },
  correlation: {
    title: { id: "Autokorelasi inovasi", en: "Autocorrelation of the innovations" },
    alt: {
      id: "Grafik korelasi antara inovasi yang berjarak satu sampai sepuluh langkah, dengan pitanya.",
      en: "Plot of the correlation of innovations one to ten steps apart, with its band.",
    },
  },
  rate: {
    title: { id: "Keadaan kedua (kecepatan)", en: "The second state (velocity)" },
    alt: {
      id: "Grafik estimasi keadaan kedua dengan pita dua simpangan baku.",
      en: "Plot of the estimate of the second state with a band of two standard deviations.",
    },
  },
};
