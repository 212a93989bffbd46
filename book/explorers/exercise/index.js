// The exercises of a page come to life: a script of its own, loaded only where there are some. Without it the
// questions stay, and the solutions can be opened.
export { grade, newState, take } from "../grading/grade.js"; // both for the tests
export { numberIn } from "../grading/typed.js";
import { speaker } from "../language/speaker.js";
import { Exercise } from "./exercise.js";
import { Paper } from "./paper.js";
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
const solved = exercises.filter(({ solution }) => solution !== null);
if (solved.length > 0) {
  new Paper(solved, t);
}
