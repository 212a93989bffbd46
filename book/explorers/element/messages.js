// What an explorer tells its reader beside the outcome: mistakes, and that something was copied.
import { label, make, setText } from "../drawing/make.js";
import { InputError } from "../language/input.js";
import { NotYet, whenThere } from "../language/later.js";
import { copyText } from "./hand-over.js";
import { WORDS } from "./words.js";

/** A button; if what it does fails, the explorer says so. */
export function makeButton(explorer, text, react) {
  const button = make("button", { type: "button" }, label(text));
  button.addEventListener("click", () => safely(explorer, react));
  return button;
}

/** Run what a reader started, as soon as all that it needs is there; a mistake becomes a sentence. */
export async function safely(explorer, action) {
  try {
    await whenThere(action);
  } catch (error) {
    tell(explorer, error);
  }
}

/** A state cannot be shown: say why. What only needs to be fetched is fetched, and the state shown then. */
export function tellWhy(explorer, error) {
  if (!(error instanceof NotYet)) {
    tell(explorer, error);
    return;
  }
  tell(explorer, error[explorer.t.language], true);
  const goOn = () => {
    if (!explorer.ended) {
      tell(explorer, null);
      explorer.schedule();
    }
  };
  explorer.coming = error.fetch().then(goOn, (failure) => tell(explorer, failure));
}

/** The message goes as soon as what is typed is right. */
export function forgive(explorer, value) {
  try {
    value();
    tell(explorer, null);
  } catch {
    // not yet
  }
}

/**
 * Show a sentence or what is wrong, beside what the reader has used; null: nothing any more. plain: it is
 * good news; otherwise the field that was filled in is marked.
 */
export function tell(explorer, news, plain = false) {
  const { message, t, asked } = explorer;
  const text = sentenceOf(news, t);
  unmark(explorer);
  message.classList.toggle("plain", plain);
  message.hidden = text === "";
  if (text !== "") {
    putBeside(explorer, asked?.part);
    if (asked?.field && !plain) {
      mark(explorer, asked.field);
    }
  }
  setText(message, text);
  if (text !== "" && asked) {
    message.scrollIntoView({ block: "nearest", behavior: "instant" });
  }
}

/** The message goes into the part of the control, or below the outcome if there is none to be seen. */
function putBeside({ message, live }, part) {
  if (!part || part.hidden) {
    live.after(message);
  } else if (part.matches("label")) {
    part.after(message); // what lies in a label belongs to its name
  } else {
    part.append(message);
  }
}

function mark(explorer, field) {
  field.setAttribute("aria-invalid", "true");
  field.setAttribute("aria-describedby", explorer.message.id);
  explorer.marked = field;
}

function unmark(explorer) {
  explorer.marked?.removeAttribute("aria-invalid");
  explorer.marked?.removeAttribute("aria-describedby");
  explorer.marked = null;
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
