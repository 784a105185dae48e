// Light or dark: what the system prefers, until the person says otherwise.

import type { Store, Theme } from "./state.js";

export function preferredTheme(): Theme {
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

export function keepTheme(store: Store, button: HTMLElement): void {
  let isChosen = false;
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    if (!isChosen) store.set({ theme: preferredTheme() });
  });
  button.addEventListener("click", () => {
    isChosen = true;
    store.set({ theme: store.state.theme === "dark" ? "light" : "dark" });
  });
  applyTheme(store.state.theme);
  store.subscribe((changes) => {
    if (changes.has("theme")) applyTheme(store.state.theme);
  });
}

export function applyTheme(theme: Theme): void {
  document.documentElement.dataset["theme"] = theme;
}
