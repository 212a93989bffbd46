// What the explorer of chapter 6 says.

export const NAME = { id: "Sikap quadrotor", en: "The attitude of the quadrotor" };

export const OUTCOME = {
  made: {
    id: "Penerbangan sintetis (benih acak {seed}).",
    en: "The flight is synthetic (random seed {seed}).",
  },
  rmse: {
    id:
      "RMSE terhadap {reference}: roll {roll}°, pitch {pitch}°, yaw {yaw}°; " +
      "sensor saja {z_roll}°, {z_pitch}°, {z_yaw}°.",
    en:
      "RMSE against {reference}: roll {roll}°, pitch {pitch}°, yaw {yaw}°; " +
      "the sensors alone {z_roll}°, {z_pitch}°, {z_yaw}°.",
  },
  truth: { id: "sudut sebenarnya", en: "the true angles" },
  device: { id: "sudut dari alat itu sendiri", en: "the device's own angles" },
  nothing: {
    id: "Rekaman ini tidak memuat sudut pembanding.",
    en: "This recording holds no reference angles.",
  },
  lies: {
    id:
      "Galat makalah berkata lain: {axis} sensor saja {z}%, filter {x}%, " +
      "padahal filterlah yang lebih {near} sudut sebenarnya.",
    en:
      "The paper’s error says otherwise: {axis}, the sensor alone {z}%, the filter {x}%, " +
      "although it is the filter that is {near} the true angle.",
  },
  closer: { id: "dekat ke", en: "closer to" },
  farther: { id: "jauh dari", en: "farther from" },
  no_mag: {
    id: "Tanpa magnetometer, yaw dimulai dari 0 dan hanya giroskop yang memutarnya.",
    en: "Without the magnetometer the yaw starts at 0 and only the gyroscope turns it.",
  },
  no_turn: {
    id: "Tanpa magnetometer dan giroskop, yaw tetap 0.",
    en: "Without magnetometer and gyroscope the yaw stays 0.",
  },
  fixed: {
    id: "Pada cara adaptif m, q, jendela, dan ambang tidak dipakai.",
    en: "The adaptive method uses neither m, q, window nor threshold.",
  },
  steep: {
    id: "Pitch mencapai {steep}°: di atas 75° sudut Euler gagal.",
    en: "The pitch reaches {steep}°: beyond 75° Euler angles fail.",
  },
};

export const FACTS = {
  rmse_z: { id: "RMSE sensor saja (°)", en: "RMSE of the sensors alone (°)" },
  rmse: { id: "RMSE filter ini (°)", en: "RMSE of this filter (°)" },
  galat: { id: "galat makalah, filter ini (%)", en: "the paper’s error, this filter (%)" },
};

/** What the reader may have drawn. */
export const SHOWN = {
  roll: { id: "roll (guling)", en: "roll" },
  pitch: { id: "pitch (angguk)", en: "pitch" },
  yaw: { id: "yaw (geleng)", en: "yaw" },
  all: { id: "ketiganya", en: "all three" },
};

export const CONTROLS = {
  shown: { id: "Sudut", en: "Angle" },
  method: { id: "Cara", en: "Method" },
  paper: { id: "makalah yang dibetulkan", en: "the paper corrected" },
  adaptive: { id: "adaptif", en: "adaptive" },
  literal: { id: "persis seperti tercetak", en: "exactly as printed" },
  recording: {
    id: "Rekaman sendiri (CSV, ZIP, atau Excel; tetap di perangkat ini)",
    en: "A recording of my own (CSV, ZIP or Excel; it stays on this device)",
  },
  axes: { id: "Sumbu alat", en: "Axes of the device" },
  frames: {
    "": { id: "menurut berkasnya", en: "as the file suggests" },
    phone: { id: "ponsel: x kanan, y tepi atas, z keluar", en: "phone: x right, y top edge, z out" },
    flu: { id: "x depan, y kiri, z atas", en: "x forward, y left, z up" },
    frd: { id: "x depan, y kanan, z bawah", en: "x forward, y right, z down" },
  },
  back: { id: "Kembali ke penerbangan sintetis", en: "Back to the synthetic flight" },
  moment: { id: "saat yang digambar", en: "the moment that is drawn" },
  fly: { id: "Terbangkan", en: "Fly" },
  gyr: { id: "giroskop dipakai", en: "gyroscope in use" },
  acc: { id: "akselerometer dipakai", en: "accelerometer in use" },
  mag: { id: "magnetometer dipakai", en: "magnetometer in use" },
  larger: {
    id: "kemiringan digambar 5 kali lebih besar",
    en: "tilt drawn 5 times as large",
  },
};

/** Of roll, pitch and yaw. */
export const PANEL_TITLES = [
  { id: "Roll, guling (°)", en: "Roll (°)" },
  { id: "Pitch, angguk (°)", en: "Pitch (°)" },
  { id: "Yaw, geleng (°)", en: "Yaw (°)" },
];

export const PANEL_ALT = {
  id: "Grafik {axis} terhadap waktu: titik pengukuran, garis sebenarnya, dan garis estimasi.",
  en: "Plot of the {axis} against time: measured dots, the true line and the estimated line.",
};

