// SPDX-License-Identifier: MIT
// What is given besides the state: moments, the look of the body, Sun and observer, a frame that
// precesses.
import { phaseAngle, type Vec3 } from "polhode/core";
import type { Explorer } from "../explorer.js";
import { number, shown, unitOf } from "../format.js";
import { OVERLAYS, SHAPES, type Overlay, type Scene, type Shape } from "../scene.js";
import { DEG, direction } from "../vectors.js";
import { NumberField } from "./field.js";

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
        (value) => {
          // The momentum and the attitude stay as they are.
          explorer.change({ moments: replaced(explorer.scene.moments, k, value) as Vec3 });
        },
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
        (value) => {
          const { precession } = explorer.scene;
          const axis = replaced(precession?.axis ?? [0, 0, 1], k, value) as Vec3;
          explorer.change({ precession: { axis, rate: precession?.rate ?? 0 } });
        },
        pause,
      );
      this.settings.push({ field, read: (scene) => (scene.precession?.axis ?? [0, 0, 1])[k]! });
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

  private precess(typed: number): void {
    const rate = typed * DEG;
    if (!Number.isFinite(rate)) throw new Error(`got ${typed}; expected a finite number`);
    const axis = this.explorer.scene.precession?.axis ?? ([0, 0, 1] as const);
    this.explorer.change({ precession: rate === 0 ? null : { axis, rate } });
  }

  show(): void {
    const { scene } = this.explorer;
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
