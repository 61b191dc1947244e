// SPDX-License-Identifier: MIT
// The same body with torques: the gravity of what it orbits, friction inside, drag. Integrated from
// the epoch on, as far as it is asked for; the state of any time is integrated from the sample before.
import {
  brightness,
  dampingOfWobble,
  integrate,
  orbitPosition,
  type KeplerOrbit,
  type Light,
  type Perturbed,
  type RotorState,
  type Vec3,
} from "polhode/core";
import type { Model } from "./model.js";
import type { Gravity, Scene } from "./scene.js";
import { DEG, scale, unit } from "./vectors.js";

const PER_TURN = 64; // samples: of a turn of the body or of a revolution, whichever is shorter
const MOST = 20_000; // samples: some 300 turns, a quarter of a second
const CHUNK = 512;
const TOLERANCE = 1e-10;
const SIZE = 7; // numbers of a state
// A link may ask for what no page can follow while it draws. Steps are at most some five times that of
// a brake, and shorter near a pericentre: so many in the mean of a sample, then the motion ends.
const STEPS = 16;
const SHORTEST = 1e-2; // of a turn or a revolution: times of the brakes

/** With the semi-axis as unit of length: only gm/r^3 acts. */
function orbitOf({ period, eccentricity, inclination, node, pericentre, anomaly }: Gravity): KeplerOrbit {
  if (!(period > 0 && Number.isFinite(period))) {
    throw new Error(`got a period of ${period}; expected a number above 0`);
  }
  if (!(eccentricity >= 0 && eccentricity < 1)) {
    throw new Error(`got an eccentricity of ${eccentricity}; expected one from 0 to below 1`);
  }
  return {
    gm: ((2 * Math.PI) / period) ** 2,
    pericentre: 1 - eccentricity,
    eccentricity,
    inclination: inclination * DEG,
    node: node * DEG,
    argument: pericentre * DEG,
    meanAnomaly: anomaly * DEG,
  };
}

function stateOf(rows: Float64Array, i: number): RotorState {
  const [w, x, y, z, a, b, c] = rows.subarray(SIZE * i, SIZE * (i + 1));
  return { q: [w!, x!, y!, z!], g: [a!, b!, c!] };
}

export class Driven {
  readonly orbit: KeplerOrbit;
  readonly epoch: number;
  readonly step: number;
  /** Rows of a state; `count` of them are there. */
  private states: Float64Array = new Float64Array(SIZE * CHUNK);
  count = 1;
  /** Why it goes no further, a sentence. */
  ended = "";
  readonly problem: Omit<Perturbed, "state" | "start" | "stop" | "count">;
  private flux = new Float64Array(0);
  private light: Light | null = null;

  /** DomainError for an orbit or a friction that there is not. */
  constructor(model: Model, gravity: Gravity, { epoch }: Pick<Scene, "epoch">) {
    const { body, motion, turn } = model;
    const { friction, drag } = gravity;
    for (const [name, time] of Object.entries({ friction, drag })) {
      if (!(time >= 0)) throw new Error(`got a time of ${time} for ${name}; expected 0 or more`);
    }
    this.orbit = orbitOf(gravity);
    this.epoch = epoch;
    const shorter = Math.min(turn, gravity.period);
    this.step = shorter / PER_TURN;
    for (const [name, time] of Object.entries({ friction, drag })) {
      if (time === 0 || time >= SHORTEST * shorter) continue;
      const least = Number((SHORTEST * shorter).toPrecision(3));
      throw new Error(
        `got a time of ${time} for ${name}; expected 0 for none, or ${least} or more: ` +
          "a hundredth of a turn or of a revolution",
      );
    }
    this.problem = {
      body,
      gravityGradient: this.orbit,
      internalDamping: friction > 0 ? dampingOfWobble(body, friction, motion.momentum) : 0,
      linearDamping: drag > 0 ? Math.max(...body.moments) / drag : 0,
      tolerance: TOLERANCE,
    };
    const { q, g } = motion.initialState;
    this.states.set([...q, ...g]);
    orbitPosition(this.orbit, epoch); // here, and not in a picture, it is refused
    this.follow(1);
    if (this.count < 2) throw new Error(this.ended);
  }

