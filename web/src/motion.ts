// SPDX-License-Identifier: MIT
// The exact torque-free motion.
import { DomainError, args, call, checked, filled, numbersOf, refusal, result, results } from "./module.js";
import type { Sadov, Serret, Tumbler } from "./charts.js";
import { SADOV, SERRET, TUMBLER, sadovOf, serretOf, tumblerOf } from "./charts.js";
import type { Light } from "./light.js";
import type { Body, RotorState, Vec3 } from "./state.js";
import { stateOf, stateResult } from "./state.js";

export type Regime = "rest" | "steady" | "short_axis" | "long_axis" | "separatrix";
const REGIMES: readonly Regime[] = ["rest", "steady", "short_axis", "long_axis", "separatrix"];

/** Evenly spaced times: start, start + step, ... so many. */
export interface Grid {
  readonly start: number;
  readonly step: number;
  readonly count: number;
}
/** States at times of either kind have the bits of at(t). */
export type Times = Grid | Float64Array | readonly number[];

/** Numbers in a row of states: q (w, x, y, z) and g. */
export const STATE_SIZE = 7;

// The rows of polhode_web.h.
const STATES = 0, BODY_RATES = 1, INERTIAL_RATES = 2, HERPOLHODE = 3, ANDOYER_ROWS = 4, BRIGHTNESS = 5;

const isGrid = (times: Times): times is Grid => "step" in times;

// What was forgotten is given back.
const forgotten = new FinalizationRegistry<number>((handle) => {
  call("motion_release", handle);
});

/** The motion through a state, prepared once; any time, a billion turns on, at the same cost. It holds
 *  half a kilobyte of the core, which dispose() gives back, or else the collection of garbage. */
export class FreeRotation {
  readonly body: Body;
  readonly initialState: RotorState;
  readonly epoch: number;

  readonly regime: Regime;
  /** G. */
  readonly momentum: number;
  /** T. */
  readonly energy: number;
  readonly modulus: { readonly m: number; readonly m1: number };
  /** G^2 - 2 T I2 to its last digit: > 0 in short-axis, < 0 in long-axis mode. */
  readonly separatrixDistance: number;
  /** Of the momentum in the body, P_psi; Infinity on the separatrix and where there is none. */
  readonly polhodePeriod: number;
  readonly precessionRateLong: number;
  readonly precessionRateShort: number;
  /** Mean periods of the long (P_phi) and of the short axis about the momentum. */
  readonly precessionPeriodLong: number;
  readonly precessionPeriodShort: number;
  readonly circulationAction: number;
  /** Of the momentum in space; NaN at rest. */
  readonly momentumDirection: Vec3;

  readonly #frequencies: { readonly nL: number; readonly nG: number };
  readonly #angles: TumblingAngles;
  #handle: number;

