// SPDX-License-Identifier: MIT
// The body in space, in inertial axes: its momentum, which stands still; its angular velocity, whose
// end stays in one plane and draws the herpolhode there; the directions to Sun and observer.
import { PerspectiveCamera, Quaternion as Turn, Vector3, type WebGLRenderer } from "three";
import type { RotorState, Vec3 } from "polhode/core";
import type { Change, Explorer } from "../explorer.js";
import type { Direction, Overlay } from "../scene.js";
import { direction, unit } from "../vectors.js";
import { draggable, pinchable } from "./drag.js";
import { Labels } from "./labels.js";
import { Sheet, type View } from "./pane.js";
import { TEXT } from "./palette.js";
import { built, lookOf, RECENT, stale, TRAIL, translated, type Parts } from "./stage.js";

const HEIGHT = 1.15; // of the invariable plane: 2T/G on paper
const FAR = 1.42; // of Sun and observer
const NEAREST = 0.45; // zooms
const FARTHEST = 2.2;
const MOST = 5e6; // pixels
const NAMES = ["b₁", "b₂", "b₃"] as const;
const UP = new Vector3(0, 1, 0);
const Z = new Vector3(0, 0, 1);

export class BodyView implements View {
  private readonly sheet: Sheet;
  private readonly labels = new Labels();
  private readonly camera = new PerspectiveCamera(26, 1, 0.1, 60);
  private part = 1;
  private longitude = 0.5;
  private latitude = 0.3;
  private distance = 10;
  private closer = 1;
  private readonly trail = new Float64Array(3 * TRAIL);
  private parts: Parts;
  /** Set when something of it is drawn for the first time, after the other pictures. */
  there = false;
  private asked = false;
  // What a picture computes with: none is made anew.
  private readonly tip = new Vector3();
  private readonly foot = new Vector3();
  private readonly g = new Vector3();
  private readonly turn = new Turn();

