// What every explorer says, whatever its paper.

export const WORDS = {
  reset: { id: "Ulang dari awal", en: "Start again" },
  noise: { id: "Derau baru", en: "New noise" },
  link: { id: "Salin tautan", en: "Copy link" },
  copied: { id: "Disalin.", en: "Copied." },
  refused: {
    id: "Peramban menolak menyalin. Tautannya ada di kolom alamat.",
    en: "The browser refused to copy. The link is in the address bar.",
  },
  typed: { id: "{name}: ketik nilainya", en: "{name}: type the value" },
  range: {
    id: "{name} = {value}: yang diterima {min} sampai {max}{unit}.",
    en: "{name} = {value}: accepted are {min} to {max}{unit}.",
  },
  hash: {
    id: "Bagian alamat “{text}” tidak dimengerti, jadi pengaturannya tidak dipakai.",
    en: "The part “{text}” of the address makes no sense, so its settings are not used.",
  },
  failed: {
    id: "Perhitungannya gagal ({text}); gambar sebelumnya tetap.",
    en: "The calculation failed ({text}); the figure before it stays.",
  },
  equations: { id: "Persamaan dengan angkanya", en: "Equations with their numbers" },
  numbers: { id: "Tampilkan angka-angkanya", en: "Show the numbers" },
  check: { id: "Hitung sendiri", en: "Work it out by hand" },
  answer: { id: "Jawaban", en: "Answer" },
  verify: { id: "Periksa", en: "Check" },
  other: { id: "Soal lain", en: "Another question" },
  right: { id: "Benar: {value}.", en: "Right: {value}." },
  wrong: { id: "Belum. {hint}", en: "Not yet. {hint}" },
  reveal: { id: "Tunjukkan jawabannya", en: "Show the answer" },
  revealed: { id: "Jawabannya {value}. {hint}", en: "The answer is {value}. {hint}" },
  settings: { id: "Setelan", en: "Settings" },
  noise_number: { id: "derau nomor", en: "noise number" },
  yes: { id: "ya", en: "yes" },
  no: { id: "tidak", en: "no" },
  controls: { id: "Kendali", en: "Controls" },
  drop: { id: "atau seret berkas ke sini", en: "or drop a file here" },
  unreadable: {
    id: "“{name}” tidak dapat dibaca peramban. Pilihlah sebuah berkas, bukan folder.",
    en: "The browser cannot read “{name}”. Choose a file, not a folder.",
  },
  too_large: {
    id: "“{name}” terlalu besar; batasnya {most} MB.",
    en: "“{name}” is too large; the limit is {most} MB.",
  },
  stop: { id: "Berhenti", en: "Stop" },
  fetching: { id: "Sebentar: bagian ini sedang diambil.", en: "One moment: this part is being fetched." },
  unfetched: {
    id: "Bagian ini belum dapat diambil: sambungkan jaringan, lalu coba lagi.",
    en: "This part could not be fetched: connect to the network and try again.",
  },
};
