// The controls of the workshop. They come in five groups, one at a time: that is enough for a small screen.
import { ownControls } from "../../own/data.js";
import { sensorControl } from "../../own/phone.js";
import { columnNames, isOwn, isTimed } from "./table.js";
import { columnsUsed, patternFor, startingNoise, usesSecond } from "./data.js";
import { START_F, START_H, readMatrices } from "./matrices.js";
import { PATTERN, SECOND } from "./model.js";
import { readyToTake, takeAway, takeWorkbook } from "./take.js";
import { CONTROLS, GROUPS, PATTERNS, SECONDS } from "./words.js";

const GROUP_NAMES = ["data", "motion", "noise", "check", "take"];
const LEAST_NOISE = 1e-9; // the range of Params
const MOST_NOISE = 1e9;

/** Only where its group is open, and `also` holds. */
function inGroup(group, also = () => true) {
  return (s, r) => s.group === group && also(s, r);
}

const isOwnPattern = (s) => s.pattern === PATTERN.OWN;
const isMadeUp = (s) => !isOwn(s);

const groups = {
  kind: "buttons",
  tabs: true,
  items: GROUP_NAMES.map((group) => ({
    ...GROUPS[group],
    set: { group },
    pressed: (s) => s.group === group,
  })),
};

// --- data --------------------------------------------------------------------------------------------------

/** Does the filter that is set use a second column? */
function wantsSecond(s) {
  return usesSecond(s, isOwnPattern(s) ? rowsOfH(s) : 1);
}

function wantsThird(s) {
  return columnsUsed(s, 1) > 2;
}

function rowsOfH(s) {
  try {
    return readMatrices(s.F, s.H).H.length;
  } catch {
    return 1; // the message speaks of it
  }
}

/** What the reader brings, as in chapters 2 and 4, and which columns of it are used. */
const brought = ownControls({
  words: { text: CONTROLS.text, placeholder: CONTROLS.placeholder, value: CONTROLS.value },
  visible: (s) => isOwn(s) && !s.motion,
  also: { motion: null, value2: "", value3: "", likely: true }, // what suits made-up data suits no other
  time: true,
}).map((control) => ({ ...control, visible: inGroup("data", control.visible) }));

/** A choice of one of the columns. */
function columnChoice(name, first, visible) {
  return {
    kind: "select",
    name,
    default: "",
    ...CONTROLS[name],
    visible: inGroup("data", visible),
    options: (s) => [["", first], ...columnNames(s).map((column) => [column, { id: column, en: column }])],
  };
}

/** What a column is multiplied by. */
function factorOf(name, visible) {
  const range = { field: true, default: 1, min: -1e9, max: 1e9, step: 0.01 };
  return { name, ...CONTROLS[name], ...range, visible: inGroup("data", visible) };
}

const dataControls = [
  ...brought,
  sensorControl({ name: "motion", visible: inGroup("data", (s) => Boolean(s.motion) || isMadeUp(s)) }),
  columnChoice("axis", CONTROLS.first_axis, (s) => Boolean(s.motion)),
  columnChoice("value2", CONTROLS.next_column, (s) => isOwn(s) && wantsSecond(s)),
  factorOf("factor", (s) => isOwn(s) && wantsSecond(s)),
  columnChoice("value3", CONTROLS.next_column, (s) => isOwn(s) && wantsThird(s)),
  factorOf("factor3", (s) => isOwn(s) && wantsThird(s)),
  {
    name: "dt",
    symbol: "Δt",
    min: 0.01,
    max: 100,
    visible: inGroup("data", (s) => !isOwnPattern(s) && !isTimed(s)),
  },
  {
    kind: "buttons",
    items: [{ ...CONTROLS.back, set: { motion: null, text: null, file: null, likely: false } }],
    visible: inGroup("data", isOwn),
  },
  {
    kind: "buttons",
    items: [{ ...CONTROLS.new_noise, set: (s) => ({ seed: s.seed + 1 }) }],
    visible: inGroup("data", isMadeUp),
  },
];

/** Does another sensor stand in the second column? */
function isSecondSensor({ second }) {
  return second !== SECOND.NONE && second !== SECOND.DRIVES;
}

// --- motion ------------------------------------------------------------------------------------------------

