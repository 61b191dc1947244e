// SPDX-License-Identifier: MIT
// What the page shows, as plain values: one body, one state, one time. The link holds these, the
// presets are these, and every view draws them.
import type { RotorState, Vec3 } from "polhode/core";

export type Shape = "ellipsoid" | "box" | "wing-nut" | "satellite" | "boom";
export const SHAPES: readonly Shape[] = ["ellipsoid", "box", "wing-nut", "satellite", "boom"];

/** Planes, nodes and angles drawn around the body. */
export type Overlay = "none" | "andoyer" | "euler";
export const OVERLAYS: readonly Overlay[] = ["none", "andoyer", "euler"];

/** Longitude and latitude in the inertial axes, degrees. */
export type Direction = readonly [longitude: number, latitude: number];

/** A reference frame that turns at `rate` (rad per unit of time) about `axis`, inertial axes. */
export interface Precession {
  readonly axis: Vec3;
  readonly rate: number;
}

/** What the body orbits, and what brakes it: it turns a second body, drawn beside the free one. */
export interface Gravity {
  /** Of a revolution. */
  readonly period: number;
  readonly eccentricity: number;
  /** Degrees, inertial axes; the mean anomaly at time 0. */
  readonly inclination: number;
  readonly node: number;
  readonly pericentre: number;
  readonly anomaly: number;
  /** Time in which friction inside takes a small wobble down by e; 0: there is none. */
  readonly friction: number;
  /** Time in which a torque against the spin takes it down by e; 0: there is none. */
  readonly drag: number;
}
export const GRAVITY: readonly (keyof Gravity)[] = [
  "period",
  "eccentricity",
  "inclination",
  "node",
  "pericentre",
  "anomaly",
  "friction",
  "drag",
];

export interface Scene {
  readonly title: string;
  readonly shape: Shape;
  readonly overlay: Overlay;
  readonly moments: Vec3;
  /** Names as in scenario files: "s", "kg m2"; the moment may be "1". */
  readonly time: string;
  readonly moment: string;
  /** The state holds at this time. */
  readonly epoch: number;
  readonly state: RotorState;
  /** The time that is shown. */
  readonly now: number;
  /** Units of time that pass in a second of the reader. */
  readonly pace: number;
  readonly sun: Direction;
  readonly observer: Direction;
  readonly precession: Precession | null;
  /** Also drawn: where friction inside the body would take the momentum. */
  readonly friction: boolean;
  readonly gravity: Gravity | null;
}

/** "kg m2/s" and the like of a scene. */
export function units(scene: Pick<Scene, "time" | "moment">) {
  const { time, moment } = scene;
  const mass = moment === "1" ? "" : moment;
  return {
    time,
    angle: "deg",
    rate: `deg/${time}`,
    moment: mass,
    momentum: mass ? `${mass}/${time}` : `1/${time}`,
    /** Of Poincare's pairs: the square root of a momentum. */
    root: mass ? `(${mass}/${time})½` : `${time}-½`,
    energy: mass ? `${mass}/${time}2` : `1/${time}2`,
    none: "",
  } as const;
}
export type Dimension = keyof ReturnType<typeof units>;

/** True where a scene is the body, the motion and the surroundings of another, whatever it is called. */
export function sameMotion(a: Scene, b: Scene): boolean {
  const told = ({ moments, state, epoch, time, moment, overlay, precession, gravity }: Scene) =>
    JSON.stringify([moments, state.q, state.g, epoch, time, moment, overlay, precession, gravity]);
  return told(a) === told(b);
}
