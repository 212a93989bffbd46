// The search page: it finds sections, opens them, and quotes their prose. The sections are those of
// book/_ext/sections.py; what the theme needs around it (searchtools.js) stays.
"use strict";

(() => {
  const DEFINING = "book/bekal"; // the page that explains; the glossary only points to the explanations
  const WHOLE_TITLE = 60; // points
  const IN_TITLE = 25;
  const DEFINED = 12; // on that page
  const EXPLAINED = 8; // set off from the text, or an abbreviation that is introduced
  const MOST_TIMES = 4; // that a word counts in the prose
  const IN_CODE = 1;
  const QUOTE = 240; // letters
  const BEFORE = 80;

  const lower = (text) => text.toLowerCase();

  function wordsOf(query) {
    return lower(query)
      .split(/[^\p{L}\p{N}_]+/u)
      .filter(Boolean);
  }

  /** The places at which a word of the text begins with `word`. */
  function placesOf(word, text) {
    const escaped = word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
    const found = lower(text).matchAll(new RegExp(`(?<![\\p{L}\\p{N}])${escaped}`, "gu"));
    return Array.from(found, (match) => match.index);
  }

  /** How well a section answers; 0 if one of the words is missing. */
  function score([page, , title, above, prose, names, terms], words, query) {
    let points = 0;
    for (const word of words) {
      const times = placesOf(word, prose).length;
      const titled = placesOf(word, title).length > 0;
      const named = placesOf(word, names).length > 0 || placesOf(word, above.join(" ")).length > 0;
      if (times === 0 && !titled && !named) {
        return 0;
      }
      const explained = placesOf(word, terms).length > 0;
      points += Math.min(times, MOST_TIMES) + (titled ? IN_TITLE : 0);
      points += (explained ? EXPLAINED : 0) + (named ? IN_CODE : 0);
    }
    if (lower(title) === lower(query.trim())) {
      points += WHOLE_TITLE;
    }
    return page === DEFINING ? points + DEFINED : points;
  }

  function find(query) {
    const words = wordsOf(query);
    if (words.length === 0) {
      return [];
    }
    return bookSections
      .map((section, order) => ({ section, order, points: score(section, words, query) }))
      .filter(({ points }) => points > 0)
      .sort((a, b) => b.points - a.points || a.order - b.order);
  }

  /** The prose around the first word that stands in it, with the words marked. */
  function quote(prose, words) {
    const places = words.flatMap((word) => placesOf(word, prose)).sort((a, b) => a - b);
    const wanted = Math.max(0, (places[0] ?? 0) - BEFORE);
    const from = wanted === 0 ? 0 : prose.indexOf(" ", wanted) + 1;
    const to = from + QUOTE >= prose.length ? prose.length : prose.lastIndexOf(" ", from + QUOTE);
    const text = document.createElement("p");
    text.className = "context";
    text.append(from > 0 ? "… " : "", ...marked(prose.slice(from, to), words), to < prose.length ? " …" : "");
    return text;
  }

  function marked(text, words) {
    const parts = [];
    let at = 0;
    const ends = words.flatMap((word) => placesOf(word, text).map((from) => [from, from + word.length]));
    for (const [from, to] of ends.sort((a, b) => a[0] - b[0])) {
      if (from >= at) {
        const mark = document.createElement("mark");
        mark.textContent = text.slice(from, to);
        parts.push(text.slice(at, from), mark);
        at = to;
      }
    }
    return [...parts, text.slice(at)];
  }

  function entry([page, anchor, title, above, prose], words) {
    const link = document.createElement("a");
    link.href = page + DOCUMENTATION_OPTIONS.LINK_SUFFIX + (anchor && `#${anchor}`);
    link.textContent = [...above.slice(0, 1), title].join(" › ");
    const item = document.createElement("li");
    item.append(link, quote(prose, words));
    return item;
  }

  function show(query) {
    Search._parseQuery(query); // it notes the words, which the page that is opened marks
    const found = find(query);
    const words = wordsOf(query);
    Search.output.replaceChildren(...found.map(({ section }) => entry(section, words)));
    _finishSearch(found.length);
    if (found.length > 0) {
      const isIndonesian = document.documentElement.lang === "id";
      Search.status.innerText = isIndonesian
        ? `Bagian yang ditemukan: ${found.length}.`
        : `Sections found: ${found.length}.`;
    }
  }

  document.addEventListener("DOMContentLoaded", () => {
    if (typeof Search !== "undefined" && typeof bookSections !== "undefined") {
      Search.query = show;
    }
    document.querySelector("form.bd-search input")?.focus();
  });
})();
