// SPDX-License-Identifier: MIT
// Curves that sphere and plane have in common, what they are drawn with, and the mark of the body with
// torques.
import { polhodes, separatrix, type Curve } from "polhode/core";
import type { Explorer } from "../explorer.js";
import { frictionPath, type Model } from "../model.js";
import type { Palette } from "./palette.js";

export const TAIL = 256; // samples behind the momentum of the body with torques

/** What a kind of curve is drawn with. */
export function look(mode: Curve["mode"], colours: Palette) {
  if (mode === "separatrix") return { colour: colours.sep, dash: [], width: 2 };
  if (mode === "long_axis") return { colour: colours.lam, dash: [5, 3], width: 1.2 };
  return { colour: colours.sam, dash: [], width: 1.1 };
}

/** Where the body with torques is: hollow, the free one is full. */
export function ring(
  context: CanvasRenderingContext2D,
  colours: Palette,
  [x, y, depth = 1]: readonly [x: number, y: number, depth?: number],
): void {
  context.globalAlpha = depth >= 0 ? 1 : 0.5;
  context.beginPath();
  context.arc(x, y, 5.5, 0, 2 * Math.PI);
  context.fillStyle = colours.paper;
  context.fill();
  context.lineWidth = 2.4;
  context.strokeStyle = colours.sun;
  context.stroke();
  context.globalAlpha = 1;
}

/** The family of a body, kept: dragging changes the state a hundred times, never these. */
const families = new Map<string, readonly Curve[]>();
export function familyOf(model: Model): readonly Curve[] {
  const key = model.body.moments.join();
  let family = families.get(key);
  if (!family) {
    family = [...polhodes(model.body, 1, 5, 145), ...separatrix(model.body, 1, 97)];
    if (families.size > 40) families.clear();
    families.set(key, family);
  }
  return family;
}

/** The path under friction, kept as long as the motion is the same. */
let drifted: { model: Model; path: Float64Array } | null = null;
export function frictionOf({ model, scene }: Explorer): Float64Array | null {
  if (!scene.friction || !(model.motion.momentum > 0)) return null;
  if (drifted?.model !== model) drifted = { model, path: frictionPath(model) };
  return drifted.path;
}
