// On paper the solutions stand on a sheet of their own behind the page, opened or not: one print gives the
// questions and the answers. Without a script they stand below their questions (exercise.css).
import { make } from "../drawing/make.js";
import { WORDS } from "./words.js";

const AT_END = "solutions-at-end"; // a class of the root: they are not printed in their place

export class Paper {
  constructor(exercises, t) {
    this.exercises = exercises;
    this.t = t;
    this.sheet = null;
    addEventListener("beforeprint", () => this.lay());
    addEventListener("afterprint", () => this.clear());
  }

  lay() {
    this.clear();
    const [first] = this.exercises;
    const worked = this.exercises.flatMap(({ name, solution }) => [
      make("p", {}, make("b", { textContent: name.textContent })),
      solution.querySelector(".exercise-worked").cloneNode(true),
    ]);
    const title = make("h2", { textContent: this.t.say(WORDS.solutions) });
    this.sheet = make("section", { className: "exercise-sheet" }, title, ...worked);
    first.element.closest("article").append(this.sheet);
    document.documentElement.classList.add(AT_END);
  }

  clear() {
    this.sheet?.remove();
    this.sheet = null;
    document.documentElement.classList.remove(AT_END);
  }
}
