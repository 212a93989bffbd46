// What the control of a phone's sensors says.

export const SENSORS = {
  name: { id: "Sensor ponsel ini", en: "This phone's sensors" },
  start: { id: "Pakai sensor ponsel ini", en: "Use this phone's sensors" },
  stop: { id: "Berhenti", en: "Stop" },
  back: { id: "Kembali ke data sintetis", en: "Back to the synthetic data" },
  keep: { id: "Simpan di ponsel ini", en: "Keep on this phone" },
  forget: { id: "Hapus simpanan", en: "Forget what is kept" },
  save: { id: "Unduh CSV", en: "Download CSV" },
  kept: { id: "Putar ulang simpanan", en: "Replay a kept recording" },
  none: { id: "pilih", en: "choose" },
  slot: { id: "{when}, {seconds} s", en: "{when}, {seconds} s" },
};

export const STATUS = {
  private: {
    id: "Bacaan sensor tetap di alat ini; tidak ada yang dikirim.",
    en: "The readings stay on this device; nothing is sent.",
  },
  synthetic: { id: "Gambar ini memakai data sintetis.", en: "The figure shows synthetic data." },
  asking: { id: "Menunggu bacaan pertama.", en: "Waiting for the first reading." },
  live: {
    id: "Langsung: {seconds} s, {rate} bacaan per detik, {compass}.",
    en: "Live: {seconds} s, {rate} readings a second, {compass}.",
  },
  recorded: {
    id: "Rekaman: {seconds} s, {rate} bacaan per detik, {compass}.",
    en: "Recorded: {seconds} s, {rate} readings a second, {compass}.",
  },
  compass: { id: "dengan kompas", en: "with a compass" },
  no_compass: { id: "tanpa kompas", en: "without a compass" },
};

export const REFUSED = {
  insecure: {
    id:
      "Peramban memberikan bacaan sensor hanya kepada halaman https. " +
      "Bukalah halaman ini lewat https. Untuk sementara gambarnya memakai data sintetis.",
    en:
      "A browser gives sensor readings to https pages only. " +
      "Open this page over https. Until then the figure shows synthetic data.",
  },
  none: {
    id: "Alat ini tidak punya giroskop dan akselerometer. Gambarnya memakai data sintetis.",
    en: "This device has no gyroscope and accelerometer. The figure shows synthetic data.",
  },
  denied: {
    id:
      "Izin membaca sensor ditolak. Izinkan sensor gerak di pengaturan situs, lalu coba lagi. " +
      "Untuk sementara gambarnya memakai data sintetis.",
    en:
      "Reading the sensors was not allowed. " +
      "Allow motion sensors in the settings of the site and try again. " +
      "Until then the figure shows synthetic data.",
  },
  full: {
    id: "Peramban menolak menyimpan rekaman ini. Unduhlah sebagai CSV.",
    en: "The browser refused to keep this recording. Download it as CSV.",
  },
};
