// SPDX-License-Identifier: MIT
// The body in space, in inertial axes: its momentum, which stands still; its angular velocity, whose
// end stays in one plane and draws the herpolhode there; the directions to Sun and observer.
import { PerspectiveCamera, Quaternion as Turn, Vector3, type WebGLRenderer } from "three";
import type { Vec3 } from "polhode/core";
import type { Change, Explorer } from "../explorer.js";
import type { Direction, Overlay } from "../scene.js";
import { add, direction, rotate, scale, unit } from "../vectors.js";
import { draggable } from "./drag.js";
import { Sheet, symbol, type View } from "./pane.js";
import { TEXT } from "./palette.js";
import type { Label } from "./planes.js";
import { built, RECENT, stale, started, TRAIL, type Parts } from "./stage.js";

const HEIGHT = 1.15; // of the invariable plane: 2T/G on paper
const FAR = 1.42; // of Sun and observer
const BODY_AXES: readonly Vec3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

export class BodyView implements View {
  private readonly sheet: Sheet;
  /** Undefined until the other pictures are there: WebGL takes longer than all of them to start. */
  private renderer: WebGLRenderer | null | undefined;
  private asked = false;
  private readonly camera = new PerspectiveCamera(26, 1, 0.1, 60);
  private part = 1;
  private longitude = 0.5;
  private latitude = 0.3;
  private readonly trail = new Float64Array(3 * TRAIL);
  private parts: Parts;

  constructor(
    readonly canvas: HTMLCanvasElement,
    labels: HTMLCanvasElement,
    private readonly explorer: Explorer,
    private readonly redraw: () => void,
  ) {
    this.sheet = new Sheet(labels);
    this.parts = built(explorer);
    this.face(explorer);
    this.changed("size", explorer);
    draggable(labels, () => ({
      move: (_to, by) => {
        this.longitude -= by.x / 140;
        this.latitude = Math.max(-1.45, Math.min(1.45, this.latitude + by.y / 140));
        this.redraw();
      },
    }));
    labels.addEventListener("keydown", (event) => {
      const step = 0.1;
      const by = {
        ArrowLeft: [-step, 0],
        ArrowRight: [step, 0],
        ArrowUp: [0, step],
        ArrowDown: [0, -step],
      }[event.key];
      if (!by) return;
      event.preventDefault();
      event.stopPropagation();
      this.longitude += by[0]!;
      this.latitude = Math.max(-1.45, Math.min(1.45, this.latitude + by[1]!));
      this.redraw();
    });
  }

  /** A body is first seen with the Sun to the left, on the side that is lit. */
  private face({ scene, model }: Explorer): void {
    this.upright(scene.overlay, model.motion.momentumDirection);
    const sun = this.inRoom(scene.sun);
    this.longitude = scene.overlay === "none" ? Math.atan2(sun.x, sun.z) + 0.85 : 0.5;
    this.latitude = 0.3;
  }

  /** Turns the stage: the momentum points up, or the third inertial axis. */
  private upright(overlay: Overlay, momentum: Vec3): void {
    const up: Vec3 = overlay === "none" ? unit(momentum) : [0, 0, 1];
    this.parts.root.quaternion.setFromUnitVectors(new Vector3(...up), new Vector3(0, 1, 0));
  }

  private inRoom(towards: Direction): Vector3 {
    return new Vector3(...direction(towards)).applyQuaternion(this.parts.root.quaternion);
  }

  /** Looks from where the observer stands. */
  fromObserver(): void {
    const seen = this.inRoom(this.explorer.scene.observer);
    this.latitude = Math.asin(Math.max(-1, Math.min(1, seen.y)));
    this.longitude = Math.atan2(seen.x, seen.z);
    this.redraw();
  }

  get there(): boolean {
    return this.renderer !== undefined;
  }

  /** Below 1: fewer pixels than the screen has. */
  set fineness(part: number) {
    this.part = part;
    this.changed("size", this.explorer);
  }

