// SPDX-License-Identifier: MIT
// The figures of the paper, alive.
import { PLAIN, planes, precessing, spinning, type Preset } from "./starts.js";

export const FIGURES: readonly Preset[] = [
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
