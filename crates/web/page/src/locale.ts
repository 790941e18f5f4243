// uPlot formats numbers by the browser's language when it is loaded. A browser that was started with LANG=C has one that isn't any.
try {
  new Intl.NumberFormat(navigator.language);
} catch {
  Object.defineProperty(navigator, "language", { value: "en" });
}
