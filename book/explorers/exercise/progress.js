// How many exercises of the page are answered, and the way to forget them.
import { make } from "../drawing/make.js";
import { WORDS } from "./words.js";

export class Progress {
  /** element: the empty paragraph above the first exercise. */
  constructor(element, t, exercises) {
    this.element = element;
    this.t = t;
    this.exercises = exercises;
    this.count = make("span", { role: "status" });
    this.button = make("button", { type: "button", textContent: t.say(WORDS.clear) });
    this.button.addEventListener("click", () => this.clear());
    element.replaceChildren(this.count, this.button);
    element.tabIndex = -1; // takes the focus when the button is gone
    this.show();
    element.hidden = false;
  }

  show() {
    const done = this.exercises.filter(({ state }) => state.right).length;
    const values = { done: String(done), all: String(this.exercises.length) };
    this.count.textContent = this.t.say(WORDS.progress, values);
    this.button.hidden = !this.exercises.some(({ wasTried }) => wasTried);
  }

  clear() {
    for (const exercise of this.exercises) {
      exercise.clear();
    }
    this.show();
    this.element.focus();
  }
}
