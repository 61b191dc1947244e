// SPDX-License-Identifier: MIT
// A canvas that fills its pane, sharp on any screen, and what all views have in common.
import type { Change, Explorer } from "../explorer.js";
import { palette, SYMBOL, type Palette } from "./palette.js";

export interface View {
  readonly canvas: HTMLCanvasElement;
  /** Something changed; what is kept between pictures may be stale. */
  changed(change: Change | "theme" | "size", explorer: Explorer): void;
  draw(explorer: Explorer): void;
}

export class Sheet {
  readonly context: CanvasRenderingContext2D;
  width = 0;
  height = 0;
  colours: Palette = palette();

  constructor(readonly canvas: HTMLCanvasElement) {
    // Drawn by the processor: lines of a thousand points, dashed ones most, cost more than the whole
    // page where a graphics card is slow or missing.
    this.context = canvas.getContext("2d", { willReadFrequently: true })!;
    this.fit();
  }

  /** The size of the canvas on the page; true where it changed. */
  fit(): boolean {
    const ratio = Math.min(window.devicePixelRatio || 1, 2.5);
    const { clientWidth, clientHeight } = this.canvas;
    const [width, height] = [Math.round(clientWidth * ratio), Math.round(clientHeight * ratio)];
    this.colours = palette();
    const same = this.canvas.width === width && this.canvas.height === height;
    if (!same) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
    this.width = clientWidth;
    this.height = clientHeight;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return !same;
  }

  clear(): CanvasRenderingContext2D {
    this.context.clearRect(0, 0, this.width, this.height);
    return this.context;
  }

  /** A canvas of the same size for what seldom changes. */
  layer(): { canvas: HTMLCanvasElement; context: CanvasRenderingContext2D } {
    const canvas = document.createElement("canvas");
    canvas.width = this.canvas.width;
    canvas.height = this.canvas.height;
    const context = canvas.getContext("2d", { willReadFrequently: true })!;
    const ratio = this.width > 0 ? this.canvas.width / this.width : 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return { canvas, context };
  }

  stamp(layer: HTMLCanvasElement): void {
    if (layer.width > 0 && layer.height > 0) {
      this.context.drawImage(layer, 0, 0, this.width, this.height);
    }
  }
}

/** "b₁" and the like: an italic letter with an upright index, on a halo of the paper. */
export function symbol(
  context: CanvasRenderingContext2D,
  text: string,
  x: number,
  y: number,
  colour: string,
  halo: string,
): void {
  context.save();
  context.font = SYMBOL;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.lineWidth = 4;
  context.strokeStyle = halo;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
  context.restore();
}
