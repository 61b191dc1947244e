// SPDX-License-Identifier: MIT
// A sphere seen from far away: where its points fall on paper, and which point is under a finger.
import type { Vec3 } from "polhode/core";
import { cross, dot, unit, add, scale } from "../vectors.js";

export class Globe {
  private right: Vec3 = [0, 1, 0];
  private up: Vec3 = [0, 0, 1];
  private toward: Vec3 = [1, 0, 0];
  x = 0;
  y = 0;
  radius = 1;

  /** Seen from this longitude and latitude, rad. */
  constructor(
    public longitude: number,
    public latitude: number,
  ) {
    this.turn(0, 0);
  }

  turn(longitude: number, latitude: number): void {
    this.longitude += longitude;
    this.latitude = Math.max(-1.5, Math.min(1.5, this.latitude + latitude));
    const [c, s] = [Math.cos(this.longitude), Math.sin(this.longitude)];
    const [C, S] = [Math.cos(this.latitude), Math.sin(this.latitude)];
    this.toward = [C * c, C * s, S];
    this.right = [-s, c, 0];
    this.up = cross(this.toward, this.right);
  }

  place(x: number, y: number, radius: number): void {
    this.x = x;
    this.y = y;
    this.radius = radius;
  }

  /** On paper, and how far it stands out of it (below 0: on the far side). */
  paper(v: Vec3): [x: number, y: number, depth: number] {
    return [
      this.x + this.radius * dot(v, this.right),
      this.y - this.radius * dot(v, this.up),
      dot(v, this.toward),
    ];
  }

  /** The point of the sphere at a place on paper, on the near or the far side; beyond the rim the
   *  nearest of the rim. */
  point(x: number, y: number, near = true): { direction: Vec3; beyond: boolean } {
    const u = (x - this.x) / this.radius;
    const v = (this.y - y) / this.radius;
    const size = Math.hypot(u, v);
    const inPlane = add(scale(u, this.right), scale(v, this.up));
    if (size >= 1) return { direction: unit(inPlane), beyond: true };
    const depth = Math.sqrt(1 - size * size) * (near ? 1 : -1);
    return { direction: unit(add(inPlane, scale(depth, this.toward))), beyond: false };
  }

  /** `v` moved on the sphere by this much to the right and up, in radii. */
  moved(v: Vec3, right: number, up: number): Vec3 {
    return unit(add(v, add(scale(right, this.right), scale(up, this.up))));
  }

  /** The parts of a curve (rows of 3) on the near or on the far side. */
  path(rows: Float64Array, near: boolean, size = 1): Path2D {
    const { right, up, toward, x, y } = this;
    const radius = this.radius / size;
    const path = new Path2D();
    let drawing = false;
    for (let i = 0; i + 2 < rows.length; i += 3) {
      const [a, b, c] = [rows[i]!, rows[i + 1]!, rows[i + 2]!];
      const here = a * toward[0] + b * toward[1] + c * toward[2] >= 0 === near;
      if (here) {
        const u = x + radius * (a * right[0] + b * right[1] + c * right[2]);
        const v = y - radius * (a * up[0] + b * up[1] + c * up[2]);
        if (drawing) path.lineTo(u, v);
        else path.moveTo(u, v);
      }
      drawing = here;
    }
    return path;
  }
}
