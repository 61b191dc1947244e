// polhode: free rotation of rigid bodies, exact, in WebAssembly.
//
//   import { Body, FreeRotation } from "polhode";            // ready when imported (top-level await)
//   import { load, Body, FreeRotation } from "polhode/core"; // the same; nothing works before
//   await load();                                            // load(): the file beside the script
//   await load(bytes);                                       // or bytes, a URL, a Response
//
// Units are any consistent set; angles are radians; rates rad per unit of time. Vectors are along
// the principal axes of the body (B) unless a name says inertial (I). Quaternions are [w, x, y, z],
// Hamilton, body to inertial: v_I = q v_B q*. Rows lie one after the other in Float64Arrays.
// What the library refuses is a DomainError with its own sentence. NaN in, NaN out.

export type Vec3 = readonly [x: number, y: number, z: number];
export type Quaternion = readonly [w: number, x: number, y: number, z: number];
/** Nine numbers, row by row. */
export type Matrix3 = readonly number[];

/** The library's refusal: message as in C++ and Python, "Body: moments (1, 1, 3) break ...". */
export class DomainError extends Error {}

/** Compiles and starts the core; later calls return at once. */
export function load(source?: string | URL | Response | BufferSource | WebAssembly.Module): Promise<void>;
/** "0.x.y" of the library. */
export function version(): string;

// ---------------------------------------------------------------- body and state

/** Principal moments about body axes 1, 2, 3, in any order. DomainError for those of no body. */
export class Body {
  constructor(I1: number, I2: number, I3: number);
  /** The ellipsoid of constant density with semi-axes a, b, c, mass 1. */
  static ofEllipsoid(semiAxes: Vec3, mass?: number): Body;
  readonly moments: Vec3;
  /** Semi-axes of the ellipsoid of constant density and this mass: [a, b, c] along axes 1, 2, 3. */
  semiAxes(mass?: number): Vec3;
  /** Indices of the axes by moment: [least, middle, greatest]. */
  readonly axisOrder: readonly [number, number, number];
}

/** The hub: attitude and angular momentum along the body axes. */
export interface RotorState {
  readonly q: Quaternion;
  readonly g: Vec3;
}

/** From an angular velocity; q is scaled to length 1. */
export function rotorState(body: Body, q: Quaternion, omegaBody: Vec3): RotorState;
export function rotorStateInertial(body: Body, q: Quaternion, omegaInertial: Vec3): RotorState;
/** Of a state as typed: finite, q not 0; q scaled to length 1. */
export function checkedState(state: RotorState): RotorState;

export function angularVelocity(body: Body, s: RotorState): Vec3;
export function inertialAngularVelocity(body: Body, s: RotorState): Vec3;
export function inertialMomentum(s: RotorState): Vec3;
export function kineticEnergy(body: Body, s: RotorState): number;

/** For dragging the momentum: the state whose body momentum points along `direction` (any length
 *  but 0), with the same |g| and the same momentum in space; the attitude turns by the least angle. */
export function withMomentumAlong(s: RotorState, direction: Vec3): RotorState;
/** The same direction of momentum, |g| as given (> 0): a faster or slower spin. */
export function withMomentum(s: RotorState, G: number): RotorState;

// ---------------------------------------------------------------- charts (each to and from the hub)

export interface Andoyer { l: number; g: number; h: number; L: number; G: number; H: number }
export interface Euler { phi: number; theta: number; psi: number; Phi: number; Theta: number; Psi: number }
export interface EulerRates { phi: number; theta: number; psi: number; phiDot: number; thetaDot: number; psiDot: number }
export type Pole = "zero" | "pi";
export interface Poincare { sigma: number; Q1: number; Q2: number; G: number; P1: number; P2: number; poleJ: Pole; poleI: Pole }
export interface RollPitchYaw { roll: number; pitch: number; yaw: number }
export interface EulerAngles { phi: number; theta: number; psi: number }
export interface Serret { g0: number; h: number; t0: number; G: number; H: number; T: number; signG1: 1 | -1; signG3: 1 | -1 }
export interface Sadov { phiL: number; phiG: number; phiH: number; IL: number; IG: number; IH: number; region: Mode; lobe: 1 | -1 }
/** As observers of asteroids describe it (long-axis convention of Kaasalainen 2001). */
export interface Tumbler {
  precessionPeriod: number; // P_phi of the long axis about the momentum
  rotationPeriod: number;   // P_psi about the long axis
  pole: Vec3;               // of the momentum, inertial axes, any length
  mode: Mode;
  phi0: number;
  psi0: number;
  branch?: 1 | -1;
  sense?: 1 | -1;
}
export type Mode = "short_axis" | "long_axis";
export type Regime = "rest" | "steady" | "short_axis" | "long_axis" | "separatrix";