export const CRAFT = {
  title: { id: "Quadrotor", en: "The quadrotor" },
  alt: {
    id:
      "Quadrotor dilihat dari selatan dan dari atas: estimasi tebal, sudut sebenarnya tipis, " +
      "panahnya hidung.",
    en:
      "The quadrotor seen from the south and from above: estimate thick, true angles thin, " +
      "the arrow is its nose.",
  },
};

/** North, east, south, west. */
export const COMPASS = { id: "UTSB", en: "NESW" };

// --- the first explorer: one axis in the hand --------------------------------------------------------------

export const TILT = {
  name: { id: "Quadrotor di tangan, satu sumbu", en: "The quadrotor in the hand, one axis" },
  gyro: { id: "giroskop saja", en: "gyroscope alone" },
  acc: { id: "akselerometer saja", en: "accelerometer alone" },
  filter: { id: "filter, x", en: "filter, x" },
  craft: {
    title: { id: "Dari belakang", en: "From behind" },
    alt: {
      id:
        "Quadrotor dari belakang pada satu saat: yang sebenarnya tipis, dan tiga yang berwarna menurut " +
        "giroskop, akselerometer, dan filter.",
      en:
        "The quadrotor from behind at one moment: the true one thin, and three coloured ones by the " +
        "gyroscope, the accelerometer and the filter.",
    },
  },
  angles: {
    title: { id: "Sudut (°)", en: "Angle (°)" },
    alt: {
      id:
        "Roll selama 20 detik: yang sebenarnya, giroskop saja, akselerometer saja, dan filter; " +
        "pita menandai detik ketika quadrotor didorong. Dari ponsel sendiri: sudut yang dipilih.",
      en:
        "Roll over 20 seconds: the true one, the gyroscope alone, the accelerometer alone and the " +
        "filter; a band marks the second in which the quadrotor is pushed. " +
        "Of our own phone: the chosen angle.",
    },
  },
  all: {
    id: "RMSE selama 20 s: giroskop saja {gyro}°, akselerometer saja {z}°, filter {filter}°.",
    en: "RMSE over 20 s: gyroscope alone {gyro}°, accelerometer alone {z}°, filter {filter}°.",
  },
  now: {
    id: "Pada t = {when} s roll sebenarnya {x}°; giroskop {gyro}°, akselerometer {z}°, filter {filter}°.",
    en: "At t = {when} s the true roll is {x}°; gyroscope {gyro}°, accelerometer {z}°, filter {filter}°.",
  },
  gain: {
    id: "Dengan R = {R} penguatan K menetap di {K}. Gerak ini sintetis.",
    en: "With R = {R} the gain K settles at {K}. The motion is synthetic.",
  },
};

export const TILT_CONTROLS = {
  R_acc: {
    id: "varians akselerometer menurut filter",
    en: "variance of the accelerometer, as the filter believes",
  },
  when: { id: "saat yang digambar", en: "the moment that is drawn" },
  push: { id: "dorongan ke kiri", en: "push to the left" },
  held: { id: "dimiringkan sampai", en: "tilted as far as" },
};

// --- the reader's own phone --------------------------------------------------------------------------------

export const PHONE = {
  compass: { id: "kompas", en: "compass" },
  use_compass: { id: "kompas dipakai", en: "compass in use" },
  play: { id: "Putar ulang", en: "Replay" },
  ghosts: {
    title: { id: "Tiga pendapat tentang ponsel", en: "Three opinions of the phone" },
    alt: {
      id: "Tiga ponsel dilihat dari belakang dan atas: menurut giroskop, akselerometer, dan filter.",
      en: "Three outlines of a phone from behind and above: by gyroscope, accelerometer and filter.",
    },
  },
  instruments: {
    title: { id: "Waterpas dan kompas", en: "Level and compass" },
    alt: {
      id: "Waterpas dengan tiga gelembung dan kompas dengan jarumnya, berwarna seperti ketiga pendapat.",
      en: "A level with three bubbles and a compass with its needles, coloured like the three opinions.",
    },
  },
  now: {
    id:
      "Pada t = {when} s roll menurut giroskop {gyro_roll}°, akselerometer {acc_roll}°, " +
      "filter {filter_roll}°; pitch {gyro_pitch}°, {acc_pitch}°, {filter_pitch}°.",
    en:
      "At t = {when} s the roll is {gyro_roll}° by the gyroscope, {acc_roll}° by the accelerometer, " +
      "{filter_roll}° by the filter; the pitch {gyro_pitch}°, {acc_pitch}°, {filter_pitch}°.",
  },
  gain: { id: "Dengan R = {R} penguatannya K = {K}.", en: "With R = {R} the gain is K = {K}." },
  synthetic: { id: "Rekaman ini sintetis.", en: "This recording is synthetic." },
  no_compass: {
    id: "Tanpa kompas, yaw dimulai dari 0 dan hanya giroskop yang memutarnya.",
    en: "Without a compass the yaw starts at 0, and only the gyroscope turns it.",
  },
};
