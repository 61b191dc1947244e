// SPDX-License-Identifier: MIT
// What is given besides the state: moments, the look of the body, Sun and observer, a frame that
// precesses.
import { phaseAngle, type Vec3 } from "polhode/core";
import type { Explorer } from "../explorer.js";
import { number, shown, unitOf } from "../format.js";
import { OVERLAYS, SHAPES, type Overlay, type Scene, type Shape } from "../scene.js";
import { DEG, direction } from "../vectors.js";
import { NumberField, together } from "./field.js";

interface Setting {
  readonly field: NumberField;
  readonly read: (scene: Scene) => number;
}

const replaced = <T extends readonly number[]>(row: T, index: number, value: number): T =>
  row.map((old, i) => (i === index ? value : old)) as unknown as T;

export class Settings {
  private readonly settings: Setting[] = [];
  private readonly moments: NumberField[];
  private readonly rate: NumberField;
  private readonly axes: NumberField[] = [];
  /** Of the frame; kept while it stands still. */
  private axis: Vec3 = [0, 0, 1];
  private readonly shape: HTMLSelectElement;
  private readonly overlay: HTMLSelectElement;
  private readonly friction: HTMLInputElement;
  private readonly phase: HTMLElement;
  private readonly trouble: HTMLElement;

  constructor(
    root: Document,
    private readonly explorer: Explorer,
  ) {
    const place = (id: string) => root.getElementById(id)!;
    const pause = () => explorer.play(false);
    this.moments = [0, 1, 2].map((k) => {
      const field = new NumberField(
        { symbol: `I<sub>${k + 1}</sub>`, label: `moment of inertia ${k + 1}` },
        (value) => this.inertia(k, value),
        pause,
      );
      this.settings.push({ field, read: (scene) => scene.moments[k]! });
      return field;
    });
    place("moments").append(...this.moments.map((field) => field.element));

    const light = (who: "sun" | "observer", k: 0 | 1) => {
      const what = k === 0 ? "longitude" : "latitude";
      const field = new NumberField(
        { symbol: k === 0 ? "λ" : "β", label: `${what} of the ${who}`, unit: "deg" },
        (value) => {
          if (!Number.isFinite(value)) throw new Error(`got ${value}; expected a finite number`);
          explorer.change({ [who]: replaced(explorer.scene[who], k, value) });
        },
      );
      this.settings.push({ field, read: (scene) => scene[who][k] });
      return field.element;
    };
    place("sun").append(light("sun", 0), light("sun", 1));
    place("observer").append(light("observer", 0), light("observer", 1));
    this.phase = place("phase");
    this.trouble = place("body-trouble");

    this.rate = new NumberField(
      { symbol: "μ", label: "rate at which the frame precesses" },
      (value) => this.precess(value),
      pause,
    );
    place("frame").append(this.rate.element);
    for (const [k, name] of ["x", "y", "z"].entries()) {
      const field = new NumberField(
        { symbol: `s<sub>${name}</sub>`, label: `axis of the frame, ${name}` },
        (value) => this.lean(k, value),
        pause,
      );
      this.axes.push(field);
      this.settings.push({ field, read: () => this.axis[k]! });
      place("frame").append(field.element);
    }

    this.shape = place("shape") as HTMLSelectElement;
    this.shape.addEventListener("change", () => {
      const shape = SHAPES.find((name) => name === this.shape.value) as Shape;
      this.ask({ shape });
    });
    this.overlay = place("overlay") as HTMLSelectElement;
    this.overlay.addEventListener("change", () => {
      const overlay = OVERLAYS.find((name) => name === this.overlay.value) as Overlay;
      this.ask({ overlay });
    });
    this.friction = place("friction") as HTMLInputElement;
    this.friction.addEventListener("change", () => {
      this.ask({ friction: this.friction.checked });
    });
    this.show();
  }

  /** A moment, with those that were refused before it. Momentum and attitude stay as they are. */
  private inertia(k: number, value: number): void {
    const { explorer, moments } = this;
    together(moments, moments[k]!, (pending) => {
      const now = explorer.scene.moments.map((old, i) => pending(moments[i]!) ?? old);
      explorer.change({ moments: replaced(now, k, value) as unknown as Vec3 });
    });
  }

  /** Another scene is shown: what was refused was of the last one. */
  forget(): void {
    for (const field of [...this.moments, ...this.settings.map((s) => s.field), this.rate]) field.forget();
    this.trouble.hidden = true;
  }

  /** What a list or a box asks for. Refused, it stands as before, with the sentence below it. */
  private ask(parts: Partial<Scene>): void {
    let reason = "";
    try {
      this.explorer.change(parts);
    } catch (error) {
      reason = (error as Error).message;
    }
    this.trouble.textContent = reason;
    this.trouble.hidden = reason === "";
    this.show();
  }

  /** The axis may be typed before the rate: it waits for it. */
  private lean(k: number, value: number): void {
    const { explorer, axes } = this;
    together(axes, axes[k]!, (pending) => {
      const axis = this.axis.map((old, i) => (i === k ? value : (pending(axes[i]!) ?? old)));
      const size = Math.hypot(...axis);
      if (!(size > 0 && Number.isFinite(size))) {
        throw new Error(`got the axis (${axis.join(", ")}); expected a direction`);
      }
      const { precession } = explorer.scene;
      if (precession) explorer.change({ precession: { ...precession, axis: axis as unknown as Vec3 } });
      this.axis = axis as unknown as Vec3;
    });
    this.show();
  }

  private precess(typed: number): void {
    const rate = typed * DEG;
    if (!Number.isFinite(rate)) throw new Error(`got ${typed}; expected a finite number`);
    this.explorer.change({ precession: rate === 0 ? null : { axis: this.axis, rate } });
  }

  show(): void {
    const { scene } = this.explorer;
    if (scene.precession) this.axis = scene.precession.axis;
    for (const { field, read } of this.settings) field.show(read(scene), 9);
    for (const field of this.moments) field.units = unitOf(scene, "moment");
    this.rate.units = unitOf(scene, "rate");
    this.rate.show((scene.precession?.rate ?? 0) * shown("rate"));
    this.shape.value = scene.shape;
    this.overlay.value = scene.overlay;
    this.friction.checked = scene.friction;
    const angle = phaseAngle(direction(scene.sun), direction(scene.observer)) / DEG;
    document.getElementById("plane-osculating")!.hidden = scene.precession === null;
    this.phase.textContent = `phase angle ${number(angle, 3)}°`;
  }
}
