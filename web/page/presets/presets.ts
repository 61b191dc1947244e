// SPDX-License-Identifier: MIT
// What the list at the top of the page has.
import { BODIES } from "./bodies.js";
import { FIGURES } from "./figures.js";
import type { Preset } from "./starts.js";

export const PRESETS: readonly Preset[] = [...BODIES, ...FIGURES];

export const preset = (id: string): Preset => {
  const found = PRESETS.find((p) => p.id === id);
  if (!found) throw new Error(`preset: no "${id}"`);
  return found;
};
