// Keeps every page of one language on the reader's device after the first visit, so that the book opens without a network.
// book/build.py fills in the version and the list of files; a new build brings a new version, which replaces the old one.
"use strict";

const VERSION = "kalman-{{ language }}-{{ version }}";
const FILES = {{ files }};

self.addEventListener("install", event => {
  event.waitUntil(caches.open(VERSION).then(cache => cache.addAll(FILES)).then(() => self.skipWaiting()));
});

self.addEventListener("activate", event => {
  const mine = name => name.startsWith("kalman-{{ language }}-");
  event.waitUntil(caches.keys()
    .then(names => Promise.all(names.filter(name => mine(name) && name !== VERSION).map(name => caches.delete(name))))
    .then(() => self.clients.claim()));
});

self.addEventListener("fetch", event => {
  if (event.request.method !== "GET") return;
  event.respondWith(caches.open(VERSION)
    .then(cache => cache.match(event.request, { ignoreSearch: true }))
    .then(kept => kept || fetch(event.request)));
});
