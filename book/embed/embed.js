// The page around an explorer that stands alone in a frame: the colours follow the reader's light or dark
// scheme, and the link to the chapter takes the settings along. Nothing is asked of the page around.
"use strict";

(() => {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const follow = () => {
    document.documentElement.dataset.theme = dark.matches ? "dark" : "light";
  };
  follow();
  dark.addEventListener("change", follow);

  document.addEventListener("click", ({ target }) => {
    const link = target.closest(".embed-source a");
    if (link && location.hash) {
      link.hash = location.hash;
    }
  });
})();