export function toAndoyer(s: RotorState): Andoyer;
export function toEuler(s: RotorState): Euler;
export function toEulerRates(body: Body, s: RotorState): EulerRates;
export function toPoincare(s: RotorState, poleJ: Pole, poleI: Pole): Poincare;
/** The set that is regular where the state is. */
export function nearestPoincare(s: RotorState): Poincare;
export function toRollPitchYaw(q: Quaternion): RollPitchYaw;
export function toEulerAngles(q: Quaternion): EulerAngles;
/** R of v_B = R v_I. */
export function toMatrix(q: Quaternion): Matrix3;

export function fromAndoyer(s: Andoyer): RotorState;
export function fromEuler(s: Euler): RotorState;
export function fromEulerRates(body: Body, s: EulerRates): RotorState;
export function fromPoincare(s: Poincare): RotorState;
export function fromRollPitchYaw(angles: RollPitchYaw): Quaternion;
export function fromEulerAngles(angles: EulerAngles): Quaternion;
export function fromMatrix(R: Matrix3): Quaternion;
export function fromSerret(body: Body, s: Serret, t: number): RotorState;
export function fromSadov(body: Body, s: Sadov): RotorState;
/** The state at the epoch of the phases. DomainError names periods that the body does not have. */
export function fromTumbler(body: Body, s: Tumbler): RotorState;

/** 1/P_phi = 1/P_short - 1/P_psi: the long axis' period where that of the short one is known. */
export function longAxisPeriod(shortAxisPeriod: number, rotationPeriod: number): number;
/** Least P_psi / P_phi of the body in a mode. */
export function leastPeriodRatio(body: Body, mode: Mode): number;

// ---------------------------------------------------------------- the exact motion

/** Evenly spaced times: start, start + step, ... (count of them). */
export interface Grid { readonly start: number; readonly step: number; readonly count: number }
/** A grid is several times as fast as times of one's own. */
export type Times = Grid | Float64Array | readonly number[];
/** Numbers in a row of states: q (w, x, y, z), g (1, 2, 3). */
export const STATE_SIZE: 7;

/** The exact torque-free motion through `state` at t0: prepared once, any time at a constant cost.
 *  It holds memory of the core, given back by dispose() or when it is collected as garbage. */
export class FreeRotation {
  constructor(body: Body, state: RotorState, t0?: number);
  readonly body: Body;
  readonly initialState: RotorState;
  readonly epoch: number;

  readonly regime: Regime;
  readonly momentum: number;            // G
  readonly energy: number;              // T
  readonly modulus: { readonly m: number; readonly m1: number };
  /** G^2 - 2 T I2: > 0 in short-axis mode, < 0 in long-axis mode. */
  readonly separatrixDistance: number;
  /** Of the momentum in the body: P_psi. Infinity on the separatrix and where there is none. */
  readonly polhodePeriod: number;
  /** Mean periods of the long and of the short axis about the momentum (P_phi and P_short). */
  readonly precessionPeriodLong: number;
  readonly precessionPeriodShort: number;
  readonly precessionRateLong: number;
  readonly precessionRateShort: number;
  readonly circulationAction: number;
  readonly momentumDirection: Vec3;     // of the constant momentum, inertial axes; NaN at rest

  at(t: number): RotorState;
  /** Rows of STATE_SIZE. `out` is filled and returned where given (no allocation). */
  states(times: Times, out?: Float64Array): Float64Array;
  /** Rows of 3: angular velocity along the inertial axes; what the herpolhode is drawn of. */
  angularVelocities(times: Times, axes: "body" | "inertial", out?: Float64Array): Float64Array;
  /** Rows of 3: the end of omega on the invariable plane, of unit |w| / (2T/G) about the momentum:
   *  two coordinates in the plane and the constant height 2T/G along it. */
  herpolhode(times: Times, out?: Float64Array): Float64Array;
  /** Rows of 6: l, g, h, L, G, H. */
  andoyer(times: Times, out?: Float64Array): Float64Array;
  /** The closed curve of the momentum in the body through this state; one row of 3 per point, the
   *  last row equals the first. Steady rotation and rest: one row. Separatrix: from end to end. */
  polhode(points?: number): Float64Array;

  /** Times in [start, stop] at which the momentum crosses the plane of the least and the greatest
   *  axis (g along the middle axis changes sign): the flips of a wing nut, half a polhode period
   *  apart. At most `most` of them from start on; `every` is Infinity where there is no next. */
  flips(start: number, stop: number, most?: number): { times: Float64Array; every: number };
  /** Angles between body axes and momentum over a polhode, rad; NaN where there is no polhode. */
  tumblingAngles(): { longLeast: number; longMost: number; shortLeast: number; shortMost: number };
  /** How far the last digit of the input turns the attitude at t, rad (0.1 ms). */
  roundingSensitivity(t: number): number;

