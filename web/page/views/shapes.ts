// SPDX-License-Identifier: MIT
// What stands for the body: an ellipsoid or a box with its moments, a nut, a satellite. The last two
// are sketches of a size that fits the first.
import {
  BoxGeometry,
  BufferGeometry,
  CylinderGeometry,
  EdgesGeometry,
  ExtrudeGeometry,
  Float32BufferAttribute,
  Group,
  LatheGeometry,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshLambertMaterial,
  Shape as Outline,
  SphereGeometry,
  Vector2,
} from "three";
import type { Vec3 } from "polhode/core";
import type { Shape } from "../scene.js";
import type { Palette } from "./palette.js";

/** A group with its parts along the body axes, the longest semi-axis 1. */
export function shapeOf(shape: Shape, axes: Vec3, colours: Palette): Group {
  const stone = new MeshLambertMaterial({ color: colours.stone });
  const lines = new LineBasicMaterial({
    color: colours.dark ? "#ffffff" : "#000000",
    transparent: true,
    opacity: 0.22,
  });
  const group = new Group();
  const [a, b, c] = axes.map((v) => Math.max(v, 0.02)) as [number, number, number];
  if (shape === "ellipsoid") {
    const body = new Mesh(new SphereGeometry(1, 64, 40), stone);
    const net = new LineSegments(graticule(), lines);
    group.add(body, net);
    group.scale.set(a, b, c);
  } else if (shape === "box") {
    solid(group, new BoxGeometry(1.6 * a, 1.6 * b, 1.6 * c), stone, lines);
  } else if (shape === "boom") {
    boom(group, stone, lines, colours);
  } else if (shape === "wing-nut") {
    nut(group, stone, lines);
  } else {
    satellite(group, stone, lines, colours);
  }
  return group;
}

function solid(
  group: Group,
  geometry: BufferGeometry,
  material: MeshLambertMaterial,
  lines: LineBasicMaterial,
): Group {
  const part = new Group();
  part.add(new Mesh(geometry, material), new LineSegments(new EdgesGeometry(geometry, 30), lines));
  group.add(part);
  return part;
}

/** Meridians and parallels of the unit sphere about the third axis. */
function graticule(): BufferGeometry {
  const places: number[] = [];
  const push = (longitude: number, latitude: number) => {
    const r = 1.002 * Math.cos(latitude);
    places.push(r * Math.cos(longitude), r * Math.sin(longitude), 1.002 * Math.sin(latitude));
  };
  const steps = 72;
  for (let i = 0; i < steps; ++i) {
    const [from, to] = [(2 * Math.PI * i) / steps, (2 * Math.PI * (i + 1)) / steps];
    for (let k = -2; k <= 2; ++k) {
      push(from, (k * Math.PI) / 6);
      push(to, (k * Math.PI) / 6);
    }
    for (let k = 0; k < 6; ++k) {
      push((k * Math.PI) / 6, from);
      push((k * Math.PI) / 6, to);
    }
  }
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(places, 3));
}

/** Wings along axis 1, the thread along axis 2, thin along axis 3. */
function nut(group: Group, stone: MeshLambertMaterial, lines: LineBasicMaterial): void {
  const wall = [
    [0.15, -0.5],
    [0.34, -0.5],
    [0.25, 0.34],
    [0.15, 0.34],
    [0.15, -0.5],
  ].map(([x, y]) => new Vector2(x, y));
  solid(group, new LatheGeometry(wall, 48), stone, lines);
  const outline = new Outline();
  outline.moveTo(0.2, -0.34);
  outline.bezierCurveTo(0.5, -0.4, 0.7, -0.2, 0.92, 0.2);
  outline.bezierCurveTo(1.12, 0.52, 0.86, 0.72, 0.66, 0.5);
  outline.bezierCurveTo(0.5, 0.32, 0.42, 0.2, 0.22, 0.16);
  outline.closePath();
  const wing = new ExtrudeGeometry(outline, {
    depth: 0.12,
    bevelEnabled: true,
    bevelSize: 0.025,
    bevelThickness: 0.03,
    bevelSegments: 3,
    curveSegments: 20,
  }).translate(0, 0, -0.06);
  solid(group, wing, stone, lines);
  solid(group, wing.clone(), stone, lines).rotation.y = Math.PI;
}

/** A bus along axis 1, a sail of solar cells beyond its end. */
function satellite(
  group: Group,
  stone: MeshLambertMaterial,
  lines: LineBasicMaterial,
  colours: Palette,
): void {
  solid(group, new BoxGeometry(1.05, 0.42, 0.4), stone, lines).position.x = -0.3;
  const cells = new MeshLambertMaterial({ color: colours.sam });
  solid(group, new BoxGeometry(0.86, 0.4, 0.02), cells, lines).position.x = 0.78;
  solid(group, new CylinderGeometry(0.02, 0.02, 0.14), stone, lines).rotation.z = Math.PI / 2;
  group.children.at(-1)!.position.x = 0.28;
  const antenna = solid(group, new BoxGeometry(0.16, 0.02, 0.7), cells, lines);
  antenna.position.set(-0.45, -0.23, 0);
}

/** A bus and a mass at the two ends of a boom along axis 1. */
function boom(
  group: Group,
  stone: MeshLambertMaterial,
  lines: LineBasicMaterial,
  colours: Palette,
): void {
  solid(group, new BoxGeometry(0.36, 0.5, 0.3), stone, lines).position.x = -0.72;
  const cells = new MeshLambertMaterial({ color: colours.sam });
  solid(group, new BoxGeometry(0.2, 0.9, 0.02), cells, lines).position.x = -0.72;
  solid(group, new BoxGeometry(1.5, 0.04, 0.04), stone, lines).position.x = 0.14;
  solid(group, new BoxGeometry(0.16, 0.16, 0.16), stone, lines).position.x = 0.92;
}
