// What an exercise of a page says. Its question, hints and solution are in the page (book/_ext/exercises.py).

export const WORDS = {
  right: { id: "Benar.", en: "Right." },
  wrong: { id: "Belum.", en: "Not yet." },
  again: { id: "Belum (percobaan ke-{n}).", en: "Not yet (try {n})." },
  open: {
    id: "Penyelesaiannya kini dapat dibuka di bawah.",
    en: "The solution can be opened below now.",
  },
  choose: { id: "Pilihlah satu jawaban.", en: "Choose an answer." },
  write: { id: "Tulislah satu baris kode.", en: "Write a line of code." },
  answered: { id: "terjawab", en: "answered" },
  progress: { id: "Terjawab: {done} / {all}", en: "Answered: {done} / {all}" },
  solutions: { id: "Penyelesaian", en: "Solutions" },
  clear: { id: "Hapus kemajuan", en: "Clear progress" },
};
