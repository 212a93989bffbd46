// The element <kalman-explorer paper="gyro"> : a chapter's model, live in the page. It reads what papers/<paper>.js exports
// and builds controls, figures, sentences and the hand check from it. To add a paper, write that one file; the build finds it.
//
// WHAT papers/<paper>.js EXPORTS. It is pure: it may import linalg, filters, metrics, random and words, and never touches
// the document. p is {name: number}, one entry for every field of the Python module's Params.
//
//   model(p)            the twin of Python's model(p), from filters.linearModel or filters.nonlinearModel
//   simulate(p, rng)    -> {T, x (T n), z (T m), u (T l) or null}; rng is random.generator(seed)
//   run(p, data)        -> the filter over data.z and data.u, a result of filters.kalmanFilter (or faster, with x, P, K, y, S)
//   twins (optional)    {python_name: (p, data, result) => numbers}: functions that the Python module has under the same
//                       name; the test calls both. Python's parameters are filled by name (see tests/test_explorers.py).
//   views               {name: view}; <kalman-explorer paper="smoother" view="online"> shows views.online, without the
//                       attribute the first one is shown
//
// A VIEW. s is the state: every field of Params, every further control, and s.seed; t speaks the language of the page:
// t.say({id, en}, {name: value}), t.decimal(value, digits), t.language.
//
//   name      {id, en}                   what the explorer is, for screen readers
//   start     {name: value}              other starting values than those of Params (optional)
//   controls  [control]                  in the order in which they are shown, see below
//   compute(s, memo) -> r                everything that is shown; pure except for what it keeps in memo for the next call
//                                        throw new InputError({id, en}) (words.js): the sentence is shown, the figure stays
//   *refine(r, s)                        (optional) a generator for long work: it improves r and yields every millisecond
//                                        or so; r is drawn when some time is used up, and again until it is done
//   plots     [{title, alt: {id, en}, xlabel, height, half, after, equal, bare, xlog, ylog,
//               draw(r, s, t) -> {layers, xlim, ylim},     layers: see plot.js
//               drag(x, y, s, r) -> {name: value} or null, the pointer drags in the figure (give keyboard users a slider)
//               visible(s)}]             after: below the controls; half: two beside each other where there is room;
//                                        bare: without axes
//   outcome(r, s, t) -> sentence         what came out; shown, and read aloud when the reader pauses
//   facts(r, s, t) -> {head, rows}       (optional) a small table; the first cell of a row names it; "x_true" gets an index
//   equations(r, s, t) -> [line]         (optional) a line is a list of words "x_pred = F x" and {matrix: [[...], ...]}
//   numbers(r, s, t) -> {head, rows}     the table "show the numbers": what the figures show
//   question(r, s, t, random) -> {text, answer, tolerance, hint(value) -> sentence}      the hand check; tolerance relative
//   noise     true: there is a button "new noise", which changes s.seed
//
// A CONTROL; visible(s, r) and disabled(s) are optional in all of them, id and en are its words; also(value, s) -> {name: value}
// (optional in select, text and file) is what else changes when the reader chooses or types:
//   {name, symbol}                       slider with a field to type into; range and words from Params; every property
//                                        can be replaced: id, en, unit, min, max, step, log. A name that Params does not
//                                        have needs all of them and a default. auto(s): the value while s[name] is null.
//                                        field: true leaves the slider out: for a range that no slider can hold
//   {kind: "entry", id, en, button: {id, en}, enter(text, s) -> {name: value}}      one line, taken with Enter or the button
//   {kind: "check", name, id, en}        s[name] is true or false
//   {kind: "select", name, id, en, options: [[value, {id, en}], ...]}    or options(s, r) -> such a list, which is then
//                                        not part of the address
//   {kind: "text", name, id, en, rows, placeholder}      s[name] is what was typed or pasted; not part of the address
//   {kind: "file", name, id, en, accept} s[name] is null or {name, bytes (Uint8Array)}; a file can also be dropped on it
//   {kind: "buttons", id, en, items: [item]}, where an item has id, en, pressed(s) (optional) and one of
//       set: {name: value} or (s, r) => {name: value} (glide: milliseconds in which numbers move there)
//       play: name, seconds              moves the control `name` from where it is to its end, or stops; for who wants
//                                        no motion it jumps there, or back
//       copy: (r, s, t) => text          puts text into the clipboard
//       save: (r, s, t) => {name, type, content}         hands over a file
import { number, InputError, speaker } from "./words.js";
import { generator } from "./random.js";
import { whenPainted } from "./painter.js";
import { Plot, label, make, onThemeChange } from "./plot.js";

