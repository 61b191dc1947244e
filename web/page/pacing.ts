// SPDX-License-Identifier: MIT
// Keeps the pictures coming on a weak machine: when the screen waits for them, the body is drawn in
// fewer pixels, and that stays so until the reader comes back.
const SLOW = 28; // ms between pictures: fewer than 36 a second
const PATIENCE = 12; // pictures in a row
const FINENESS: readonly number[] = [1, 0.75, 0.5];

export class Pacing {
  private slow = 0;
  private level = 0;

  /** What the interval between two pictures says; the fineness to draw with, where it changes. */
  after(interval: number): number | null {
    this.slow = interval > SLOW ? this.slow + 1 : Math.max(0, this.slow - 2);
    if (this.slow < PATIENCE || this.level + 1 >= FINENESS.length) return null;
    this.slow = 0;
    return FINENESS[++this.level]!;
  }
}
