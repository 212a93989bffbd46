// The exercises of a page come to life: a script of its own, loaded only where there are some. Without it the
// questions stay, and the solutions can be opened.
export { grade, newState, take } from "../grading/grade.js"; // both for the tests
export { numberIn } from "../grading/typed.js";
import { speaker } from "../language/speaker.js";
import { Exercise } from "./exercise.js";
import { Progress } from "./progress.js";

const t = speaker(document.documentElement.lang);
let progress = null;
const exercises = [...document.querySelectorAll(".exercise[data-about]")].map((element) => {
  return new Exercise(element, t, () => progress?.show());
});
const place = document.querySelector(".exercise-progress");
if (place) {
  progress = new Progress(place, t, exercises);
}

// On paper the solutions stand open. Chromium opens them by the style sheet, others need it done.
let opened = [];
addEventListener("beforeprint", () => {
  opened = exercises.map(({ solution }) => ({ solution, open: solution.open }));
  for (const { solution } of opened) {
    solution.open = true;
  }
});
addEventListener("afterprint", () => {
  for (const { solution, open } of opened) {
    solution.open = open;
  }
});
