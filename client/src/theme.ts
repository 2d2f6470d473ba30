// Dark or light: as it was left, or as the system is.

export type Theme = "dark" | "light";

const KEY = "pdeface.studio.1.theme";

export function theme(): Theme {
  const kept = localStorage.getItem(KEY);
  if (kept === "dark" || kept === "light") return kept;
  return matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
}

export function setTheme(value: Theme): void {
  document.documentElement.dataset.theme = value;
  localStorage.setItem(KEY, value);
}
