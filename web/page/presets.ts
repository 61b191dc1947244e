// SPDX-License-Identifier: MIT
// Bodies to begin with, from the scenarios in examples/ and the paper's figures.
import {
  Body,
  fromAndoyer,
  fromEulerAngles,
  fromTumbler,
  rotorState,
  type Mode,
  type RotorState,
  type Vec3,
} from "polhode/core";
import type { Direction, Gravity, Scene } from "./scene.js";
import { DEG, direction } from "./vectors.js";

export interface Preset {
  readonly id: string;
  readonly group: "Bodies" | "Figures of the paper";
  readonly name: string;
  /** What to look at, one or two sentences. */
  readonly about: string;
  readonly source: string;
  readonly scene: () => Scene;
}

const PLAIN = {
  shape: "ellipsoid",
  overlay: "none",
  moment: "1",
  epoch: 0,
  now: 0,
  precession: null,
  friction: false,
  gravity: null,
  sun: [20, 10],
  observer: [-35, -5],
} as const;

const TURN = 2 * Math.PI;

/** In the plane of the first two inertial axes, at the pericentre at time 0. */
export const ORBIT: Gravity = {
  period: 1,
  eccentricity: 0,
  inclination: 0,
  node: 0,
  pericentre: 0,
  anomaly: 0,
  friction: 0,
  drag: 0,
};

function tumbling(
  moments: Vec3,
  mode: Mode,
  periods: readonly [phi: number, psi: number],
  pole: Direction,
): { moments: Vec3; state: RotorState } {
  const state = fromTumbler(new Body(...moments), {
    precessionPeriod: periods[0],
    rotationPeriod: periods[1],
    pole: direction(pole),
    mode,
    phi0: 0,
    psi0: 0,
  });
  return { moments, state };
}

function spinning(moments: Vec3, omega: Vec3, angles = { phi: 0, theta: 0, psi: 0 }) {
  const state = rotorState(new Body(...moments), fromEulerAngles(angles), omega);
  return { moments, state };
}

/** The state of the paper's figures of planes and angles. */
function planes(): { moments: Vec3; state: RotorState } {
  const [I, J] = [38 * DEG, 32 * DEG];
  const state = fromAndoyer({
    l: 55 * DEG,
    g: 70 * DEG,
    h: 40 * DEG,
    L: Math.cos(J),
    G: 1,
    H: Math.cos(I),
  });
  return { moments: [3, 4, 6], state };
}

const precessing = () => ({
  ...PLAIN,
  ...spinning([1, 2, 2.5], [0.75, 0.25, 0.45], { phi: 0.4, theta: 1.1, psi: -0.7 }),
  time: "s",
  pace: 1.5,
  precession: { axis: [0.2, -0.1, 1] as Vec3, rate: 0.15 },
});

