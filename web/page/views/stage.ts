// SPDX-License-Identifier: MIT
// What stands on the stage of the body's picture, for one body in one theme, in inertial axes.
import {
  AmbientLight,
  CircleGeometry,
  DirectionalLight,
  Group,
  Line,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  Scene as Stage,
  SphereGeometry,
  WebGLRenderer,
  type Camera,
} from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import type { Vec3 } from "polhode/core";
import type { Explorer } from "../explorer.js";
import type { Shape } from "../scene.js";
import { Arrow, flat, Hairline, Path } from "./lines.js";
import { palette } from "./palette.js";
import { Planes } from "./planes.js";
import { shapeOf } from "./shapes.js";

export const TRAIL = 900; // points of the herpolhode
export const RECENT = 160; // the last of them, drawn bold

/** What a stage is built for. */
interface Look {
  readonly key: string;
  readonly shape: Shape;
  readonly axes: Vec3;
  readonly order: readonly number[];
}

const keyOf = ({ scene }: Explorer): string =>
  [scene.title, scene.shape, scene.overlay, ...scene.moments].join();
export const stale = (parts: Parts, e: Explorer): boolean => parts.key !== keyOf(e);
export const lookOf = (e: Explorer): Look => ({
  key: keyOf(e),
  shape: e.scene.shape,
  axes: e.model.axes,
  order: e.model.body.axisOrder,
});

/** Null where the browser has no WebGL. */
export function started(canvas: HTMLCanvasElement): WebGLRenderer | null {
  try {
    // No samples of its own: these take half the time of a picture on a machine without a graphics
    // card. What is drawn in full is drawn in more pixels than the screen has.
    const renderer = new WebGLRenderer({ canvas, antialias: false, alpha: true });
    renderer.debug.checkShaderErrors = false; // to ask means to wait for each, one after another
    return renderer;
  } catch {
    return null;
  }
}

/** WebGL by the processor: no need to find out that it is slow. */
export function slow(renderer: WebGLRenderer | null): boolean {
  const gl = renderer?.getContext();
  const named = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = named ? String(gl!.getParameter(named.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/** Lets the shaders of all that is seen be translated at the same time. */
export function translated(renderer: WebGLRenderer, { stage }: Parts, camera: Camera): void {
  const seen = new Stage();
  stage.traverseVisible((thing) => {
    if (thing instanceof Mesh || thing instanceof Line) seen.children.push(thing);
  });
  renderer.compile(seen, camera, stage);
  renderer.getContext().flush();
}

export type Parts = ReturnType<typeof built>;

/** Everything on the stage, for one body in one theme. */
export function built({ key, shape: kind, axes: semiAxes, order }: Look) {
  const colours = palette();
  const stage = new Stage();
  const root = new Group();
  const body = new Group();
  const shape = shapeOf(kind, semiAxes, colours);
  body.add(shape);
  const driven = outlined(shape, colours.sun);
  const drivenMomentum = new Arrow({ colour: colours.sun, width: 2 });
  const centre = new Arrow({ colour: colours.soft, width: 1.5, dashed: true });
  const tones: string[] = [];
  tones[order[0]!] = colours.lam;
  tones[order[1]!] = colours.sep;
  tones[order[2]!] = colours.sam;
  const axes = tones.map((colour) => new Arrow({ colour, width: 2 }));
  const momentum = new Arrow({ colour: colours.momentum, width: 3 });
  const omega = new Arrow({ colour: colours.omega, width: 2.5 });
  const relative = new Arrow({ colour: colours.sun, width: 2, dashed: true });
  const past = new Hairline(TRAIL, { colour: colours.omega, opacity: 0.45 });
  const recent = new Path(RECENT, { colour: colours.omega, width: 2.2 });
  const invariable = new Mesh(
    new CircleGeometry(1.15, 72),
    flat(colours.momentum, colours.dark ? 0.1 : 0.07),
  );
  const planes = new Planes(colours);
  const sun = new Mesh(new SphereGeometry(0.07, 24, 16), flat(colours.sun));
  const observer = new Mesh(
    new SphereGeometry(0.045, 20, 12),
    flat(colours.soft),
  );
  const light = new DirectionalLight("#ffffff", 2.6);
  root.add(
    body,
    driven,
    drivenMomentum.group,
    centre.group,
    ...axes.map((axis) => axis.group),
    momentum.group,
    omega.group,
    relative.group,
    past.line,
    recent.line,
    invariable,
    planes.group,
    sun,
    observer,
    light,
  );
  stage.add(root, new AmbientLight("#ffffff", colours.dark ? 0.75 : 1.15));
  const hairs = new Map<LineBasicMaterial, number>();
  stage.traverse((thing) => {
    if (!(thing instanceof Line) || thing instanceof Line2) return;
    const material = thing.material as LineBasicMaterial;
    hairs.set(material, material.opacity);
  });
  const dispose = () => {
    stage.traverse((thing) => {
      if (!(thing instanceof Mesh || thing instanceof Line)) return;
      thing.geometry.dispose();
      for (const material of [thing.material].flat()) material.dispose();
    });
  };
  return {
    key,
    stage,
    root,
    body,
    shape,
    driven,
    drivenMomentum,
    centre,
    tones,
    axes,
    momentum,
    omega,
    relative,
    past,
    recent,
    invariable,
    planes,
    sun,
    observer,
    light,
    /** Of the free motion; of the one with torques. */
    traces: [past, recent, omega, invariable],
    pulled: [driven, drivenMomentum, centre],
    /** One pixel wide, so finer the more pixels there are: as much ink with `part` times as many along
     *  an edge. */
    hairs: (part: number) => {
      for (const [material, opacity] of hairs) material.opacity = Math.min(1, opacity * part);
    },
    dispose,
  };
}

/** The edges of a shape alone, just outside of it: a second body that hides nothing. */
function outlined(shape: Group, color: string): Group {
  const outline = shape.clone();
  const lines = new LineBasicMaterial({ color, transparent: true });
  outline.traverse((thing) => {
    if (thing instanceof LineSegments) thing.material = lines;
    else if (thing instanceof Mesh) thing.visible = false;
  });
  const turned = new Group();
  turned.add(outline);
  turned.scale.setScalar(1.015);
  return turned;
}
