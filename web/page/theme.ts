// SPDX-License-Identifier: MIT
// Light or dark: as the system says, until the reader says otherwise.
const KEY = "polhode-theme";

function kept(): string | null {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

export function theme(changed: () => void): void {
  const root = document.documentElement;
  const system = window.matchMedia("(prefers-color-scheme: dark)");
  const button = document.getElementById("theme")!;
  const apply = () => {
    root.dataset["theme"] = kept() ?? (system.matches ? "dark" : "light");
    button.setAttribute("aria-pressed", String(root.dataset["theme"] === "dark"));
    changed();
  };
  system.addEventListener("change", apply);
  button.addEventListener("click", () => {
    const next = root.dataset["theme"] === "dark" ? "light" : "dark";
    try {
      localStorage.setItem(KEY, next);
    } catch {
      // Kept for this visit only.
    }
    root.dataset["theme"] = next;
    button.setAttribute("aria-pressed", String(next === "dark"));
    changed();
  });
  apply();
}
