// SPDX-License-Identifier: MIT
// The variable sets: what each holds of the state shown, and the state that typed numbers make.
import {
  fromAndoyer,
  fromEuler,
  fromEulerRates,
  fromSadov,
  fromSerret,
  fromTumbler,
  inertialAngularVelocity,
  inertialMomentum,
  rotorState,
  angularVelocity,
  toAndoyer,
  toEuler,
  toEulerRates,
  type RotorState,
} from "polhode/core";
import type { Model } from "./model.js";
import type { Dimension } from "./scene.js";
import { direction, DEG } from "./vectors.js";

export interface Field {
  /** HTML of the symbol, and the same for readers of screens. */
  readonly symbol: string;
  readonly label: string;
  readonly dimension: Dimension;
  /** A number that follows from others: it is shown, and cannot be typed. */
  readonly fixed?: boolean;
}

export interface Chart {
  readonly id: string;
  readonly name: string;
  readonly about: string;
  readonly fields: readonly Field[];
  /** DomainError where the motion has no such variables. */
  readonly read: (model: Model, t: number) => number[];
  readonly write: (model: Model, t: number, values: readonly number[]) => RotorState;
}

const f = (symbol: string, label: string, dimension: Dimension, fixed = false): Field => ({
  symbol,
  label,
  dimension,
  fixed,
});
const sub = (letter: string, index: string) => `${letter}<sub>${index}</sub>`;

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

const serret: Chart = {
  id: "serret",
  name: "Serret",
  about: "Canonical constants of the free motion: nothing here moves.",
  fields: [
    f(sub("g", "0"), "g 0", "angle"),
    f("h", "h", "angle"),
    f(sub("t", "0"), "t 0", "time"),
    f("G", "G", "momentum"),
    f("H", "H", "momentum"),
    f("T", "T", "energy"),
  ],
  read: (m, t) => {
    const s = m.motion.serret(t);
    return [s.g0, s.h, s.t0, s.G, s.H, s.T];
  },
  write: (m, t, [g0, h, t0, G, H, T]) =>
    fromSerret(m.body, { ...m.motion.serret(t), g0: g0!, h: h!, t0: t0!, G: G!, H: H!, T: T! }, t),
};

const sadov: Chart = {
  id: "sadov",
  name: "Sadov",
  about: "Action and angle: the momenta are constant, the angles grow evenly.",
  fields: [
    f(sub("φ", "l"), "phi l", "angle"),
    f(sub("φ", "g"), "phi g", "angle"),
    f(sub("φ", "h"), "phi h", "angle"),
    f(sub("I", "l"), "I l", "momentum"),
    f(sub("I", "g"), "I g", "momentum"),
    f(sub("I", "h"), "I h", "momentum"),
  ],
  read: (m, t) => {
    const s = m.motion.sadov(t);
    return [s.phiL, s.phiG, s.phiH, s.IL, s.IG, s.IH];
  },
  write: (m, t, [phiL, phiG, phiH, IL, IG, IH]) =>
    fromSadov(m.body, {
      ...m.motion.sadov(t),
      phiL: phiL!,
      phiG: phiG!,
      phiH: phiH!,
      IL: IL!,
      IG: IG!,
      IH: IH!,
    }),
};

const tumbler: Chart = {
  id: "tumbler",
  name: "Tumbler",
  about:
    "As observers give it: periods of the long axis, pole of the momentum, two angles (Kaasalainen 2001).",
  fields: [
    f(sub("P", "φ"), "precession period", "time"),
    f(sub("P", "ψ"), "rotation period", "time"),
    f("λ", "longitude of the pole", "angle"),
    f("β", "latitude of the pole", "angle"),
    f(sub("φ", "0"), "phi 0", "angle"),
    f(sub("ψ", "0"), "psi 0", "angle"),
  ],
  read: (m, t) => {
    const s = m.motion.tumbler(t);
    const [x, y, z] = s.pole;
    return [
      s.precessionPeriod,
      s.rotationPeriod,
      Math.atan2(y, x),
      Math.atan2(z, Math.hypot(x, y)),
      s.phi0,
      s.psi0,
    ];
  },
  write: (m, t, [precessionPeriod, rotationPeriod, longitude, latitude, phi0, psi0]) =>
    fromTumbler(m.body, {
      ...m.motion.tumbler(t),
      precessionPeriod: precessionPeriod!,
      rotationPeriod: rotationPeriod!,
      pole: direction([longitude! / DEG, latitude! / DEG]),
      phi0: phi0!,
      psi0: psi0!,
    }),
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
];
