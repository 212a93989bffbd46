// The rooms that only some readers need. Each is a script of its own beside the core, fetched when something
// in it is first called: so it works from a folder, too, and without a network where the page is kept. In the
// scripts of the papers stand calls of roomOf in their place (book/_ext/bundle.mjs).
import { make } from "../drawing/make.js";
import { InputError } from "../language/input.js";
import { NotYet } from "../language/later.js";
import { WORDS } from "./words.js";

export const rooms = {}; // name -> {module: {function}}, as its script tells

const HERE = document.currentScript?.src; // of the core
const coming = new Map(); // name -> a promise that it is there
let files = {}; // name -> the file of its script

/** The core ends with this call. */
export function knowRooms(names) {
  files = names;
}

/** The modules of a room; NotYet: it must be fetched first. */
export function roomOf(name) {
  if (!rooms[name]) {
    throw new NotYet(WORDS.fetching, () => fetched(name));
  }
  return rooms[name];
}

/** Once for all who ask; after a failure it is tried again. */
function fetched(name) {
  if (!coming.has(name)) {
    coming.set(name, fetchRoom(name));
  }
  return coming.get(name);
}

function fetchRoom(name) {
  return new Promise((done, fail) => {
    const script = make("script", { src: new URL(files[name], HERE).href });
    const end = () => {
      if (rooms[name]) {
        done();
        return;
      }
      coming.delete(name);
      script.remove();
      fail(new InputError(WORDS.unfetched));
    };
    script.addEventListener("load", end);
    script.addEventListener("error", end);
    document.head.append(script);
  });
}
