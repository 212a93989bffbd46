// What the explorer of the toy paper says.
export const NAME = { id: "Botol di atas timbangan", en: "A bottle on a scale" };
export const CONTROLS = { flow: { id: "debit keran", en: "flow of the tap" } };
export const HEAD = ["t (s)", "z (kg)", "x (kg)", "K"];
export const LABELS = { truth: "x_true", z: "z", x: "x" };
export const OUTCOME = {
  id: "Setelah satu menit isi botol {mass} kg, dengan simpangan baku {sigma} kg.",
  en: "After a minute the bottle holds {mass} kg, with a standard deviation of {sigma} kg.",
};
export const PLOT = {
  title: { id: "Massa (kg)", en: "Mass (kg)" },
  alt: {
    id: "Massa botol terhadap waktu: pengukuran, nilai sebenarnya, dan estimasi dengan pitanya.",
    en: "Mass of the bottle over time: measurements, the true value, and the estimate with its band.",
  },
};
