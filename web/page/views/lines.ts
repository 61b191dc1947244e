// SPDX-License-Identifier: MIT
// Lines of a width in pixels, hairlines and arrows, which change in place from picture to picture:
// nothing here makes an object per picture.
import {
  BufferAttribute,
  BufferGeometry,
  ConeGeometry,
  DoubleSide,
  DynamicDrawUsage,
  Group,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  Vector3,
} from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { InterleavedBufferAttribute } from "three";

/** Of one colour from both sides. All of these have one shader, and to translate one takes longer than
 *  to draw a picture: so all count as transparent. */
export function flat(color: string, opacity = 1): MeshBasicMaterial {
  return new MeshBasicMaterial({
    color,
    opacity,
    transparent: true,
    side: DoubleSide,
    forceSinglePass: true,
    depthWrite: opacity === 1,
  });
}

export interface LineLook {
  readonly colour: string;
  readonly width: number;
  readonly dashed?: boolean;
}

/** A line through a fixed number of points. Each of its segments is some 18 vertices. */
export class Path {
  readonly line: Line2;
  private readonly geometry = new LineGeometry();
  private readonly material: LineMaterial;
  private readonly segments: Float32Array;
  private readonly dashed: boolean;

  constructor(
    private readonly points: number,
    look: LineLook,
  ) {
    this.geometry.setPositions(new Float32Array(3 * points));
    const start = this.geometry.attributes["instanceStart"] as InterleavedBufferAttribute;
    this.segments = start.data.array as Float32Array;
    start.data.setUsage(DynamicDrawUsage);
    this.dashed = look.dashed ?? false;
    this.material = new LineMaterial({
      linewidth: look.width,
      dashed: this.dashed,
      dashSize: 0.07,
      gapSize: 0.05,
    });
    this.line = new Line2(this.geometry, this.material);
    this.line.frustumCulled = false;
    this.colour = look.colour;
  }

  set colour(colour: string) {
    this.material.color.set(colour);
  }
  set visible(on: boolean) {
    this.line.visible = on;
  }

  /** Through the points of rows of 3 from a row on, each times `size`. */
  follow(rows: ArrayLike<number>, size = 1, first = 0): void {
    const { segments, points } = this;
    for (let i = 0; i + 1 < points; ++i) {
      for (let k = 0; k < 6; ++k) segments[6 * i + k] = size * rows[3 * (first + i) + k]!;
    }
    this.changed();
  }

  /** Of two points. */
  join(from: Vector3, to: Vector3): void {
    from.toArray(this.segments, 0);
    to.toArray(this.segments, 3);
    this.changed();
  }

  private changed(): void {
    (this.geometry.attributes["instanceStart"] as InterleavedBufferAttribute).data.needsUpdate =
      true;
    if (this.dashed) this.line.computeLineDistances();
  }
}

/** A line of one pixel: for a thousand points, which as a Path cost more than all the rest. */
export class Hairline {
  readonly line: Line;
  private readonly places: BufferAttribute;

  constructor(points: number, { colour, opacity }: { colour: string; opacity: number }) {
    this.places = new BufferAttribute(new Float32Array(3 * points), 3).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry().setAttribute("position", this.places);
    const material = new LineBasicMaterial({ color: colour, transparent: true, opacity });
    this.line = new Line(geometry, material);
    this.line.frustumCulled = false;
  }

  set visible(on: boolean) {
    this.line.visible = on;
  }

  follow(rows: ArrayLike<number>, size: number): void {
    const { array } = this.places;
    for (let i = 0; i < array.length; ++i) array[i] = size * rows[i]!;
    this.places.needsUpdate = true;
  }
}

const UP = new Vector3(0, 1, 0);
const ORIGIN = new Vector3();
const HEAD = new ConeGeometry(0.045, 0.15, 20).translate(0, -0.075, 0);

export class Arrow {
  readonly group = new Group();
  private readonly shaft: Path;
  private readonly head: Mesh;
  private readonly way = new Vector3();
  private readonly end = new Vector3();

  constructor(look: LineLook) {
    this.shaft = new Path(2, look);
    this.head = new Mesh(HEAD, flat(look.colour));
    this.head.scale.setScalar(Math.min(1, 0.35 + 0.22 * look.width));
    this.group.add(this.shaft.line, this.head);
  }

  set visible(on: boolean) {
    this.group.visible = on;
  }

  point(tip: Vector3, from = ORIGIN): void {
    const { way, end, head } = this;
    way.subVectors(tip, from);
    const size = way.length();
    head.visible = size > 1e-6;
    const short = Math.max(0, 1 - 0.1 / Math.max(size, 0.1));
    this.shaft.join(from, end.copy(from).addScaledVector(way, short));
    head.position.copy(tip);
    if (size > 1e-6) head.quaternion.setFromUnitVectors(UP, way.multiplyScalar(1 / size));
  }
}
