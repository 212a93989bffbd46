// The control of a phone's sensors: live, kept, replayed, handed on. A paper puts sensorControl({name})
// among its controls; s[name] is null, or a motion (recording.js) that grows while it is live. What it
// needs of the page it gets from element/controls.js: {make, makeButton, saveFile, setText}.
import { InputError } from "../language/input.js";
import { forgetRecordings, keepRecording, keptRecordings, replayed } from "./kept.js";
import { Live } from "./live.js";
import { rateOf, toCsv } from "./recording.js";
import { REFUSED, SENSORS, STATUS } from "./words.js";

const LONGEST = 120; // s

/** seconds: how long a recording may become. */
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
  return `${t.say(motion.live ? STATUS.live : STATUS.recorded, values)} ${stays}`;
}

/** [{element, show()}, ...]: the first one starts and stops, the others are there when there is something. */
function buttonsOf(explorer, { name }, { makeButton, saveFile, setText }, live) {
  const { t } = explorer;
  const main = makeButton(explorer, t.say(SENSORS.start), () => (live.isOn ? live.end() : live.start()));
  const showMain = () => setText(main, t.say(live.isOn ? SENSORS.stop : SENSORS.start));
  const isDone = () => Boolean(explorer.s[name]) && !live.isOn;
  const later = [
    [SENSORS.back, isDone, () => explorer.change({ [name]: null })],
    [SENSORS.keep, isDone, () => keep(explorer, explorer.s[name])],
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
  return { name: "sensors.csv", type: "text/csv;charset=utf-8", content: toCsv(motion, language) };
}

function keep(explorer, motion) {
  if (!keepRecording(motion, new Date().toISOString())) {
    throw new InputError(REFUSED.full);
  }
  explorer.showControls();
}

function forget(explorer) {
  forgetRecordings();
  explorer.showControls();
}

/** The recordings that are kept; the one that the reader chooses is replayed. */
function keptList(explorer, { name }, make) {
  const { t } = explorer;
  const id = `${explorer.id}-${name}-kept`;
  const box = make("select", { id });
  const element = make("div", {}, make("label", { htmlFor: id, textContent: t.say(SENSORS.kept) }), box);
  box.addEventListener("change", () => {
    const motion = replayed(box.value);
    if (motion) {
      explorer.change({ [name]: motion });
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
      const textContent = t.say(SENSORS.slot, { when: localTime(when), seconds });
      return make("option", { value: when, textContent });
    });
    box.replaceChildren(make("option", { value: "", textContent: t.say(SENSORS.none) }), ...options);
  };
  return { element, show };
}

/** "2026-11-28 14:03" where the reader is. */
function localTime(when) {
  const time = new Date(when);
  const two = (number) => String(number).padStart(2, "0");
  const day = [time.getFullYear(), two(time.getMonth() + 1), two(time.getDate())].join("-");
  return `${day} ${two(time.getHours())}:${two(time.getMinutes())}`;
}
