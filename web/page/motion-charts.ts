// SPDX-License-Identifier: MIT
// The sets that belong to a motion: constants, actions and angles, what observers give.
import { fromSadov, fromSerret, fromTumbler, type Mode } from "polhode/core";
import { f, sub, type Chart } from "./chart.js";
import { DEG, direction } from "./vectors.js";

export const serret: Chart = {
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

export const sadov: Chart = {
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

const SIGNS = [
  ["1", "+1"],
  ["-1", "−1"],
] as const;

export const tumbler: Chart = {
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
  choices: [
    {
      label: "mode",
      options: [
        ["short_axis", "short-axis mode"],
        ["long_axis", "long-axis mode"],
      ],
    },
    { label: "branch", options: SIGNS },
    { label: "sense", options: SIGNS },
  ],
  chosen: (m, t) => {
    const { mode, branch, sense } = m.motion.tumbler(t);
    return [mode, String(branch), String(sense)];
  },
  first: (m) => {
    const [x, y, z] = m.motion.momentumDirection;
    return [NaN, NaN, Math.atan2(y, x), Math.atan2(z, Math.hypot(x, y)), 0, 0];
  },
  write: (m, _t, [precessionPeriod, rotationPeriod, longitude, latitude, phi0, psi0], chosen) => {
    if (Number.isNaN(precessionPeriod) || Number.isNaN(rotationPeriod)) {
      throw new Error("This motion has no such periods: type both of another one.");
    }
    return fromTumbler(m.body, {
      precessionPeriod: precessionPeriod!,
      rotationPeriod: rotationPeriod!,
      pole: direction([longitude! / DEG, latitude! / DEG]),
      mode: chosen[0] as Mode,
      phi0: phi0!,
      psi0: psi0!,
      branch: Number(chosen[1]) as 1 | -1,
      sense: Number(chosen[2]) as 1 | -1,
    });
  },
};