  /** DomainError where the chart does not exist. */
  serret(t: number): Serret;
  sadov(t: number): Sadov;
  sadovFrequencies(): { nL: number; nG: number };
  tumbler(t: number): Tumbler;

  /** Brightness of a Lommel-Seeliger ellipsoid along the motion, in units of semi-axis squared.
   *  Directions (any length) along the inertial axes to the Sun and to the observer. */
  lightCurve(light: Light, times: Times, out?: Float64Array): Float64Array;

  dispose(): void;
}

export interface Light {
  readonly semiAxes: Vec3; // along body axes 1, 2, 3: body.semiAxes()
  readonly toSun: Vec3;
  readonly toObserver: Vec3;
}
/** -2.5 log10 of a flux over its mean, in place or into `out`. */
export function magnitudes(flux: Float64Array, out?: Float64Array): Float64Array;
/** Brightness of the ellipsoid in one attitude. */
export function brightness(light: Light, q: Quaternion): number;
/** Angle Sun - body - observer, rad. */
export function phaseAngle(toSun: Vec3, toObserver: Vec3): number;

// ---------------------------------------------------------------- momentum sphere and phase plane

/** A closed curve on the sphere |g| = G. */
export interface Curve {
  readonly mode: Mode | "separatrix";
  /** 1 or -1: the side of the axis that it goes about (short or long axis); of the separatrix the
   *  number of the half circle, 0 to 3. */
  readonly side: number;
  readonly energy: number;
  /** Rows of 3, body axes; the last equals the first (separatrix: from -b2 to b2 or back). */
  readonly points: Float64Array;
}
/** Families of polhodes of |g| = G: `perMode` curves about each end of the long and of the short
 *  axis, evenly spaced in angle between axis and separatrix. */
export function polhodes(body: Body, G: number, perMode?: number, points?: number): Curve[];
/** The four half circles of the separatrix; none for bodies without one (two equal moments). */
export function separatrix(body: Body, G: number, points?: number): Curve[];
/** Andoyer's plane of such points: rows of 2, l (unwrapped along the row) and L. */
export function andoyerPlane(points: Float64Array): Float64Array;

// ---------------------------------------------------------------- perturbed motion

export interface KeplerOrbit {
  readonly gm: number;            // length^3 / time^2, of the central mass
  readonly pericentre: number;    // a (1 - e)
  readonly eccentricity: number;
  readonly inclination?: number;
  readonly node?: number;
  readonly argument?: number;
  readonly meanAnomaly?: number;  // at `epoch`
  readonly epoch?: number;
}
export interface Perturbed {
  readonly body: Body;
  readonly state: RotorState;     // at `start`, in the frame
  readonly start?: number;        // 0
  readonly stop: number;
  readonly count: number;         // evenly spaced samples, start and stop included; >= 2
  readonly gravityGradient?: KeplerOrbit;
  /** v = k g x w: takes energy, no momentum. k in 1 / momentum. */
  readonly internalDamping?: number;
  /** u = -d w. */
  readonly linearDamping?: number;
  /** A frame that precesses at `rate` about `axis`; the state is then relative to it. */
  readonly precessingFrame?: { readonly axis: Vec3; readonly rate: number };
  readonly tolerance?: number;    // 1e-12
}
export interface Trajectory {
  readonly times: Float64Array;
  readonly states: Float64Array;          // rows of STATE_SIZE, in the frame
  readonly energy: Float64Array;          // the Hamiltonian in the frame
  readonly kineticEnergy: Float64Array;
  readonly andoyer: Float64Array;         // canonical: rows of l, g, h, L, G, H
  readonly osculating: Float64Array;      // the same of the osculating free rotation
  /** "" or the sentence that says why the run ended before `stop`; samples so far are kept. */
  readonly ended: string;
}
/** DomainError for what the library refuses. */
export function integrate(problem: Perturbed): Trajectory;
/** k of internal damping with which a small wobble falls by e in `time` at momentum G. */
export function dampingOfWobble(body: Body, time: number, G: number): number;

// ---------------------------------------------------------------- the state elsewhere

export interface Copies { toml: string; python: string; cpp: string }
/** Text that makes the same motion, to the last bit, of the command line, Python and C++.
 *  `units` (names as in scenario files, "s", "kg m2") are written into the TOML. */
export function copies(body: Body, state: RotorState, options?: { t0?: number; title?: string; time?: string; moment?: string }): Copies;
