// SPDX-License-Identifier: MIT
// The axes of a chart: round ticks, their numbers, grid lines.
import { number } from "../format.js";
import { SMALL, type Palette } from "./palette.js";

export interface Box {
  readonly left: number;
  readonly right: number;
  readonly top: number;
  readonly bottom: number;
}

export const NO_BOX: Box = { left: 0, right: 1, top: 0, bottom: 1 };

/** Round numbers 1, 2, 5 times a power of ten, about `count` of them from low to high. */
export function ticks(low: number, high: number, count: number): number[] {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const rough = span / Math.max(count, 1);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((k) => k * power >= rough) ?? 10);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  if (!(last - first < 200)) return [];
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

/** Digits that tell neighbours apart at a value so large. */
export const digitsFor = (value: number, step: number): number =>
  Math.max(3, Math.min(16, Math.ceil(Math.log10(Math.abs(value) / step + 1)) + 2));

export class Axes {
  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly colours: Palette,
    private readonly box: Box,
  ) {
    context.font = SMALL;
  }

  grid(xs: readonly number[], ys: readonly number[]): void {
    const { context, box, colours } = this;
    context.strokeStyle = colours.faint;
    context.lineWidth = 1;
    context.beginPath();
    for (const x of xs) {
      context.moveTo(Math.round(x) + 0.5, box.top);
      context.lineTo(Math.round(x) + 0.5, box.bottom);
    }
    for (const y of ys) {
      context.moveTo(box.left, Math.round(y) + 0.5);
      context.lineTo(box.right, Math.round(y) + 0.5);
    }
    context.stroke();
  }

  frame(): void {
    const { context, box, colours } = this;
    context.strokeStyle = colours.line;
    context.lineWidth = 1;
    context.strokeRect(
      Math.round(box.left) + 0.5,
      Math.round(box.top) + 0.5,
      Math.round(box.right - box.left),
      Math.round(box.bottom - box.top),
    );
  }

  /** Numbers below, at places on paper; the outermost stay inside the box. */
  below(labels: readonly (readonly [x: number, text: string])[]): void {
    const { context, box, colours } = this;
    context.fillStyle = colours.soft;
    context.textBaseline = "top";
    context.textAlign = "center";
    let end = -Infinity;
    for (const [x, text] of labels) {
      const half = context.measureText(text).width / 2;
      const centre = Math.max(box.left + half - 6, Math.min(box.right - half + 6, x));
      if (centre - half < end + 8) continue;
      context.fillText(text, centre, box.bottom + 5);
      end = centre + half;
    }
  }

  beside(labels: readonly (readonly [y: number, text: string])[]): void {
    const { context, box, colours } = this;
    context.fillStyle = colours.soft;
    context.textBaseline = "middle";
    context.textAlign = "right";
    for (const [y, text] of labels) context.fillText(text, box.left - 6, y);
  }
}

/** Labels of times on an axis from `low` to `high`, in digits that tell them apart. */
export function timeLabels(
  low: number,
  high: number,
  count: number,
  place: (t: number) => number,
): (readonly [number, string])[] {
  const times = ticks(low, high, count);
  const step = times.length > 1 ? times[1]! - times[0]! : high - low;
  return times.map((t) => {
    const value = Math.abs(t) < step / 2 ? 0 : t;
    return [place(t), number(value, digitsFor(t, step))] as const;
  });
}
