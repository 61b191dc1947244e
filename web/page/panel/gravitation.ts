// SPDX-License-Identifier: MIT
// The orbit whose gravity turns a second body, and what brakes it. What is typed while there is none
// waits for it.
import type { Explorer } from "../explorer.js";
import { unitOf } from "../format.js";
import { ORBIT } from "../presets/starts.js";
import type { Gravity } from "../scene.js";
import { NumberField, together } from "./field.js";

const FIELDS: readonly (readonly [key: keyof Gravity, symbol: string, label: string])[] = [
  ["period", "P", "period of the orbit"],
  ["eccentricity", "e", "eccentricity of the orbit"],
  ["inclination", "i", "inclination of the orbit"],
  ["node", "Ω", "longitude of the ascending node"],
  ["pericentre", "ω", "argument of the pericentre"],
  ["anomaly", "M", "mean anomaly at time 0"],
  ["friction", "τ<sub>f</sub>", "time in which friction inside takes a wobble down by e"],
  ["drag", "τ<sub>d</sub>", "time in which drag takes a spin about the axis of the largest moment down by e"],
];
const TIMES: readonly (keyof Gravity)[] = ["period", "friction", "drag"];
const BRAKES: readonly (keyof Gravity)[] = ["friction", "drag"];

export class Gravitation {
  private readonly fields: NumberField[];
  private readonly box = document.getElementById("gravity") as HTMLInputElement;
  private readonly trouble = document.getElementById("gravity-trouble")!;
  /** Kept while there is none. */
  private kept: Gravity | null = null;

  constructor(private readonly explorer: Explorer) {
    this.fields = FIELDS.map(([key, symbol, label], k) => {
      const angle = !TIMES.includes(key) && key !== "eccentricity";
      const field = new NumberField(
        { symbol, label, unit: angle ? "deg" : "" },
        (value) => this.type(k, value),
        () => explorer.play(false),
      );
      document.getElementById(BRAKES.includes(key) ? "brakes" : "orbit")!.append(field.element);
      return field;
    });
    this.box.addEventListener("change", () => this.toggle());
    this.show();
  }

  /** The orbit, or one that is slow against the turns of the body. */
  private get gravity(): Gravity {
    const { scene, model } = this.explorer;
    const turn = Number.isFinite(model.turn) ? model.turn : 1;
    return scene.gravity ?? this.kept ?? { ...ORBIT, period: Number((5 * turn).toPrecision(3)) };
  }

  private type(k: number, value: number): void {
    const { explorer, fields } = this;
    together(fields, fields[k]!, (pending) => {
      const entries = FIELDS.map(([key], i) => {
        const other = pending(fields[i]!);
        return [key, i === k ? value : (other ?? this.gravity[key])] as const;
      });
      const gravity = Object.fromEntries(entries) as unknown as Gravity;
      if (!Object.values(gravity).every(Number.isFinite)) throw new Error("expected finite numbers");
      if (explorer.scene.gravity) explorer.change({ gravity });
      else this.kept = gravity;
    });
    this.show();
  }

  /** On and off. Refused, it stays as before, with the sentence below. */
  toggle(): void {
    const { explorer } = this;
    const { gravity } = explorer.scene;
    let reason = "";
    try {
      const asked = gravity ? null : this.gravity;
      explorer.change({ gravity: asked });
      if (gravity) this.kept = gravity;
    } catch (error) {
      reason = (error as Error).message;
    }
    this.trouble.textContent = reason;
    this.trouble.hidden = reason === "";
    this.show();
  }

  /** Another scene is shown. */
  forget(): void {
    this.kept = null;
    for (const field of this.fields) field.forget();
    this.trouble.hidden = true;
  }

  show(): void {
    const { scene } = this.explorer;
    const { gravity } = this;
    this.box.checked = scene.gravity !== null;
    for (const [k, [key]] of FIELDS.entries()) {
      const field = this.fields[k]!;
      if (TIMES.includes(key)) field.units = unitOf(scene, "time");
      field.show(gravity[key], 9);
    }
  }
}
