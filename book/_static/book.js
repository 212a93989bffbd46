// The little that every page of the book needs: the language switcher, and texts that extensions wrote in English only.
"use strict";

(() => {
  const language = document.documentElement.lang;

  // Search summaries are fetched from the pages, which a browser refuses for file://.
  if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;

  // sphinx-copybutton knows no Indonesian; it reads its texts from `messages` when the page is ready.
  if (language === "id" && typeof messages !== "undefined") {
    Object.assign(messages.en, {
      copy: "Salin", copy_to_clipboard: "Salin ke papan klip", copy_success: "Tersalin!", copy_failure: "Gagal menyalin",
    });
    iconCopy = iconCopy.replace("Copy to clipboard", messages.en.copy_to_clipboard);
    iconCheck = iconCheck.replace("Copied!", messages.en.copy_success);
  }

  // The id of the last section that starts above the upper edge of the window (below the header).
  function sectionInView() {
    const limit = 120;
    let id = "";
    for (const section of document.querySelectorAll("article section[id]")) {
      if (section.getBoundingClientRect().top > limit) break;
      id = section.id;
    }
    return window.scrollY < 50 ? "" : id;
  }

  document.addEventListener("DOMContentLoaded", () => {
    for (const link of document.querySelectorAll("a.language-switcher")) {
      link.addEventListener("click", () => {
        const id = sectionInView();
        link.hash = location.hash.includes(":") ? location.hash : id;     // the settings of an explorer go along
        try { localStorage.setItem("book-language", link.hreflang); } catch (error) { /* storage is switched off */ }
      });
    }

    for (const button of document.querySelectorAll("button.toggle-button")) {
      button.setAttribute("aria-label", toggleHintShow);
    }

    // A box that scrolls must be reachable with the keyboard.
    const focusable = () => {
      for (const box of document.querySelectorAll(".katex-display, div.output, pre")) {
        if (box.scrollWidth > box.clientWidth + 1) box.tabIndex = 0;
      }
    };
    focusable();
    window.addEventListener("load", focusable); // the fonts are here now
    window.addEventListener("resize", focusable);

    // The contents of the page lie over the text on a phone: close them when a section was chosen.
    document.getElementById("pst-secondary-sidebar-modal")?.addEventListener("click", event => {
      if (event.target.closest('a[href^="#"]')) event.currentTarget.close();
    });

    // A search result shows a formula once, and a term apart from its meaning.
    if (typeof Search !== "undefined") {
      const textOf = Search.htmlToText;
      Search.htmlToText = (page, anchor) => {
        const parsed = new DOMParser().parseFromString(page, "text/html");
        parsed.querySelectorAll(".katex-mathml").forEach(element => element.remove());
        parsed.querySelectorAll("dt, td, th, p, h2").forEach(element => element.append(" "));
        return textOf(parsed.documentElement.outerHTML, anchor);
      };
    }
  });

  // Keep the book for reading without a network (when the page is complete), unless the reader asks to save data.
  window.addEventListener("load", () => {
    if ("serviceWorker" in navigator && location.protocol.startsWith("http") && !navigator.connection?.saveData) {
      const root = document.documentElement.dataset.content_root || "./";
      navigator.serviceWorker.register(new URL(root + "offline-worker.js", location)).catch(() => { /* refused: read online */ });
    }
  });
})();
