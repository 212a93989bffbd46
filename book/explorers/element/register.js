// The element <kalman-explorer paper="gyro" view="mismatch">. The core of the page defines it; the bundle of
// a paper, which comes later, registers the paper and brings its elements to life. Until then, and without a
// script, the picture stays.
import { Explorer } from "./explorer.js";

export const papers = {}; // name -> what papers/<name>/index.js exports
export const tables = {}; // name -> the fields of the Params of the Python module

class KalmanExplorer extends HTMLElement {
  connectedCallback() {
    this.start();
  }

  /** Show the explorer, if its paper is there and it is not shown yet. */
  start() {
    const paper = this.getAttribute("paper");
    const views = papers[paper]?.views;
    if (this.explorer || !views) {
      return;
    }
    const first = Object.keys(views)[0];
    const name = this.getAttribute("view") || first;
    const key = name === first ? paper : `${paper}.${name}`;
    this.explorer = new Explorer(this, key, tables[paper], views[name]);
  }
}

/** Make a paper known: its module, and the table of its Params. */
export function register(name, paper, table) {
  papers[name] = paper;
  tables[name] = table;
  for (const element of document.querySelectorAll("kalman-explorer")) {
    element.start();
  }
}

customElements.define("kalman-explorer", KalmanExplorer);
