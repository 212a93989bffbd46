// The control of a phone's sensors: live, kept, replayed, handed on. A paper puts sensorControl({name})
// among its controls; s[name] is null, or a motion (recording.js) that grows while it is live. What it
// needs of the page it gets from element/controls.js: {make, makeButton, safely, saveFile, setText}. What
// listens to the sensors comes from sensors/ with the first tap.
import { InputError } from "../language/input.js";
import { whenThere } from "../language/later.js";
import { liveOf } from "../sensors/live.js";
import { rateOf, toCsv } from "../sensors/recording.js";
import { forgetRecordings, keepRecording, keptRecordings, replayed } from "./kept.js";
import { SENSORS, STATUS } from "./words.js";

const LONGEST = 120; // s
const MINUTE = 60000; // ms

/** Put a motion that is complete, or none, into the state. */
function take(explorer, { name, also }, motion) {
  explorer.change({ [name]: motion, ...also?.(motion, explorer.s) });
}

/** The readings of one control: isOn, isAsking, start(), end(), follow(). */
class Readings {
  constructor(explorer, control) {
    this.explorer = explorer;
    this.control = control;
    this.live = null; // what listens, from the first tap on
    this.isComing = false;
  }

  get isOn() {
    return Boolean(this.live?.isOn);
  }

  get isAsking() {
    return this.isComing || Boolean(this.live?.isAsking);
  }

  /** The permission is asked in the tap itself: iOS shows its question only then. */
  async start() {
    if (this.isComing) {
      return;
    }
    const allowed = askPermission();
    this.isComing = true;
    this.explorer.showControls();
    try {
      this.live ??= await whenThere(() => liveOf(this.explorer, this.control, take));
    } finally {
      this.isComing = false;
      this.explorer.showControls();
    }
    await this.live.start(allowed);
  }

  follow() {
    this.live?.follow();
  }

  end() {
    this.live?.end();
  }
}

/** One question for both events; where there is no such function, nothing needs to be asked. */
function askPermission() {
  const asked = ["DeviceMotionEvent", "DeviceOrientationEvent"].map((name) => {
    const event = window[name];
    return event?.requestPermission ? event.requestPermission() : "granted";
  });
  return Promise.allSettled(asked);
}

/**
 * seconds: how long a recording may become; also(motion or null, s) -> {name: value}: what else changes when
 * a recording ends or is chosen, or is left; example() -> motion: what is shown where there is no sensor.
 */
export function sensorControl({ name, seconds = LONGEST, ...more }) {
  return { kind: "sensor", name, seconds, default: null, build: buildSensor, ...SENSORS.name, ...more };
}

function buildSensor(explorer, control, tools) {
  const { make, setText } = tools;
  const live = new Readings(explorer, control);
  const buttons = buttonsOf(explorer, control, tools, live);
  const list = keptList(explorer, control, tools);
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
    throw new InputError(SENSORS.full);
  }
  explorer.showControls();
}

function forget(explorer) {
  forgetRecordings();
  explorer.showControls();
}

/** The recordings that are kept; the one that the reader chooses is replayed. */
function keptList(explorer, control, { make, safely }) {
  const { t } = explorer;
  const id = `${explorer.id}-${control.name}-kept`;
  const box = make("select", { id });
  const element = make("div", {}, make("label", { htmlFor: id, textContent: t.say(SENSORS.kept) }), box);
  const replay = () => {
    const motion = replayed(box.value);
    if (motion) {
      take(explorer, control, motion);
    }
  };
  box.addEventListener("change", () => safely(explorer, replay));
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