  changed(change: Change | "theme" | "size", explorer: Explorer): void {
    if (change === "theme" || (change !== "time" && change !== "size" && stale(this.parts, explorer))) {
      this.parts.dispose();
      this.parts = built(explorer);
      if (change !== "theme") this.face(explorer);
    }
    if (change === "theme" || change === "size") {
      this.sheet.fit();
      const { width, height } = this.sheet;
      if (!this.renderer || width === 0 || height === 0) return;
      this.renderer.setPixelRatio(this.part * Math.min(window.devicePixelRatio || 1, 2));
      this.renderer.setSize(width, height, false);
      this.camera.aspect = width / height;
      const narrow = Math.min(1, width / height);
      this.camera.userData["distance"] = 6.9 / narrow ** 0.85;
      this.camera.updateProjectionMatrix();
    }
  }

  draw({ model, scene, now }: Explorer): void {
    if (!this.asked) {
      this.asked = true;
      this.redraw();
      return;
    }
    if (this.renderer === undefined) {
      this.renderer = started(this.canvas);
      this.changed("size", this.explorer);
    }
    const { sheet, parts, renderer, camera } = this;
    const context = sheet.clear();
    if (!renderer) {
      context.font = TEXT;
      context.fillStyle = sheet.colours.soft;
      context.textAlign = "center";
      context.fillText(
        "This browser has no WebGL: the body is not drawn. All else works.",
        sheet.width / 2,
        sheet.height / 2,
      );
      return;
    }
    const state = model.at(now);
    this.upright(scene.overlay, model.motion.momentumDirection);
    const [w, x, y, z] = state.q;
    parts.body.quaternion.copy(new Turn(x, y, z, w));
    const plain = scene.overlay === "none";
    parts.shape.visible = true;
    parts.body.scale.setScalar(plain ? 1 : 0.42);

    const labels: Label[] = [];
    const { colours } = sheet;
    const { momentum, energy } = model.motion;
    const moving = momentum > 0;
    const g = unit(model.motion.momentumDirection);
    parts.momentum.visible = moving;
    if (moving) {
      parts.momentum.point(scale(1.52, g));
      labels.push({ text: "G", at: scale(1.64, g), colour: colours.momentum });
    }
    this.herpolhode(this.explorer, moving && plain, (HEIGHT * momentum) / (2 * energy), g, labels);
    for (const [k, axis] of BODY_AXES.entries()) {
      const tip = rotate(state.q, axis);
      const reach = plain ? model.axes[k]! + 0.26 : 1.05;
      parts.axes[k]!.point(scale(reach, tip), scale(plain ? model.axes[k]! * 0.9 : 0, tip));
      labels.push({
        text: ["b₁", "b₂", "b₃"][k]!,
        at: scale(reach + 0.13, tip),
        colour: parts.tones[k]!,
      });
    }
    this.beside(this.explorer, plain, labels);
    parts.planes.show(scene.overlay, state);
    labels.push(...parts.planes.labels);
    this.lights(labels);

    const distance = (camera.userData["distance"] as number) ?? 10;
    const C = Math.cos(this.latitude);
    camera.position.set(
      distance * C * Math.sin(this.longitude),
      distance * Math.sin(this.latitude),
      distance * C * Math.cos(this.longitude),
    );
    camera.lookAt(0, plain ? 0.3 : 0, 0);
    renderer.render(parts.stage, camera);
    this.write(labels);
  }

