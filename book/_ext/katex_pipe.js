// Renders equations while the book is built: one JSON request per line on stdin, one JSON answer per line on
// stdout. Started by offline.py; ends when its stdin closes. Usage: node katex_pipe.js path/to/katex.js
"use strict";
const katex = require(process.argv[2]);
const lines = require("readline").createInterface({ input: process.stdin });

lines.on("line", (line) => {
  const { latex, options } = JSON.parse(line);
  let answer;
  try {
    answer = { html: katex.renderToString(latex, options) };
  } catch (error) {
    answer = { error: String(error.message) };
  }
  process.stdout.write(JSON.stringify(answer) + "\n");
});