const WORDS = {
  reset: { id: "Ulang dari awal", en: "Start again" },
  noise: { id: "Derau baru", en: "New noise" },
  link: { id: "Salin tautan", en: "Copy link" },
  copied: { id: "Disalin.", en: "Copied." },
  refused: { id: "Peramban menolak menyalin. Tautannya ada di kolom alamat.", en: "The browser refused to copy. The link is in the address bar." },
  typed: { id: "{name}: ketik nilainya", en: "{name}: type the value" },
  range: { id: "{name} = {value}: yang diterima {min} sampai {max}{unit}.", en: "{name} = {value}: accepted are {min} to {max}{unit}." },
  hash: { id: "Bagian alamat “{text}” tidak dimengerti, jadi pengaturannya tidak dipakai.",
          en: "The part “{text}” of the address makes no sense, so its settings are not used." },
  failed: { id: "Perhitungannya gagal ({text}); gambar sebelumnya tetap.", en: "The calculation failed ({text}); the figure before it stays." },
  numbers: { id: "Tampilkan angka-angkanya", en: "Show the numbers" },
  check: { id: "Hitung sendiri", en: "Work it out by hand" },
  answer: { id: "Jawaban", en: "Answer" },
  verify: { id: "Periksa", en: "Check" },
  other: { id: "Soal lain", en: "Another question" },
  right: { id: "Benar: {value}.", en: "Right: {value}." },
  controls: { id: "Kendali", en: "Controls" },
  drop: { id: "atau seret berkas ke sini", en: "or drop a file here" },
  stop: { id: "Berhenti", en: "Stop" },
};

const SEED = 2, STEPS = 1000;           // STEPS: places of a log slider
const PART = /^[a-z]+(\.[a-z]+)?:/;

/** The address after #: "gyro:sigma_w=1,sigma_v=2;theory:z=3" -> Map {"gyro" -> "sigma_w=1,sigma_v=2", ...}; or null. */
function readHash() {
  const text = location.hash.slice(1);
  if (!PART.test(text)) return null;
  return new Map(text.split(";").map(part => { const at = part.indexOf(":"); return [part.slice(0, at), part.slice(at + 1)]; }));
}

function writeHash(key, text) {
  const parts = readHash() || new Map();
  if (text === "" && !parts.has(key)) return;
  if (text === "") parts.delete(key); else parts.set(key, text);
  const hash = [...parts].map(([name, value]) => `${name}:${value}`).join(";");
  try {
    history.replaceState(history.state, "", hash ? `#${hash}` : location.pathname + location.search);
  } catch { /* the browser allows only so many changes a minute: the next one will do */ }
}

const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

class Explorer {
  constructor(element, key, table, view) {
    const language = document.documentElement.lang === "id" ? "id" : "en";
    Object.assign(this, { element, key, table, view, t: speaker(language), memo: {}, tween: {}, touched: false, dragging: false, worded: 0, unsaid: 0 });
    this.id = `explorer-${key.replace(".", "-")}-${Explorer.count = (Explorer.count || 0) + 1}`;
    this.controls = view.controls.map(control => ({ ...table[control.name], unit: table[control.name]?.unit || "", ...control }));
    this.defaults = { seed: SEED };
    for (const [name, field] of Object.entries(table)) this.defaults[name] = field.default;
    for (const control of this.controls) if (control.name && (!(control.name in this.defaults) || "default" in control)) this.defaults[control.name] = control.default ?? null;
    Object.assign(this.defaults, view.start);
    this.s = { ...this.defaults };
    this.asked = (SEED + Math.random() * 1e9) | 0;
    this.build();
    this.fromHash();
    this.render();
    addEventListener("hashchange", () => this.fromHash() && this.schedule());
  }

  say(key, values) { return this.t.say(WORDS[key], values); }

  // --- the parts -----------------------------------------------------------------------------------------------------

