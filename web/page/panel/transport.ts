// SPDX-License-Identifier: MIT
// Time: play, step to the next flip, type any time, or leap a billion turns on a logarithmic slide.
// A far time costs what now costs: the motion is a closed form.
import type { Explorer } from "../explorer.js";
import { number, span } from "../format.js";
import { spoken } from "../words.js";
import { NumberField } from "./field.js";

const STEPS = 1000; // of the slide, on either side of 0
const FIRST = -1; // its first decade of turns, and its last
const LAST = 9;

/** Turns of a place on the slide: 0 in the middle, 10^LAST at the end. */
export function turnsAt(step: number): number {
  if (step === 0) return 0;
  const decade = FIRST + ((LAST - FIRST) * Math.abs(step)) / STEPS;
  return Math.sign(step) * 10 ** decade;
}

export function stepAt(turns: number): number {
  const size = Math.abs(turns);
  if (size < 10 ** FIRST) return 0;
  const step = ((Math.log10(size) - FIRST) / (LAST - FIRST)) * STEPS;
  return Math.sign(turns) * Math.min(STEPS, Math.round(step));
}

export class Transport {
  private readonly play = this.button("play");
  private readonly slide = document.getElementById("slide") as HTMLInputElement;
  private readonly pace = document.getElementById("pace") as HTMLInputElement;
  private readonly paceText = document.getElementById("pace-text")!;
  private readonly turns = document.getElementById("turns")!;
  private readonly time: NumberField;
  private base = 1;
  private title = "";

  constructor(private readonly explorer: Explorer) {
    this.play.addEventListener("click", () => explorer.play(!explorer.playing));
    this.button("previous").addEventListener("click", () => this.flip(-1));
    this.button("next").addEventListener("click", () => this.flip(1));
    this.button("start").addEventListener("click", () => (explorer.now = 0));
    this.time = new NumberField(
      { symbol: "t", label: "time" },
      (value) => {
        if (!Number.isFinite(value)) throw new Error(`got ${value}; expected a finite time`);
        explorer.now = value;
      },
      () => explorer.play(false),
    );
    document.getElementById("time")!.append(this.time.element);
    this.slide.addEventListener("input", () => {
      explorer.play(false);
      const { turn } = explorer.model;
      if (Number.isFinite(turn)) explorer.now = turnsAt(Number(this.slide.value)) * turn;
    });
    this.pace.addEventListener("input", () => {
      explorer.change({ pace: this.base * 2 ** Number(this.pace.value) });
    });
    this.show();
  }

  private button(id: string): HTMLButtonElement {
    return document.getElementById(id) as HTMLButtonElement;
  }

  flip(way: 1 | -1): void {
    const { explorer } = this;
    explorer.play(false);
    const flip = explorer.flipFrom(explorer.now, way);
    explorer.now = Number.isFinite(flip) ? flip : explorer.now + way * explorer.model.turn;
  }

  /** So many times the pace, as far as the slider goes. */
  faster(by: number): void {
    const { pace } = this;
    const level = Number(pace.value) + Math.log2(by);
    const kept = Math.max(Number(pace.min), Math.min(Number(pace.max), level));
    this.explorer.change({ pace: this.base * 2 ** kept });
    this.show();
  }

  forget(): void {
    this.time.forget();
  }

  show(): void {
    const { explorer } = this;
    const { scene, model, now } = explorer;
    if (scene.title !== this.title) {
      this.title = scene.title;
      this.base = scene.pace;
    }
    this.play.setAttribute("aria-label", explorer.playing ? "Pause" : "Play");
    this.play.dataset["playing"] = String(explorer.playing);
    this.time.units = scene.time;
    this.time.show(now, 10);
    const turns = now / model.turn;
    this.turns.textContent = Number.isFinite(turns) ? `${number(turns, 4)} turns` : "";
    if (document.activeElement !== this.slide) this.slide.value = String(stepAt(turns));
    this.slide.setAttribute("aria-valuetext", spoken(model, now, scene.time));
    const level = Math.round(2 * Math.log2(scene.pace / this.base)) / 2;
    if (document.activeElement !== this.pace) this.pace.value = String(level);
    this.paceText.textContent = `1 s = ${span(scene.pace, scene.time)}`;
    this.pace.setAttribute("aria-valuetext", this.paceText.textContent);
  }
}
