// Slides of a chapter: how many below each other a section fills is found here, where the height of a part is
// known. A slide has the same size in every window (reveal.js makes it larger or smaller), so that it is
// parted in the same way everywhere; only a window that stands upright, a phone, has a size of its own.
"use strict";

(() => {
  const LYING = { width: 1280, height: 720 };
  const STANDING = { width: 560, height: 1000 };
  const SMALLEST = 0.4; // of its size, for a part that is too high even alone
  const FINER = 0.97;
  const SIDES = [0.85, 0.75, 0.65, 0.6, 0.55]; // of the text at the side of an explorer
  const HEIGHTS = [2, 1.8, 1.6, 1.4, 1.2, 1.1, 1, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4]; // of its figures
  const EXPLORER = /^#[a-z]+(\.[a-z]+)?:/; // the address holds the settings of an explorer
  const LEAST = [0.8, 0.4]; // of the height of its figures, while a place for the words is found
  const STARTS = ["new", "alone"]; // what slides.py says of a part
  const ENDS = ["last", "alone"];
  const LABELS = {
    id: {
      left: "Bagian sebelumnya",
      right: "Bagian berikutnya",
      up: "Ke atas",
      down: "Ke bawah",
      on: "Lanjut",
    },
    en: { left: "Previous section", right: "Next section", up: "Up", down: "Down", on: "Go on" },
  };
  const root = document.documentElement;
  const article = document.querySelector("article");
  const frame = article.parentElement;
  const size = innerHeight > innerWidth ? STANDING : LYING;

  // --- the slides of a section ----------------------------------------------------------------------------

  function element(name, className, ...children) {
    const made = document.createElement(name);
    made.className = className;
    made.append(...children);
    return made;
  }

  /** A section -> its slides below each other. */
  function partSection(section) {
    const heading = section.querySelector(":scope > h2");
    const blocks = [...section.children].filter((child) => child !== heading);
    const column = { section, heading, slides: [] };
    section.classList.add("parting");
    open(column);
    fill(column, blocks);
    section.classList.remove("parting");
    column.slides.forEach(({ body, slide }, i) => {
      markSolutions(body);
      if (heading && column.slides.length > 1) {
        slide.firstChild.append(element("span", "slide-count", `${i + 1}/${column.slides.length}`));
      }
    });
  }

  /** A new slide at the end of a column; the heading stands on all of them. */
  function open(column) {
    const body = element("div", "slide-body");
    const slide = element("section", "part-slide", body);
    if (column.heading && column.slides.length === 0) {
      slide.prepend(column.heading);
    } else if (column.heading) {
      slide.prepend(element("p", "slide-again", column.heading.textContent));
    }
    column.section.append(slide);
    column.slides.push({ slide, body });
  }

  function fill(column, blocks) {
    for (const block of blocks) {
      put(column, block);
    }
  }

  function put(column, block) {
    const { body } = column.slides.at(-1);
    const before = body.lastElementChild;
    if (before && (STARTS.includes(block.dataset.slide) || ENDS.includes(before.dataset.slide))) {
      open(column);
      put(column, block);
      return;
    }
    body.append(block);
    if (block.querySelector(".explorer")) {
      layOut(block);
      fitExplorer(body, block);
    }
    if (fits(body)) {
      return;
    }
    if (before) {
      const along = [block];
      while (leads(body, along[0].previousElementSibling)) {
        along.unshift(along[0].previousElementSibling);
      }
      open(column);
      fill(column, along);
      return;
    }
    const halves = halve(block);
    if (halves) {
      block.remove();
      fill(column, halves);
    } else {
      shrink(body, block);
    }
  }

  function fits(body) {
    return body.scrollHeight <= body.clientHeight;
  }

  /** Does it stand with what follows, and not alone on its slide? */
  function leads(body, block) {
    return block?.dataset.slide === "leads" && block !== body.firstElementChild;
  }

  /** A list, a table or a solution in two pieces, or null: a paragraph, a figure and code stay whole. */
  function halve(block) {
    const items = piecesOf(block);
    if (items.length < 2 || block.querySelector("kalman-explorer, figure, pre")) {
      return null;
    }
    const middle = Math.ceil(items.length / 2);
    const second = block.cloneNode(true);
    piecesOf(second)
      .slice(0, middle)
      .forEach((item) => item.remove());
    items.slice(middle).forEach((item) => item.remove());
    if (block.tagName === "OL") {
      second.start = block.start + middle;
    }
    delete second.dataset.slide;
    return [block, second];
  }

  function piecesOf(block) {
    const table = block.matches("table") ? block : block.querySelector(":scope > table");
    if (table) {
      return [...table.tBodies].flatMap((part) => [...part.rows]);
    }
    return block.matches("ol, ul, div:not(.math)") ? [...block.children] : [];
  }

  function shrink(body, block) {
    let zoom = body.clientHeight / body.scrollHeight;
    block.style.zoom = zoom;
    while (!fits(body) && zoom > SMALLEST) {
      zoom *= FINER;
      block.style.zoom = zoom;
    }
  }

  /** Draw all explorers once: what their legends say takes room. */
  async function drawExplorers() {
    const explorers = [...document.querySelectorAll("kalman-explorer.live")].map((e) => e.explorer);
    await Promise.all(explorers.flatMap(({ plots }) => plots.map((plot) => plot.coming)));
    for (const explorer of explorers) {
      explorer.draw(true);
      explorer.words(true);
    }
  }

  /** An explorer that lies down: all its figures at the left, all that is said and moved at the right. */
  function layOut(block) {
    const stage = block.querySelector(".explorer-stage");
    stage.append(...block.querySelectorAll(".explorer-figures"));
  }

  /** The largest text at its side with which there is room, then the highest figures. */
  function fitExplorer(body, block) {
    const [stage, side, equations] = ["stage", "side", "equations"].map((name) =>
      block.querySelector(`.explorer-${name}`),
    );
    const isFitted = LEAST.some((height) => {
      block.style.setProperty("--slide-figures", height);
      return [side, stage].some((place) => {
        place.append(equations);
        return largest("--slide-side", SIDES, body, block);
      });
    });
    if (!isFitted) {
      shrink(body, block);
    }
    largest("--slide-figures", HEIGHTS, body, block);
    dispatchEvent(new Event("resize")); // the figures are drawn anew
  }

  /** Give a part the first value with which it fits, or the last one; is there such a one? */
  function largest(name, values, body, block) {
    return values.some((value) => {
      block.style.setProperty(name, value);
      return fits(body);
    });
  }

  /** A solution below its question appears one step later; on a slide of its own it is there at once. */
  function markSolutions(body) {
    for (const solution of body.querySelectorAll(".slide-solution")) {
      solution.classList.toggle("fragment", solution !== body.firstElementChild);
    }
  }

  // --- going through them ---------------------------------------------------------------------------------

  /** Keys that the part with the focus needs itself. */
  function isFree({ key, target }) {
    const works = key === " " || key === "Enter" ? "button, summary, a, select" : "select, [tabindex='0']";
    return !target.closest?.(works);
  }

  /** What reveal.js says in English only. */
  function nameControls() {
    const { on, ...directions } = LABELS[root.lang] ?? LABELS.en;
    for (const [direction, label] of Object.entries(directions)) {
      frame.querySelector(`.controls .navigate-${direction}`).setAttribute("aria-label", label);
    }
    frame.querySelector(".pause-overlay button").textContent = on;
  }

  /** An address with the settings of an explorer opens its slide. */
  function goToExplorer(address) {
    const key = address.slice(1, address.indexOf(":"));
    const found = [...document.querySelectorAll("kalman-explorer")].find((e) => e.explorer?.key === key);
    if (found) {
      const { h, v } = Reveal.getIndices(found.closest(".part-slide"));
      Reveal.slide(h, v);
    }
  }

  async function start() {
    const asked = location.hash;
    root.classList.add("deck");
    root.style.setProperty("--slide-width", `${size.width}px`);
    root.style.setProperty("--slide-height", `${size.height}px`);
    await document.fonts.ready;
    await drawExplorers();
    root.classList.add("parting");
    [...article.children].forEach(partSection);
    root.classList.remove("parting");
    frame.classList.add("reveal");
    article.classList.add("slides");
    const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;
    await Reveal.initialize({
      ...size,
      margin: 0,
      center: false,
      hash: true,
      help: false,
      jumpToSlide: false,
      controlsTutorial: false,
      slideNumber: "c/t",
      scrollActivationWidth: null,
      transition: isStill ? "none" : "slide",
      keyboardCondition: isFree,
    });
    nameControls();
    frame.scrollTop = 0;
    window.scrollTo(0, 0);
    if (EXPLORER.test(asked)) {
      goToExplorer(asked);
    }
    root.classList.add("ready");
  }

  for (const explorer of document.querySelectorAll("kalman-explorer")) {
    explorer.setAttribute("data-prevent-swipe", "");
  }
  start();
})();
