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
      "Rumus galat makalah berkata lain: untuk {axis} sensor saja {z} %, filter {x} %, " +
      "padahal filterlah yang lebih {near} sudut sebenarnya.",
    en:
      "The paper’s error formula says otherwise: for {axis} the sensor alone {z} %, the filter {x} %, " +
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
  galat_z: { id: "galat makalah, sensor saja (%)", en: "the paper’s error, sensors alone (%)" },
  galat: { id: "galat makalah, filter ini (%)", en: "the paper’s error, this filter (%)" },
  truth: { id: "rata-rata sudut sebenarnya (°)", en: "mean of the true angle (°)" },
  mean: { id: "rata-rata filter ini (°)", en: "mean of this filter (°)" },
};

export const CONTROLS = {
  method: { id: "Cara", en: "Method" },
  paper: { id: "makalah, dibetulkan", en: "the paper, corrected" },
  adaptive: { id: "adaptif", en: "adaptive" },
  literal: { id: "persis seperti tercetak", en: "to the letter of the paper" },
  recording: {
    id: "Rekaman sendiri (CSV, ZIP, atau Excel; tetap di komputer ini)",
    en: "A recording of my own (CSV, ZIP or Excel; it stays on this computer)",
  },
  back: { id: "Kembali ke penerbangan sintetis", en: "Back to the synthetic flight" },
  moment: { id: "saat yang digambar", en: "the moment that is drawn" },
  fly: { id: "Terbangkan", en: "Fly" },
  gyr: { id: "giroskop dipakai", en: "gyroscope in use" },
  acc: { id: "akselerometer dipakai", en: "accelerometer in use" },
  mag: { id: "magnetometer dipakai", en: "magnetometer in use" },
  larger: {
    id: "kemiringan wahana digambar 5 kali lebih besar",
    en: "tilt of the craft drawn 5 times as large",
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
  title: { id: "Wahana", en: "The craft" },
  alt: {
    id:
      "Wahana dilihat dari selatan dan dari atas: estimasi tebal, sudut sebenarnya tipis, " +
      "panahnya hidung.",
    en:
      "The craft seen from the south and from above: estimate thick, true angles thin, " +
      "the arrow is its nose.",
  },
};

/** North, east, south, west. */
export const COMPASS = { id: "UTSB", en: "NESW" };
