// SPDX-License-Identifier: MIT
// The motion in words: its mode, what one sees, and its clocks.
import type { Model } from "./model.js";
import { number } from "./format.js";

export interface Clock {
  readonly symbol: string; // HTML
  readonly what: string;
  readonly value: number;
}

export interface Headline {
  readonly mode: string;
  /** "sam", "lam", "sep" or "plain": what it is coloured by. */
  readonly tone: "sam" | "lam" | "sep" | "plain";
  readonly sentence: string;
  readonly clocks: readonly Clock[];
}

const PSI = "P<sub>ψ</sub>";
const PHI = "P<sub>φ</sub>";

export function headline(model: Model): Headline {
  const { motion } = model;
  const [least, , greatest] = model.body.axisOrder.map((axis) => "b" + "₁₂₃"[axis]);
  const periods: Clock[] = [
    { symbol: PSI, what: "rotation period", value: motion.polhodePeriod },
    { symbol: PHI, what: "precession, long axis", value: motion.precessionPeriodLong },
    { symbol: PHI, what: "precession, short axis", value: motion.precessionPeriodShort },
  ];
  const flip: Clock = {
    symbol: "½" + PSI,
    what: "turns over every",
    value: motion.polhodePeriod / 2,
  };
  const clocks = model.flipsOver && motion.regime !== "separatrix" ? [flip, ...periods] : periods;
  switch (motion.regime) {
    case "long_axis":
      return {
        mode: "Long-axis mode",
        tone: "lam",
        sentence: `The momentum circles the axis of least moment, ${least}.`,
        clocks,
      };
    case "short_axis":
      return {
        mode: "Short-axis mode",
        tone: "sam",
        sentence: `The momentum circles the axis of greatest moment, ${greatest}.`,
        clocks,
      };
    case "separatrix":
      return {
        mode: "Separatrix",
        tone: "sep",
        sentence: "It turns over once, and never again.",
        clocks: [
          {
            symbol: PHI,
            what: "turn, before and after",
            value: motion.precessionPeriodLong,
          },
        ],
      };
    case "steady":
      return {
        mode: "Steady rotation",
        tone: "plain",
        sentence: "The angular velocity stands still, along the momentum.",
        clocks: [
          { symbol: "P", what: "one turn", value: model.turn },
          ...(Number.isFinite(motion.polhodePeriod)
            ? [{ symbol: PSI, what: "a small wobble", value: motion.polhodePeriod }]
            : []),
        ],
      };
    case "rest":
      return { mode: "At rest", tone: "plain", sentence: "Nothing moves.", clocks: [] };
  }
}

/** What a reader of screens hears of the time shown. */
export function spoken(model: Model, now: number, unit: string): string {
  const { mode } = headline(model);
  const turns = now / model.turn;
  return `${mode}, ${number(now, 6)} ${unit}, ${number(turns, 3)} turns`;
}