  build() {
    const { view, t, id } = this;
    let asked = 0;
    const again = () => { asked ||= requestAnimationFrame(() => { asked = 0; if (this.r) { this.draw(true); this.words(true); } }); };
    this.plots = view.plots.map(spec => {
      const plot = new Plot(spec, t, () => again());
      if (spec.drag) this.draggable(plot, spec);
      return plot;
    });
    const figures = (name, plots) => make("div", { className: `explorer-figures ${name} ${plots.some(plot => plot.spec.half) ? "halves" : ""}` }, ...plots.map(plot => plot.element));
    this.outcome = make("p", { className: "explorer-outcome" });
    this.live = make("p", { className: "explorer-live", role: "status", "aria-live": "polite" });
    this.message = make("p", { className: "explorer-message", role: "alert", hidden: true });
    this.parts = this.controls.map(control => this.control(control));
    const is_check = i => this.controls[i]?.kind === "check";
    this.parts.forEach((part, i) => part.element.classList.toggle("beside", is_check(i) && (is_check(i - 1) || is_check(i + 1))));
    const fixed = make("div", { className: "explorer-buttons" });
    if (view.noise) fixed.append(this.button(this.say("noise"), () => this.change({ seed: this.s.seed + 1 })));
    fixed.append(this.button(this.say("reset"), () => this.reset()), this.button(this.say("link"), () => this.copyLink()));
    const controls = make("div", { className: "explorer-controls", role: "group", "aria-label": this.say("controls") }, ...this.parts.map(part => part.element));
    this.equations = make("div", { className: "explorer-equations", tabIndex: 0, role: "region", hidden: !view.equations });
    this.equations.setAttribute("aria-label", t.say({ id: "Persamaan dengan angkanya", en: "Equations with their numbers" }));
    this.facts = make("table", { className: "explorer-facts", hidden: !view.facts });
    this.table = make("div", { className: "explorer-table", tabIndex: 0, role: "region" });
    this.table.setAttribute("aria-label", `${this.say("numbers")}: ${t.say(view.name)}`);
    this.details = make("details", { className: "explorer-numbers" }, make("summary", { textContent: this.say("numbers") }), this.table);
    this.details.addEventListener("toggle", () => this.fillNumbers());
    this.section = make("div", { className: "explorer", id, role: "region", "aria-label": t.say(view.name) },
      make("div", { className: "explorer-stage" }, figures("first", this.plots.filter(plot => !plot.spec.after)),
        this.outcome, this.live, this.message, controls, fixed),
      this.equations, this.facts,
      figures("", this.plots.filter(plot => plot.spec.after)),
      ...(view.question ? [this.handCheck()] : []), this.details);
    this.element.append(this.section);
    this.element.classList.add("live");
    for (let around = this.element.parentElement; around && around !== document.body; around = around.parentElement) around.classList.add("explorer-around");
    for (const image of this.element.querySelectorAll("img")) image.loading = "eager";       // hidden, yet ready to be printed
    let width, height;
    const first = this.section.querySelector(".explorer-figures.first"), tall = () => first.offsetHeight > innerHeight - 280;
    this.resizes = new ResizeObserver(() => {
      const { clientWidth, offsetHeight } = this.section, wide = width !== clientWidth, low = first.classList.contains("low");
      if (!wide && height === offsetHeight) return;
      this.outcome.style.minHeight = wide ? "" : `${this.outcome.offsetHeight}px`;         // it only grows: nothing below it jumps back
      first.classList.remove("low");
      first.classList.toggle("low", tall());
      first.classList.toggle("stays", !tall());         // in sight above the sliders of a phone
      if (tall()) first.classList.remove("low");
      if (wide || low !== first.classList.contains("low")) { for (const plot of this.plots) plot.width = undefined; again(); }
      [width, height] = [clientWidth, this.section.offsetHeight];
    });
    this.resizes.observe(this.section);
    onThemeChange(again);
    this.views = new IntersectionObserver(entries => {
      for (const entry of entries) this.plots.find(plot => plot.element === entry.target).seen = entry.isIntersecting;
      if (this.r) { this.draw(); this.words(); }
    });
    for (const plot of this.plots) this.views.observe(plot.element);
  }

  button(text, react) {
    const button = make("button", { type: "button" }, label(text));
    button.addEventListener("click", () => this.safely(react));
    return button;
  }

  control(control) {
    const part = { slider: this.slider, entry: this.entry, check: this.check, select: this.select, text: this.textArea, file: this.file, buttons: this.buttons }[control.kind || "slider"].call(this, control);
    part.element.classList.add("explorer-control", control.kind || "slider");
    return { control, ...part };
  }

  value(control) { return this.s[control.name] ?? control.auto?.(this.s) ?? 0; }

