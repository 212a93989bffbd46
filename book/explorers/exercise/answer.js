// The fields of an exercise and what the reader has put into them, one class a kind. read() -> {value}, or
// {problem: {id, en}}, or {problem, either: [value, value]}.
import { numberIn } from "../grading/typed.js";
import { WORDS } from "./words.js";

class Line {
  constructor(element) {
    this.field = element.querySelector("input");
  }

  get typed() {
    return this.field.value;
  }

  set typed(text) {
    this.field.value = text;
  }

  mark(isWrong) {
    if (isWrong) {
      this.field.setAttribute("aria-invalid", "true");
    } else {
      this.field.removeAttribute("aria-invalid");
    }
  }

  focus() {
    this.field.focus();
  }
}

class NumberLine extends Line {
  constructor(element, { unit = "" }) {
    super(element);
    this.unit = unit;
  }

  read() {
    const isMeant = this.meant?.typed === this.typed; // the reader has said which number it is
    return isMeant ? { value: this.meant.value } : numberIn(this.typed, this.unit);
  }

  /** What was typed stands for this value. */
  mean(value) {
    this.meant = { typed: this.typed, value };
  }
}

class CodeLine extends Line {
  read() {
    const value = this.typed.trim();
    return value === "" ? { problem: WORDS.write } : { value };
  }
}

class Choice {
  constructor(element) {
    this.fields = [...element.querySelectorAll("input")];
  }

  get typed() {
    return String(this.fields.findIndex((field) => field.checked));
  }

  set typed(place) {
    this.fields.forEach((field, i) => {
      field.checked = String(i) === place;
    });
  }

  read() {
    const value = Number(this.typed);
    return value < 0 ? { problem: WORDS.choose } : { value };
  }

  mark() {
    // a choice cannot be mistyped
  }

  focus() {
    (this.fields.find((field) => field.checked) ?? this.fields[0]).focus();
  }
}

const KINDS = { number: NumberLine, choice: Choice, code: CodeLine };

export function answerOf(element, about) {
  return new KINDS[about.kind](element, about);
}
