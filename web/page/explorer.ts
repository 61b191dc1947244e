// SPDX-License-Identifier: MIT
// The one state of the page. Whoever changes it says what; all views hear of it and draw the same
// body at the same time. A change that the library refuses throws, and leaves everything as it was.
import type { RotorState } from "polhode/core";
import { Driven } from "./driven.js";
import { Model } from "./model.js";
import type { Scene } from "./scene.js";

export type Change = "motion" | "looks" | "time";
export type Listener = (change: Change, explorer: Explorer) => void;

const MOTION: readonly (keyof Scene)[] = ["moments", "state", "epoch"];

export class Explorer {
  private listeners: Listener[] = [];
  scene: Scene;
  model: Model;
  /** The body with torques, where the scene has any. */
  driven: Driven | null;
  playing = false;
  refusal = "";

  constructor(scene: Scene) {
    this.scene = scene;
    this.model = new Model(scene);
    this.driven = drivenBy(this.model, scene);
  }

  onChange(listener: Listener): void {
    this.listeners.push(listener);
  }

  private tell(change: Change): void {
    for (const listener of this.listeners) listener(change, this);
  }

  /** Changes parts of the scene. DomainError for a body, a state or a frame that there is not. */
  change(parts: Partial<Scene>): void {
    const { scene, model, driven } = this;
    const next = { ...scene, ...parts };
    const moved = MOTION.some((key) => next[key] !== scene[key]);
    const fresh = moved ? new Model(next) : model;
    [this.scene, this.model] = [next, fresh];
    try {
      if (moved || next.gravity !== scene.gravity) this.driven = drivenBy(fresh, next);
      this.tell(moved ? "motion" : "looks");
    } catch (error) {
      // The views compute curves of their own, and these can be refused, too.
      [this.scene, this.model, this.driven] = [scene, model, driven];
      if (moved) fresh.motion.dispose();
      this.tell("motion");
      throw error;
    }
    if (moved) model.motion.dispose();
    if (this.refusal) {
      this.refusal = "";
      this.tell("looks");
    }
  }

  /** Another state at the time that is shown: the motion goes on from it. */
  changeState(state: RotorState): void {
    this.change({ state, epoch: this.scene.now });
  }

  /** The same from a drag or a key. These have no place for a sentence: what is refused changes
   *  nothing, and `refusal` says why until something is accepted. */
  steer(to: (state: RotorState) => RotorState): void {
    try {
      this.changeState(to(this.state));
    } catch (error) {
      this.refusal = (error as Error).message;
      this.tell("looks");
    }
  }

  get state(): RotorState {
    return this.model.at(this.scene.now);
  }

  set now(t: number) {
    if (!Number.isFinite(t)) return;
    this.scene = { ...this.scene, now: t };
    this.tell("time");
  }
  get now(): number {
    return this.scene.now;
  }

  play(on: boolean): void {
    if (on === this.playing) return;
    this.playing = on;
    this.tell("looks");
  }

  /** The next (1) or the last (-1) time at which the momentum crosses the plane of the least and
   *  the greatest axis. */
  flipFrom(t: number, way: 1 | -1): number {
    const { flips, motion } = this.model;
    if (!Number.isFinite(flips.every)) return NaN;
    const [slack, reach] = [1e-6 * flips.every, 1.01 * flips.every];
    const { times } =
      way > 0 ? motion.flips(t + slack, t + reach, 1) : motion.flips(t - reach, t - slack, 3);
    return times.at(way > 0 ? 0 : -1) ?? NaN;
  }
}

const drivenBy = (model: Model, scene: Scene): Driven | null =>
  scene.gravity && new Driven(model, scene.gravity, scene);