  slider(control) {
    const { t } = this, id = `${this.id}-${control.name}`, words = t.say(control);
    const low = control.min > 0 ? control.min : (control.low ?? (control.default > 0 ? control.default / 1e6 : 1e-9));
    const [from, to] = [Math.log(low), Math.log(control.max)];
    const range = make("input", { type: "range", id, min: control.log ? 0 : control.min, max: control.log ? STEPS : control.max, step: control.log ? 1 : control.step });
    const typed = make("input", { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false, className: "explorer-value" });
    typed.setAttribute("aria-label", this.say("typed", { name: `${control.symbol || ""} ${words}`.trim().replaceAll("_", "") }));
    const name = make("label", { htmlFor: id });
    if (control.symbol) name.append(make("b", {}, label(control.symbol)), " ");
    name.append(make("span", {}, label(words)));
    const box = input => make("span", { className: "explorer-box" }, input);
    const element = make("div", {}, name, box(range), make("span", { className: "explorer-typed" }, box(typed), make("span", { className: "explorer-unit", textContent: control.unit })));
    range.hidden = Boolean(control.field);
    range.addEventListener("input", () => {
      const place = Number(range.value);
      let value = place;
      if (control.log) value = place === 0 ? control.min : place === STEPS ? control.max : Number(Math.exp(from + (to - from) * place / STEPS).toPrecision(3));
      if (control.log) value = Math.min(Math.max(value, control.min), control.max);
      this.change({ [control.name]: value }, true);
    });
    range.addEventListener("change", () => this.toHash());
    typed.addEventListener("change", () => this.safely(() => this.change({ [control.name]: this.accepted(control, number(typed.value)) })));
    const place = () => {
      const value = this.value(control), at = control.log ? (value <= low ? 0 : Math.round(STEPS * (Math.log(value) - from) / (to - from))) : value;
      if (Number(range.value) !== at) range.value = at;
    };
    let seen;
    const show = () => {
      const value = this.value(control), disabled = Boolean(control.disabled?.(this.s)), now = `${value} ${disabled} ${typed.value}`;
      place();
      if (now === seen) return;
      const text = t.language === "id" ? plain(value).replace(".", ",") : plain(value);
      if (typed.value !== text && document.activeElement !== typed) typed.value = text;
      range.setAttribute("aria-valuetext", `${t.decimal(value)} ${control.unit}`.trim());
      range.disabled = typed.disabled = disabled;
      seen = `${value} ${disabled} ${typed.value}`;
    };
    return { element, place, show };
  }

  check(control) {
    const box = make("input", { type: "checkbox" });
    box.addEventListener("change", () => this.change({ [control.name]: box.checked }));
    return { element: make("label", {}, box, make("span", { textContent: this.t.say(control) })), show: () => { box.checked = this.s[control.name]; } };
  }

  select(control) {
    const id = `${this.id}-${control.name}`;
    const box = make("select", { id }), { options } = control;
    let shown = [];
    const fill = options => {
      if (JSON.stringify(options) === JSON.stringify(shown)) return;
      shown = options;
      box.replaceChildren(...options.map(([value, words]) => make("option", { value, textContent: this.t.say(words) })));
    };
    box.addEventListener("change", () => this.choose(control, shown[box.selectedIndex][0]));
    const show = () => { fill(typeof options === "function" ? options(this.s, this.r) : options); box.value = this.s[control.name]; };
    return { element: make("div", {}, make("label", { htmlFor: id, textContent: this.t.say(control) }), box), show };
  }

  choose(control, value) { this.change({ [control.name]: value, ...control.also?.(value, this.s) }); }

  entry(control) {
    const id = `${this.id}-entry`, box = make("input", { type: "text", id, inputMode: "decimal", autocomplete: "off", className: "explorer-value" });
    const enter = () => { this.change(control.enter(box.value, this.s)); box.value = ""; };
    box.addEventListener("keydown", event => { if (event.key === "Enter") this.safely(enter); });
    return { element: make("div", {}, make("label", { htmlFor: id, textContent: this.t.say(control) }), box, this.button(this.t.say(control.button), enter)), show() {} };
  }

  textArea(control) {
    const id = `${this.id}-${control.name}`, box = make("textarea", { id, rows: control.rows || 4, spellcheck: false });
    if (control.placeholder) box.placeholder = this.t.say(control.placeholder);
    box.addEventListener("input", () => this.choose(control, box.value));
    return { element: make("div", {}, make("label", { htmlFor: id, textContent: this.t.say(control) }), box),
             show: () => { const text = this.s[control.name] ?? ""; if (document.activeElement !== box && box.value !== text) box.value = text; } };
  }

