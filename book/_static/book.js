// The little that every page of the book needs: the language switcher, and texts that extensions wrote in
// English only.
"use strict";

(() => {
  const HEADER = 120; // pixels: a section that starts above is read

  /** The id of the last section that starts above the upper edge of the window (below the header). */
  function sectionInView() {
    let id = "";
    for (const section of document.querySelectorAll("article section[id]")) {
      if (section.getBoundingClientRect().top > HEADER) {
        break;
      }
      id = section.id;
    }
    return window.scrollY < 50 ? "" : id;
  }

  /** sphinx-copybutton knows no Indonesian; it reads its texts from `messages` when the page is ready. */
  function translateCopyButton() {
    Object.assign(messages.en, {
      copy: "Salin",
      copy_to_clipboard: "Salin ke papan klip",
      copy_success: "Tersalin!",
      copy_failure: "Gagal menyalin",
    });
    iconCopy = iconCopy.replace("Copy to clipboard", messages.en.copy_to_clipboard);
    iconCheck = iconCheck.replace("Copied!", messages.en.copy_success);
  }

  /** The other language opens at the same section with the same settings, and is remembered. */
  function prepareSwitcher(link) {
    link.addEventListener("click", () => {
      const id = sectionInView();
      link.hash = location.hash.includes(":") ? location.hash : id;
      try {
        localStorage.setItem("book-language", link.hreflang);
      } catch {
        // storage is switched off
      }
    });
  }

  /** A box that scrolls must be reachable with the keyboard. */
  function makeBoxesFocusable() {
    for (const box of document.querySelectorAll(".katex-display, div.output, pre")) {
      if (box.scrollWidth > box.clientWidth + 1) {
        box.tabIndex = 0;
      }
    }
  }

  /** A search result shows a formula once, and a term apart from its meaning. */
  function mendSearch() {
    const textOf = Search.htmlToText;
    Search.htmlToText = (page, anchor) => {
      const parsed = new DOMParser().parseFromString(page, "text/html");
      parsed.querySelectorAll(".katex-mathml").forEach((element) => element.remove());
      parsed.querySelectorAll("dt, td, th, p, h2").forEach((element) => element.append(" "));
      return textOf(parsed.documentElement.outerHTML, anchor);
    };
  }

  /** The contents of the page lie over the text on a phone: close them when a section was chosen. */
  function closeContentsAfterChoice() {
    document.getElementById("pst-secondary-sidebar-modal")?.addEventListener("click", (event) => {
      if (event.target.closest('a[href^="#"]')) {
        event.currentTarget.close();
      }
    });
  }

  /** Keep the book for reading without a network, unless the reader asks to save data. */
  function keepForOffline() {
    const canKeep = "serviceWorker" in navigator && location.protocol.startsWith("http");
    if (!canKeep || navigator.connection?.saveData) {
      return;
    }
    const root = document.documentElement.dataset.content_root || "./";
    navigator.serviceWorker.register(new URL(root + "offline-worker.js", location)).catch(() => {
      // refused: read online
    });
  }

  // Search summaries are fetched from the pages, which a browser refuses for file://.
  if (location.protocol === "file:") {
    DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;
  }
  if (document.documentElement.lang === "id" && typeof messages !== "undefined") {
    translateCopyButton();
  }

  document.addEventListener("DOMContentLoaded", () => {
    document.querySelectorAll("a.language-switcher").forEach(prepareSwitcher);
    for (const button of document.querySelectorAll("button.toggle-button")) {
      button.setAttribute("aria-label", toggleHintShow);
    }
    makeBoxesFocusable();
    window.addEventListener("load", makeBoxesFocusable); // the fonts are here now
    window.addEventListener("resize", makeBoxesFocusable);
    closeContentsAfterChoice();
    if (typeof Search !== "undefined") {
      mendSearch();
    }
  });

  window.addEventListener("load", keepForOffline); // when the page is complete
})();