const motionControls = [
  {
    kind: "select",
    name: "pattern",
    ...CONTROLS.pattern,
    options: Object.values(PATTERN).map((pattern) => [pattern, PATTERNS[pattern]]),
    also: (pattern, s) => (isOwn(s) ? { likely: true } : startingNoise(pattern)),
    visible: inGroup("motion"),
  },
  {
    kind: "text",
    name: "F",
    rows: 2,
    kept: true,
    default: START_F,
    ...CONTROLS.F,
    visible: inGroup("motion", isOwnPattern),
  },
  {
    kind: "text",
    name: "H",
    rows: 2,
    kept: true,
    default: START_H,
    ...CONTROLS.H,
    visible: inGroup("motion", isOwnPattern),
  },
  {
    kind: "select",
    name: "second",
    ...CONTROLS.second,
    options: Object.values(SECOND).map((second) => [second, SECONDS[second]]),
    also(second, s) {
      const pattern = patternFor(second, s.pattern);
      return pattern === s.pattern ? {} : { pattern, ...startingNoise(pattern) };
    },
    visible: inGroup("motion", (s) => !isOwnPattern(s)),
  },
  {
    kind: "select",
    name: "bias",
    ...CONTROLS.bias,
    options: [
      [0, CONTROLS.without_bias],
      [1, CONTROLS.with_bias],
    ],
    visible: inGroup("motion", (s) => !isOwnPattern(s) && s.second !== SECOND.NONE),
  },
  {
    kind: "select",
    name: "third",
    ...CONTROLS.third,
    options: [
      [0, SECONDS[SECOND.NONE]],
      [1, SECONDS[SECOND.DRIVES]],
    ],
    visible: inGroup("motion", (s) => !isOwnPattern(s) && isSecondSensor(s)),
  },
];

// --- noise -------------------------------------------------------------------------------------------------

/** Where the filter starts, after what its states are. */
const startControls = ["first_x", "first_P"].map((name) => ({
  kind: "text",
  name,
  rows: 1,
  kept: true,
  default: "",
  ...CONTROLS[name],
  visible: inGroup("motion"),
}));

/** The most likely noise, as the sliders can hold it. */
function keep(s, { found }) {
  const values = Object.entries(found?.values ?? {}).map(([name, value]) => {
    const inside = Math.min(Math.max(value, LEAST_NOISE), MOST_NOISE);
    return [name, Number(inside.toPrecision(4))];
  });
  return values.length > 0 ? { likely: false, ...Object.fromEntries(values) } : {};
}

const byHand = (s) => !s.likely;
const noiseControls = [
  {
    kind: "select",
    name: "likely",
    default: false,
    ...CONTROLS.likely,
    options: [
      [false, CONTROLS.by_hand],
      [true, CONTROLS.most_likely],
    ],
    visible: inGroup("noise"),
  },
  {
    name: "q",
    symbol: "q",
    visible: inGroup("noise", (s) => byHand(s) && s.pattern !== PATTERN.CONSTANT),
  },
  { name: "R", symbol: "R", visible: inGroup("noise", byHand) },
  {
    name: "R2",
    symbol: "R_2",
    visible: inGroup("noise", (s, r) => byHand(s) && r?.data.m > 1),
  },
  {
    kind: "buttons",
    items: [{ ...CONTROLS.keep, set: keep }],
    visible: inGroup("noise", (s) => s.likely),
  },
];

// --- check, and take along ---------------------------------------------------------------------------------

const checkControls = [
  { kind: "check", name: "gate", default: false, ...CONTROLS.gate, visible: inGroup("check") },
  { kind: "check", name: "average", default: false, ...CONTROLS.average, visible: inGroup("check") },
  {
    name: "window",
    symbol: "n",
    ...CONTROLS.window,
    default: 10,
    min: 2,
    max: 50,
    step: 1,
    visible: inGroup("check", (s) => s.average),
  },
  { kind: "check", name: "dirty", default: false, ...CONTROLS.dirty, visible: inGroup("check", isMadeUp) },
  { kind: "check", name: "hole", default: false, ...CONTROLS.hole, visible: inGroup("check", isMadeUp) },
];

const takeControls = [
  { kind: "buttons", items: takeAway, prepare: readyToTake, visible: inGroup("take") },
  {
    kind: "buttons",
    items: [takeWorkbook],
    visible: inGroup("take", (s, r) => r?.result.n === 1 && r.data.m === 1),
  },
];

export const controls = [
  groups,
  ...dataControls,
  ...motionControls,
  ...startControls,
  ...noiseControls,
  ...checkControls,
  ...takeControls,
];
