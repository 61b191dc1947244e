// SPDX-License-Identifier: MIT
// What an observer sees of an ellipsoid.
import { args, call } from "./module.js";
import type { Quaternion, Vec3 } from "./state.js";

export interface Light {
  /** Along body axes 1, 2, 3: body.semiAxes(). */
  readonly semiAxes: Vec3;
  /** Directions of any length, inertial axes. */
  readonly toSun: Vec3;
  readonly toObserver: Vec3;
}

/** Brightness in one attitude, in units of semi-axis squared. */
export function brightness(light: Light, q: Quaternion): number {
  const at = args(13, ...light.semiAxes, ...light.toSun, ...light.toObserver, ...q);
  return call("brightness", at, at + 72);
}

/** The angle Sun, body, observer, rad. */
export function phaseAngle(toSun: Vec3, toObserver: Vec3): number {
  const at = args(6, ...toSun, ...toObserver);
  return call("phase_angle", at, at + 24);
}

/** Magnitudes relative to the mean flux: -2.5 log10 (flux / mean). */
export function magnitudes(flux: Float64Array, out = new Float64Array(flux.length)): Float64Array {
  let sum = 0;
  for (const f of flux) sum += f;
  const mean = sum / flux.length;
  for (let i = 0; i < flux.length; ++i) out[i] = -2.5 * Math.log10(flux[i]! / mean);
  return out;
}
