// What chapter 7 says about data, matrices, or a start that cannot be used.

export const WRONG = {
  no_second: {
    id: "Tabel ini tidak punya kolom kedua: pilihlah “tidak dipakai” di bawah “2 Gerak”.",
    en: "This table has no second column: choose “not used” below “2 Motion”.",
  },
  no_third: {
    id: "Tabel ini tidak punya kolom ketiga: pilihlah “tidak dipakai” di bawah “2 Gerak”.",
    en: "This table has no third column: choose “not used” below “2 Motion”.",
  },
  empty_input: {
    id: "Kolom masukan yang diketahui kosong: pilihlah kolom lain.",
    en: "The column of the known input is empty: choose another one.",
  },
  short: {
    id: "Filter memerlukan sedikitnya sepuluh baris data.",
    en: "A filter needs at least ten rows of data.",
  },
};

export const MATRICES = {
  empty: { id: "{name} masih kosong.", en: "{name} is still empty." },
  no_number: { id: "“{cell}” di dalam {name} bukan bilangan.", en: "“{cell}” in {name} is not a number." },
  ragged: {
    id: "Baris ke-{row} dari {name} berisi {has} bilangan, sedangkan baris pertamanya {first}.",
    en: "Row {row} of {name} has {has} numbers, but its first row has {first}.",
  },
  square: {
    id: "F harus persegi: sekarang {n} baris dan {m} kolom.",
    en: "F must be square: it has {n} rows and {m} columns.",
  },
  large: {
    id: "F berisi {n} keadaan; di sini paling banyak {most}.",
    en: "F has {n} states; here {most} is the most.",
  },
  columns: {
    id: "H harus mempunyai {n} kolom seperti F: sekarang {m}.",
    en: "H must have {n} columns, like F: it has {m}.",
  },
  sensors: {
    id: "H berisi {m} baris; di sini paling banyak {most}, satu untuk setiap sensor.",
    en: "H has {m} rows; here {most} is the most, one for each sensor.",
  },
};

export const START = {
  count: {
    id: "{name} berisi {has} bilangan, tetapi keadaannya {n}: tuliskan satu untuk setiap keadaan.",
    en: "{name} has {has} numbers, but there are {n} states: type one for each.",
  },
  shape: {
    id: "{name} memerlukan {n} varians, satu untuk setiap keadaan, atau matriks {n} × {n}.",
    en: "{name} needs {n} variances, one for each state, or a matrix of {n} × {n}.",
  },
  large: {
    id: "Bilangan di dalam {name} terlalu besar: batasnya {most}.",
    en: "A number in {name} is too large: the limit is {most}.",
  },
  negative: {
    id: "Varians di dalam {name} tidak boleh negatif.",
    en: "No variance in {name} may be negative.",
  },
  symmetric: {
    id: "{name} harus simetris: kovarians ke-{i},{j} sama dengan yang ke-{j},{i}.",
    en: "{name} must be symmetric: its covariance {i},{j} is the same as {j},{i}.",
  },
  correlation: {
    id: "{name} bukan kovarians: korelasi di dalamnya lebih dari 1.",
    en: "{name} is no covariance: a correlation in it is larger than 1.",
  },
};
