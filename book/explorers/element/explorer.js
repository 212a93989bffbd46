// One explorer of the page: it keeps the state, computes, draws, and says what came out. What a paper hands
// over to it (a view) is described in papers/README.md.
import { make, setLabel } from "../drawing/make.js";
import { whenPainted } from "../drawing/painter.js";
import { Plot } from "../drawing/plot.js";
import { speaker } from "../language/speaker.js";
import { makeControl } from "./controls.js";
import { makeDraggable } from "./drag.js";
import { fillEquations } from "./equations.js";
import { HandCheck } from "./handcheck.js";
import { page } from "./host.js";
import { arrange } from "./layout.js";
import { tell, tellWhy } from "./messages.js";
import { completeControls, defaultsOf } from "./settings.js";
import { holdStill } from "./still.js";
import { fillTable } from "./tables.js";

const READING = 160; // ms between two changes of the words while something moves: as fast as anybody reads
const PAUSE = 600; // ms without a change: the reader pauses
const WORK_AT_ONCE = 4; // ms of long work before the first drawing
const WORK_A_FRAME = 8; // ms of it in every frame after that

let count = 0;

export class Explorer {
  /** table: the fields of the paper's Params; key: its name in the address; host: see host.js. */
  constructor(element, key, table, view, host = page()) {
    this.element = element;
    this.key = key;
    this.view = view;
    this.host = host;
    this.t = speaker(host.language);
    this.id = `explorer-${key.replace(".", "-")}-${++count}`;
    this.controls = completeControls(view, table);
    this.defaults = { ...defaultsOf(view, this.controls, table), ...host.start };
    this.s = { ...this.defaults, ...host.state }; // the state: what the reader has set
    this.tween = {}; // numbers of the state that are on their way
    this.memo = {}; // what the paper keeps from one calculation to the next
    this.touched = false; // has the reader changed anything?
    this.dragging = false;
    this.playing = null; // the control that moves by itself
    this.coming = null; // a promise of what had to be fetched first
    this.worded = 0; // when the words were last written
    this.ended = false; // has it left the page?
    this.build();
    host.enter(this);
    this.render();
  }

  build() {
    this.plots = this.view.plots.map((spec) => this.makePlot(spec));
    this.parts = this.controls.map((control) => makeControl(this, control));
    this.check = this.view.question ? new HandCheck(this) : null;
    arrange(this);
  }

  makePlot(spec) {
    const plot = new Plot(spec, this.t, () => this.drawAgain());
    if (spec.drag) {
      makeDraggable(this, plot);
    }
    return plot;
  }

  // --- change and draw -------------------------------------------------------------------------------------

  /**
   * Put new values into the state and draw in the next frame; dragging: the address waits until the reader
   * lets go.
   */
  change(changes, dragging = false) {
    this.s = { ...this.s, ...changes };
    this.dragging = dragging;
    this.touched = true;
    this.moving = null;
    this.tween = {};
    tell(this, null);
    this.schedule();
    if (!dragging) {
      this.settled();
    }
  }

  /** The reader has let go. */
  settled() {
    this.host.settled(this);
  }

  reset() {
    this.playing = null;
    this.change({ ...this.defaults });
  }

  stopPlaying() {
    this.playing = null;
    this.showControls();
    this.settled();
  }

  /**
   * Render in the next frame. While one drawing is painted the next may be made, but not a third: none queues
   * up behind the finger.
   */
  schedule() {
    this.frame ||= requestAnimationFrame(() => {
      whenPainted(() => {
        if (this.frame) {
          this.frame = 0;
          this.render();
        }
      }, 1);
    });
  }

  /** Render in this frame, in the place of what was scheduled. */
  renderNow(dragging) {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    this.dragging = dragging;
    this.render();
  }

  /** A promise that all that was drawn has been painted, also what waited for its sheet. */
  async painted() {
    await Promise.all(this.plots.map((plot) => plot.coming));
    if (this.redrawing) {
      await new Promise(requestAnimationFrame); // its drawing was asked for first, so it is there now
    }
    await new Promise((done) => whenPainted(done));
  }

  /** Compute and show the state; if that fails, the figure stays. */
  render() {
    const start = performance.now();
    const s = { ...this.s, ...this.tween };
    try {
      this.r = this.view.compute(s, this.memo);
      this.work = this.view.refine?.(this.r, s);
      this.shown = s;
    } catch (error) {
      this.showControls();
      tellWhy(this, error);
      return;
    }
    this.refine(start + WORK_AT_ONCE);
    for (const part of this.parts) {
      part.place?.();
    }
    this.draw();
    this.words(!this.dragging);
    this.host.drawn(this);
    this.element.dispatchEvent(new CustomEvent("explorer-drawn", { detail: performance.now() - start }));
    this.continue();
    clearTimeout(this.pause);
    this.pause = setTimeout(() => this.settle(), PAUSE);
  }

