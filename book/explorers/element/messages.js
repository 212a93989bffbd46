// What an explorer tells its reader beside the outcome: mistakes, and that something was copied.
import { label, make, setText } from "../drawing/make.js";
import { InputError } from "../language/input.js";
import { copyText } from "./hand-over.js";
import { WORDS } from "./words.js";

/** A button; if what it does fails, the explorer says so. */
export function makeButton(explorer, text, react) {
  const button = make("button", { type: "button" }, label(text));
  button.addEventListener("click", () => safely(explorer, react));
  return button;
}

/** Run what a reader started; a mistake becomes a sentence. */
export async function safely(explorer, action) {
  try {
    await action();
  } catch (error) {
    tell(explorer, error);
  }
}

/** Show a sentence or what is wrong; null: nothing any more. plain: it is good news. */
export function tell({ message, t }, news, plain = false) {
  const text = sentenceOf(news, t);
  message.classList.toggle("plain", plain);
  setText(message, text);
  message.hidden = text === "";
}

function sentenceOf(news, t) {
  if (!news || typeof news === "string") {
    return news || "";
  }
  if (news instanceof InputError) {
    return news[t.language];
  }
  console.warn(news);
  return t.say(WORDS.failed, { text: news.message });
}

/** Put a text into the clipboard, and say whether that went well. */
export async function copy(explorer, text) {
  const done = await copyText(text, explorer.section);
  tell(explorer, explorer.t.say(done ? WORDS.copied : WORDS.refused), true);
}
