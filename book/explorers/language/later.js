// What a page fetches only when a reader first needs it: until then, calling it throws NotYet.
import { InputError } from "./input.js";

/** What was called is still to come: a sentence in both languages; fetch() is a promise that it is there. */
export class NotYet extends InputError {
  constructor(words, fetch) {
    super(words);
    this.fetch = fetch;
  }
}

/** What the action gives, as soon as all that it calls is there; until then it is started again. */
export async function whenThere(action) {
  try {
    return await action();
  } catch (error) {
    if (!(error instanceof NotYet)) {
      throw error;
    }
    await error.fetch();
    return whenThere(action);
  }
}