  /** Samples up to this index, as far as there are any. */
  private follow(index: number): void {
    while (this.count <= index && this.count < MOST && !this.ended) {
      const more = Math.min(CHUNK, Math.max(PER_TURN, this.count), MOST - this.count);
      const last = this.count - 1;
      const run = integrate({
        ...this.problem,
        state: this.sample(last),
        start: this.epoch + last * this.step,
        stop: this.epoch + (last + more) * this.step,
        count: more + 1,
        mostSteps: STEPS * more,
      });
      this.ended = run.ended;
      const made = run.states.length / SIZE;
      if (this.states.length < SIZE * (last + made)) {
        const wider = new Float64Array(Math.max(2 * this.states.length, SIZE * (last + made)));
        wider.set(this.states.subarray(0, SIZE * this.count));
        this.states = wider;
      }
      this.states.set(run.states.subarray(SIZE), SIZE * this.count);
      this.count += made - 1;
    }
  }

  private sample(i: number): RotorState {
    return stateOf(this.states, i);
  }

  /** Null before the epoch, and beyond what is followed. */
  at(t: number): RotorState | null {
    if (t !== this.last.t) this.last = { t, state: this.found(t) };
    return this.last.state;
  }
  private last: { t: number; state: RotorState | null } = { t: NaN, state: null };

  private found(t: number): RotorState | null {
    const place = (t - this.epoch) / this.step;
    if (!(place >= 0 && place < MOST)) return null;
    const before = Math.floor(place);
    this.follow(before);
    if (before >= this.count) return null;
    const start = this.epoch + before * this.step;
    const state = this.sample(before);
    if (!(t > start)) return state;
    const { states } = integrate({
      ...this.problem,
      state,
      start,
      stop: t,
      count: 2,
      mostSteps: STEPS * PER_TURN,
    });
    if (states.length < 2 * SIZE) return null;
    return stateOf(states, 1);
  }

  /** The samples from `low` to `high`, first and last index; last < first where there are none. */
  between(low: number, high: number): readonly [first: number, last: number] {
    const first = Math.max(0, Math.ceil((low - this.epoch) / this.step));
    const last = Math.floor((high - this.epoch) / this.step);
    if (!(last >= first && first < MOST)) return [0, -1];
    this.follow(Math.min(last, MOST - 1));
    return [first, Math.min(last, this.count - 1)];
  }

  time(i: number): number {
    return this.epoch + i * this.step;
  }

  /** The momentum of a sample along a body axis, over its length. */
  ratio(i: number, axis: number): number {
    const at = SIZE * i + 4;
    const [a, b, c] = [this.states[at]!, this.states[at + 1]!, this.states[at + 2]!];
    return this.states[at + axis]! / Math.hypot(a, b, c);
  }

  /** Directions of the momentum in the body, rows of 3, of samples that are there. */
  directions(first: number, last: number): Float64Array {
    const rows = new Float64Array(3 * Math.max(0, last - first + 1));
    for (let i = first; i <= last; ++i) {
      for (const k of [0, 1, 2]) rows[3 * (i - first) + k] = this.ratio(i, k);
    }
    return rows;
  }

  /** Brightness of a sample. */
  brightness(light: Light, i: number): number {
    if (light !== this.light) {
      this.light = light;
      this.flux = new Float64Array(0);
    }
    if (this.flux.length <= i) {
      const wider = new Float64Array(this.states.length / SIZE).fill(NaN);
      wider.set(this.flux);
      this.flux = wider;
    }
    if (Number.isNaN(this.flux[i]!)) this.flux[i] = brightness(light, this.sample(i).q);
    return this.flux[i]!;
  }

  /** Where the centre is, seen from the body. */
  toCentre(t: number): Vec3 {
    return scale(-1, unit(orbitPosition(this.orbit, t)));
  }
}
