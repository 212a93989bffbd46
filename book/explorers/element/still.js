// What the reader has taken hold of stays where it is, also when a sentence above it gets another line: the
// page is scrolled by as much.

/** Remember what the reader touches: explorer.asked = {part, field}, see messages.js, and .touching. */
export function watchTouch(explorer) {
  const note = ({ target }) => {
    const part = target.closest(".explorer-control, .explorer-buttons");
    const isField = target.matches("textarea, select, input[type=text], input[type=file]");
    explorer.touching = target;
    explorer.asked = part ? { part, field: isField ? target : null } : null;
  };
  for (const kind of ["pointerdown", "input", "change", "click", "keydown", "drop"]) {
    explorer.section.addEventListener(kind, note, { capture: true });
  }
}

/** Change the page; what the reader touched last, if it is in sight, stays in its place of the window. */
export function holdStill({ touching }, change) {
  const before = touching?.isConnected ? touching.getBoundingClientRect() : null;
  change();
  if (!before || before.height === 0 || before.bottom < 0 || before.top > innerHeight) {
    return;
  }
  const shift = touching.getBoundingClientRect().top - before.top;
  if (Math.abs(shift) > 0.1) {
    scrollerOf(touching).scrollBy({ top: shift, behavior: "instant" });
  }
}

/** What scrolls around an element: the window, or in a notebook a part of it. */
function scrollerOf(element) {
  for (let around = element; around; around = around.parentElement ?? around.getRootNode().host) {
    const isBox = around !== document.body && around !== document.documentElement;
    if (
      isBox &&
      around.scrollHeight > around.clientHeight &&
      /auto|scroll/.test(getComputedStyle(around).overflowY)
    ) {
      return around;
    }
  }
  return document.scrollingElement;
}
