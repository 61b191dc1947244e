// SPDX-License-Identifier: MIT
// Charts of a state: each to and from the hub. Angles in rad.
import { args, checked, result, results, setResult } from "./module.js";
import type { Body, Matrix3, Quaternion, RotorState, Vec3 } from "./state.js";
import { stateResult, vector } from "./state.js";

export interface Andoyer {
  readonly l: number;
  readonly g: number;
  readonly h: number;
  readonly L: number;
  readonly G: number;
  readonly H: number;
}
/** 3-1-3 angles and their momenta. */
export interface Euler {
  readonly phi: number;
  readonly theta: number;
  readonly psi: number;
  readonly Phi: number;
  readonly Theta: number;
  readonly Psi: number;
}
export interface EulerAngles {
  readonly phi: number;
  readonly theta: number;
  readonly psi: number;
}
export interface EulerRates extends EulerAngles {
  readonly phiDot: number;
  readonly thetaDot: number;
  readonly psiDot: number;
}
export type Pole = "zero" | "pi";
export interface Poincare {
  readonly sigma: number;
  readonly Q1: number;
  readonly Q2: number;
  readonly G: number;
  readonly P1: number;
  readonly P2: number;
  readonly poleJ: Pole;
  readonly poleI: Pole;
}
export interface RollPitchYaw {
  readonly roll: number;
  readonly pitch: number;
  readonly yaw: number;
}
export type Sign = 1 | -1;
/** Short-axis or long-axis mode. */
export type Mode = "short_axis" | "long_axis";
export interface Serret {
  readonly g0: number;
  readonly h: number;
  readonly t0: number;
  readonly G: number;
  readonly H: number;
  readonly T: number;
  readonly signG1: Sign;
  readonly signG3: Sign;
}
/** Action-angle variables. */
export interface Sadov {
  readonly phiL: number;
  readonly phiG: number;
  readonly phiH: number;
  readonly IL: number;
  readonly IG: number;
  readonly IH: number;
  readonly region: Mode;
  readonly lobe: Sign;
}
/** As observers of asteroids describe a motion (long-axis convention of Kaasalainen 2001). */
export interface Tumbler {
  /** P_phi: mean period of the long axis about the momentum. */
  readonly precessionPeriod: number;
  /** P_psi: period of the motion about, or the swing around, the long axis. */
  readonly rotationPeriod: number;
  /** Direction of the momentum, inertial axes. */
  readonly pole: Vec3;
  readonly mode: Mode;
  readonly phi0: number;
  readonly psi0: number;
  readonly branch?: Sign;
  readonly sense?: Sign;
}

// The numbers of polhode_web.h.
const ANDOYER = 0, EULER = 1, EULER_RATES = 2, POINCARE = 3, ROLL_PITCH_YAW = 4, EULER_ANGLES = 5, MATRIX = 6;
const SIZES = [6, 6, 6, 8, 3, 3, 9];
export const SERRET = 0, SADOV = 1, TUMBLER = 2;

const ONE: Vec3 = [1, 1, 1];
const STILL: Vec3 = [0, 0, 0];

function to(chart: number, count: number, s: RotorState, moments: Vec3 = ONE): number[] {
  const at = args(10, ...moments, ...s.q, ...s.g);
  checked("to_chart", chart, at, at + 24, results());
  return result(count);
}
function from(chart: number, numbers: readonly number[], moments: Vec3 = ONE): RotorState {
  const at = args(3 + SIZES[chart]!, ...moments, ...numbers);
  checked("from_chart", chart, at, at + 24, results());
  return stateResult();
}
const attitude = (q: Quaternion): RotorState => ({ q, g: STILL });

export function toAndoyer(s: RotorState): Andoyer {
  const [l, g, h, L, G, H] = to(ANDOYER, 6, s) as [number, number, number, number, number, number];
  return { l, g, h, L, G, H };
}
export function toEuler(s: RotorState): Euler {
  const [phi, theta, psi, Phi, Theta, Psi] = to(EULER, 6, s) as [number, number, number, number, number, number];
  return { phi, theta, psi, Phi, Theta, Psi };
}
export function toEulerRates(body: Body, s: RotorState): EulerRates {
  const [phi, theta, psi, phiDot, thetaDot, psiDot] = to(EULER_RATES, 6, s, body.moments) as [
    number, number, number, number, number, number,
  ];
  return { phi, theta, psi, phiDot, thetaDot, psiDot };
}

const pole = (number: number): Pole => (number === 1 ? "pi" : "zero");
const poleNumber = (of: Pole): number => (of === "pi" ? 1 : 0);

export function toPoincare(s: RotorState, poleJ: Pole, poleI: Pole): Poincare {
  return poincare(s, poleNumber(poleJ), poleNumber(poleI));
}
/** The set that is regular where the state is. */
export function nearestPoincare(s: RotorState): Poincare {
  return poincare(s, -1, -1);
}
function poincare(s: RotorState, poleJ: number, poleI: number): Poincare {
  setResult(6, poleJ);
  setResult(7, poleI);
  const found = to(POINCARE, 8, s);
  const [sigma, Q1, Q2, G, P1, P2] = found as [number, number, number, number, number, number];
  return { sigma, Q1, Q2, G, P1, P2, poleJ: pole(found[6]!), poleI: pole(found[7]!) };
}

