// SPDX-License-Identifier: MIT
// Motion under a gravity gradient, under damping, in a precessing frame.
import { DomainError, args, call, checked, filled, numbersOf, refusal, result, results } from "./module.js";
import { STATE_SIZE } from "./motion.js";
import type { Body, RotorState, Vec3 } from "./state.js";
import { vector } from "./state.js";

/** Any consistent units; angles in rad. */
export interface KeplerOrbit {
  /** Of the central mass: length^3 / time^2. */
  readonly gm: number;
  /** Distance a (1 - e). */
  readonly pericentre: number;
  readonly eccentricity: number;
  readonly inclination?: number;
  readonly node?: number;
  readonly argument?: number;
  /** At `epoch`. */
  readonly meanAnomaly?: number;
  readonly epoch?: number;
}

export interface Perturbed {
  readonly body: Body;
  /** At `start`; relative to the frame where there is one. */
  readonly state: RotorState;
  readonly start?: number;
  readonly stop: number;
  /** Evenly spaced samples, start and stop among them; at least 2. */
  readonly count: number;
  readonly gravityGradient?: KeplerOrbit;
  /** k of v = k g x w, in 1 / momentum: takes energy, and no momentum. */
  readonly internalDamping?: number;
  /** d of the torque -d w. */
  readonly linearDamping?: number;
  /** Axes that precess about `axis` at `rate`; at t = 0 they are the inertial ones. */
  readonly precessingFrame?: { readonly axis: Vec3; readonly rate: number };
  /** Of the local error of a step; 1e-12. */
  readonly tolerance?: number;
  /** Of the whole run, which ends there; each sample takes at least one. 200,000, some seconds. */
  readonly mostSteps?: number;
}

export interface Trajectory {
  readonly times: Float64Array;
  /** Rows of STATE_SIZE. */
  readonly states: Float64Array;
  /** The Hamiltonian of the motion in its frame: constant where nothing depends on time or damps. */
  readonly energy: Float64Array;
  readonly kineticEnergy: Float64Array;
  /** Rows of 6: l, g, h, L, G, H of the canonical momentum. */
  readonly andoyer: Float64Array;
  /** The same of the momentum of the free motion that touches this one. */
  readonly osculating: Float64Array;
  /** Why the run ended before `stop`, a sentence; "" where it did not. */
  readonly ended: string;
}

const PROBLEM_SIZE = 28, SAMPLE_SIZE = 22;

/** The motion with terms, integrated. DomainError for what the library refuses. */
export function integrate(problem: Perturbed): Trajectory {
  const { body, state, start = 0, stop, count } = problem;
  const orbit = problem.gravityGradient, frame = problem.precessingFrame;
  const numbers = [
    ...body.moments, ...state.q, ...state.g, start, stop, problem.tolerance ?? 1e-12,
    ...(orbit === undefined ? [0, 0, 0, 0, 0, 0, 0, 0] : elements(orbit)),
    problem.internalDamping ?? 0, problem.linearDamping ?? 0,
    ...(frame?.axis ?? [0, 0, 1]), frame?.rate ?? 0, problem.mostSteps ?? 200_000,
  ];
  let made = 0;
  const rows = filled(numbersOf(count, SAMPLE_SIZE, 2), undefined, (address) => {
    made = call("integrate", args(PROBLEM_SIZE, ...numbers), count, address);
    return SAMPLE_SIZE * Math.max(made, 0);
  });
  if (made < 0) throw new DomainError(refusal());
  const columns = (from: number, size: number): Float64Array => {
    const column = new Float64Array(size * made);
    for (let i = 0; i < made; ++i)
      column.set(rows.subarray(SAMPLE_SIZE * i + from, SAMPLE_SIZE * i + from + size), size * i);
    return column;
  };
  return {
    times: columns(0, 1),
    states: columns(1, STATE_SIZE),
    energy: columns(8, 1),
    kineticEnergy: columns(9, 1),
    andoyer: columns(10, 6),
    osculating: columns(16, 6),
    ended: refusal(),
  };
}

function elements(orbit: KeplerOrbit): number[] {
  const { gm, pericentre, eccentricity, inclination = 0, node = 0, argument = 0 } = orbit;
  return [gm, pericentre, eccentricity, inclination, node, argument, orbit.meanAnomaly ?? 0, orbit.epoch ?? 0];
}

/** Where the body is on its orbit about the central mass, inertial axes. DomainError for no orbit. */
export function orbitPosition(orbit: KeplerOrbit, t: number): Vec3 {
  checked("orbit_position", args(8, ...elements(orbit)), t, results());
  return vector(result(3));
}

/** The k of internal damping with which a small wobble falls by e in `time` at the momentum G. */
export function dampingOfWobble(body: Body, time: number, G: number): number {
  checked("damping_of_wobble", args(3, ...body.moments), time, G, results());
  return result(1)[0]!;
}
