// What stands around an explorer. In the book it is a page: its address keeps the settings, and its language
// is that of the text. In a notebook it is a cell, see jupyter/cell.js.
import { linkTo, settingsToAddress, takeAddress } from "./address.js";
import { breakOut } from "./breakout.js";
import { copy } from "./messages.js";
import { printState } from "./paper.js";

/**
 * A host is
 *   language           "id" or "en"
 *   themed             the element whose attribute data-theme says which colours are in use
 *   start, state       {name: value}: other defaults than those of the view, and what differs from them
 *   kernel             null, or what reads and writes files that the page cannot: {read, write}
 *   enter(explorer)    it is built, and not drawn yet
 *   drawn(explorer)    a state was accepted and is shown
 *   settled(explorer)  the reader has let go
 *   link               null, or link(explorer): hand out a link with the settings
 *   leave()            the explorer goes: forget it
 */
export function page() {
  const left = new AbortController();
  return {
    language: document.documentElement.lang === "id" ? "id" : "en",
    themed: document.documentElement,
    start: {},
    state: {},
    kernel: null,
    enter(explorer) {
      takeAddress(explorer);
      const follow = () => takeAddress(explorer) && explorer.schedule();
      addEventListener("hashchange", follow, { signal: left.signal });
      markAround(explorer.element);
      breakOut(explorer.element, left.signal);
      printState(explorer, left.signal);
    },
    drawn() {},
    settled: settingsToAddress,
    async link(explorer) {
      settingsToAddress(explorer);
      await copy(explorer, linkTo(explorer.key));
    },
    leave: () => left.abort(),
  };
}

/** What stands around the element in the page is told so: see element.css. */
function markAround(element) {
  let around = element.parentElement;
  while (around && around !== document.body) {
    around.classList.add("explorer-around");
    around = around.parentElement;
  }
}
