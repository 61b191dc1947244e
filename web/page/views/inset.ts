// SPDX-License-Identifier: MIT
// A curve too small for the sphere, enlarged: the momentum around its axis, with the angle that it
// stays within.
import type { Vec3 } from "polhode/core";
import { number } from "../format.js";
import type { Wobble } from "../model.js";
import { DEG } from "../vectors.js";
import { SMALL, type Palette } from "./palette.js";

const RADIUS = 42;

/** "0.2″", "3.1′", "1.2°" */
export function smallAngle(angle: number): string {
  const degrees = angle / DEG;
  if (degrees >= 1) return `${number(degrees, 3)}°`;
  if (degrees >= 1 / 60) return `${number(60 * degrees, 3)}′`;
  return `${number(3600 * degrees, 3)}″`;
}

export function inset(
  context: CanvasRenderingContext2D,
  colours: Palette,
  [x, y]: readonly [number, number],
  { axis, angle }: Wobble,
  curve: Float64Array,
  g: Vec3,
  colour: string,
): void {
  const [u, v] = [(axis + 1) % 3, (axis + 2) % 3] as [number, number];
  const size = Math.hypot(...g);
  const scale = (0.8 * RADIUS) / (size * Math.sin(angle));
  context.save();
  context.translate(x, y);
  context.beginPath();
  context.arc(0, 0, RADIUS, 0, 2 * Math.PI);
  context.fillStyle = colours.paper;
  context.fill();
  context.strokeStyle = colours.line;
  context.lineWidth = 1;
  context.stroke();
  context.beginPath();
  for (const [a, b] of [[1, 0], [0, 1]] as const) {
    context.moveTo(-6 * a, -6 * b);
    context.lineTo(6 * a, 6 * b);
  }
  context.stroke();
  context.beginPath();
  for (let i = 0; i < curve.length; i += 3) {
    context.lineTo(scale * curve[i + u]!, -scale * curve[i + v]!);
  }
  context.strokeStyle = colour;
  context.lineWidth = 2;
  context.stroke();
  context.beginPath();
  context.arc(scale * g[u]!, -scale * g[v]!, 5, 0, 2 * Math.PI);
  context.fillStyle = colours.momentum;
  context.fill();
  context.font = SMALL;
  context.fillStyle = colours.soft;
  context.textAlign = "center";
  context.fillText(`${smallAngle(angle)} from b${"₁₂₃"[axis]}`, 0, RADIUS + 14);
  context.restore();
}
