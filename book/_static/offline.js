// The book on the reader's device: keeps it for reading without a network, says when the copy is complete,
// and offers a new version. What is kept, and how, stands in offline-worker.js.
"use strict";

(() => {
  const WORDS = {
    id: {
      complete: "Buku ini tersimpan di perangkat ini dan dapat dibaca tanpa jaringan.",
      partly: "Tersimpan untuk dibaca tanpa jaringan: {kept} dari {all} berkas.",
      newer: "Ada versi baru buku ini.",
      reload: "Muat ulang",
    },
    en: {
      complete: "This book is kept on this device and can be read without a network.",
      partly: "Kept for reading without a network: {kept} of {all} files.",
      newer: "There is a new version of this book.",
      reload: "Reload",
    },
  };
  const words = WORDS[document.documentElement.lang] ?? WORDS.en;

  async function keepForOffline() {
    const canKeep = "serviceWorker" in navigator && location.protocol.startsWith("http");
    if (!canKeep || navigator.connection?.saveData) {
      return;
    }
    const root = new URL(document.documentElement.dataset.content_root || "./", location);
    try {
      const ours = await register(new URL("offline-worker.js", root));
      if (document.querySelector("link[hreflang=x-default]")) {
        await register(new URL("../offline-worker.js", root)); // the page that chooses a language
      }
      listen(ours);
      await ours.update(); // the browser does so by itself, some time
    } catch {
      // refused: read online
    }
  }

  /** The browser looks for a new version at every visit, past what it keeps by itself. */
  function register(address) {
    return navigator.serviceWorker.register(address, { updateViaCache: "none" });
  }

  function listen(registration) {
    navigator.serviceWorker.addEventListener("message", (event) => tellHowMuch(event.data));
    const ask = () => registration.active?.postMessage("how much is kept?");
    const follow = (worker) =>
      worker?.addEventListener("statechange", () => {
        if (worker.state === "activated") {
          ask();
        }
        offerWhenReady(registration);
      });
    ask();
    offerWhenReady(registration);
    follow(registration.installing);
    registration.addEventListener("updatefound", () => follow(registration.installing));
  }

  /** The line at the end of the page. */
  function tellHowMuch({ kept, all }) {
    const text = kept === all ? words.complete : words.partly.replace("{kept}", kept).replace("{all}", all);
    let line = document.querySelector(".offline-word");
    if (!line) {
      line = document.createElement("p");
      line.className = "offline-word";
      line.setAttribute("role", "status");
      document.querySelector(".footer-content__inner, footer.bd-footer-content, main")?.append(line);
    }
    line.textContent = text;
  }

  /** A new version is here and an older one is being read: a quiet line offers to change over. */
  function offerWhenReady(registration) {
    if (
      !registration.waiting ||
      !navigator.serviceWorker.controller ||
      document.querySelector(".newer-word")
    ) {
      return;
    }
    const line = document.createElement("div");
    line.className = "newer-word";
    line.setAttribute("role", "status");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = words.reload;
    button.addEventListener("click", () => {
      navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
      registration.waiting.postMessage("take over");
    });
    line.append(words.newer, " ", button);
    document.body.append(line);
  }

  window.addEventListener("load", keepForOffline); // when the page is complete
})();
