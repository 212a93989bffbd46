// "Work it out by hand": a question of the paper, a field for the answer, and a hint that fits the mistake.
import { label, make } from "../drawing/make.js";
import { number } from "../language/input.js";
import { generator } from "../numerics/random.js";
import { makeButton } from "./messages.js";
import { SEED } from "./settings.js";
import { WORDS } from "./words.js";

const TOLERANCE = 0.01; // of the answer, where the question says nothing
const LEAST_TOLERANCE = 1e-12;
const TRIES = 2; // wrong answers, after which the answer may be shown
const ATTEMPTS = 50; // to find a question that differs from the one before

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
    this.reveal = makeButton(explorer, t.say(WORDS.reveal), () => this.show());
    const buttons = [verify, this.reveal, other];
    const row = make("div", { className: "explorer-buttons" }, name, this.field, ...buttons);
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
    this.wrong = 0;
    this.reveal.hidden = true;
    this.tell("", "");
  }

  /** Another one than that which stands there, if the paper has another one for these numbers. */
  askAnother() {
    const before = this.text.dataset.text;
    for (let i = 0; i < ATTEMPTS && this.text.dataset.text === before; i++) {
      this.seed = (this.seed + 1) | 0;
      this.ask();
    }
    this.field.focus();
  }

  /** The answer, and how to get there. */
  show() {
    const { question, t } = this.explorer;
    const { answer, hint } = question;
    const value = t.decimal(answer, 4);
    const general = hint(NaN); // which is near to no mistake
    this.tell("", t.say(WORDS.revealed, { value, hint: general }));
    this.reveal.hidden = true;
    this.field.focus();
  }

  judge() {
    const { question, t } = this.explorer;
    const { answer, tolerance = TOLERANCE, hint } = question;
    this.field.removeAttribute("aria-invalid");
    try {
      const value = number(this.field.value); // one sign is the decimal one: what we ask for is no thousand
      const isRight = Math.abs(value - answer) <= tolerance * Math.abs(answer) + LEAST_TOLERANCE;
      if (isRight) {
        this.tell("right", t.say(WORDS.right, { value: t.decimal(answer, 4) }));
      } else {
        this.wrong += 1;
        this.reveal.hidden = this.wrong < TRIES;
        this.tell("wrong", t.say(WORDS.wrong, { hint: hint(value) }));
      }
    } catch (error) {
      this.field.setAttribute("aria-invalid", "true");
      this.tell("wrong", error[t.language] ?? error.message);
    }
  }

  tell(kind, text) {
    this.verdict.className = `explorer-verdict ${kind}`.trim();
    this.verdict.replaceChildren(label(text));
  }
}
