// SPDX-License-Identifier: MIT
// The variable sets: what each holds of the state shown, and the state that typed numbers make.
import {
  fromAndoyer,
  fromEuler,
  fromEulerRates,
  fromPoincare,
  fromRollPitchYaw,
  inertialAngularVelocity,
  inertialMomentum,
  nearestPoincare,
  rotorState,
  angularVelocity,
  toAndoyer,
  toEuler,
  toEulerRates,
  toMatrix,
  toRollPitchYaw,
  type Pole,
} from "polhode/core";
import { f, sub, type Chart } from "./chart.js";
import { sadov, serret, tumbler } from "./motion-charts.js";

const rates: Chart = {
  id: "rates",
  name: "Attitude",
  about: "Quaternion from body to inertial axes, scalar first; angular velocity along the body axes.",
  fields: [
    ...["w", "x", "y", "z"].map((c) => f(sub("q", c), `quaternion ${c}`, "none")),
    ...["1", "2", "3"].map((c) => f(sub("ω", c), `angular velocity ${c}`, "rate")),
  ],
  read: (m, t) => {
    const s = m.at(t);
    return [...s.q, ...angularVelocity(m.body, s)];
  },
  write: (m, _t, [w, x, y, z, w1, w2, w3]) =>
    rotorState(m.body, [w!, x!, y!, z!], [w1!, w2!, w3!]),
};

const vectors: Chart = {
  id: "vectors",
  name: "In space",
  about: "Angular velocity and momentum along the inertial axes, and the energy.",
  fields: [
    ...["1", "2", "3"].map((c) => f(sub("Ω", c), `inertial angular velocity ${c}`, "rate", true)),
    ...["1", "2", "3"].map((c) => f(sub("G", c), `inertial momentum ${c}`, "momentum", true)),
    f("T", "kinetic energy", "energy", true),
    f("m", "elliptic parameter", "none", true),
  ],
  read: (m, t) => {
    const s = m.at(t);
    return [
      ...inertialAngularVelocity(m.body, s),
      ...inertialMomentum(s),
      m.motion.energy,
      m.motion.modulus.m,
    ];
  },
  write: (m, t) => m.at(t),
};

const euler: Chart = {
  id: "euler",
  name: "Euler",
  about: "3-1-3 angles and their canonical momenta.",
  fields: [
    f("φ", "phi", "angle"),
    f("θ", "theta", "angle"),
    f("ψ", "psi", "angle"),
    f("Φ", "Phi", "momentum"),
    f("Θ", "Theta", "momentum"),
    f("Ψ", "Psi", "momentum"),
  ],
  read: (m, t) => {
    const e = toEuler(m.at(t));
    return [e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi];
  },
  write: (_m, _t, [phi, theta, psi, Phi, Theta, Psi]) =>
    fromEuler({ phi: phi!, theta: theta!, psi: psi!, Phi: Phi!, Theta: Theta!, Psi: Psi! }),
};

const eulerRates: Chart = {
  id: "euler-rates",
  name: "Euler rates",
  about: "3-1-3 angles and how fast they change.",
  fields: [
    f("φ", "phi", "angle"),
    f("θ", "theta", "angle"),
    f("ψ", "psi", "angle"),
    f("φ̇", "rate of phi", "rate"),
    f("θ̇", "rate of theta", "rate"),
    f("ψ̇", "rate of psi", "rate"),
  ],
  read: (m, t) => {
    const e = toEulerRates(m.body, m.at(t));
    return [e.phi, e.theta, e.psi, e.phiDot, e.thetaDot, e.psiDot];
  },
  write: (m, _t, [phi, theta, psi, phiDot, thetaDot, psiDot]) =>
    fromEulerRates(m.body, {
      phi: phi!,
      theta: theta!,
      psi: psi!,
      phiDot: phiDot!,
      thetaDot: thetaDot!,
      psiDot: psiDot!,
    }),
};

const andoyer: Chart = {
  id: "andoyer",
  name: "Andoyer",
  about: "l, g, h and the momenta L = G cos J, G, H = G cos I. Free rotation moves l, g and L only.",
  fields: [
    f("l", "l", "angle"),
    f("g", "g", "angle"),
    f("h", "h", "angle"),
    f("L", "L", "momentum"),
    f("G", "G", "momentum"),
    f("H", "H", "momentum"),
  ],
  read: (m, t) => {
    const a = toAndoyer(m.at(t));
    return [a.l, a.g, a.h, a.L, a.G, a.H];
  },
  write: (_m, _t, [l, g, h, L, G, H]) => fromAndoyer({ l: l!, g: g!, h: h!, L: L!, G: G!, H: H! }),
};

const POLES = [
  ["zero", "0"],
  ["pi", "π"],
] as const;

const poincare: Chart = {
  id: "poincare",
  name: "Poincaré",
  about: "The one of the four sets that is regular at this state, and near it.",
  fields: [
    f("σ", "sigma", "angle"),
    f(sub("Q", "1"), "Q 1", "root"),
    f(sub("Q", "2"), "Q 2", "root"),
    f("G", "G", "momentum"),
    f(sub("P", "1"), "P 1", "root"),
    f(sub("P", "2"), "P 2", "root"),
  ],
  read: (m, t) => {
    const s = nearestPoincare(m.at(t));
    return [s.sigma, s.Q1, s.Q2, s.G, s.P1, s.P2];
  },
  choices: [
    { label: "J near", options: POLES },
    { label: "I near", options: POLES },
  ],
  chosen: (m, t) => {
    const { poleJ, poleI } = nearestPoincare(m.at(t));
    return [poleJ, poleI];
  },
  write: (_m, _t, [sigma, Q1, Q2, G, P1, P2], [poleJ, poleI]) =>
    fromPoincare({
      sigma: sigma!,
      Q1: Q1!,
      Q2: Q2!,
      G: G!,
      P1: P1!,
      P2: P2!,
      poleJ: poleJ as Pole,
      poleI: poleI as Pole,
    }),
};

const rollPitchYaw: Chart = {
  id: "roll-pitch-yaw",
  name: "Roll, pitch, yaw",
  about: "Tait and Bryan's angles of the attitude, 3-2-1. Typed, the momentum stays as the body sees it.",
  fields: ["roll", "pitch", "yaw"].map((name) => f(name, name, "angle")),
  read: (m, t) => {
    const { roll, pitch, yaw } = toRollPitchYaw(m.at(t).q);
    return [roll, pitch, yaw];
  },
  write: (m, t, [roll, pitch, yaw]) => ({
    q: fromRollPitchYaw({ roll: roll!, pitch: pitch!, yaw: yaw! }),
    g: m.at(t).g,
  }),
};

const matrix: Chart = {
  id: "matrix",
  name: "Matrix",
  about: "R of v_B = R v_I, row by row: from inertial to body axes.",
  fields: [1, 2, 3].flatMap((row) =>
    [1, 2, 3].map((column) =>
      f(sub("R", `${row}${column}`), `row ${row}, column ${column}`, "none", true),
    ),
  ),
  read: (m, t) => [...toMatrix(m.at(t).q)],
  write: (m, t) => m.at(t),
};

export const CHARTS: readonly Chart[] = [
  rates,
  andoyer,
  tumbler,
  vectors,
  euler,
  eulerRates,
  serret,
  sadov,
  poincare,
  rollPitchYaw,
  matrix,
];
