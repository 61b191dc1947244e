// SPDX-License-Identifier: MIT
// Bodies and states.
import { args, call, checked, result, results } from "./module.js";

export type Vec3 = readonly [x: number, y: number, z: number];
/** [w, x, y, z], Hamilton, body to inertial: v_I = q v_B q*. */
export type Quaternion = readonly [w: number, x: number, y: number, z: number];
/** Nine numbers, row by row. */
export type Matrix3 = readonly number[];

/** Attitude and angular momentum along the body axes: what every chart converts to and from. */
export interface RotorState {
  readonly q: Quaternion;
  readonly g: Vec3;
}

export const vector = (from: readonly number[], at = 0): Vec3 => [from[at]!, from[at + 1]!, from[at + 2]!];
export const quaternion = (from: readonly number[], at = 0): Quaternion => [
  from[at]!,
  from[at + 1]!,
  from[at + 2]!,
  from[at + 3]!,
];
export const stateOf = (from: readonly number[]): RotorState => ({ q: quaternion(from), g: vector(from, 4) });

/** The state that a call has left in the results. */
export const stateResult = (): RotorState => stateOf(result(7));

/** Principal moments of inertia about body axes 1, 2, 3, in any order. */
export class Body {
  readonly moments: Vec3;
  /** Indices of the body axes by moment: of the least, the middle and the greatest. */
  readonly axisOrder: readonly [least: number, middle: number, greatest: number];
  /** From the principal axes to those of the tensor the body was made of: v_F = q v_B q*. */
  readonly axes: Quaternion = [1, 0, 0, 0];

  /** DomainError for moments that no body has. */
  constructor(I1: number, I2: number, I3: number) {
    checked("body", args(3, I1, I2, I3));
    const moments: Vec3 = [I1, I2, I3];
    this.moments = moments;
    const order = [0, 1, 2].sort((i, j) => moments[i]! - moments[j]!);
    this.axisOrder = [order[0]!, order[1]!, order[2]!];
  }

  /** Of a full tensor of inertia, symmetric, in any axes F of the body: finds the principal axes, `axes`.
   * Element (1, 2) is minus the integral of x y dm. */
  static fromTensor(tensor: Matrix3): Body {
    checked("body_of_tensor", args(9, ...tensor), results());
    const found = result(7);
    const body = new Body(...vector(found));
    (body as { axes: Quaternion }).axes = quaternion(found, 3);
    return body;
  }

  /** The ellipsoid of constant density with these semi-axes along axes 1, 2, 3. */
  static ofEllipsoid(semiAxes: Vec3, mass = 1): Body {
    checked("ellipsoid_moments", args(3, ...semiAxes), mass, results());
    return new Body(...vector(result(3)));
  }

  /** Semi-axes of the ellipsoid of constant density and this mass that has these moments. */
  semiAxes(mass = 1): Vec3 {
    call("semi_axes", args(3, ...this.moments), mass, results());
    return vector(result(3));
  }
}

/** The state with this attitude (any length but 0) and angular velocity along the body axes. */
export function rotorState(body: Body, q: Quaternion, omegaBody: Vec3): RotorState {
  return ofRate(body, q, omegaBody, 0);
}
/** The same with an angular velocity along the inertial axes. */
export function rotorStateInertial(body: Body, q: Quaternion, omegaInertial: Vec3): RotorState {
  return ofRate(body, q, omegaInertial, 1);
}
/** A state as it was typed: DomainError unless it is finite and q is not 0; q scaled to length 1. */
export function checkedState(state: RotorState): RotorState {
  const at = args(7, ...state.q, ...state.g);
  checked("checked_state", at, results());
  return stateResult();
}
function ofRate(body: Body, q: Quaternion, omega: Vec3, isInertial: number): RotorState {
  const at = args(10, ...body.moments, ...q, ...omega);
  checked("state_of_rate", at, at + 24, at + 56, isInertial, results());
  return stateResult();
}

function derived(moments: Vec3, s: RotorState): number[] {
  const at = args(10, ...moments, ...s.q, ...s.g);
  call("derived", at, at + 24, results());
  return result(10);
}
/** Along the body axes. */
export const angularVelocity = (body: Body, s: RotorState): Vec3 => vector(derived(body.moments, s));
export const inertialAngularVelocity = (body: Body, s: RotorState): Vec3 => vector(derived(body.moments, s), 3);
export const inertialMomentum = (s: RotorState): Vec3 => vector(derived([1, 1, 1], s), 6);
export const kineticEnergy = (body: Body, s: RotorState): number => derived(body.moments, s)[9]!;

/** For dragging the momentum in the body: the state whose body momentum points along `direction` (any
 *  length but 0), with the same |g| and the same momentum in space; the attitude makes the least turn. */
export function withMomentumAlong(s: RotorState, direction: Vec3): RotorState {
  const at = args(10, ...s.q, ...s.g, ...direction);
  checked("momentum_along", at, at + 56, results());
  return stateResult();
}
/** The same direction of the momentum with another length: a faster or slower spin. */
export function withMomentum(s: RotorState, G: number): RotorState {
  const scale = G / Math.hypot(...s.g);
  return { q: s.q, g: [scale * s.g[0], scale * s.g[1], scale * s.g[2]] };
}
