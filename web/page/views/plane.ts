// SPDX-License-Identifier: MIT
// Andoyer's plane: the angle l against L/G. The sphere unrolled, and as in the paper's figure 4 the
// long-axis mode is shaded. Where |L| = G all l are one state.
import { andoyerPlane, fromAndoyer, separatrix, toAndoyer } from "polhode/core";
import type { Change, Explorer } from "../explorer.js";
import { osculatingPlane, SWINGS } from "../model.js";
import type { Precession } from "../scene.js";
import { DEG } from "../vectors.js";
import { Axes, NO_BOX, type Box } from "./axes.js";
import { familyOf, frictionOf, look, ring, TAIL } from "./curves.js";
import { draggable, near, NOWHERE, type Place } from "./drag.js";
import { Sheet, symbol, type View } from "./pane.js";

const REACH = 26;
const TURN = 2 * Math.PI;

export class PlaneView implements View {
  private readonly sheet: Sheet;
  private layer: HTMLCanvasElement | null = null;
  private body = "";
  private own = new Float64Array(0);
  private osculating: Float64Array | null = null;
  private precession: Precession | null = null;
  private friction: Float64Array | null = null;
  /** Of the rows above on paper: made when they or the size change. */
  private paths: { own: Path2D; friction: Path2D | null; osculating: Path2D | null } | null = null;
  /** Where the state is on paper. */
  dot: Place = NOWHERE;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private readonly explorer: Explorer,
  ) {
    this.sheet = new Sheet(canvas);
    this.fit();
    this.changed("motion", explorer);
    const holds = (at: Place) => near(at, this.dot, REACH);
    draggable(canvas, (at) => (holds(at) ? { move: (to) => this.point(to) } : null), holds);
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  private box: Box = NO_BOX;

  private x = (l: number) =>
    this.box.left + ((l / Math.PI + 1) / 2) * (this.box.right - this.box.left);
  private y = (ratio: number) =>
    (this.box.top + this.box.bottom) / 2 - (ratio * (this.box.bottom - this.box.top)) / 2.08;

  private fit(): void {
    this.sheet.fit();
    this.box = { left: 44, right: this.sheet.width - 12, top: 10, bottom: this.sheet.height - 34 };
  }

  /** The state with l and L there; g, h, G and H stay. */
  private point(to: Place): void {
    const { box } = this;
    const l = ((to.x - box.left) / (box.right - box.left)) * TURN - Math.PI;
    const ratio = ((box.top + box.bottom) / 2 - to.y) * (2.08 / (box.bottom - box.top));
    this.move(() => [l, ratio]);
  }

  /** To l and L/G; a state at rest has neither. */
  private move(to: (l: number, ratio: number) => readonly [l: number, ratio: number]): void {
    this.explorer.steer((state) => {
      const a = toAndoyer(state);
      if (!(a.G > 0)) throw new Error("At rest: there is no momentum to move.");
      const [l, ratio] = to(a.l, a.L / a.G);
      return fromAndoyer({ ...a, l, L: Math.max(-0.9999, Math.min(0.9999, ratio)) * a.G });
    });
  }

  private key(event: KeyboardEvent): void {
    const step = event.shiftKey ? 5 : 1;
    const by = {
      ArrowLeft: [-step, 0],
      ArrowRight: [step, 0],
      ArrowUp: [0, step],
      ArrowDown: [0, -step],
    }[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    this.move((l, ratio) => [l + by[0]! * DEG, ratio + 0.01 * by[1]!]);
  }

  changed(change: Change | "theme" | "size", explorer: Explorer): void {
    const { model, scene } = explorer;
    if (change === "motion" || change === "looks") {
      const body = model.body.moments.join();
      if (body !== this.body) this.layer = null;
      this.body = body;
      this.own = andoyerPlane(model.motion.polhode(361));
      const friction = frictionOf(explorer);
      this.friction = friction && andoyerPlane(friction);
      if (change === "motion" || scene.precession !== this.precession) {
        this.precession = scene.precession;
        this.osculating = scene.precession ? osculatingPlane(model, scene.precession) : null;
      }
    }
    if (change !== "time") this.paths = null;
    if (change === "theme" || change === "size") {
      this.fit();
      this.layer = null;
    }
  }

  draw({ model, driven, scene, now }: Explorer): void {
    const { sheet } = this;
    const { colours } = sheet;
    this.layer ??= this.still();
    const context = sheet.clear();
    sheet.stamp(this.layer);
    const { momentum, regime } = model.motion;
    if (!(momentum > 0)) {
      this.dot = NOWHERE;
      return;
    }
    const style = look(
      regime === "long_axis" || regime === "separatrix" ? regime : "short_axis",
      colours,
    );
    const { own, friction, osculating } = this;
    this.paths ??= {
      own: this.path(own, momentum),
      friction: friction && this.path(friction, 1),
      osculating: osculating && this.path(osculating, momentum),
    };
    const { paths } = this;
    this.clipped(context, () => {
      context.strokeStyle = style.colour;
      context.lineWidth = 3;
      context.stroke(paths.own);
      if (paths.friction) {
        context.strokeStyle = colours.sun;
        context.lineWidth = 1.4;
        context.stroke(paths.friction);
      }
      if (driven) {
        context.strokeStyle = colours.sun;
        context.lineWidth = 1.6;
        const [first, last] = driven.between(now - TAIL * driven.step, now);
        context.stroke(this.path(andoyerPlane(driven.directions(first, last)), 1));
      }
      if (this.osculating && paths.osculating) {
        context.strokeStyle = colours.omega;
        context.lineWidth = 1.8;
        context.setLineDash([6, 3]);
        context.stroke(paths.osculating);
        context.setLineDash([]);
        this.ring(context, this.osculating, momentum, (now - scene.epoch) / (SWINGS * model.swing));
      }
    });
    const pulled = driven?.at(now);
    if (pulled) {
      const { l, L, G } = toAndoyer(pulled);
      ring(context, colours, [this.x(l), this.y(L / G)]);
    }
    const a = toAndoyer(model.at(now));
    this.dot = { x: this.x(a.l), y: this.y(a.L / a.G) };
    context.beginPath();
    context.arc(this.dot.x, this.dot.y, 7, 0, TURN);
    context.fillStyle = colours.momentum;
    context.fill();
    context.lineWidth = 2.5;
    context.strokeStyle = colours.paper;
    context.stroke();
  }

  /** Where the osculating elements are now, as long as they are followed. */
  private ring(
    context: CanvasRenderingContext2D,
    rows: Float64Array,
    G: number,
    part: number,
  ): void {
    const i = Math.round(part * (rows.length / 2 - 1));
    if (!(i >= 0 && 2 * i < rows.length)) return;
    const l = Math.atan2(Math.sin(rows[2 * i]!), Math.cos(rows[2 * i]!));
    context.beginPath();
    context.arc(this.x(l), this.y(rows[2 * i + 1]! / G), 6, 0, TURN);
    context.fillStyle = this.sheet.colours.paper;
    context.fill();
    context.stroke();
  }

  private clipped(context: CanvasRenderingContext2D, draw: () => void): void {
    const { box } = this;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.clip();
    draw();
    context.restore();
  }

  /** Rows of l, L: as often as the plane holds them, a turn apart. */
  private path(rows: Float64Array, G: number): Path2D {
    const path = new Path2D();
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i < rows.length; i += 2) {
      low = Math.min(low, rows[i]!);
      high = Math.max(high, rows[i]!);
    }
    if (!Number.isFinite(low)) return path;
    const first = Math.ceil((-Math.PI - high) / TURN);
    const last = Math.floor((Math.PI - low) / TURN);
    for (let turn = first; turn <= Math.min(last, first + 40); ++turn) {
      for (let i = 0; i < rows.length; i += 2) {
        const [x, y] = [this.x(rows[i]! + turn * TURN), this.y(rows[i + 1]! / G)];
        if (i === 0) path.moveTo(x, y);
        else path.lineTo(x, y);
      }
    }
    return path;
  }

  private still(): HTMLCanvasElement {
    const { sheet, box } = this;
    const { colours } = sheet;
    const { canvas, context } = sheet.layer();
    const axes = new Axes(context, colours, box);
    const angles = sheet.width < 300 ? [-180, 0, 180] : [-180, -90, 0, 90, 180];
    axes.grid(
      angles.map((l) => this.x(l * DEG)),
      [-1, -0.5, 0, 0.5, 1].map(this.y),
    );
    this.clipped(context, () => {
      this.shade(context);
      for (const curve of familyOf(this.explorer.model)) {
        const style = look(curve.mode, colours);
        context.strokeStyle = style.colour;
        context.globalAlpha = curve.mode === "separatrix" ? 0.9 : 0.65;
        context.lineWidth = style.width;
        context.setLineDash(style.dash);
        context.stroke(this.path(andoyerPlane(curve.points), 1));
      }
      context.setLineDash([]);
      context.globalAlpha = 1;
    });
    axes.frame();
    axes.below(angles.map((l) => [this.x(l * DEG), `${l}°`.replace("-", "−")] as const));
    const low = box.bottom - box.top < 130;
    const levels = low ? [-1, 0, 1] : [-1, -0.5, 0, 0.5, 1];
    axes.beside(levels.map((v) => [this.y(v), String(v).replace("-", "−")] as const));
    symbol(context, "l", (box.left + box.right) / 2 + 34, box.bottom + 22, colours.ink, colours.paper);
    symbol(context, "L/G", 18, this.y(0.75), colours.ink, colours.paper);
    return canvas;
  }

  /** The long-axis mode lies between the arcs of the separatrix, around the ends of the axis of least
   *  moment: two lobes in this plane, where axis 3 is that of the greatest moment. */
  private shade(context: CanvasRenderingContext2D): void {
    const { body } = this.explorer.model;
    const [least, , greatest] = body.axisOrder;
    if (greatest !== 2) return;
    const arcs = separatrix(body, 1, 97);
    const middle = least === 0 ? Math.PI / 2 : 0; // l at one end of that axis
    context.fillStyle = this.sheet.colours.lam;
    context.globalAlpha = 0.07;
    for (const centre of [middle - Math.PI, middle, middle + Math.PI]) {
      const places: [number, number][] = [];
      for (const arc of arcs) {
        const rows = andoyerPlane(arc.points);
        for (let i = 0; i < rows.length; i += 2) {
          const from = rows[i]! - centre;
          const l = centre + Math.atan2(Math.sin(from), Math.cos(from));
          if (Math.abs(l - centre) <= Math.PI / 2) places.push([l, rows[i + 1]!]);
        }
      }
      const edge = (sign: number) =>
        places.filter(([, L]) => L * sign >= 0).sort((a, b) => sign * (a[0] - b[0]));
      context.beginPath();
      for (const [l, L] of [...edge(1), ...edge(-1)]) context.lineTo(this.x(l), this.y(L));
      context.closePath();
      context.fill();
    }
    context.globalAlpha = 1;
  }
}
