// SPDX-License-Identifier: MIT
// What the body with torques does now: the mode and the clocks of the free motion that touches its
// own, and how it stands to what it orbits.
import type { Vec3 } from "polhode/core";
import type { Explorer } from "../explorer.js";
import { number } from "../format.js";
import { Model } from "../model.js";
import { DEG, dot, length, rotate } from "../vectors.js";
import { headline } from "../words.js";

type Row = readonly [symbol: string, what: string, value: string];
const AXES: readonly Vec3[] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

export class DrivenPanel {
  private readonly box = document.getElementById("driven")!;
  private readonly mode = document.getElementById("driven-mode")!;
  private readonly list = document.getElementById("driven-clocks")!;

  /** Of what is listed. */
  private names = "";

  constructor(private readonly explorer: Explorer) {
    this.show();
  }

  show(): void {
    const { driven } = this.explorer;
    this.box.hidden = driven === null;
    if (!driven) return;
    const [mode, rows] = this.rows();
    if (this.mode.textContent !== mode) this.mode.textContent = mode;
    const data = this.list.querySelectorAll("dd");
    const names = rows.map(([symbol, what]) => symbol + what).join();
    if (names === this.names) {
      for (const [k, [, , value]] of rows.entries()) {
        if (data[k]!.textContent !== value) data[k]!.textContent = value;
      }
      return;
    }
    this.names = names;
    this.list.replaceChildren(
      ...rows.flatMap(([symbol, what, value]) => {
        const term = document.createElement("dt");
        term.innerHTML = (symbol && `<span class="symbol">${symbol}</span> `) + `<span>${what}</span>`;
        const data = document.createElement("dd");
        data.textContent = value; // a unit may come from a link
        return [term, data];
      }),
    );
  }

  private rows(): [mode: string, rows: Row[]] {
    const { driven, now, model, scene } = this.explorer;
    const state = driven!.at(now);
    if (!state) return [this.missing(), []];
    const { moments } = scene;
    const touching = new Model({ moments, state, epoch: now });
    const { mode, clocks } = headline(touching);
    touching.motion.dispose();
    const [least, , greatest] = model.body.axisOrder;
    const toCentre = driven!.toCentre(now);
    const off = Math.abs(dot(rotate(state.q, AXES[least]!), toCentre));
    const momentum = length(state.g) / model.motion.momentum;
    return [
      mode,
      [
        ...clocks
          .filter(({ value }) => Number.isFinite(value))
          .map(({ symbol, what, value }) => [symbol, what, `${number(value, 5)} ${scene.time}`] as const),
        ["", `b${"₁₂₃"[least]} off the line to the planet`, `${number(Math.acos(Math.min(1, off)) / DEG, 3)}°`],
        ["", "momentum, now over then", number(momentum, 5)],
        ["", `b${"₁₂₃"[greatest]} off the momentum`, `${number(this.tilt(state.g, greatest), 3)}°`],
      ],
    ];
  }

  private tilt(g: Vec3, axis: number): number {
    return Math.acos(Math.min(1, Math.abs(g[axis]!) / length(g))) / DEG;
  }

  private missing(): string {
    const { driven, now, scene } = this.explorer;
    const { epoch, count, ended } = driven!;
    if (now < epoch) return `from t = ${number(epoch, 6)} ${scene.time} on`;
    return ended || `followed to t = ${number(driven!.time(count - 1), 6)} ${scene.time}`;
  }
}
