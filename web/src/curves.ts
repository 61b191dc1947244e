// SPDX-License-Identifier: MIT
// Polhodes on the sphere of the momentum, and in Andoyer's plane.
import { args, call, filled, numbersOf } from "./module.js";
import type { Mode } from "./charts.js";
import type { Body } from "./state.js";

/** A curve on the sphere |g| = G. */
export interface Curve {
  readonly mode: Mode | "separatrix";
  /** Which end of the long or short axis it goes about; of the separatrix the half circle, 0 to 3. */
  readonly side: number;
  /** T. */
  readonly energy: number;
  /** Rows of 3, body axes. Polhodes: the last equal to the first. Separatrix: from one end of the middle
   *  axis to the other. */
  readonly points: Float64Array;
}

const MODES: readonly Mode[] = ["long_axis", "short_axis"];

/** `perMode` polhodes about each end of the long and of the short axis, evenly spaced in the angle from
 *  the axis to the separatrix. None of a mode that the body does not have. */
export function polhodes(body: Body, G: number, perMode = 4, points = 129): Curve[] {
  const curves: Curve[] = [];
  for (const mode of MODES)
    for (const side of [1, -1])
      for (let i = 1; i <= perMode; ++i) {
        const angle = (Math.PI / 2) * (i / (perMode + 1));
        const isLong = mode === "long_axis" ? 1 : 0;
        const curve = curveOf(points, (address, moments) =>
          call("curve", moments, G, isLong, side, angle, points, address),
          body,
        );
        if (!Number.isNaN(curve.energy)) curves.push({ mode, side, ...curve });
      }
  return curves;
}

/** The four half circles of the separatrix; none where two moments are equal. */
export function separatrix(body: Body, G: number, points = 65): Curve[] {
  const curves: Curve[] = [];
  for (let side = 0; side < 4; ++side) {
    const long = side % 2 === 0 ? 1 : -1, short = side < 2 ? 1 : -1;
    const curve = curveOf(points, (address, moments) =>
      call("half_separatrix", moments, G, long, short, points, address),
      body,
    );
    if (!Number.isNaN(curve.energy)) curves.push({ mode: "separatrix", side, ...curve });
  }
  return curves;
}

function curveOf(
  points: number,
  fill: (address: number, moments: number) => number,
  body: Body,
): { energy: number; points: Float64Array } {
  let twice = NaN;
  const rows = filled(numbersOf(points, 3, 2), undefined, (address) => {
    twice = fill(address, args(3, ...body.moments));
  });
  return { energy: twice / 2, points: rows };
}

/** Rows of 2 of momenta in the body (rows of 3): l, without jumps, and L. */
export function andoyerPlane(momenta: Float64Array): Float64Array {
  const count = momenta.length / 3;
  const fill = (address: number, input: number): void => {
    call("andoyer_plane", input, count, address);
  };
  return filled(numbersOf(count, 2), undefined, fill, momenta);
}
