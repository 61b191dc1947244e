// SPDX-License-Identifier: MIT
// The time line: the momentum along the three body axes around now, and when the body flips. It can
// be dragged through; a wheel changes how much of it is seen.
import type { Change, Explorer } from "../explorer.js";
import type { Model } from "../model.js";
import { Axes, NO_BOX, timeLabels, type Box } from "./axes.js";
import { draggable, pinchable, type Place } from "./drag.js";
import { smallAngle } from "./inset.js";
import { Sheet, symbol, type View } from "./pane.js";

const COUNT = 900;
const SIZE = 7; // numbers of a state

export class StripView implements View {
  private readonly sheet: Sheet;
  private readonly states = new Float64Array(COUNT * SIZE);
  /** Swings of the momentum that fit in. */
  private swings = 3;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly explorer: Explorer,
    private readonly redraw: () => void,
  ) {
    this.sheet = new Sheet(canvas);
    this.fit();
    draggable(canvas, () => this.drag());
    pinchable(canvas, (by) => this.zoom(1 / by));
    canvas.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey && Math.abs(event.deltaX) > Math.abs(event.deltaY)) return;
        event.preventDefault();
        this.zoom(Math.exp(event.deltaY / 400));
      },
      { passive: false },
    );
  }

  /** So many times as much of the time is seen. */
  zoom(by: number): void {
    this.swings = Math.max(0.05, Math.min(40, this.swings * by));
    this.redraw();
  }

  private window(model: Model): number {
    return this.swings * (Number.isFinite(model.swing) ? model.swing : 1);
  }

  private drag() {
    const playing = this.explorer.playing;
    this.explorer.play(false);
    return {
      move: (_to: Place, by: Place) => {
        const { box } = this;
        const perPixel = this.window(this.explorer.model) / (box.right - box.left);
        this.explorer.now -= by.x * perPixel;
      },
      end: () => this.explorer.play(playing),
    };
  }

  private box: Box = NO_BOX;

  private fit(): void {
    this.sheet.fit();
    this.box = { left: 44, right: this.sheet.width - 12, top: 16, bottom: this.sheet.height - 20 };
  }

  changed(change: Change | "theme" | "size"): void {
    if (change === "theme" || change === "size") this.fit();
  }

  draw({ model, driven, now }: Explorer): void {
    const { sheet, box, states } = this;
    const { colours } = sheet;
    const context = sheet.clear();
    const window = this.window(model);
    const [low, high] = [now - window / 2, now + window / 2];
    const x = (t: number) => box.left + ((t - low) / window) * (box.right - box.left);
    const y = (ratio: number) =>
      (box.top + box.bottom) / 2 - (ratio * (box.bottom - box.top)) / 2.16;
    const axes = new Axes(context, colours, box);
    const labels = timeLabels(low, high, Math.max(2, sheet.width / 110), x);
    axes.grid(
      labels.map(([at]) => at),
      [y(-1), y(0), y(1)],
    );
    const { momentum } = model.motion;
    // A wobble too small to be seen is enlarged.
    const full = model.wobble ? Math.sin(model.wobble.angle) : 1;
    if (momentum > 0) {
      this.flips(context, model, low, high, x);
      model.motion.states({ start: low, step: window / (COUNT - 1), count: COUNT }, states);
      const order = model.body.axisOrder;
      const tones = [colours.lam, colours.ink, colours.sam];
      const across = (box.right - box.left) / (COUNT - 1);
      const middle = y(0);
      const up = (middle - y(1)) / (momentum * full);
      for (const rank of [0, 2, 1]) {
        if (order[rank] === model.wobble?.axis) continue; // all but 1, and off the enlarged scale
        context.beginPath();
        const first = 4 + order[rank]!;
        for (let i = 0; i < COUNT; ++i) {
          context.lineTo(box.left + i * across, middle - states[i * SIZE + first]! * up);
        }
        context.strokeStyle = tones[rank]!;
        context.lineWidth = rank === 1 ? 2 : 1;
        context.globalAlpha = rank === 1 ? 1 : 0.75;
        context.setLineDash(rank === 0 ? [5, 3] : []);
        context.stroke();
      }
      context.setLineDash([]);
      context.globalAlpha = 1;
    }
    if (driven) {
      const axis = model.body.axisOrder[1];
      const [first, last] = driven.between(low, high);
      context.save();
      context.beginPath();
      context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
      context.clip();
      context.beginPath();
      for (let i = first; i <= last; ++i) {
        context.lineTo(x(driven.time(i)), y(driven.ratio(i, axis) / full));
      }
      context.strokeStyle = colours.sun;
      context.lineWidth = 1.6;
      context.stroke();
      context.restore();
    }
    axes.frame();
    axes.below(labels);
    axes.beside([
      [y(1), model.wobble ? smallAngle(model.wobble.angle) : "1"],
      [y(0), "0"],
      [y(-1), model.wobble ? "" : "−1"],
    ]);
    this.cursor(context, x(now), full === 1);
  }

  private flips(
    context: CanvasRenderingContext2D,
    model: Model,
    low: number,
    high: number,
    x: (t: number) => number,
  ): void {
    const { first, every } = model.flips;
    const { box, sheet } = this;
    // Crossings of the plane; of a body that does not turn over they are no flips.
    const flips = model.flipsOver || model.motion.regime === "separatrix";
    if (!Number.isFinite(first) || !flips) return;
    context.fillStyle = sheet.colours.sep;
    const from = Number.isFinite(every) ? Math.ceil((low - first) / every) : 0;
    const upTo = Number.isFinite(every) ? Math.floor((high - first) / every) : 0;
    if (upTo - from > 200) return;
    for (let k = from; k <= upTo; ++k) {
      const at = Number.isFinite(every) ? x(first + k * every) : x(first);
      if (at < box.left || at > box.right) continue;
      context.beginPath();
      context.moveTo(at - 4.5, box.top - 8);
      context.lineTo(at + 4.5, box.top - 8);
      context.lineTo(at, box.top - 1);
      context.fill();
    }
  }

  private cursor(context: CanvasRenderingContext2D, at: number, named: boolean): void {
    const { box, sheet } = this;
    context.strokeStyle = sheet.colours.momentum;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(at, box.top - 8);
    context.lineTo(at, box.bottom);
    context.stroke();
    if (!named) return; // the number of the scale stands there
    symbol(context, "g/G", 16, (3 * box.top + box.bottom) / 4, sheet.colours.ink, sheet.colours.paper);
  }
}