  file(control) {
    const id = `${this.id}-${control.name}`, box = make("input", { type: "file", id, accept: control.accept || "" });
    const take = async file => {
      if (file) this.choose(control, { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) });
    };
    box.addEventListener("change", () => take(box.files[0]));
    const element = make("div", {}, make("label", { htmlFor: id, textContent: this.t.say(control) }), box, make("span", { className: "explorer-hint", textContent: this.say("drop") }));
    element.addEventListener("dragover", event => event.preventDefault());
    element.addEventListener("drop", event => { event.preventDefault(); take(event.dataTransfer.files[0]); });
    return { element, show: () => { if (this.s[control.name] === null && box.value) box.value = ""; } };
  }

  buttons(control) {
    const buttons = control.items.map(item => {
      const button = this.button(this.t.say(item), () => this.press(item));
      return button;
    });
    const element = make("div", { role: "group" }, ...buttons);
    if (control[this.t.language]) {
      element.setAttribute("aria-label", this.t.say(control));
      element.prepend(make("span", { className: "explorer-name", textContent: this.t.say(control) }));
    }
    const show = () => control.items.forEach((item, i) => {
      if (item.pressed) setAttribute(buttons[i], "aria-pressed", String(Boolean(item.pressed(this.s))));
      if (item.disabled) buttons[i].disabled = Boolean(item.disabled(this.s));
      if (item.play) setText(buttons[i], this.playing === item.play ? this.say("stop") : this.t.say(item));
    });
    return { element, show };
  }

  async press(item) {
    if (item.set) {
      const changes = typeof item.set === "function" ? item.set(this.s, this.r) : item.set;
      if (item.glide && !calm()) this.glide(changes, item.glide); else this.change(changes);
    } else if (item.play) {
      this.play(item);
    } else if (item.copy) {
      await this.copy(item.copy(this.r, this.s, this.t));
    } else if (item.save) {
      const { name, type, content } = item.save(this.r, this.s, this.t), address = URL.createObjectURL(new Blob([content], { type }));
      make("a", { href: address, download: name }).click();
      setTimeout(() => URL.revokeObjectURL(address), 10000);
    }
  }

  // --- change and draw -----------------------------------------------------------------------------------------------

  /** Put new values into the state and draw in the next frame; dragging: the address waits until the reader lets go. */
  change(changes, dragging = false) {
    this.s = { ...this.s, ...changes };
    this.dragging = dragging;
    this.touched = true;
    this.moving = null;
    this.tween = {};
    this.tell(null);
    this.schedule();
    if (!dragging) this.toHash();
  }

  reset() {
    this.playing = null;
    this.change({ ...this.defaults });
  }

  /** Render in the next frame. While one drawing is painted the next may be made, but not a third: none queues up behind the finger. */
  schedule() {
    this.frame ||= requestAnimationFrame(() => whenPainted(() => { if (this.frame) { this.frame = 0; this.render(); } }, 1));
  }

  /** A promise that all that was drawn has been painted. */
  painted() { return new Promise(done => whenPainted(done)); }

  render() {
    const start = performance.now();
    const s = { ...this.s, ...this.tween };
    try {
      const r = this.view.compute(s, this.memo);
      this.work = this.view.refine?.(r, s);
      Object.assign(this, { r, shown: s });
    } catch (error) {
      this.tell(error);                 // the figure stays
      this.showControls();
      return;
    }
    this.refine(start + 4);
    for (const part of this.parts) part.place?.();
    this.draw();
    this.words(!this.dragging);
    this.element.dispatchEvent(new CustomEvent("explorer-drawn", { detail: performance.now() - start }));
    this.continue();
    clearTimeout(this.pause);
    this.pause = setTimeout(() => this.settle(), 600);
  }

  /** Let the long work go on until the time is up, one piece at least. */
  refine(until) {
    do if (this.work?.next().done) this.work = null; while (this.work && performance.now() < until);
  }

  continue() {
    if (!this.work || this.later) return;
    this.later = requestAnimationFrame(() => whenPainted(() => {
      this.later = 0;
      if (this.frame) return;           // the reader is faster: render() starts anew
      this.refine(performance.now() + 8);
      this.draw();
      this.words();
      this.continue();
    }, 1));
  }

  /** All that is text: at once, or while something moves six times a second, as fast as anybody reads: the page is laid out anew each time. */
  words(now = false) {
    const wait = this.worded + 160 - performance.now();
    if (wait > 0 && !now) { this.unsaid ||= setTimeout(() => { this.unsaid = 0; this.words(); }, wait); return; }
    this.worded = performance.now();
    this.showControls();
    for (const plot of this.plots) plot.renewLegend();
    if (this.view.outcome) setLabel(this.outcome, this.view.outcome(this.r, this.shown, this.t));
    if (this.view.equations) fillEquations(this.equations, this.view.equations(this.r, this.shown, this.t));
    if (this.view.facts) fillTable(this.facts, this.view.facts(this.r, this.shown, this.t));
  }

  showControls() {
    for (const { control, element, show } of this.parts) {
      element.hidden = control.visible ? !control.visible(this.s, this.r) : false;
      if (!element.hidden) show();
    }
  }

  /** Draw the plots in sight, or all of them. */
  draw(all = false) {
    for (const plot of this.plots) {
      const hidden = plot.spec.visible ? !plot.spec.visible(this.shown) : false;
      if (plot.element.hidden !== hidden) { plot.element.hidden = hidden; plot.width = undefined; }
      if (!hidden && (all || plot.seen)) plot.draw(plot.spec.draw(this.r, this.shown, this.t));
    }
  }

  /** The reader pauses: say the outcome, fill the table, renew the question. */
  settle() {
    if (this.work) { this.pause = setTimeout(() => this.settle(), 300); return; }
    const outcome = this.outcome.textContent;
    if (this.touched) this.live.textContent = outcome;
    for (const { canvas, spec } of this.plots) canvas.setAttribute("aria-label", `${this.t.say(spec.alt)} ${outcome}`);
    this.fillNumbers();
    this.ask();
  }

  glide(changes, milliseconds) {
    const from = this.s, start = performance.now(), token = {};
    this.change(changes);
    this.moving = token;
    const step = now => {
      if (this.moving !== token) return;
      const share = Math.min((now - start) / milliseconds, 1), eased = share * share * (3 - 2 * share);
      this.tween = {};
      if (share < 1) for (const name of Object.keys(changes)) if (typeof changes[name] === "number" && typeof from[name] === "number") this.tween[name] = from[name] + eased * (changes[name] - from[name]);
      cancelAnimationFrame(this.frame);
      this.frame = 0;
      this.dragging = share < 1;
      this.render();
      if (share < 1) requestAnimationFrame(step); else this.moving = null;
    };
    step(start);
  }

  play(item) {
    if (this.playing === item.play) { this.playing = null; this.showControls(); this.toHash(); return; }
    const control = this.controls.find(({ name }) => name === item.play);
    if (calm()) { this.change({ [item.play]: this.value(control) >= control.max ? control.min : control.max }); return; }
    let value = this.value(control) >= control.max ? control.min : this.value(control), last;
    this.playing = item.play;
    const step = now => {
      if (this.playing !== item.play || !this.element.isConnected) return;
      last ??= now;
      if (calm() && now - last < 1000) { requestAnimationFrame(step); return; }         // reduced motion: pictures, one a second
      value = Math.min(value + (now - last) / 1000 * (control.max - control.min) / (item.seconds || 8), control.max);
      last = now;
      if (value >= control.max) this.playing = null;
      this.change({ [item.play]: control.step ? Number((Math.floor(value / control.step + 1e-9) * control.step).toPrecision(12)) : value }, this.playing !== null);
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  draggable(plot, spec) {
    const { canvas } = plot;
    canvas.classList.add("draggable");
    let held = false, pressed = null;           // a finger that goes up or down scrolls the page
    const move = event => {
      const box = canvas.getBoundingClientRect();
      const changes = this.r && spec.drag(plot.x_of(event.clientX - box.left), plot.y_of(event.clientY - box.top), this.s, this.r);
      if (!changes) return false;
      for (const [name, value] of Object.entries(changes)) {
        const control = this.controls.find(other => other.name === name);
        if (control && typeof value === "number" && !control.log) changes[name] = Math.min(Math.max(Number((Math.round(value / control.step) * control.step).toPrecision(12)), control.min), control.max);
      }
      this.change(changes, true);
      return true;
    };
    const hold = event => {
      pressed = null;
      held = move(event);
      if (held) canvas.setPointerCapture(event.pointerId);
    };
    canvas.addEventListener("pointerdown", event => {
      if (!event.isPrimary) return;
      if (event.pointerType === "touch") pressed = event; else hold(event);
    });
    canvas.addEventListener("pointermove", event => {
      if (held) move(event);
      else if (pressed && Math.abs(event.clientX - pressed.clientX) > 6) hold(event);
    });
    canvas.addEventListener("pointerup", event => { if (pressed) hold(event); });
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { if (held) this.toHash(); held = false; pressed = null; });
  }

  // --- messages ------------------------------------------------------------------------------------------------------

  /** Run what a reader started; a mistake becomes a sentence. */
  async safely(action) {
    try { await action(); } catch (error) { this.tell(error); }
  }

  tell(error, plain = false) {
    const { language } = this.t;
    let text = "";
    if (error instanceof InputError) text = error[language];
    else if (typeof error === "string") text = error;
    else if (error) { text = this.say("failed", { text: error.message }); console.warn(error); }
    this.message.classList.toggle("plain", plain);
    setText(this.message, text);
    this.message.hidden = text === "";
  }

  accepted(control, value) {
    if (value >= control.min && value <= control.max) return value;
    const { t } = this, unit = control.unit ? ` ${control.unit}` : "";
    const text = this.say("range", { name: control.symbol || t.say(control) || control.name, value: t.decimal(value, 12), min: t.decimal(control.min, 12), max: t.decimal(control.max, 12), unit });
    throw Object.assign(new InputError({ [t.language]: text }), { outside: true });
  }

  async copy(text) {
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      const box = make("textarea", { value: text, className: "explorer-live" });
      this.section.append(box);
      box.select();
      const done = document.execCommand("copy");
      box.remove();
      if (!done) { this.tell(this.say("refused"), true); return; }
    }
    this.tell(this.say("copied"), true);
  }

  // --- the address ---------------------------------------------------------------------------------------------------

  /** The controls that the address may hold, by name. */
  addressed() {
    return new Map([["seed", { name: "seed", min: 0, max: 1e9, unit: "" }],
                    ...this.controls.filter(control => control.name && !["text", "file"].includes(control.kind) && typeof control.options !== "function").map(control => [control.name, control])]);
  }

  toHash() {
    const changed = [...this.addressed().keys()].filter(name => this.s[name] !== this.defaults[name] && this.s[name] !== null);
    writeHash(this.key, changed.map(name => `${name}=${this.s[name]}`).join(","));
  }

  async copyLink() {
    this.toHash();
    const address = location.href;
    await this.copy(readHash()?.has(this.key) ? address : `${address.split("#")[0]}#${this.key}:`);
  }

  /** Take the settings from the address; true if there were any. What makes no sense is refused as a whole. */
  fromHash() {
    const part = readHash()?.get(this.key);
    if (part === undefined) return false;
    const values = {}, controls = this.addressed();
    for (const piece of part.split(",").filter(Boolean)) {
      let text = piece;
      try {
        text = decodeURIComponent(piece);
        const [name, value] = [text.slice(0, text.indexOf("=")), text.slice(text.indexOf("=") + 1)], control = controls.get(name);
        if (!control) throw new Error("no such control");
        if (control.kind === "check") {
          if (!["true", "false"].includes(value)) throw new Error("neither true nor false");
          values[name] = value === "true";
        } else if (control.kind === "select") {
          const option = control.options.find(([known]) => String(known) === value);
          if (!option) throw new Error("no such choice");
          values[name] = option[0];
        } else {
          values[name] = this.accepted(control, number(value));
        }
      } catch (error) {
        this.tell(error.outside ? error : this.say("hash", { text: text.slice(0, 60) }));
        return false;
      }
    }
    this.s = { ...this.defaults, ...values };
    this.tell(null);
    if ([...readHash().keys()][0] === this.key) requestAnimationFrame(() => this.element.scrollIntoView({ block: "start" }));
    return true;
  }

  // --- tables and the hand check -------------------------------------------------------------------------------------

  fillNumbers() {
    if (this.details.open && this.r) fillTable(this.table.firstChild || this.table.appendChild(make("table")), this.view.numbers(this.r, this.shown, this.t));
  }

  handCheck() {
    const id = `${this.id}-answer`;
    this.asks = make("p", { className: "explorer-question", id: `${id}-question` });
    this.given = make("input", { type: "text", id, inputMode: "decimal", autocomplete: "off", className: "explorer-value" });
    this.given.setAttribute("aria-describedby", `${id}-question`);
    this.verdict = make("p", { className: "explorer-verdict", role: "status" });
    const verify = make("button", { type: "submit", textContent: this.say("verify") });
    const other = this.button(this.say("other"), () => { this.asked = (this.asked + 1) | 0; this.ask(); this.given.focus(); });
    const form = make("form", { className: "explorer-check", noValidate: true },
      make("p", { className: "explorer-name", textContent: this.say("check") }), this.asks,
      make("div", { className: "explorer-buttons" }, make("label", { htmlFor: id, textContent: this.say("answer") }), this.given, verify, other), this.verdict);
    form.addEventListener("submit", event => {
      event.preventDefault();
      try {
        const value = number(this.given.value), { answer, tolerance = 0.01, hint } = this.question;
        const right = Math.abs(value - answer) <= tolerance * Math.abs(answer) + 1e-12;
        this.verdict.className = `explorer-verdict ${right ? "right" : "wrong"}`;
        this.verdict.replaceChildren(label(right ? this.say("right", { value: this.t.decimal(answer, 4) }) : hint(value)));
      } catch (error) {
        this.verdict.className = "explorer-verdict wrong";
        this.verdict.textContent = error[this.t.language] ?? error.message;
      }
    });
    return form;
  }

  ask() {
    if (!this.view.question) return;
    this.question = this.view.question(this.r, this.shown, this.t, generator(this.asked));
    if (this.asks.dataset.text === this.question.text) return;
    this.asks.dataset.text = this.question.text;
    this.asks.replaceChildren(label(this.question.text));
    this.verdict.textContent = this.given.value = "";
    this.verdict.className = "explorer-verdict";
  }
}

