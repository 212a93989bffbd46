// The page that chooses a language: the reader's last choice, else the browser's languages (Indonesian or
// Malay: id; all others: en). index.html#choose shows the two links instead.
"use strict";

(() => {
  if (location.hash === "#choose") {
    return;
  }
  let language = null;
  try {
    language = localStorage.getItem("book-language");
  } catch {
    // storage is switched off
  }
  if (language !== "id" && language !== "en") {
    const [first] = navigator.languages ?? [navigator.language];
    language = /^(id|in|ms)\b/i.test(first) ? "id" : "en";
  }
  location.replace(document.querySelector(`link[hreflang="${language}"]`).href);
})();