export function toRollPitchYaw(q: Quaternion): RollPitchYaw {
  const [roll, pitch, yaw] = to(ROLL_PITCH_YAW, 3, attitude(q)) as [number, number, number];
  return { roll, pitch, yaw };
}
export function toEulerAngles(q: Quaternion): EulerAngles {
  const [phi, theta, psi] = to(EULER_ANGLES, 3, attitude(q)) as [number, number, number];
  return { phi, theta, psi };
}
/** R of v_B = R v_I. */
export const toMatrix = (q: Quaternion): Matrix3 => to(MATRIX, 9, attitude(q));

export const fromAndoyer = (a: Andoyer): RotorState => from(ANDOYER, [a.l, a.g, a.h, a.L, a.G, a.H]);
export const fromEuler = (e: Euler): RotorState => from(EULER, [e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi]);
export const fromEulerRates = (body: Body, e: EulerRates): RotorState =>
  from(EULER_RATES, [e.phi, e.theta, e.psi, e.phiDot, e.thetaDot, e.psiDot], body.moments);
export const fromPoincare = (p: Poincare): RotorState =>
  from(POINCARE, [p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2, poleNumber(p.poleJ), poleNumber(p.poleI)]);
export const fromRollPitchYaw = (a: RollPitchYaw): Quaternion => from(ROLL_PITCH_YAW, [a.roll, a.pitch, a.yaw]).q;
export const fromEulerAngles = (a: EulerAngles): Quaternion => from(EULER_ANGLES, [a.phi, a.theta, a.psi]).q;
export const fromMatrix = (R: Matrix3): Quaternion => from(MATRIX, R).q;

const modeNumber = (mode: Mode): number => (mode === "long_axis" ? 1 : 0);
const modeOf = (number: number): Mode => (number === 1 ? "long_axis" : "short_axis");

function fromMotionChart(body: Body, chart: number, numbers: readonly number[], t: number): RotorState {
  const at = args(chart === TUMBLER ? 13 : 11, ...body.moments, ...numbers);
  checked("from_motion_chart", chart, at, at + 24, t, results());
  return stateResult();
}
/** The state at time t of the motion with these elements. */
export const fromSerret = (body: Body, s: Serret, t: number): RotorState =>
  fromMotionChart(body, SERRET, [s.g0, s.h, s.t0, s.G, s.H, s.T, s.signG1, s.signG3], t);
export const fromSadov = (body: Body, s: Sadov): RotorState =>
  fromMotionChart(body, SADOV, [s.phiL, s.phiG, s.phiH, s.IL, s.IG, s.IH, modeNumber(s.region), s.lobe], 0);
/** The state at the epoch of the phases. DomainError names what periods the body does not have. */
export const fromTumbler = (body: Body, s: Tumbler): RotorState =>
  fromMotionChart(
    body,
    TUMBLER,
    [
      s.precessionPeriod, s.rotationPeriod, ...s.pole, modeNumber(s.mode), s.phi0, s.psi0,
      s.branch ?? 1, s.sense ?? 1,
    ],
    0,
  );

const sign = (number: number | undefined): Sign => (number === -1 ? -1 : 1);

export function serretOf(x: readonly number[]): Serret {
  const [g0, h, t0, G, H, T] = x as [number, number, number, number, number, number];
  return { g0, h, t0, G, H, T, signG1: sign(x[6]), signG3: sign(x[7]) };
}
export function sadovOf(x: readonly number[]): Sadov {
  const [phiL, phiG, phiH, IL, IG, IH] = x as [number, number, number, number, number, number];
  return { phiL, phiG, phiH, IL, IG, IH, region: modeOf(x[6]!), lobe: sign(x[7]) };
}
export function tumblerOf(x: readonly number[]): Required<Tumbler> {
  return {
    precessionPeriod: x[0]!,
    rotationPeriod: x[1]!,
    pole: vector(x, 2),
    mode: modeOf(x[5]!),
    phi0: x[6]!,
    psi0: x[7]!,
    branch: sign(x[8]),
    sense: sign(x[9]),
  };
}

/** P_phi of the long axis where that of the short one is known: 1/P_phi = 1/P_short - 1/P_psi. */
export function longAxisPeriod(shortAxisPeriod: number, rotationPeriod: number): number {
  checked("long_axis_period", shortAxisPeriod, rotationPeriod, results());
  return result(1)[0]!;
}
/** The least P_psi / P_phi that the body has in a mode. */
export function leastPeriodRatio(body: Body, mode: Mode): number {
  checked("least_period_ratio", args(3, ...body.moments), modeNumber(mode), results());
  return result(1)[0]!;
}
