// One exercise of the page: it grades an answer, says a hint, opens the solution, and remembers.
import { make } from "../drawing/make.js";
import { grade, isOpen, newState, take } from "../grading/grade.js";
import { answerOf } from "./answer.js";
import { forget, keep, recall } from "./memory.js";
import { WORDS } from "./words.js";

export class Exercise {
  /** element: made by book/_ext/exercises.py; changed(): is called when the progress may have changed. */
  constructor(element, t, changed) {
    this.element = element;
    this.t = t;
    this.changed = changed;
    this.number = element.dataset.exercise;
    this.about = JSON.parse(element.dataset.about);
    this.answer = answerOf(element, this.about);
    this.verdict = element.querySelector(".exercise-verdict");
    this.solution = element.querySelector(".exercise-solution"); // null in an edition for students
    this.name = document.getElementById(element.getAttribute("aria-labelledby"));
    this.tick = make("span", {
      className: "exercise-tick",
      role: "img",
      "aria-label": t.say(WORDS.answered),
      textContent: "✓",
    });
    this.remember();
    const form = element.querySelector("form");
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.check();
    });
    form.addEventListener("input", () => this.answer.mark(false));
  }

  get wasTried() {
    return this.state.right || this.state.wrong > 0;
  }

  /** What was kept, if it still fits: a right answer is graded again, for the exercise may have changed. */
  remember() {
    const { wrong = 0, value, typed = "" } = recall(this.number);
    this.state = { ...newState(), wrong };
    if (value !== undefined && grade(this.about, value).right) {
      this.state.right = true;
      this.answer.typed = typed;
      this.answer.mean?.(value);
      this.tell("right", this.t.say(WORDS.right));
    }
    this.show();
  }

  check() {
    const { problem, either, value } = this.answer.read();
    this.answer.mark(Boolean(problem));
    if (either) {
      this.askWhich(problem, either);
    } else if (problem) {
      this.tell("refused", "", this.sentence(problem));
      this.answer.focus();
    } else {
      this.judge(value);
    }
  }

  /** What was typed can be read in two ways: the reader says which. */
  askWhich(problem, either) {
    const buttons = either.map((value) => {
      const shown = this.t.language === "id" ? String(value).replace(".", ",") : String(value);
      const button = make("button", { type: "button", textContent: shown });
      button.addEventListener("click", () => {
        this.answer.mean(value);
        this.answer.focus();
        this.check();
      });
      return button;
    });
    this.tell("refused", "", this.sentence(problem), ...buttons);
  }

  judge(value) {
    const wasOpen = isOpen(this.state);
    const name = take(this.state, grade(this.about, value));
    if (name === null) {
      keep(this.number, { wrong: this.state.wrong, value, typed: this.answer.typed });
      this.tell("right", this.t.say(WORDS.right));
    } else {
      this.keepWrong();
      this.tellHint(name, wasOpen);
    }
    this.show();
    this.changed();
  }

  /** One more wrong answer; a right one that was kept stays. */
  keepWrong() {
    keep(this.number, { ...recall(this.number), wrong: this.state.wrong });
  }

  tellHint(name, wasOpen) {
    const { wrong } = this.state;
    const verdict = wrong > 1 ? this.t.say(WORDS.again, { n: String(wrong) }) : this.t.say(WORDS.wrong);
    const hint = this.element.querySelector(`.exercise-hints [data-hint="${name}"]`).cloneNode(true);
    const opensNow = this.solution !== null && isOpen(this.state) && !wasOpen;
    const opened = opensNow ? [this.sentence(WORDS.open)] : [];
    this.tell("wrong", verdict, hint, ...opened);
  }

  sentence(words) {
    return make("p", { textContent: this.t.say(words) });
  }

  tell(kind, text, ...more) {
    this.verdict.className = `exercise-verdict ${kind}`.trim();
    this.verdict.replaceChildren(...(text ? [make("b", { textContent: text })] : []), ...more);
  }

  show() {
    if (this.solution !== null) {
      this.solution.hidden = !isOpen(this.state);
    }
    if (this.state.right) {
      this.name.after(this.tick);
    } else {
      this.tick.remove();
    }
  }

  /** As if it had never been answered. */
  clear() {
    forget(this.number);
    this.state = newState();
    this.answer.typed = "";
    this.answer.mark(false);
    this.solution?.removeAttribute("open");
    this.tell("", "");
    this.show();
  }
}