// What is as it should be is left alone: every change costs a layout or a style.
const setAttribute = (element, name, value) => { if (element.getAttribute(name) !== value) element.setAttribute(name, value); };
const setText = (element, text) => { if (element.textContent !== text) element.textContent = text; };
const setLabel = (element, text) => { if (element.dataset.text !== text) { element.dataset.text = text; element.replaceChildren(label(text)); } };

/** A number for a text field: no digit lost, no needless one. */
const plain = value => Math.abs(value) >= 1e6 || (value !== 0 && Math.abs(value) < 1e-4) ? value.toExponential().replace("e+", "e") : String(Number(value.toPrecision(12)));

/** Put head and rows into a table; cells that did not change are left alone. */
function fillTable(table, { head, rows }) {
  const shape = `${head.length} ${rows.length}`;
  if (table.dataset.shape !== shape) {
    table.dataset.shape = shape;
    const name = (text, scope) => text ? make("th", { scope }) : make("td");
    table.replaceChildren(make("thead", {}, make("tr", {}, ...head.map(text => name(text, "col")))),
      make("tbody", {}, ...rows.map(cells => make("tr", {}, ...cells.map((text, i) => i ? make("td") : name(text, "row"))))));
  }
  [head, ...rows].forEach((cells, i) => cells.forEach((text, j) => {
    const cell = table.rows[i].cells[j];
    if (cell.dataset.text === text) return;
    cell.dataset.text = text;
    if (i === 0 || j === 0) cell.replaceChildren(label(text)); else cell.textContent = text;
  }));
}

