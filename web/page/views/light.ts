// SPDX-License-Identifier: MIT
// The light curve of the ellipsoid with the moments of the body, as its observer has it: magnitudes
// against their mean, brighter above.
import { brightness, type Light } from "polhode/core";
import type { Change, Explorer } from "../explorer.js";
import { number } from "../format.js";
import { lightOf } from "../model.js";
import { Axes, NO_BOX, ticks, timeLabels, type Box } from "./axes.js";
import { Sheet, type View } from "./pane.js";
import { SMALL } from "./palette.js";

const COUNT = 600;
const TURNS = 6;

export class LightView implements View {
  private readonly sheet: Sheet;
  private readonly flux = new Float64Array(COUNT);
  private light: Light;
  private mean = 1;
  /** No light at any time. */
  private dark = false;
  private low = -0.1;
  private high = 0.1;

  constructor(
    readonly canvas: HTMLCanvasElement,
    explorer: Explorer,
  ) {
    this.sheet = new Sheet(canvas);
    this.fit();
    this.light = lightOf(explorer.model, explorer.scene);
    this.scale(explorer);
  }

  /** The mean and the range over some swings: a scale that does not move with time. */
  private scale({ model, driven, scene }: Explorer): void {
    this.light = lightOf(model, scene);
    const length = Number.isFinite(model.swing) ? Math.max(3 * model.swing, TURNS * model.turn) : 1;
    const count = 1500;
    const { epoch } = scene;
    const flux = model.motion.lightCurve(this.light, { start: epoch, step: length / count, count });
    this.mean = flux.reduce((sum, value) => sum + value, 0) / count;
    let [low, high] = [Infinity, -Infinity];
    for (const value of flux) {
      const m = this.magnitude(value);
      if (Number.isFinite(m)) [low, high] = [Math.min(low, m), Math.max(high, m)];
    }
    if (driven) {
      const [first, last] = driven.between(epoch, epoch + 2 * TURNS * model.turn);
      for (let i = first; i <= last; ++i) {
        const m = this.magnitude(driven.brightness(this.light, i));
        if (Number.isFinite(m)) [low, high] = [Math.min(low, m), Math.max(high, m)];
      }
    }
    this.dark = !(low <= high);
    if (this.dark) [low, high] = [-1, 1];
    const room = Math.max(0.02, 0.08 * (high - low));
    [this.low, this.high] = [low - room, high + room];
  }

  private magnitude = (flux: number): number => -2.5 * Math.log10(flux / this.mean);

  private box: Box = NO_BOX;

  private fit(): void {
    this.sheet.fit();
    this.box = { left: 50, right: this.sheet.width - 12, top: 10, bottom: this.sheet.height - 34 };
  }

  changed(change: Change | "theme" | "size", explorer: Explorer): void {
    if (change === "motion" || change === "looks") this.scale(explorer);
    if (change === "theme" || change === "size") this.fit();
  }

  draw({ model, driven, scene, now }: Explorer): void {
    const { sheet, box, flux } = this;
    const { colours } = sheet;
    const context = sheet.clear();
    const window = TURNS * (Number.isFinite(model.turn) ? model.turn : 1);
    const [low, high] = [now - window / 2, now + window / 2];
    const x = (t: number) => box.left + ((t - low) / window) * (box.right - box.left);
    const y = (m: number) =>
      box.top + ((m - this.low) / (this.high - this.low)) * (box.bottom - box.top);
    const times = timeLabels(low, high, Math.max(2, sheet.width / 100), x);
    const magnitudes = ticks(this.low, this.high, Math.max(2, (box.bottom - box.top) / 44));
    const axes = new Axes(context, colours, box);
    axes.grid(
      times.map(([at]) => at),
      magnitudes.map(y),
    );
    model.motion.lightCurve(this.light, { start: low, step: window / (COUNT - 1), count: COUNT }, flux);
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.clip();
    context.beginPath();
    const { mean, low: least, high: most } = this;
    const across = (box.right - box.left) / (COUNT - 1);
    const down = (box.bottom - box.top) / (most - least);
    for (let i = 0; i < COUNT; ++i) {
      const m = Math.min(-2.5 * Math.log10(flux[i]! / mean), most + 1);
      context.lineTo(box.left + i * across, box.top + (m - least) * down);
    }
    context.strokeStyle = colours.ink;
    context.lineWidth = 1.6;
    context.lineJoin = "round";
    context.stroke();
    if (driven) {
      const [first, last] = driven.between(low, high);
      context.beginPath();
      for (let i = first; i <= last; ++i) {
        const m = Math.min(this.magnitude(driven.brightness(this.light, i)), this.high + 1);
        context.lineTo(x(driven.time(i)), y(m));
      }
      context.strokeStyle = colours.sun;
      context.stroke();
    }
    context.restore();
    axes.frame();
    axes.below(times);
    if (this.dark) {
      context.font = SMALL;
      context.fillStyle = colours.soft;
      context.textAlign = "center";
      const middle = [(box.left + box.right) / 2, (box.top + box.bottom) / 2] as const;
      context.fillText("An ellipsoid without thickness: it has no light curve.", ...middle);
    }
    axes.beside(magnitudes
        .filter((m) => y(m) > box.top + 18)
        .map((m) => [y(m), number(Math.abs(m) < 1e-9 ? 0 : m, 3)] as const));
    context.font = SMALL;
    context.fillStyle = colours.soft;
    context.textAlign = "right";
    context.textBaseline = "bottom";
    context.fillText(scene.time, box.right, sheet.height - 1);
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText("mag", 8, box.top);
    this.cursor(context, x(now), y(this.magnitude(brightness(this.light, model.at(now).q))));
  }

  private cursor(context: CanvasRenderingContext2D, x: number, y: number): void {
    const { box, sheet } = this;
    context.strokeStyle = sheet.colours.momentum;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x, box.top);
    context.lineTo(x, box.bottom);
    context.stroke();
    if (!(y >= box.top && y <= box.bottom)) return;
    context.beginPath();
    context.arc(x, y, 5, 0, 2 * Math.PI);
    context.fillStyle = sheet.colours.momentum;
    context.fill();
    context.strokeStyle = sheet.colours.paper;
    context.lineWidth = 2;
    context.stroke();
  }
}
