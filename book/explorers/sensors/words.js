// Why the sensors of a phone cannot be read.

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
};
