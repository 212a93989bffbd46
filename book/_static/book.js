// The little that every page of the book needs: the language switcher, and texts that extensions wrote in
// English only.
"use strict";

(() => {
  const NARROW = "(max-width: 576px)";
  const SHORT_CODE = 6; // lines, which stay open on a phone
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

  /** The other language opens at the same section with the same settings. */
  function prepareSwitcher(link) {
    link.addEventListener("click", () => {
      const id = sectionInView();
      link.hash = location.hash.includes(":") ? location.hash : id;
    });
  }

  /** The first page opens the language that was read last. (Kept here, not at the tap on the switcher: what
      a page keeps while it is being left can be lost, seen once from file://.) */
  function rememberLanguage() {
    try {
      localStorage.setItem("book-language", document.documentElement.lang);
    } catch {
      // storage is switched off
    }
  }

  /** A box that scrolls must be reachable with the keyboard. */
  function makeBoxesFocusable() {
    for (const box of document.querySelectorAll(".katex-display, div.output, pre")) {
      if (box.scrollWidth > box.clientWidth + 1) {
        box.tabIndex = 0;
      }
    }
  }

  /** On a phone a long piece of code is one line to tap; without this script, and on paper, it is open. */
  function foldCode() {
    const narrow = matchMedia(NARROW);
    const long = [...document.querySelectorAll("div.cell > div.cell_input")].filter(isLong);
    const folds = long.map(foldOf);
    const follow = () => folds.forEach((fold) => (fold.open = !narrow.matches));
    follow();
    narrow.addEventListener("change", follow);
    window.addEventListener("beforeprint", () => folds.forEach((fold) => (fold.open = true)));
    window.addEventListener("afterprint", follow);
  }

  function isLong(input) {
    const lines = input.querySelector("pre").textContent.trim().split("\n").length; // without the copy button
    return lines > SHORT_CODE && !input.matches(".tag_exercise *, .tag_open-code *");
  }

  /** The code inside a <details> such as MyST-NB makes for code that every reader finds closed. */
  function foldOf(input) {
    const isIndonesian = document.documentElement.lang === "id";
    const names = isIndonesian ? ["Tampilkan kode", "Sembunyikan kode"] : ["Show the code", "Hide the code"];
    const fold = document.createElement("details");
    fold.className = "admonition hide above-input fold";
    const summary = document.createElement("summary");
    ["collapsed", "expanded"].forEach((name, i) => {
      const text = document.createElement("p");
      text.className = `${name} admonition-title`;
      text.textContent = names[i];
      summary.append(text);
    });
    input.replaceWith(fold);
    fold.append(summary, input);
    return fold;
  }

  /** The contents of the page lie over the text on a phone: close them when a section was chosen. */
  function closeContentsAfterChoice() {
    document.getElementById("pst-secondary-sidebar-modal")?.addEventListener("click", (event) => {
      if (event.target.closest('a[href^="#"]')) {
        event.currentTarget.close();
      }
    });
  }

  /** The lines for other people's pages name this site, where nobody has written down its address. */
  function nameThisSite() {
    const unknown = document.querySelector(".embed-unknown");
    if (unknown === null || !location.protocol.startsWith("http")) {
      return;
    }
    const here = new URL("../..", location).href.replace(/\/$/, "");
    for (const line of document.querySelectorAll(".embed-lines pre")) {
      line.textContent = line.textContent.replace(unknown.dataset.placeholder, here);
    }
    unknown.remove();
  }

  /** What prints the page says so with an attribute: no page holds a script (book/_make/policy.py). */
  function preparePrinting() {
    for (const button of document.querySelectorAll("[data-print]")) {
      button.addEventListener("click", () => window.print());
    }
  }

  /** The menu of downloads: a tap opens it, a tap elsewhere, Escape or leaving it closes it. */
  function prepareMenu(button) {
    const menu = button.nextElementSibling;
    const show = (isOpen) => {
      menu.classList.toggle("show", isOpen);
      button.setAttribute("aria-expanded", isOpen);
    };
    button.addEventListener("click", () => show(!menu.classList.contains("show")));
    document.addEventListener("click", (event) => button.parentElement.contains(event.target) || show(false));
    button.parentElement.addEventListener("focusout", ({ relatedTarget }) => {
      if (relatedTarget && !button.parentElement.contains(relatedTarget)) {
        show(false);
      }
    });
    button.parentElement.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && menu.classList.contains("show")) {
        show(false);
        button.focus();
      }
    });
  }

  rememberLanguage();
  if (document.documentElement.lang === "id" && typeof messages !== "undefined") {
    translateCopyButton();
  }

  document.addEventListener("DOMContentLoaded", () => {
    document.querySelectorAll("a.language-switcher").forEach(prepareSwitcher);
    for (const button of document.querySelectorAll("button.toggle-button")) {
      button.setAttribute("aria-label", toggleHintShow);
    }
    document.querySelectorAll("button.dropdown-toggle").forEach(prepareMenu);
    foldCode();
    nameThisSite();
    preparePrinting();
    makeBoxesFocusable();
    window.addEventListener("load", makeBoxesFocusable); // the fonts are here now
    window.addEventListener("resize", makeBoxesFocusable);
    closeContentsAfterChoice();
  });
})();
