// SPDX-License-Identifier: MIT
// Keeps the pictures coming on a weak machine. When the screen waits for them, the body is drawn in
// fewer pixels and the pictures beside it take turns; after a while that goes well it tries more. What
// stands still is drawn in full.
const SLOW = 24; // ms between pictures: fewer than 42 a second
const FAST = 18;
const PATIENCE = 8; // slow pictures in a row
const TRUST = 180; // fast ones in a row; twice as many after each disappointment

export interface Level {
  /** Pixels of the body along an edge, over those of the screen. */
  readonly fineness: number;
  /** Every which picture of a view beside the body is drawn. */
  readonly every: number;
  /** ms between two showings of the numbers. */
  readonly numbers: number;
}
const LEVELS: readonly Level[] = [
  { fineness: 2, every: 1, numbers: 100 },
  { fineness: 1, every: 1, numbers: 150 },
  { fineness: 0.75, every: 2, numbers: 250 },
  { fineness: 0.5, every: 4, numbers: 500 },
];
const REST = 250; // ms without a change: what is drawn then is drawn in full

export class Pacing {
  private slow = 0;
  private fast = 0;
  private trust = TRUST;
  private level: number;
  private last = -Infinity;

  /** On a machine that is known to be slow one level down. */
  constructor(slow: boolean) {
    this.level = slow ? 1 : 0;
  }

  /** The interval between two pictures of a motion. */
  after(interval: number): void {
    if (!(interval > 0)) return;
    this.slow = interval > SLOW ? this.slow + 1 : 0;
    this.fast = interval < FAST ? this.fast + 1 : 0;
    if (this.slow >= PATIENCE && this.level + 1 < LEVELS.length) {
      this.turn(1);
    } else if (this.fast >= this.trust && this.level > 0) {
      this.turn(-1);
      this.trust *= 2;
    }
  }

  private turn(by: 1 | -1): void {
    this.level += by;
    this.slow = this.fast = 0;
  }

  /** How to draw at this time: while much changes in a row, as far down as it has to be. */
  at(clock: number, playing: boolean): Level {
    const busy = playing || clock - this.last < REST;
    this.last = clock;
    return LEVELS[busy ? this.level : 0]!;
  }

  /** Of the first picture: soon, and in full a moment later. */
  get first(): Level {
    return LEVELS[1]!;
  }

  /** ms until what was drawn like this is to be drawn in full; 0: it was. */
  untilRest(drawn: Level): number {
    return drawn === LEVELS[0] ? 0 : REST + 50;
  }
}