  /** Let the long work go on until the time is up, one piece at least. */
  refine(until) {
    do {
      if (this.work?.next().done) {
        this.work = null;
      }
    } while (this.work && performance.now() < until);
  }

  /** The long work goes on in the next frames, and what it has found is drawn. */
  continue() {
    if (!this.work || this.later) {
      return;
    }
    const goOn = () => {
      this.later = 0;
      if (this.frame || this.ended) {
        return; // the reader is faster: render() starts anew
      }
      this.refine(performance.now() + WORK_A_FRAME);
      this.draw();
      this.words();
      this.continue();
    };
    this.later = requestAnimationFrame(() => whenPainted(goOn, 1));
  }

  /**
   * All that is text: at once, or while something moves only now and then, because the page is laid out anew.
   */
  words(now = false) {
    const wait = this.worded + READING - performance.now();
    if (wait > 0 && !now) {
      this.unsaid ||= setTimeout(() => {
        this.unsaid = 0;
        this.words();
      }, wait);
      return;
    }
    this.worded = performance.now();
    holdStill(this, () => this.writeWords());
  }

  writeWords() {
    this.showControls();
    for (const plot of this.plots) {
      plot.renewLegend();
    }
    const { view, r, shown, t } = this;
    if (view.outcome) {
      setLabel(this.outcome, view.outcome(r, shown, t));
    }
    if (view.equations) {
      fillEquations(this.equations, view.equations(r, shown, t));
    }
    if (view.facts) {
      fillTable(this.facts, view.facts(r, shown, t));
    }
  }

  showControls() {
    for (const { control, element, show } of this.parts) {
      element.hidden = control.visible ? !control.visible(this.s, this.r) : false;
      if (!element.hidden) {
        show();
      }
    }
  }

  /** Draw the plots in sight, or all of them. */
  draw(all = false) {
    for (const plot of this.plots) {
      const hidden = plot.spec.visible ? !plot.spec.visible(this.shown) : false;
      if (plot.element.hidden !== hidden) {
        plot.element.hidden = hidden;
        plot.forgetSize();
      }
      if (!hidden && (all || plot.seen)) {
        plot.draw(plot.spec.draw(this.r, this.shown, this.t));
      }
    }
  }

  /** In the next frame, whatever is in sight: sizes, colours or fonts have changed. */
  drawAgain() {
    this.redrawing ||= requestAnimationFrame(() => {
      this.redrawing = 0;
      if (!this.r || this.ended) {
        return;
      }
      this.draw(true);
      this.words(true);
      if (this.plots.some((plot) => plot.isMissed)) {
        this.drawAgain();
      }
    });
  }

  /** The reader pauses: say the outcome aloud, fill the table, renew the question. */
  settle() {
    if (this.work) {
      this.pause = setTimeout(() => this.settle(), PAUSE / 2);
      return;
    }
    const outcome = this.outcome.textContent;
    if (this.touched) {
      this.live.textContent = outcome;
    }
    for (const { canvas, spec } of this.plots) {
      canvas.setAttribute("aria-label", `${this.t.say(spec.alt)} ${outcome}`);
    }
    this.fillNumbers();
    this.check?.ask();
  }

  fillNumbers() {
    if (this.details.open && this.r) {
      const table = this.table.firstChild || this.table.appendChild(make("table"));
      fillTable(table, this.view.numbers(this.r, this.shown, this.t));
    }
  }

  // --- the end ---------------------------------------------------------------------------------------------

  /** The explorer leaves the page, and nothing of it stays: no timer, no listener, no thread. */
  destroy() {
    this.ended = true;
    this.playing = null;
    this.moving = null;
    this.work = null;
    this.parts.forEach((part) => part.end?.());
    [this.frame, this.later, this.redrawing].forEach((frame) => cancelAnimationFrame(frame));
    this.frame = 0;
    [this.pause, this.unsaid].forEach(clearTimeout);
    this.stopFitting();
    this.sights.disconnect();
    this.forgetTheme();
    this.plots.forEach((plot) => plot.destroy());
    this.host.leave();
    this.section.remove();
    this.element.classList.remove("live");
  }
}