/** Lines of words and matrices; while their shape stays, only the numbers are renewed. A screen reader hears the line. */
function fillEquations(box, lines) {
  const leaves = [], shape = [];
  const word = text => {
    const [, base, low, high] = /^([^_^]+)(?:_([^^]+))?(?:\^(.+))?$/.exec(text) || [, text];
    const kind = /^\p{L}+$/u.test(base) ? "i" : "span";
    shape.push(`${kind}_${low || ""}^${high || ""}`);
    leaves.push(base);
    return { kind, base, low, high };
  };
  const plan = lines.map(line => {
    shape.push("/");
    return line.flatMap(part => {
      if (!part.matrix) return part.split(" ").filter(Boolean).map(word);
      shape.push(`[${part.matrix.map(row => row.length)}]`);
      return [{ columns: part.matrix[0].length, cells: part.matrix.flat().map(word) }];
    });
  });
  const key = shape.join(" ");
  if (box.dataset.shape !== key) {
    box.dataset.shape = key;
    box.leaves = [];
    const place = ({ kind, base, low, high }) => {
      const leaf = make(kind, { textContent: base });
      box.leaves.push(leaf);
      return make("span", {}, leaf, ...(low ? [make("sub", { textContent: low })] : []), ...(high ? [make("sup", { textContent: high })] : []));
    };
    box.replaceChildren(...plan.map((line, i) => {
      const row = make("div", { className: `explorer-line ${lines[i][0].startsWith?.("=") ? "more" : ""}`, role: "img" });
      row.append(...line.map(part => {
        if (!part.cells) return place(part);
        const matrix = make("span", { className: "explorer-matrix" }, ...part.cells.map(place));
        matrix.style.gridTemplateColumns = `repeat(${part.columns}, auto)`;
        return matrix;
      }));
      return row;
    }));
  } else {
    box.leaves.forEach((leaf, i) => setText(leaf, leaves[i]));
  }
  lines.forEach((line, i) => box.children[i].setAttribute("aria-label", line.map(part => part.matrix ? `[${part.matrix.map(row => row.join(" ")).join("; ")}]` : part).join(" ")));
}

/** Define the element for all papers: papers is name -> module, tables is name -> the fields of its Params. */
export function define(papers, tables) {
  customElements.define("kalman-explorer", class extends HTMLElement {
    connectedCallback() {
      if (this.explorer) return;
      const paper = this.getAttribute("paper"), views = papers[paper]?.views;
      if (!views) return;               // the picture stays
      const name = this.getAttribute("view") || Object.keys(views)[0];
      this.explorer = new Explorer(this, name === Object.keys(views)[0] ? paper : `${paper}.${name}`, tables[paper], views[name]);
    }
  });
}
