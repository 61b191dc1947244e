// SPDX-License-Identifier: MIT
// The paper's figures 2 and 3 around a living body: the inertial plane, the invariable plane, the
// equator of the body, the nodes where they meet, and the angles that count from these.
import { CircleGeometry, Group, Mesh, Vector3 } from "three";
import { toAndoyer, toEuler, type RotorState, type Vec3 } from "polhode/core";
import type { Overlay } from "../scene.js";
import { rotate, scale, turned, unit } from "../vectors.js";
import type { Labels } from "./labels.js";
import { flat, Path } from "./lines.js";
import type { Palette } from "./palette.js";

const REACH = 1.45;
const ARC = 41;
const Z = new Vector3(0, 0, 1);

export class Planes {
  readonly group = new Group();
  private labels: Labels | null = null;
  private readonly place = new Vector3();
  private readonly discs: readonly Mesh[];
  private readonly rims: readonly Path[];
  private readonly nodes: readonly Path[];
  private readonly arcs: readonly Path[];

  constructor(private readonly colours: Palette) {
    const tones = [colours.soft, colours.sam, colours.lam];
    this.discs = tones.map((colour) => new Mesh(new CircleGeometry(REACH, 72), flat(colour, 0.1)));
    this.rims = tones.map((colour) => new Path(97, { colour, width: 1.5 }));
    this.nodes = [0, 1].map(() => new Path(2, { colour: colours.ink, width: 1.5, dashed: true }));
    this.arcs = [0, 1, 2, 3, 4].map(() => new Path(ARC, { colour: colours.ink, width: 2.5 }));
    this.group.add(...this.discs);
    for (const path of [...this.rims, ...this.nodes, ...this.arcs]) this.group.add(path.line);
    this.group.visible = false;
  }

  show(overlay: Overlay, state: RotorState, labels: Labels): void {
    this.group.visible = overlay !== "none";
    this.labels = labels;
    if (overlay === "none") return;
    const andoyer = toAndoyer(state);
    const euler = toEuler(state);
    const s1: Vec3 = [1, 0, 0];
    const s3: Vec3 = [0, 0, 1];
    const G = unit(rotate(state.q, state.g));
    const b3 = rotate(state.q, [0, 0, 1]);
    for (const [k, normal] of [s3, G, b3].entries()) this.plane(k, normal);
    this.discs[1]!.visible = overlay === "andoyer";
    this.rims[1]!.visible = overlay === "andoyer";
    const { colours } = this;
    if (overlay === "andoyer") {
      const I = Math.acos(Math.max(-1, Math.min(1, andoyer.H / andoyer.G)));
      const J = Math.acos(Math.max(-1, Math.min(1, andoyer.L / andoyer.G)));
      const i = turned(s3, s1, andoyer.h);
      const j = turned(G, i, andoyer.g);
      this.node(0, i, "i");
      this.node(1, j, "j");
      this.arc(0, "h", s3, s1, andoyer.h, 1.1, colours.soft);
      this.arc(1, "I", i, s3, I, 1.0, colours.soft);
      this.arc(2, "g", G, i, andoyer.g, 1.25, colours.sam);
      this.arc(3, "J", j, G, J, 1.15, colours.lam);
      this.arc(4, "l", b3, j, andoyer.l, 1.1, colours.lam);
    } else {
      const node = turned(s3, s1, euler.phi);
      this.node(0, node, "n");
      this.nodes[1]!.visible = false;
      this.arc(0, "φ", s3, s1, euler.phi, 1.1, colours.soft);
      this.arc(1, "θ", node, s3, euler.theta, 1.0, colours.momentum);
      this.arc(2, "ψ", b3, node, euler.psi, 1.2, colours.lam);
      this.arcs[3]!.visible = this.arcs[4]!.visible = false;
    }
  }

  private plane(k: number, normal: Vec3): void {
    this.discs[k]!.quaternion.setFromUnitVectors(Z, new Vector3(...normal));
    const across = unit(Math.abs(normal[2]) < 0.9 ? [-normal[1], normal[0], 0] : [0, normal[2], -normal[1]]);
    const rows: number[] = [];
    for (let i = 0; i < 97; ++i) {
      rows.push(...scale(REACH, turned(normal, across, (2 * Math.PI * i) / 96)));
    }
    this.rims[k]!.follow(rows);
  }

  private node(k: number, along: Vec3, text: string): void {
    const path = this.nodes[k]!;
    path.visible = true;
    path.follow([...scale(-REACH, along), ...scale(REACH, along)]);
    this.labels?.add(text, this.place.set(...along), this.colours.ink, REACH + 0.12);
  }

  private arc(
    k: number,
    text: string,
    axis: Vec3,
    start: Vec3,
    angle: number,
    radius: number,
    colour: string,
  ): void {
    const path = this.arcs[k]!;
    path.visible = true;
    path.colour = colour;
    const rows: number[] = [];
    for (let i = 0; i < ARC; ++i) {
      rows.push(...scale(radius, turned(axis, start, (angle * i) / (ARC - 1))));
    }
    path.follow(rows);
    this.labels?.add(text, this.place.set(...turned(axis, start, angle / 2)), colour, radius + 0.14);
  }
}
