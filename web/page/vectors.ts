// SPDX-License-Identifier: MIT
// Vectors of the drawing: turned, projected, named. What a body does comes from the core.
import type { Quaternion, Vec3 } from "polhode/core";

export const DEG = Math.PI / 180;

export const dot = (a: Vec3, b: Vec3): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const scale = (k: number, a: Vec3): Vec3 => [k * a[0], k * a[1], k * a[2]];
export const add = (a: Vec3, b: Vec3): Vec3 => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const length = (a: Vec3): number => Math.hypot(a[0], a[1], a[2]);
export const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** The direction of `a`; `otherwise` where it has none. */
export function unit(a: Vec3, otherwise: Vec3 = [0, 0, 1]): Vec3 {
  const size = length(a);
  return size > 0 && Number.isFinite(size) ? scale(1 / size, a) : otherwise;
}

/** q v q*: from body axes to inertial ones. */
export function rotate(q: Quaternion, v: Vec3): Vec3 {
  const [w, ...u] = q;
  const axis: Vec3 = [u[0], u[1], u[2]];
  const twice = scale(2, cross(axis, v));
  return add(add(v, scale(w, twice)), cross(axis, twice));
}

/** `v` turned by `angle` about the unit vector `axis`. */
export function turned(axis: Vec3, v: Vec3, angle: number): Vec3 {
  const along = scale(dot(axis, v), axis);
  const across = add(v, scale(-1, along));
  return add(along, add(scale(Math.cos(angle), across), scale(Math.sin(angle), cross(axis, v))));
}

/** A direction by longitude and latitude in degrees. */
export function direction([longitude, latitude]: readonly [number, number]): Vec3 {
  const c = Math.cos(latitude * DEG);
  return [c * Math.cos(longitude * DEG), c * Math.sin(longitude * DEG), Math.sin(latitude * DEG)];
}
