// SPDX-License-Identifier: MIT
// What the core makes of a scene: the body, its exact motion, the clocks. Prepared when the body or
// the state changes; a scene that the library refuses throws its DomainError, and nothing changes.
import {
  Body,
  FreeRotation,
  checkedState,
  dampingOfWobble,
  integrate,
  type Light,
  type RotorState,
  type Vec3,
} from "polhode/core";
import type { Precession, Scene } from "./scene.js";
import { direction, scale } from "./vectors.js";

export interface Flips {
  /** The last flip at or before the time asked for, and the time between two. */
  readonly first: number;
  readonly every: number;
}

export interface Wobble {
  readonly axis: 0 | 1 | 2;
  readonly angle: number;
}
const UNSEEN = 0.03; // rad

function wobbleOf(curve: Float64Array): Wobble | null {
  for (const axis of [0, 1, 2] as const) {
    let angle = 0;
    for (let i = 0; i < curve.length; i += 3) {
      const across = Math.hypot(curve[i + ((axis + 1) % 3)]!, curve[i + ((axis + 2) % 3)]!);
      angle = Math.max(angle, Math.atan2(across, Math.abs(curve[i + axis]!)));
    }
    // Below the roundings of a state it is a spin about the axis, not a wobble.
    if (angle > 1e-13 && angle < UNSEEN) return { axis, angle };
  }
  return null;
}

export class Model {
  readonly body: Body;
  readonly motion: FreeRotation;
  /** Semi-axes of the ellipsoid over the largest. */
  readonly axes: Vec3;
  /** The time that the body takes, on average, to turn once about its momentum. */
  readonly turn: number;
  /** The period of the momentum in the body, or some turns where there is none. */
  readonly swing: number;
  readonly flips: Flips;

  constructor(scene: Pick<Scene, "moments" | "state" | "epoch">) {
    this.body = new Body(...scene.moments);
    const state = checkedState(scene.state);
    this.motion = new FreeRotation(this.body, state, scene.epoch);
    const semiAxes = this.body.semiAxes();
    this.axes = scale(1 / Math.max(...semiAxes), semiAxes);
    const { regime, momentum, energy, polhodePeriod } = this.motion;
    // 2T/G is the rate about the momentum: that of any spin, and the mean one of a tumbler.
    this.turn = momentum > 0 ? (Math.PI * momentum) / energy : Infinity;
    this.swing =
      regime !== "rest" && Number.isFinite(polhodePeriod) ? polhodePeriod : 12 * this.turn;
    const { times, every } = this.motion.flips(scene.epoch, scene.epoch + this.swing, 1);
    this.flips = { first: times.length > 0 ? times[0]! : NaN, every };
  }

  at(t: number): RotorState {
    return this.motion.at(t);
  }

  /** The axis that a momentum stays so close to that its curve cannot be seen on the sphere, and the
   *  widest angle from it, rad. */
  get wobble(): Wobble | null {
    this.wobbleFound ??= { found: wobbleOf(this.motion.polhode(97)) };
    return this.wobbleFound.found;
  }
  private wobbleFound: { found: Wobble | null } | null = null;

  /** The body spends most of a half period near the middle axis: what is seen is a flip. */
  get flipsOver(): boolean {
    return this.motion.modulus.m > 0.97;
  }
}

/** The light in which the ellipsoid of the body stands. */
export function lightOf(model: Model, scene: Pick<Scene, "sun" | "observer">): Light {
  return {
    semiAxes: model.axes,
    toSun: direction(scene.sun),
    toObserver: direction(scene.observer),
  };
}

export const SWINGS = 3; // that osculating elements are followed for

/** (l, L) of the osculating elements in a frame that precesses, from the epoch on: rows of 2. */
export function osculatingPlane(model: Model, precession: Precession, count = 1441): Float64Array {
  const run = integrate({
    body: model.body,
    state: model.motion.initialState,
    stop: SWINGS * model.swing,
    count,
    precessingFrame: precession,
    tolerance: 1e-9,
  });
  if (run.ended) throw new Error(run.ended);
  const rows = new Float64Array((2 * run.osculating.length) / 6);
  for (let i = 0; 2 * i < rows.length; ++i) {
    const l = run.osculating[6 * i]!; // within a turn: followed over its ends, or strokes cross the plane
    const last = i === 0 ? l : rows[2 * i - 2]!;
    rows[2 * i] = l + 2 * Math.PI * Math.round((last - l) / (2 * Math.PI));
    rows[2 * i + 1] = run.osculating[6 * i + 3]!;
  }
  return rows;
}

/** Where friction inside would take the momentum: rows of 3, over its length. It keeps the momentum
 *  and takes energy, so the body ends in a spin about the axis of the greatest moment. The strength
 *  is ours: a wobble falls by e in three swings. */
export function frictionPath(model: Model, count = 2401): Float64Array {
  const { body, motion, swing } = model;
  const { momentum } = motion;
  const run = integrate({
    body,
    state: motion.initialState,
    stop: 16 * swing,
    count,
    internalDamping: dampingOfWobble(body, 3 * swing, momentum),
    tolerance: 1e-8,
  });
  if (run.ended) throw new Error(run.ended);
  const size = 7;
  const rows = new Float64Array((3 * run.states.length) / size);
  for (let i = 0; 3 * i < rows.length; ++i) {
    for (const k of [0, 1, 2]) rows[3 * i + k] = run.states[size * i + 4 + k]! / momentum;
  }
  return rows;
}
