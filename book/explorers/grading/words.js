// What is said about a number that is none.

export const WORDS = {
  empty: { id: "Isilah sebuah bilangan.", en: "Type a number." },
  none: {
    id: "Tulislah sebuah bilangan seperti 0,25, bukan “{text}”.",
    en: "Write a number such as 0.25, not “{text}”.",
  },
  groups: {
    id: "Tulislah “{text}” tanpa pemisah ribuan, misalnya 12345,6.",
    en: "Write “{text}” without thousands separators, such as 12345.6.",
  },
  either: {
    id: "“{text}” dapat dibaca sebagai dua bilangan. Yang mana?",
    en: "“{text}” can be read as two numbers. Which one?",
  },
};
