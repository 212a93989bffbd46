// What `make lint-js` asks of the explorers. Prettier decides how a line is broken; here stands what it
// cannot know. Single letters are welcome: x, P, F, H, Q, R, z, u, y, S, K are the letters of the equations.
const BROWSER = [
  "AbortController",
  "addEventListener",
  "Blob",
  "cancelAnimationFrame",
  "clearTimeout",
  "console",
  "customElements",
  "CustomEvent",
  "DecompressionStream",
  "devicePixelRatio",
  "document",
  "DOMParser",
  "FontFace",
  "fonts",
  "getComputedStyle",
  "history",
  "HTMLElement",
  "innerHeight",
  "IntersectionObserver",
  "localStorage",
  "location",
  "matchMedia",
  "MutationObserver",
  "navigator",
  "OffscreenCanvas",
  "performance",
  "postMessage",
  "queueMicrotask",
  "requestAnimationFrame",
  "ResizeObserver",
  "setTimeout",
  "TextDecoder",
  "TextEncoder",
  "URL",
  "window",
  "Worker",
];
const NODE = ["Buffer", "console", "process", "require"];
// Of its scripts
const SPHINX = [
  "DOCUMENTATION_OPTIONS",
  "Search",
  "_finishSearch",
  "bookSections",
  "iconCheck",
  "iconCopy",
  "messages",
  "toggleHintShow",
];

function globals(names, kind = "readonly") {
  return Object.fromEntries(names.map((name) => [name, kind]));
}

const readable = {
  "max-lines": ["error", 300],
  "max-lines-per-function": ["error", { max: 40, skipComments: true }],
  "max-len": ["error", { code: 110 }],
  "max-statements-per-line": ["error", { max: 1 }],
  "max-depth": ["error", 4],
  complexity: ["error", 12],
  "one-var": ["error", "never"],
  "no-nested-ternary": "error",
  "no-sequences": "error",
  "no-multi-assign": "error",
  curly: ["error", "all"],
};
const correct = {
  "no-undef": "error",
  "no-unused-vars": "error",
  "no-redeclare": "error",
  "no-shadow-restricted-names": "error",
  "no-unreachable": "error",
  "no-dupe-keys": "error",
  "no-const-assign": "error",
  "no-use-before-define": ["error", { functions: false, variables: false }],
  "no-var": "error",
  "prefer-const": "error",
  eqeqeq: "error",
  "no-eval": "error",
  "no-implied-eval": "error",
};

const rules = { ...readable, ...correct };

export default [
  { ignores: ["_static/vendor/**", "_templates/**", "_locale/**"] },
  {
    files: ["explorers/**/*.js"],
    languageOptions: { ecmaVersion: 2023, sourceType: "module", globals: globals(BROWSER) },
    rules,
  },
  {
    files: ["_ext/*.mjs", "eslint.config.mjs"],
    languageOptions: { ecmaVersion: 2023, sourceType: "module", globals: globals(NODE) },
    rules,
  },
  {
    files: ["_ext/*.js"],
    languageOptions: { ecmaVersion: 2023, sourceType: "commonjs", globals: globals(NODE) },
    rules,
  },
  {
    files: ["_static/*.js"],
    languageOptions: {
      ecmaVersion: 2023,
      sourceType: "script",
      globals: { ...globals(BROWSER), ...globals(SPHINX, "writable") },
    },
    rules,
  },
  {
    files: ["slides/*.js"],
    languageOptions: {
      ecmaVersion: 2023,
      sourceType: "script",
      globals: { ...globals(BROWSER), ...globals(["dispatchEvent", "Event", "innerWidth", "Reveal"]) },
    },
    rules,
  },
];