  private herpolhode(
    { model, now, scene }: Explorer,
    shown: boolean,
    size: number,
    g: Vec3,
    labels: Label[],
  ): void {
    const { parts, trail } = this;
    for (const part of [parts.past, parts.recent, parts.omega]) part.visible = shown;
    parts.invariable.visible = shown;
    parts.relative.visible = shown && scene.precession !== null;
    if (!shown) return;
    const window = Math.min(model.swing, 24 * model.turn);
    const step = window / (TRAIL - 1);
    model.motion.angularVelocities({ start: now - window, step, count: TRAIL }, "inertial", trail);
    parts.past.follow(trail, size);
    parts.recent.follow(trail.subarray(3 * (TRAIL - RECENT)), size);
    const end = 3 * (TRAIL - 1);
    const omega: Vec3 = [trail[end]!, trail[end + 1]!, trail[end + 2]!];
    const tip = scale(size, omega);
    parts.omega.point(tip);
    labels.push({ text: "ω", at: add(tip, scale(0.16, unit(omega))), colour: this.sheet.colours.omega });
    parts.invariable.quaternion.setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...g));
    parts.invariable.position.set(...(scale(HEIGHT, g) as [number, number, number]));
    const { precession } = scene;
    if (precession) {
      const mu = scale(precession.rate, unit(precession.axis));
      const relative = scale(size, add(omega, scale(-1, mu)));
      parts.relative.point(relative);
      labels.push({
        text: "ω − μ",
        at: add(relative, scale(0.2, unit(relative))),
        colour: this.sheet.colours.sun,
      });
    }
  }

  /** The body with torques, and what it orbits. */
  private beside({ driven, now }: Explorer, plain: boolean, labels: Label[]): void {
    const { parts, sheet } = this;
    const state = plain ? (driven?.at(now) ?? null) : null;
    for (const part of [parts.driven, parts.drivenMomentum, parts.centre]) part.visible = state !== null;
    if (!state) return;
    const [w, x, y, z] = state.q;
    parts.driven.quaternion.set(x, y, z, w);
    const g = unit(rotate(state.q, state.g));
    parts.drivenMomentum.point(scale(1.52, g));
    labels.push({ text: "G′", at: scale(1.64, g), colour: sheet.colours.sun });
    const centre = driven!.toCentre(now);
    parts.centre.point(scale(1.5, centre));
    labels.push({ text: "planet", at: scale(1.5, centre), colour: "text" });
  }

  private lights(labels: Label[]): void {
    const { parts } = this;
    const { scene } = this.explorer;
    const sun = direction(scene.sun);
    const observer = direction(scene.observer);
    parts.light.position.set(...(scale(10, sun) as [number, number, number]));
    const shown = scene.overlay === "none" && scene.precession === null;
    parts.sun.visible = parts.observer.visible = shown;
    if (!shown) return;
    parts.sun.position.set(...(scale(FAR, sun) as [number, number, number]));
    parts.observer.position.set(...(scale(FAR, observer) as [number, number, number]));
    labels.push(
      { text: "Sun", at: scale(FAR + 0.02, sun), colour: "text" },
      { text: "observer", at: scale(FAR + 0.02, observer), colour: "text" },
    );
  }

  private write(labels: readonly Label[]): void {
    const { sheet, camera, parts } = this;
    const { context, colours } = sheet;
    const taken: [number, number][] = [];
    for (const { text, at, colour } of labels) {
      const v = new Vector3(...at).applyQuaternion(parts.root.quaternion).project(camera);
      const wide = colour === "text" ? 40 : 19;
      const place = [((v.x + 1) / 2) * sheet.width, ((1 - v.y) / 2) * sheet.height] as const;
      const [left, low] = free(taken, ...place, wide);
      // Within the sheet: a narrow one would cut them.
      const x = Math.max(14, Math.min(sheet.width - 14, left));
      const y = Math.max(11, Math.min(sheet.height - 11, low));
      if (colour !== "text") {
        symbol(context, text, x, y, colour, colours.paper);
      } else {
        context.font = TEXT;
        context.textAlign = "center";
        context.textBaseline = "top";
        context.fillStyle = colours.soft;
        context.fillText(text, Math.max(26, Math.min(sheet.width - 26, x)), y + 8);
      }
    }
  }
}

/** The place itself, or the nearest beside it where no other label stands. */
function free(
  taken: [number, number][],
  x: number,
  y: number,
  wide: number,
): [number, number] {
  const ways = [0, 1, -1].flatMap((u) => [0, -1, 1].map((v) => [20 * u, 18 * v] as const));
  const way = ways.find(([u, v]) =>
    taken.every(([a, b]) => Math.abs(a - x - u) > wide || Math.abs(b - y - v) > 15),
  ) ?? [0, 0];
  const place: [number, number] = [x + way[0], y + way[1]];
  taken.push(place);
  return place;
}
