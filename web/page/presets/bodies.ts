// SPDX-License-Identifier: MIT
// Bodies to begin with, from the scenarios in examples/.
import { ORBIT, PLAIN, spinning, tumbling, TURN, type Preset } from "./starts.js";
import { DEG } from "../vectors.js";

export const BODIES: readonly Preset[] = [
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
];