  /** DomainError for a state that is not finite, q = 0, or a body of other moments than bodies have. */
  constructor(body: Body, state: RotorState, t0 = 0) {
    const at = args(10, ...body.moments, ...state.q, ...state.g);
    this.#handle = call("motion_of", at, at + 24, t0);
    if (this.#handle === 0) throw new DomainError(refusal());
    forgotten.register(this, this.#handle, this);
    this.body = body;
    this.initialState = state;
    this.epoch = t0;
    call("motion_summary", this.#handle, results());
    const x = result(19) as [
      number, number, number, number, number, number, number, number, number, number,
      number, number, number, number, number, number, number, number, number,
    ];
    this.regime = REGIMES[x[0]]!;
    this.momentum = x[1];
    this.energy = x[2];
    this.modulus = { m: x[3], m1: x[4] };
    this.separatrixDistance = x[5];
    this.polhodePeriod = x[6];
    this.precessionRateLong = x[7];
    this.precessionRateShort = x[8];
    this.precessionPeriodLong = (2 * Math.PI) / x[7];
    this.precessionPeriodShort = (2 * Math.PI) / x[8];
    this.circulationAction = x[9];
    this.momentumDirection = [x[10], x[11], x[12]];
    this.#frequencies = { nL: x[13], nG: x[14] };
    this.#angles = { longLeast: x[15], longMost: x[16], shortLeast: x[17], shortMost: x[18] };
  }

  get #motion(): number {
    if (this.#handle === 0) throw new Error("FreeRotation: used after dispose()");
    return this.#handle;
  }

  at(t: number): RotorState {
    call("motion_at", this.#motion, t, results());
    return stateResult();
  }

  /** Rows of STATE_SIZE. Where `out` is given, it is filled and returned. */
  states(times: Times, out?: Float64Array): Float64Array {
    return this.#rows(STATES, STATE_SIZE, times, out);
  }
  /** Rows of 3. */
  angularVelocities(times: Times, axes: "body" | "inertial", out?: Float64Array): Float64Array {
    return this.#rows(axes === "body" ? BODY_RATES : INERTIAL_RATES, 3, times, out);
  }
  /** Rows of 3: the end of the angular velocity in the invariable plane, two coordinates, and its part
   *  along the momentum, which is 2 T / G all the time. rad per time. */
  herpolhode(times: Times, out?: Float64Array): Float64Array {
    return this.#rows(HERPOLHODE, 3, times, out);
  }
  /** Rows of 6: l, g, h, L, G, H. */
  andoyer(times: Times, out?: Float64Array): Float64Array {
    return this.#rows(ANDOYER_ROWS, 6, times, out);
  }
  /** Brightness of an ellipsoid that scatters by the law of Lommel and Seeliger, one number a time, in
   *  units of semi-axis squared. */
  lightCurve(light: Light, times: Times, out?: Float64Array): Float64Array {
    return this.#rows(BRIGHTNESS, 1, times, out, args(9, ...light.semiAxes, ...light.toSun, ...light.toObserver));
  }

  #rows(kind: number, size: number, times: Times, out: Float64Array | undefined, light = 0): Float64Array {
    const motion = this.#motion;
    if (isGrid(times)) {
      const { start, step, count } = times;
      return filled(numbersOf(count, size), out, (address) => {
        checked("motion_rows", motion, kind, 0, start, step, count, light, address);
      });
    }
    const count = times.length;
    const fill = (address: number, input: number): void => {
      checked("motion_rows", motion, kind, input, 0, 0, count, light, address);
    };
    return filled(numbersOf(count, size), out, fill, times);
  }

  /** The closed curve of the momentum in the body through this state: rows of 3, the last equal to the
   *  first, at least 2. One row where it stands still; on the separatrix from one end to the other. */
  polhode(points = 257): Float64Array {
    return filled(numbersOf(points, 3, 2), undefined, (address) => 3 * call("motion_curve", this.#motion, points, address));
  }

  /** Times from start to stop, at most `most`, at which the momentum along the middle axis changes its
   *  sign, the flips of a wing nut; and the time between two, half a polhode period. */
  flips(start: number, stop: number, most = 1000): { readonly times: Float64Array; readonly every: number } {
    const interval = results();
    let count = 0;
    const times = filled(numbersOf(most, 1), undefined, (address) => {
      count = call("motion_flips", this.#motion, start, stop, most, address, interval);
      return Math.max(count, 0);
    });
    if (count < 0) throw new DomainError(refusal());
    return { times, every: result(1)[0]! };
  }

  /** Between which angles the long and the short axis swing about the momentum; NaN without polhode. */
  tumblingAngles(): TumblingAngles {
    return this.#angles;
  }
  /** How far the last digit of the input turns the attitude at t, rad. */
  roundingSensitivity(t: number): number {
    return call("motion_sensitivity", this.#motion, t);
  }

  serret(t: number): Serret {
    return serretOf(this.#chart(SERRET, 8, t));
  }
  sadov(t: number): Sadov {
    return sadovOf(this.#chart(SADOV, 8, t));
  }
  sadovFrequencies(): { readonly nL: number; readonly nG: number } {
    return this.#frequencies;
  }
  /** DomainError where there is no such description: steady rotation, separatrix, rest. */
  tumbler(t: number): Required<Tumbler> {
    return tumblerOf(this.#chart(TUMBLER, 10, t));
  }
  #chart(chart: number, size: number, t: number): number[] {
    checked("motion_chart", this.#motion, chart, t, results());
    return result(size);
  }

  dispose(): void {
    if (this.#handle === 0) return;
    forgotten.unregister(this);
    call("motion_release", this.#handle);
    this.#handle = 0;
  }
}

export interface TumblingAngles {
  readonly longLeast: number;
  readonly longMost: number;
  readonly shortLeast: number;
  readonly shortMost: number;
}

/** The state in row `index` of states. */
export function stateAt(rows: Float64Array, index: number): RotorState {
  return stateOf([...rows.subarray(STATE_SIZE * index, STATE_SIZE * (index + 1))]);
}
