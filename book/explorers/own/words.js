// What the controls for data of the reader's own say, in every chapter: tables, and a phone's sensors.

export const OWN = {
  text: {
    id:
      "Data sendiri: tempelkan kolom dari lembar kerja, atau sebuah daftar. " +
      "Data tidak meninggalkan perangkat ini.",
    en: "Data of my own: paste columns from a spreadsheet, or a list. Nothing leaves this device.",
  },
  file: {
    id: "atau pilih berkas CSV, Excel (.xlsx), atau .zip dari aplikasi ponsel",
    en: "or choose a CSV or Excel (.xlsx) file, or the .zip of a phone app",
  },
  sheet: { id: "Lembar", en: "Sheet" },
  longest: { id: "yang tabelnya terpanjang", en: "the one with the longest table" },
  sign: { id: "Tanda desimal", en: "Decimal sign" },
  find_out: { id: "kenali sendiri", en: "find out" },
  comma: { id: "koma (1,5)", en: "comma (1,5)" },
  point: { id: "titik (1.5)", en: "point (1.5)" },
  missing: { id: "Bilangan yang berarti kosong", en: "Numbers that mean missing" },
  no_codes: { id: "tidak ada: semuanya data", en: "none: all are data" },
  other_codes: {
    id: "Bilangan lain yang berarti kosong, misalnya −999",
    en: "Other numbers that mean missing, such as −999",
  },
  take_codes: { id: "Kosongkan", en: "Leave them out" },
  time: { id: "Kolom waktu", en: "Time column" },
  no_time: { id: "tidak ada", en: "none" },
  value: { id: "Kolom", en: "Column" },
  found: { id: "dikenali: {name}", en: "found: {name}" },
  unclear_codes: {
    id: "“{text}” bukan daftar bilangan: tuliskan misalnya −999; 85.",
    en: "“{text}” is no list of numbers: type for example −999; 85.",
  },
};

export const SENSORS = {
  name: { id: "Sensor ponsel ini", en: "This phone's sensors" },
  start: { id: "Pakai sensor ponsel ini", en: "Use this phone's sensors" },
  stop: { id: "Berhenti", en: "Stop" },
  back: { id: "Tutup rekaman", en: "Close the recording" },
  keep: { id: "Simpan di ponsel ini", en: "Keep on this phone" },
  forget: { id: "Hapus simpanan", en: "Forget what is kept" },
  save: { id: "Unduh CSV", en: "Download CSV" },
  kept: { id: "Putar ulang simpanan", en: "Replay a kept recording" },
  none: { id: "pilih", en: "choose" },
  full: {
    id: "Peramban menolak menyimpan rekaman ini. Unduhlah sebagai CSV.",
    en: "The browser refused to keep this recording. Download it as CSV.",
  },
};

export const STATUS = {
  private: {
    id: "Bacaan sensor tetap di perangkat ini; tidak ada yang dikirim.",
    en: "The readings stay on this device; nothing is sent.",
  },
  synthetic: { id: "Gambar ini memakai data sintetis.", en: "The figure shows synthetic data." },
  asking: { id: "Menunggu bacaan pertama.", en: "Waiting for the first reading." },
  live: {
    id: "Langsung: {seconds} s, {rate} bacaan per detik, {compass}.",
    en: "Live: {seconds} s, {rate} readings a second, {compass}.",
  },
  recorded: {
    id: "Rekaman: {seconds} s, {rate} bacaan per detik, {compass}.",
    en: "Recorded: {seconds} s, {rate} readings a second, {compass}.",
  },
  example: {
    id: "Rekaman sintetis: {seconds} s, {rate} bacaan per detik, {compass}.",
    en: "A synthetic recording: {seconds} s, {rate} readings a second, {compass}.",
  },
  compass: { id: "dengan kompas", en: "with a compass" },
  no_compass: { id: "tanpa kompas", en: "without a compass" },
};