  /** Without a renderer the browser has no WebGL. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    labels: HTMLCanvasElement,
    private readonly renderer: WebGLRenderer | null,
    private readonly explorer: Explorer,
    private readonly redraw: () => void,
  ) {
    this.sheet = new Sheet(labels);
    this.parts = built(lookOf(explorer));
    this.face(explorer);
    this.changed("size", explorer);
    draggable(labels, () => ({ move: (_to, by) => this.orbit(-by.x / 140, by.y / 140) }));
    pinchable(labels, (by) => this.zoom(1 / by));
    labels.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey && !event.shiftKey) return; // the page scrolls on
        event.preventDefault();
        this.zoom(Math.exp((event.deltaY || event.deltaX) / 300));
      },
      { passive: false },
    );
    labels.addEventListener("keydown", (event) => {
      const step = 0.1;
      const act = {
        ArrowLeft: () => this.orbit(-step, 0),
        ArrowRight: () => this.orbit(step, 0),
        ArrowUp: () => this.orbit(0, step),
        ArrowDown: () => this.orbit(0, -step),
        "+": () => this.zoom(1 / 1.15),
        "=": () => this.zoom(1 / 1.15),
        "-": () => this.zoom(1.15),
        "0": () => this.zoom(1 / this.closer),
      }[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      event.stopPropagation();
      act();
    });
  }

  private orbit(longitude: number, latitude: number): void {
    this.longitude += longitude;
    this.latitude = Math.max(-1.45, Math.min(1.45, this.latitude + latitude));
    this.redraw();
  }

  /** So many times as far away. */
  zoom(by: number): void {
    this.closer = Math.max(NEAREST, Math.min(FARTHEST, this.closer * by));
    this.redraw();
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
    const { foot } = this;
    if (overlay === "none") foot.set(...unit(momentum));
    else foot.copy(Z);
    this.parts.root.quaternion.setFromUnitVectors(foot, UP);
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

  /** Draws with so many pixels along an edge over those of the screen; true where that is new. */
  refine(part: number): boolean {
    if (part === this.part) return false;
    this.part = part;
    this.fit();
    return true;
  }

  changed(change: Change | "theme" | "size", explorer: Explorer): void {
    const { parts } = this;
    if (change === "theme" || (change !== "time" && change !== "size" && stale(parts, explorer))) {
      parts.dispose();
      this.parts = built(lookOf(explorer));
      if (change !== "theme") this.face(explorer);
    }
    if (change === "motion") this.upright(explorer.scene.overlay, explorer.model.motion.momentumDirection);
    if (change === "motion" || change === "looks" || change === "theme") this.light(explorer);
    if (change !== "theme" && change !== "size") return;
    this.sheet.fit();
    this.fit();
  }

  private fit(): void {
    const { renderer, camera, part } = this;
    const { width, height } = this.sheet;
    if (!renderer || width === 0 || height === 0) return;
    const most = Math.sqrt(MOST / (width * height));
    renderer.setPixelRatio(Math.min(part * Math.min(window.devicePixelRatio || 1, 2), most));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    this.distance = 6.9 / Math.min(1, width / height) ** 0.85;
    camera.updateProjectionMatrix();
  }

  draw(explorer: Explorer): void {
    if (!this.asked) {
      // The other pictures first: WebGL takes longer than all of them to start.
      this.asked = true;
      this.light(explorer);
      this.redraw();
      return;
    }
    const { sheet, parts, renderer, camera, labels, tip } = this;
    const { model, scene, now } = explorer;
    const context = sheet.clear();
    if (!renderer) {
      this.there = true;
      context.font = TEXT;
      context.fillStyle = sheet.colours.soft;
      context.textAlign = "center";
      const text = "This browser has no WebGL: the body is not drawn. All else works.";
      context.fillText(text, sheet.width / 2, sheet.height / 2);
      return;
    }
    const state = model.at(now);
    this.upright(scene.overlay, model.motion.momentumDirection);
    turnOf(state, parts.body.quaternion);
    const plain = scene.overlay === "none";
    parts.body.scale.setScalar(plain ? 1 : 0.42);

    labels.clear();
    const { momentum, energy } = model.motion;
    const moving = momentum > 0;
    const g = this.g.set(...model.motion.momentumDirection);
    parts.momentum.visible = moving;
    if (moving) {
      parts.momentum.point(tip.copy(g).multiplyScalar(1.52));
      labels.add("G", g, sheet.colours.momentum, 1.64);
    }
    this.herpolhode(explorer, moving && plain, (HEIGHT * momentum) / (2 * energy));
    for (let k = 0; k < 3; ++k) {
      const own = model.axes[k]!;
      const reach = plain ? own + 0.26 : 1.05;
      tip.set(0, 0, 0).setComponent(k, 1).applyQuaternion(parts.body.quaternion);
      labels.add(NAMES[k]!, tip, parts.tones[k]!, reach + 0.13);
      this.foot.copy(tip).multiplyScalar(plain ? own * 0.9 : 0);
      parts.axes[k]!.point(tip.multiplyScalar(reach), this.foot);
    }
    this.beside(explorer, plain);
    parts.planes.show(scene.overlay, state, labels);
    if (parts.sun.visible) {
      labels.add("Sun", parts.sun.position, null);
      labels.add("observer", parts.observer.position, null);
    }

    const distance = this.distance * this.closer;
    const across = distance * Math.cos(this.latitude);
    camera.position.set(
      across * Math.sin(this.longitude),
      distance * Math.sin(this.latitude),
      across * Math.cos(this.longitude),
    );
    camera.lookAt(0, plain ? 0.3 : 0, 0);
    if (!this.there) translated(renderer, parts, camera);
    parts.hairs(this.part);
    renderer.render(parts.stage, camera);
    this.there = true;
    labels.write(sheet, camera, parts.root.quaternion);
  }

  private herpolhode({ model, now, scene }: Explorer, shown: boolean, size: number): void {
    const { parts, trail, labels, tip, foot, g, sheet } = this;
    for (const part of parts.traces) part.visible = shown;
    parts.relative.visible = shown && scene.precession !== null;
    if (!shown) return;
    const window = Math.min(model.swing, 24 * model.turn);
    const step = window / (TRAIL - 1);
    model.motion.angularVelocities({ start: now - window, step, count: TRAIL }, "inertial", trail);
    parts.past.follow(trail, size);
    parts.recent.follow(trail, size, TRAIL - RECENT);
    tip.fromArray(trail, 3 * (TRAIL - 1)).multiplyScalar(size);
    parts.omega.point(tip);
    const length = tip.length();
    labels.add("ω", tip, sheet.colours.omega, 1 + 0.16 / length);
    parts.invariable.quaternion.setFromUnitVectors(Z, g);
    parts.invariable.position.copy(g).multiplyScalar(HEIGHT);
    const { precession } = scene;
    if (!precession) return;
    foot.set(...unit(precession.axis));
    tip.addScaledVector(foot, -size * precession.rate);
    parts.relative.point(tip);
    labels.add("ω − μ", tip, sheet.colours.sun, 1 + 0.2 / Math.max(tip.length(), 1e-9));
  }

  /** The body with torques, and what it orbits. */
  private beside({ driven, now }: Explorer, plain: boolean): void {
    const { parts, sheet, labels, tip, turn } = this;
    const state = plain && driven ? driven.at(now) : null;
    for (const part of parts.pulled) part.visible = state !== null;
    if (!state) return;
    parts.driven.quaternion.copy(turnOf(state, turn));
    tip.set(...state.g).applyQuaternion(turn).normalize();
    labels.add("G′", tip, sheet.colours.sun, 1.64);
    parts.drivenMomentum.point(tip.multiplyScalar(1.52));
    tip.set(...driven!.toCentre(now));
    labels.add("planet", tip, null, 1.5);
    parts.centre.point(tip.multiplyScalar(1.5));
  }

  /** Sun and observer, which stand still. */
  private light({ scene }: Explorer): void {
    const { parts } = this;
    const sun = direction(scene.sun);
    parts.light.position.set(...sun).multiplyScalar(10);
    parts.sun.visible = parts.observer.visible = scene.overlay === "none" && scene.precession === null;
    parts.sun.position.set(...sun).multiplyScalar(FAR);
    parts.observer.position.set(...direction(scene.observer)).multiplyScalar(FAR);
  }
}

function turnOf({ q }: RotorState, turn: Turn): Turn {
  return turn.set(q[1], q[2], q[3], q[0]);
}
