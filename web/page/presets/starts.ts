// SPDX-License-Identifier: MIT
// What the scenes to begin with have in common.
import {
  Body,
  fromAndoyer,
  fromEulerAngles,
  fromTumbler,
  rotorState,
  type Mode,
  type RotorState,
  type Vec3,
} from "polhode/core";
import type { Direction, Gravity, Scene } from "../scene.js";
import { DEG, direction } from "../vectors.js";

export interface Preset {
  readonly id: string;
  readonly group: "Bodies" | "Figures of the paper";
  readonly name: string;
  /** What to look at, one or two sentences. */
  readonly about: string;
  readonly source: string;
  readonly scene: () => Scene;
}

export const PLAIN = {
  shape: "ellipsoid",
  overlay: "none",
  moment: "1",
  epoch: 0,
  now: 0,
  precession: null,
  friction: false,
  gravity: null,
  sun: [20, 10],
  observer: [-35, -5],
} as const;

export const TURN = 2 * Math.PI;

/** In the plane of the first two inertial axes, at the pericentre at time 0. */
export const ORBIT: Gravity = {
  period: 1,
  eccentricity: 0,
  inclination: 0,
  node: 0,
  pericentre: 0,
  anomaly: 0,
  friction: 0,
  drag: 0,
};

export function tumbling(
  moments: Vec3,
  mode: Mode,
  periods: readonly [phi: number, psi: number],
  pole: Direction,
): { moments: Vec3; state: RotorState } {
  const state = fromTumbler(new Body(...moments), {
    precessionPeriod: periods[0],
    rotationPeriod: periods[1],
    pole: direction(pole),
    mode,
    phi0: 0,
    psi0: 0,
  });
  return { moments, state };
}

export function spinning(moments: Vec3, omega: Vec3, angles = { phi: 0, theta: 0, psi: 0 }) {
  const state = rotorState(new Body(...moments), fromEulerAngles(angles), omega);
  return { moments, state };
}

/** The state of the paper's figures of planes and angles. */
export function planes(): { moments: Vec3; state: RotorState } {
  const [I, J] = [38 * DEG, 32 * DEG];
  const state = fromAndoyer({
    l: 55 * DEG,
    g: 70 * DEG,
    h: 40 * DEG,
    L: Math.cos(J),
    G: 1,
    H: Math.cos(I),
  });
  return { moments: [3, 4, 6], state };
}

export const precessing = () => ({
  ...PLAIN,
  ...spinning([1, 2, 2.5], [0.75, 0.25, 0.45], { phi: 0.4, theta: 1.1, psi: -0.7 }),
  time: "s",
  pace: 1.5,
  precession: { axis: [0.2, -0.1, 1] as Vec3, rate: 0.15 },
});
