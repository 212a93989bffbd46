// Keeps the files below on the reader's device after the first visit, so that they open without a network.
// book/_make/kept.py fills in the list, {path: fingerprint of its content}, and the version, the fingerprint of the list.
//
// Each language has such a worker for its pages, and the folder above one for the page that chooses between
// them. A new version fetches only what has changed, and waits until the reader takes it or closes the book.
"use strict";

const FILES = {{ files }};
const OTHERWISE = {{ otherwise }}; // the page for an address that is not kept, or null

const SCOPE = new URL(self.registration.scope).pathname;
const MINE = `kalman:${SCOPE}:`; // two books of one host do not touch each other's copy
const CACHE = MINE + "{{ version }}";
const AT_ONCE = 4; // requests

self.addEventListener("install", (event) => event.waitUntil(keepAll()));

self.addEventListener("activate", (event) => event.waitUntil(removeOlder().then(() => self.clients.claim())));

self.addEventListener("message", (event) => {
  if (event.data === "take over") {
    self.skipWaiting();
  }
  if (event.data === "how much is kept?") {
    event.waitUntil(keepAll().then((kept) => event.source.postMessage({ kept, all: Object.keys(FILES).length })));
  }
});

self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  const isOurs = event.request.method === "GET" && url.origin === location.origin;
  if (isOurs && url.pathname.startsWith(SCOPE)) {
    event.respondWith(answer(event.request, decodeURI(url.pathname.slice(SCOPE.length))));
  }
});

/** What was asked for: kept, or from the network, or a page that says that it is not there. */
async function answer(request, path) {
  const name = nameOf(path);
  if (!name) {
    return fetch(request).catch((error) => notKept(request, error));
  }
  const cache = await caches.open(CACHE);
  return (await cache.match(addressOf(name))) ?? (await keep(cache, name));
}

/** Some hosts drop ".html" from an address, and a folder stands for its first page. */
function nameOf(path) {
  const folder = path === "" || path.endsWith("/") ? path : `${path}/`;
  return [path, `${path}.html`, `${folder}index.html`].find((name) => Object.hasOwn(FILES, name));
}

function notKept(request, error) {
  if (request.mode === "navigate" && OTHERWISE) {
    return Response.redirect(addressOf(OTHERWISE));
  }
  throw error;
}

/** Fetch whatever is not here yet -> how many files are here. One that fails leaves the others alone. */
async function keepAll() {
  const cache = await caches.open(CACHE);
  const older = await olderCopies();
  const waiting = Object.keys(FILES);
  const found = [];
  const next = async () => {
    while (waiting.length) {
      found.push(await isKept(cache, waiting.shift(), older));
    }
  };
  await Promise.all(Array.from({ length: AT_ONCE }, next));
  return found.filter(Boolean).length;
}

async function isKept(cache, name, older) {
  try {
    const here = (await cache.match(addressOf(name))) ?? (await fromOlder(cache, name, older));
    return (here ?? (await keep(cache, name))).ok;
  } catch {
    return false; // no network now; it is tried again at the next visit
  }
}

/** The same file from an older version, or undefined. */
async function fromOlder(cache, name, older) {
  for (const copy of older) {
    const same = await copy.match(addressOf(name));
    if (same?.headers.get("x-fingerprint") === FILES[name]) {
      await cache.put(addressOf(name), same.clone());
      return same;
    }
  }
  return undefined;
}

/** From the host, past what the browser keeps by itself, which may be older than this version. */
async function keep(cache, name) {
  const response = await fetch(addressOf(name), { cache: "no-cache" });
  if (!response.ok) {
    return response;
  }
  const headers = new Headers(response.headers);
  headers.set("x-fingerprint", FILES[name]);
  const copy = new Response(await response.blob(), { headers }); // anew: a redirected one may not be shown
  await cache.put(addressOf(name), copy.clone());
  return copy;
}

function addressOf(name) {
  return SCOPE + encodeURI(name);
}

async function olderCopies() {
  const names = (await caches.keys()).filter((name) => name.startsWith(MINE) && name !== CACHE);
  return Promise.all(names.map((name) => caches.open(name)));
}

async function removeOlder() {
  const names = (await caches.keys()).filter((name) => name.startsWith(MINE) && name !== CACHE);
  await Promise.all(names.map((name) => caches.delete(name)));
}