export const PRESETS: readonly Preset[] = [
  {
    id: "wing-nut",
    group: "Bodies",
    name: "Wing nut",
    about:
      "Spun about the axis of the intermediate moment, it turns over again and again. Its momentum stays still in space; in the body it runs along a curve next to the separatrix.",
    source: "Dzhanibekov (1985); moments of a brass plate, examples/wing-nut.toml",
    scene: () => ({
      ...PLAIN,
      ...spinning([30.53, 83.87, 113.3], [0.01, 6.28, 0]),
      title: "Wing nut",
      shape: "wing-nut",
      time: "s",
      moment: "g cm2",
      pace: 0.5,
      sun: [132, 48],
      observer: [6, 59],
    }),
  },
  {
    id: "apophis",
    group: "Bodies",
    name: "Apophis",
    about:
      "A tumbler in short-axis mode: the long axis goes round the momentum in 30.56 h while the body rocks about it in 263 h. Its light curve never quite repeats.",
    source: "Pravec et al. (2014), Icarus 233, 48; phases set to 0",
    scene: () => ({
      ...PLAIN,
      ...tumbling([0.61, 0.965, 1], "short_axis", [30.56, 263], [250, -75]),
      title: "Apophis",
      time: "h",
      pace: 8,
      sun: [250, 0],
      observer: [210, 0],
    }),
  },
  {
    id: "toutatis",
    group: "Bodies",
    name: "Toutatis",
    about:
      "A tumbler in long-axis mode: it turns about its long axis in 5.37 d, while that axis goes round the momentum in 7.41 d.",
    source:
      "Attitudes from radar, Takahashi et al. (2013), AJ 146, 95; our fit, examples/toutatis-1992.toml",
    scene: () => ({
      ...PLAIN,
      ...tumbling(
        [1, 2.97786, 3.22207],
        "long_axis",
        [7.413686853, 5.370388817],
        [180.9371752, -54.66661952],
      ),
      title: "Toutatis",
      time: "d",
      pace: 1.25,
      sun: [215, 0],
      observer: [255, 10],
    }),
  },
  {
    id: "hyperion",
    group: "Bodies",
    name: "Hyperion's shape",
    about:
      "The ellipsoid of Hyperion, 190, 145 and 114 km, thrown freely. Near Saturn the gravity gradient makes its rotation chaotic; without it, it only tumbles.",
    source: "Shape: Wisdom, Peale & Mignard (1984), Icarus 58, 137; the start is ours",
    scene: () => ({
      ...PLAIN,
      ...spinning([34021, 49096, 57125], [50 * DEG, 52 * DEG, 30 * DEG]),
      title: "Hyperion's shape",
      time: "d",
      pace: 1.5,
      sun: [-20, 20],
      observer: [0, -30],
    }),
  },
  {
    id: "hyperion-saturn",
    group: "Bodies",
    name: "Hyperion at Saturn",
    about:
      "Free, it would turn evenly about its shortest axis. Saturn pulls at a body so long on an orbit so eccentric: the amber outline tumbles, and starts that differ by a thousandth part are far apart within half a year.",
    source:
      "Wisdom, Peale & Mignard (1984), Icarus 58, 137; orbit of 21.277 d, e = 0.1; the start of examples/hyperion.toml",
    scene: () => ({
      ...PLAIN,
      ...spinning([34021, 49096, 57125], [0, 0, 22 * DEG], {
        phi: 10 * DEG,
        theta: 30 * DEG,
        psi: 10 * DEG,
      }),
      title: "Hyperion at Saturn",
      time: "d",
      pace: 3,
      gravity: { ...ORBIT, period: 21.277, eccentricity: 0.1 },
      sun: [-20, 20],
      observer: [0, -30],
    }),
  },
  {
    id: "gravity-satellite",
    group: "Bodies",
    name: "Gravity-gradient satellite",
    about:
      "A boom that the Earth holds upright: thrown 20° off, the amber outline swings about the line to the Earth like a pendulum; friction inside slowly calms what of the swing leaves the plane of the orbit. Free, the satellite would stay behind.",
    source: "examples/gravity-gradient-satellite.toml, 800 km up, with a larger swing; the friction is ours",
    scene: () => ({
      ...PLAIN,
      ...spinning([10, 98, 100], [0, 0, 0.059480403488 * DEG], {
        phi: 20 * DEG,
        theta: 12 * DEG,
        psi: 0,
      }),
      title: "Gravity-gradient satellite",
      shape: "boom",
      time: "s",
      moment: "kg m2",
      pace: 600,
      gravity: { ...ORBIT, period: 6052.414, friction: 3000 },
      sun: [-50, 20],
      observer: [95, 35],
    }),
  },
  {
    id: "envisat",
    group: "Bodies",
    name: "Envisat",
    about:
      "The satellite, silent since 2012, turns once in 128 s about the axis of its greatest moment. Pull the dot off the pole of the sphere to make it wobble.",
    source:
      "Inertia: D-SPOSE; spin of May 2013: Lin & Zhao (2018); examples/envisat.toml without torques",
    scene: () => ({
      ...PLAIN,
      ...spinning([16979.74, 124801.207, 129180.253], [0, 0, 2.81788278 * DEG], {
        phi: 0,
        theta: 82 * DEG,
        psi: 0,
      }),
      title: "Envisat",
      shape: "satellite",
      time: "s",
      moment: "kg m2",
      pace: 30,
      sun: [-20, 10],
      observer: [10, 30],
    }),
  },
  {
    id: "earth",
    group: "Bodies",
    name: "Earth's wobble",
    about:
      "Euler's wobble of a rigid Earth: the pole moves round the axis of figure once in 304 days, 6 m off it: far too close to be seen on the sphere, so it is enlarged beside it. The real, elastic Earth takes 433 days.",
    source: "(C - A)/C = 0.0032737548: Souchay et al. (1999); examples/earth-wobble.toml",
    scene: () => ({
      ...PLAIN,
      ...spinning(
        [0.9967262452, 0.9967262452, 1],
        [9.7228e-7 * TURN, 0, 1.00273781191135448 * TURN],
      ),
      title: "Earth's wobble",
      time: "d",
      pace: 0.25,
      observer: [75, 0],
    }),
  },
  {
    id: "figure-1",
    group: "Figures of the paper",
    name: "Figure 1: phase flow on the sphere",
    about:
      "The momentum keeps its length, so in the body it moves on a sphere, along curves of equal energy. Drag the dot from one curve to another.",
    source: "Gurfil, Elipe, Tangren & Efroimsky (2007), figure 1; moments 3, 4, 6",
    scene: () => ({
      ...PLAIN,
      ...spinning([3, 4, 6], [0.25, 0.1, 0.2]),
      title: "Figure 1",
      time: "s",
      pace: 4,
    }),
  },
  {
    id: "figure-2",
    group: "Figures of the paper",
    name: "Figure 2: planes and nodes",
    about:
      "Three planes: the inertial one, the invariable one (normal to the momentum) and the body's equator. Their lines of intersection are the nodes from which Andoyer's h, g and l count.",
    source: "Gurfil et al. (2007), figure 2",
    scene: () => ({
      ...PLAIN,
      ...planes(),
      title: "Figure 2",
      overlay: "andoyer",
      time: "s",
      pace: 3,
    }),
  },
  {
    id: "figure-3",
    group: "Figures of the paper",
    name: "Figure 3: Euler's angles",
    about:
      "The same attitude, directly: phi in the inertial plane, theta between the axes, psi in the equator of the body. All three move; of Andoyer's angles only l and g do.",
    source: "Gurfil et al. (2007), figure 3",
    scene: () => ({
      ...PLAIN,
      ...planes(),
      title: "Figure 3",
      overlay: "euler",
      time: "s",
      pace: 3,
    }),
  },
  {
    id: "figure-4",
    group: "Figures of the paper",
    name: "Figure 4: phase plane of l and L",
    about:
      "The sphere unrolled: in the short-axis mode l circulates, in the long-axis mode it librates, as a pendulum does.",
    source: "Gurfil et al. (2007), figure 4; moments 3, 4, 6",
    scene: () => ({
      ...PLAIN,
      ...spinning([3, 4, 6], [0.12, 0.12, 0.2]),
      title: "Figure 4",
      time: "s",
      pace: 4,
    }),
  },
  {
    id: "figure-5",
    group: "Figures of the paper",
    name: "Figure 5: canonical elements",
    about:
      "In a frame that precesses, canonical elements do not osculate: put into the formulas of free rotation they give the inertial angular velocity. The paper draws it for an orbit; here is a rotation.",
    source: "Gurfil et al. (2007), section 4; the body of examples/precessing-frame.toml",
    scene: () => ({ ...precessing(), title: "Figure 5" }),
  },
  {
    id: "figure-6",
    group: "Figures of the paper",
    name: "Figure 6: osculating elements",
    about:
      "Osculating elements give the angular velocity relative to the frame, and leave every curve of the free motion: the dashed loop in the phase plane.",
    source: "Gurfil et al. (2007), section 4; the frame turns twice as fast as in figure 5",
    scene: () => ({
      ...precessing(),
      title: "Figure 6",
      precession: { axis: [0.2, -0.1, 1], rate: 0.3 },
    }),
  },
];

export const preset = (id: string): Preset => {
  const found = PRESETS.find((p) => p.id === id);
  if (!found) throw new Error(`preset: no "${id}"`);
  return found;
};
