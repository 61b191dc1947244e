// SPDX-License-Identifier: MIT
// The momentum as the body sees it: it keeps its length, so it moves on a sphere, along curves of
// equal energy. The dot can be dragged: the body turns until its momentum, which stands still in
// space, lies where the dot is.
import { withMomentumAlong, type Curve, type Vec3 } from "polhode/core";
import type { Change, Explorer } from "../explorer.js";
import { scale, unit } from "../vectors.js";
import { familyOf, frictionOf, look, ring, TAIL } from "./curves.js";
import { draggable, near, NOWHERE, type Place } from "./drag.js";
import { Globe } from "./globe.js";
import { inset } from "./inset.js";
import { Sheet, symbol, type View } from "./pane.js";

const REACH = 26; // px: how far from the dot a finger takes it
/** Behind, in front. */
const SIDES = [false, true] as const;
const AXES: readonly [Vec3, string][] = [
  [[1, 0, 0], "b₁"],
  [[0, 1, 0], "b₂"],
  [[0, 0, 1], "b₃"],
];

export class SphereView implements View {
  private readonly sheet: Sheet;
  private readonly globe = new Globe(0.98, 0.36);
  private curves: readonly Curve[] = [];
  private polhode = new Float64Array(0);
  private friction: Float64Array | null = null;
  private layer: HTMLCanvasElement | null = null;
  /** On paper, the far side and the near one: made when the motion or the view changes. */
  private own: readonly Path2D[] = [];
  private drift: readonly Path2D[] = [];
  private drawn = false;
  /** Where the state is on paper. */
  dot: Place = NOWHERE;
  private depth = 1;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly explorer: Explorer,
    private readonly redraw: () => void,
  ) {
    this.sheet = new Sheet(canvas);
    this.changed("motion", explorer);
    draggable(
      canvas,
      (at) => (near(at, this.dot, REACH) ? this.dragDot() : this.dragGlobe()),
      (at) => near(at, this.dot, REACH),
    );
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  private dragDot() {
    let nearSide = this.depth >= 0;
    let outside = false;
    return {
      move: (to: Place) => {
        const { direction, beyond } = this.globe.point(to.x, to.y, nearSide);
        if (beyond && !outside) nearSide = !nearSide; // over the rim, to the other side
        outside = beyond;
        this.point(direction);
      },
    };
  }

  private dragGlobe() {
    return {
      move: (_to: Place, by: Place) => {
        this.globe.turn(-by.x / this.globe.radius, by.y / this.globe.radius);
        this.layer = null;
        this.drawn = false;
        this.redraw();
      },
    };
  }

  private point(direction: Vec3): void {
    this.explorer.steer((state) => withMomentumAlong(state, direction));
  }

  private key(event: KeyboardEvent): void {
    const step = event.shiftKey ? 0.1 : 0.02;
    const by = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
    }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    this.point(this.globe.moved(unit(this.explorer.state.g), by[0]!, by[1]!));
  }

  changed(change: Change | "theme" | "size", explorer: Explorer): void {
    if (change === "motion") {
      const { model } = explorer;
      const fresh = familyOf(model);
      if (fresh !== this.curves) {
        this.curves = fresh;
        this.layer = null;
      }
      this.polhode = model.motion.polhode(241);
    }
    if (change === "motion" || change === "looks") this.friction = frictionOf(explorer);
    if (change !== "time") this.drawn = false;
    if (change === "theme" || change === "size") {
      this.sheet.fit();
      this.layer = null;
    }
  }

  draw({ model, driven, now }: Explorer): void {
    const { sheet, globe } = this;
    const { colours } = sheet;
    globe.place(
      sheet.width / 2,
      sheet.height / 2,
      Math.max(10, Math.min(sheet.width, sheet.height) / 2.38 - 9),
    );
    this.layer ??= this.still();
    const context = sheet.clear();
    sheet.stamp(this.layer);

    const { momentum, regime } = model.motion;
    if (!(momentum > 0)) {
      this.dot = NOWHERE;
      return;
    }
    if (!this.drawn) {
      this.drawn = true;
      const sides = (rows: Float64Array, size: number) => SIDES.map((near) => globe.path(rows, near, size));
      this.own = sides(this.polhode, momentum);
      this.drift = this.friction ? sides(this.friction, 1) : [];
    }
    const style = look(regime === "long_axis" || regime === "separatrix" ? regime : "short_axis", colours);
    context.strokeStyle = style.colour;
    context.lineCap = "round";
    for (const side of SIDES) {
      context.globalAlpha = side ? 1 : 0.35;
      context.lineWidth = side ? 3 : 2;
      context.stroke(this.own[side ? 1 : 0]!);
    }
    if (this.friction) {
      context.strokeStyle = colours.sun;
      context.lineWidth = 1.4;
      for (const side of SIDES) {
        context.globalAlpha = side ? 0.95 : 0.25;
        context.stroke(this.drift[side ? 1 : 0]!);
      }
    }
    if (driven) {
      const state = driven.at(now);
      const [first, last] = driven.between(now - TAIL * driven.step, now);
      context.strokeStyle = colours.sun;
      const path = driven.directions(first, last);
      for (const side of SIDES) {
        context.globalAlpha = side ? 0.95 : 0.35;
        context.lineWidth = side ? 1.6 : 1.2;
        context.stroke(globe.path(path, side));
      }
      if (state) ring(context, colours, globe.paper(unit(state.g)));
    }
    const g = scale(1 / momentum, model.at(now).g);
    const [x, y, depth] = globe.paper(g);
    this.dot = { x, y };
    this.depth = depth;
    context.globalAlpha = depth >= 0 ? 1 : 0.45;
    context.beginPath();
    context.arc(x, y, 7, 0, 2 * Math.PI);
    context.fillStyle = colours.momentum;
    context.fill();
    context.lineWidth = 2.5;
    context.strokeStyle = colours.paper;
    context.stroke();
    context.globalAlpha = 1;
    const { wobble } = model;
    if (wobble) {
      const tone = model.body.axisOrder[0] === wobble.axis ? colours.lam : colours.sam;
      const place = [sheet.width - 62, sheet.height - 68] as const;
      inset(context, colours, place, wobble, this.polhode, model.at(now).g, tone);
    }
  }

  /** Sphere, family of curves, axes: as long as neither the body nor the view changes. */
  private still(): HTMLCanvasElement {
    const { sheet, globe } = this;
    const { colours } = sheet;
    const { canvas, context } = sheet.layer();
    const { x, y, radius } = globe;
    const shade = context.createRadialGradient(
      x - 0.35 * radius,
      y - 0.4 * radius,
      0.1 * radius,
      x,
      y,
      radius,
    );
    shade.addColorStop(0, colours.paper);
    shade.addColorStop(1, colours.faint);
    this.axes(context, false);
    context.globalAlpha = 0.85;
    context.fillStyle = shade;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fill();
    context.globalAlpha = 1;
    context.lineWidth = 1;
    context.strokeStyle = colours.line;
    context.stroke();
    for (const side of SIDES) {
      for (const curve of this.curves) {
        const style = look(curve.mode, colours);
        context.strokeStyle = style.colour;
        context.globalAlpha = side ? 0.8 : 0.16;
        context.lineWidth = style.width;
        context.setLineDash(style.dash);
        context.stroke(globe.path(curve.points, side));
      }
    }
    context.setLineDash([]);
    context.globalAlpha = 1;
    this.axes(context, true);
    return canvas;
  }

  private axes(context: CanvasRenderingContext2D, front: boolean): void {
    const { globe, sheet } = this;
    const { colours } = sheet;
    const order = this.explorer.model.body.axisOrder;
    const tones = [colours.lam, colours.sep, colours.sam];
    for (const [index, [axis, name]] of AXES.entries()) {
      const rank = order.indexOf(index as 0 | 1 | 2);
      for (const end of [1, -1] as const) {
        const tip = scale(end, axis);
        const [x, y, depth] = globe.paper(tip);
        if (depth >= 0 !== front) continue;
        context.globalAlpha = front ? 1 : 0.5;
        context.beginPath();
        context.arc(x, y, 3.6, 0, 2 * Math.PI);
        context.fillStyle = rank === 1 ? colours.paper : tones[rank]!;
        context.fill();
        context.lineWidth = 1.5;
        context.strokeStyle = tones[rank]!;
        context.stroke();
        if (end < 0) continue;
        // Outwards on paper, clear of the end itself, which an axis towards the eye would cover.
        const [u, v] = globe.paper(scale(1.19, axis));
        const away = Math.hypot(u - x, v - y);
        const reach = Math.max(away, 22) / Math.max(away, 1e-9);
        const towardEye = away < 2;
        const [a, b] = towardEye ? [x + 16, y - 16] : [x + reach * (u - x), y + reach * (v - y)];
        context.lineWidth = 1.2;
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(x + 0.45 * (a - x), y + 0.45 * (b - y));
        context.stroke();
        symbol(context, name, a, b, tones[rank]!, colours.paper);
      }
    }
    context.globalAlpha = 1;
  }
}
