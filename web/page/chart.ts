// SPDX-License-Identifier: MIT
// What a set of variables is to the page: its fields, how they are read from a state and written to one.
import type { RotorState } from "polhode/core";
import type { Model } from "./model.js";
import type { Dimension } from "./scene.js";

export interface Field {
  /** HTML of the symbol, and the same for readers of screens. */
  readonly symbol: string;
  readonly label: string;
  readonly dimension: Dimension;
  /** A number that follows from others: it is shown, and cannot be typed. */
  readonly fixed?: boolean;
}

/** Which of some motions with the same numbers it is. */
export interface Choice {
  readonly label: string;
  /** What is written, and what is read. */
  readonly options: readonly (readonly [value: string, text: string])[];
}

export interface Chart {
  readonly id: string;
  readonly name: string;
  readonly about: string;
  readonly fields: readonly Field[];
  readonly choices?: readonly Choice[];
  /** DomainError where the motion has no such variables. */
  readonly read: (model: Model, t: number) => number[];
  readonly chosen?: (model: Model, t: number) => string[];
  /** What typing begins with where `read` throws; NaN has to be typed. */
  readonly first?: (model: Model) => number[];
  readonly write: (
    model: Model,
    t: number,
    values: readonly number[],
    chosen: readonly string[],
  ) => RotorState;
}

export const f = (symbol: string, label: string, dimension: Dimension, fixed = false): Field => ({
  symbol,
  label,
  dimension,
  fixed,
});
export const sub = (letter: string, index: string) => `${letter}<sub>${index}</sub>`;
