// SPDX-License-Identifier: MIT
// Keeps the pictures coming on a weak machine. When the screen waits for them, the body is drawn in
// fewer pixels and the pictures beside it take turns; after a while that goes well it tries more. What
// stands still is drawn in full.
const SLOW = 24; // ms between pictures: fewer than 42 a second
const FAST = 18;
const PATIENCE = 8; // slow pictures in a row
const TRUST = 180; // fast ones in a row; twice as many after each disappointment

interface Level {
  /** Pixels of the body along an edge, over those of the screen. */
  readonly fineness: number;
  /** Every which picture of a view beside the body is drawn. */
  readonly every: number;
  /** ms between two showings of the numbers. */
  readonly numbers: number;
}
const LEVELS: readonly Level[] = [
  { fineness: 1, every: 1, numbers: 100 },
  { fineness: 0.75, every: 2, numbers: 200 },
  { fineness: 0.5, every: 2, numbers: 330 },
  { fineness: 0.35, every: 4, numbers: 500 },
];

export class Pacing {
  private slow = 0;
  private fast = 0;
  private trust = TRUST;
  private level = 0;

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

  get now(): Level {
    return LEVELS[this.level]!;
  }
  get still(): Level {
    return LEVELS[0]!;
  }
}
