// Where the window is wider than the column of text, an explorer of the page takes the room beside
// it. The contents of the page, which may stand there, step aside while it passes.

const LEAST = 40; // pixels that it must gain
const WIDEST = 985;
const EDGE = 16; // pixels that stay free at the right
const CONTENTS = ".bd-sidebar-secondary";

let frame = 0; // in which all explorers of the page are looked at, once

/** Until the signal, follow the window. */
export function breakOut(element, signal) {
  const column = element.parentElement;
  const follow = () => {
    const room = document.documentElement.clientWidth - column.getBoundingClientRect().left - EDGE;
    const width = Math.min(WIDEST, room);
    const isWide = width >= column.clientWidth + LEAST;
    element.classList.toggle("wide", isWide);
    element.style.width = isWide ? `${width}px` : "";
  };
  follow();
  const sizes = new ResizeObserver(follow); // the menu at the left was opened or closed
  const watched = document.querySelector(".bd-main") ?? document.body;
  sizes.observe(watched);
  addEventListener("resize", follow, { signal });
  signal.addEventListener("abort", () => sizes.disconnect());
  stepAside(signal);
}

/** The contents are hidden while a wide explorer lies where they stand. */
function stepAside(signal) {
  const contents = document.querySelector(CONTENTS);
  if (!contents) {
    return;
  }
  const look = () => {
    frame = 0;
    const { top, bottom } = contents.getBoundingClientRect();
    const passes = [...document.querySelectorAll("kalman-explorer.wide")].some((element) => {
      const box = element.getBoundingClientRect();
      return box.top < bottom && box.bottom > top;
    });
    document.documentElement.classList.toggle("explorer-passes", passes);
  };
  const lookSoon = () => {
    frame ||= requestAnimationFrame(look);
  };
  look();
  addEventListener("scroll", lookSoon, { signal, passive: true });
  addEventListener("resize", lookSoon, { signal });
}
