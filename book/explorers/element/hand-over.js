// What a reader takes along: a text for the clipboard, a file to be saved.
import { make } from "../drawing/make.js";

const KEPT = 10000; // ms until a saved file is forgotten

/** Put a text into the clipboard; false: the browser refused. */
export async function copyText(text, section) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copyOldWay(text, section);
  }
}

/** From file:// there is no clipboard, but a selected text can be copied. */
function copyOldWay(text, section) {
  const box = make("textarea", { value: text, className: "explorer-live" });
  section.append(box);
  box.select();
  const done = document.execCommand("copy");
  box.remove();
  return done;
}

/** Save a file: {name, type, content}. */
export function saveFile({ name, type, content }) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT);
}
