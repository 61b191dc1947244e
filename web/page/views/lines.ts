// SPDX-License-Identifier: MIT
// Lines of a width in pixels and arrows, which change in place from picture to picture.
import { ConeGeometry, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { InterleavedBufferAttribute } from "three";
import type { Vec3 } from "polhode/core";
import { length } from "../vectors.js";

export interface LineLook {
  readonly colour: string;
  readonly width: number;
  readonly opacity?: number;
  readonly dashed?: boolean;
}

/** A line through a fixed number of points. */
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
    this.dashed = look.dashed ?? false;
    this.material = new LineMaterial({
      linewidth: look.width,
      transparent: (look.opacity ?? 1) < 1,
      opacity: look.opacity ?? 1,
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

  /** Through the points of rows of 3, each times `size`. */
  follow(rows: ArrayLike<number>, size = 1): void {
    const { segments, points } = this;
    for (let i = 0; i + 1 < points; ++i) {
      for (let k = 0; k < 6; ++k) segments[6 * i + k] = size * rows[3 * i + k]!;
    }
    (this.geometry.attributes["instanceStart"] as InterleavedBufferAttribute).data.needsUpdate =
      true;
    if (this.dashed) this.line.computeLineDistances();
  }

  dispose(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}

const UP = new Vector3(0, 1, 0);
const HEAD = new ConeGeometry(0.045, 0.15, 20).translate(0, -0.075, 0);

export class Arrow {
  readonly group = new Group();
  private readonly shaft: Path;
  private readonly head: Mesh;
  private readonly material: MeshBasicMaterial;

  constructor(look: LineLook) {
    this.shaft = new Path(2, look);
    this.material = new MeshBasicMaterial({ color: look.colour });
    this.head = new Mesh(HEAD, this.material);
    this.head.scale.setScalar(Math.min(1, 0.35 + 0.22 * look.width));
    this.group.add(this.shaft.line, this.head);
  }

  set colour(colour: string) {
    this.shaft.colour = colour;
    this.material.color.set(colour);
  }
  set visible(on: boolean) {
    this.group.visible = on;
  }

  point(tip: Vec3, from: Vec3 = [0, 0, 0]): void {
    const way: Vec3 = [tip[0] - from[0], tip[1] - from[1], tip[2] - from[2]];
    const size = length(way);
    this.head.visible = size > 1e-6;
    const short = Math.max(0, 1 - 0.1 / Math.max(size, 0.1));
    this.shaft.follow([...from, ...way.map((w, k) => from[k]! + short * w)]);
    this.head.position.set(...(tip as [number, number, number]));
    if (size > 1e-6) {
      this.head.quaternion.setFromUnitVectors(
        UP,
        new Vector3(...way).multiplyScalar(1 / size),
      );
    }
  }
}
