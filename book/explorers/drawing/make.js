// New elements of the page. Text only ever goes through textContent: what a reader typed is never HTML.

const ATTRIBUTES = new Set(["role", "list"]); // properties of the same name cannot be set

/** A new element with these properties and attributes. */
export function make(tag, properties = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name in element && !ATTRIBUTES.has(name)) {
      element[name] = value;
    } else {
      element.setAttribute(name, value);
    }
  }
  element.append(...children);
  return element;
}

/** A label, in which "_" makes what follows an index: "x_true" -> x with a lowered "true". */
export function label(text) {
  const parts = document.createDocumentFragment();
  text.split(/(_\p{L}+\p{N}*|_\p{N}+)/u).forEach((part, i) => {
    const isIndex = i % 2 === 1;
    if (part !== "") {
      const textContent = isIndex ? part.slice(1) : part;
      parts.append(make(isIndex ? "sub" : "span", { textContent }));
    }
  });
  return parts;
}

// What is as it should be is left alone: every change costs a layout or a style.

export function setAttribute(element, name, value) {
  if (element.getAttribute(name) !== value) {
    element.setAttribute(name, value);
  }
}

export function setText(element, text) {
  if (element.textContent !== text) {
    element.textContent = text;
  }
}

export function setLabel(element, text) {
  if (element.dataset.text !== text) {
    element.dataset.text = text;
    element.replaceChildren(label(text));
  }
}
