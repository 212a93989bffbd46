// The control of a phone's sensors: live, kept, replayed, handed on. A paper puts sensorControl({name})
// among its controls; s[name] is null, or a motion (recording.js) that grows while it is live. What it
// needs of the page it gets from element/controls.js: {make, makeButton, saveFile, setText}.
import { InputError } from "../language/input.js";
import { forgetRecordings, keepRecording, keptRecordings, replayed } from "./kept.js";
import { Live, take } from "./live.js";
import { rateOf, toCsv } from "./recording.js";
import { REFUSED, SENSORS, STATUS } from "./words.js";

const LONGEST = 120; // s
const MINUTE = 60000; // ms

/**
 * seconds: how long a recording may become; also(motion or null, s) -> {name: value}: what else changes when
 * a recording ends or is chosen, or is left; example() -> motion: what is shown where there is no sensor.
 */
export function sensorControl({ name, seconds = LONGEST, ...more }) {
  return { kind: "sensor", name, seconds, default: null, build: buildSensor, ...SENSORS.name, ...more };
}

function buildSensor(explorer, control, tools) {
  const { make, setText } = tools;
  const live = new Live(explorer, control);
  const buttons = buttonsOf(explorer, control, tools, live);
  const list = keptList(explorer, control, make);
  const status = make("p", { className: "explorer-hint" });
  const name = make("span", { className: "explorer-name", textContent: explorer.t.say(control) });
  const elements = buttons.map(({ element }) => element);
  const show = () => {
    live.follow();
    [...buttons, list].forEach((part) => part.show());
    setText(status, statusOf(explorer, control, live));
  };
  return { element: make("div", {}, name, ...elements, list.element, status), show, end: () => live.end() };
}

function statusOf({ s, t }, { name }, { isAsking }) {
  const motion = s[name];
  const stays = t.say(STATUS.private);
  if (!motion) {
    return `${t.say(isAsking ? STATUS.asking : STATUS.synthetic)} ${stays}`;
  }
  const has_compass = motion.heading.some((value) => !Number.isNaN(value));
  const values = {
    seconds: t.decimal(Math.round(motion.t[motion.T - 1])),
    rate: t.decimal(Math.round(rateOf(motion))),
    compass: t.say(has_compass ? STATUS.compass : STATUS.no_compass),
  };
  return `${t.say(STATUS[kindOf(motion)], values)} ${stays}`;
}

function kindOf({ live, synthetic }) {
  if (synthetic) {
    return "example";
  }
  return live ? "live" : "recorded";
}

/** [{element, show()}, ...]: the first one starts and stops, the others are there when there is something. */
function buttonsOf(explorer, control, { makeButton, saveFile, setText }, live) {
  const { t } = explorer;
  const { name } = control;
  const main = makeButton(explorer, t.say(SENSORS.start), () => (live.isOn ? live.end() : live.start()));
  const showMain = () => setText(main, t.say(live.isOn ? SENSORS.stop : SENSORS.start));
  const isDone = () => Boolean(explorer.s[name]) && !live.isOn;
  const isOwn = () => isDone() && !explorer.s[name].synthetic;
  const later = [
    [SENSORS.back, isDone, () => take(explorer, control, null)],
    [SENSORS.keep, isOwn, () => keep(explorer, explorer.s[name])],
    [SENSORS.save, isDone, () => saveFile(fileOf(explorer.s[name], t))],
    [SENSORS.forget, () => keptRecordings().length > 0, () => forget(explorer)],
  ];
  const parts = later.map(([words, isShown, react]) => {
    const element = makeButton(explorer, t.say(words), react);
    const show = () => {
      element.hidden = !isShown();
    };
    return { element, show };
  });
  return [{ element: main, show: showMain }, ...parts];
}

function fileOf(motion, { language }) {
  const name = motion.synthetic ? "sensors-synthetic.csv" : "sensors.csv";
  return { name, type: "text/csv;charset=utf-8", content: toCsv(motion, language) };
}

function keep(explorer, motion) {
  if (!keepRecording(motion, localTime())) {
    throw new InputError(REFUSED.full);
  }
  explorer.showControls();
}

function forget(explorer) {
  forgetRecordings();
  explorer.showControls();
}

/** The recordings that are kept; the one that the reader chooses is replayed. */
function keptList(explorer, control, make) {
  const { t } = explorer;
  const id = `${explorer.id}-${control.name}-kept`;
  const box = make("select", { id });
  const element = make("div", {}, make("label", { htmlFor: id, textContent: t.say(SENSORS.kept) }), box);
  box.addEventListener("change", () => {
    const motion = replayed(box.value);
    if (motion) {
      take(explorer, control, motion);
    }
  });
  let shown = "";
  const show = () => {
    const kept = keptRecordings();
    element.hidden = kept.length === 0;
    if (shown === JSON.stringify(kept)) {
      return;
    }
    shown = JSON.stringify(kept);
    const options = kept.map(({ when, seconds }) => {
      const textContent = `${when.slice(0, 16)}, ${seconds} s`;
      return make("option", { value: when, textContent });
    });
    box.replaceChildren(make("option", { value: "", textContent: t.say(SENSORS.none) }), ...options);
  };
  return { element, show };
}

/** "2026-11-28 14:03:07.125", as clocks show it where the reader is. */
function localTime() {
  const now = new Date();
  const shifted = now.getTime() - MINUTE * now.getTimezoneOffset();
  return new Date(shifted).toISOString().slice(0, 23).replace("T", " ");
}
