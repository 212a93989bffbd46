// What the controls for data of the reader's own say, in every chapter.

export const OWN = {
  text: {
    id:
      "Data sendiri: tempelkan kolom dari lembar kerja, atau sebuah daftar. " +
      "Data tidak meninggalkan perangkat ini.",
    en: "Data of my own: paste columns from a spreadsheet, or a list. Nothing leaves this device.",
  },
  file: { id: "atau pilih berkas CSV atau Excel (.xlsx)", en: "or choose a CSV or Excel (.xlsx) file" },
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
