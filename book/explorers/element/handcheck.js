// "Work it out by hand": a question of the paper, a field for the answer, and a hint that fits the mistake.
import { label, make } from "../drawing/make.js";
import { number } from "../language/input.js";
import { generator } from "../numerics/random.js";
import { makeButton } from "./messages.js";
import { SEED } from "./settings.js";
import { WORDS } from "./words.js";

const TOLERANCE = 0.01; // of the answer, where the question says nothing
const LEAST_TOLERANCE = 1e-12;

export class HandCheck {
  constructor(explorer) {
    const { t, id } = explorer;
    this.explorer = explorer;
    this.seed = Math.trunc(SEED + Math.random() * 1e9); // which question: another one at every visit
    const answer_id = `${id}-answer`;
    const question_id = `${answer_id}-question`;
    this.text = make("p", { className: "explorer-question", id: question_id });
    this.field = make("input", {
      type: "text",
      id: answer_id,
      inputMode: "decimal",
      autocomplete: "off",
      className: "explorer-value",
      "aria-describedby": question_id,
    });
    this.verdict = make("p", { className: "explorer-verdict", role: "status" });
    const title = make("p", { className: "explorer-name", textContent: t.say(WORDS.check) });
    const name = make("label", { htmlFor: answer_id, textContent: t.say(WORDS.answer) });
    const verify = make("button", { type: "submit", textContent: t.say(WORDS.verify) });
    const other = makeButton(explorer, t.say(WORDS.other), () => this.askAnother());
    const row = make("div", { className: "explorer-buttons" }, name, this.field, verify, other);
    const parts = [title, this.text, row, this.verdict];
    this.element = make("form", { className: "explorer-check", noValidate: true }, ...parts);
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      this.judge();
    });
  }

  /** Ask with the numbers that are shown now; what was answered stays while the question stays. */
  ask() {
    const { view, r, shown, t } = this.explorer;
    const question = view.question(r, shown, t, generator(this.seed));
    this.explorer.question = question;
    if (this.text.dataset.text === question.text) {
      return;
    }
    this.text.dataset.text = question.text;
    this.text.replaceChildren(label(question.text));
    this.field.value = "";
    this.tell("", "");
  }

  askAnother() {
    this.seed = (this.seed + 1) | 0;
    this.ask();
    this.field.focus();
  }

  judge() {
    const { question, t } = this.explorer;
    const { answer, tolerance = TOLERANCE, hint } = question;
    try {
      const value = number(this.field.value);
      const isRight = Math.abs(value - answer) <= tolerance * Math.abs(answer) + LEAST_TOLERANCE;
      if (isRight) {
        this.tell("right", t.say(WORDS.right, { value: t.decimal(answer, 4) }));
      } else {
        this.tell("wrong", hint(value));
      }
    } catch (error) {
      this.tell("wrong", error[t.language] ?? error.message);
    }
  }

  tell(kind, text) {
    this.verdict.className = `explorer-verdict ${kind}`.trim();
    this.verdict.replaceChildren(label(text));
  }
}
