// SPDX-License-Identifier: MIT
// Numbers as they are read: significant digits, a true minus, powers of ten only where needed.
import { units, type Dimension, type Scene } from "./scene.js";
import { DEG } from "./vectors.js";

/** "3.695488", "−0.25", "1.2e9" as 1.2 × 10⁹. */
export function number(x: number, digits = 7): string {
  if (Number.isNaN(x)) return "–";
  if (!Number.isFinite(x)) return x > 0 ? "∞" : "−∞";
  const size = Math.abs(x);
  const plain = size === 0 || (size >= 1e-4 && size < 10 ** Math.max(digits, 6));
  const text = plain ? trimmed(x.toPrecision(digits)) : power(x.toExponential(digits - 1));
  return text.replace("-", "−");
}

function trimmed(text: string): string {
  if (text.includes("e")) return String(Number(text));
  return text.includes(".") ? text.replace(/\.?0+$/, "") : text;
}

const RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹";
function power(text: string): string {
  const [digits = "", exponent = ""] = text.split("e");
  const raised = [...exponent.replace("+", "")]
    .map((c) => (c === "-" ? "⁻" : RAISED[Number(c)]))
    .join("");
  return `${trimmed(digits)} × 10${raised}`;
}

/** A number as a person types it, "−" and "1 × 10⁹" as on the page included; NaN for none. */
export function typed(text: string): number {
  const plain = text
    .trim()
    .replace(/[−–]/g, "-")
    .replace(/\s*[×x]\s*10\s*([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)/, (_, raised: string) => {
      const digits = [...raised].map((c) => (c === "⁻" ? "-" : RAISED.indexOf(c))).join("");
      return `e${digits}`;
    })
    .replace(/\s/g, "");
  return plain === "" ? NaN : Number(plain);
}

/** What a number of the core is multiplied by for the reader: angles are shown in degrees. */
export const shown = (dimension: Dimension): number =>
  dimension === "angle" || dimension === "rate" ? 1 / DEG : 1;

export const unitOf = (scene: Scene, dimension: Dimension): string => units(scene)[dimension];

const SECONDS: Readonly<Record<string, number>> = {
  s: 1,
  min: 60,
  h: 3600,
  d: 86400,
  yr: 31557600,
};

/** "12 h", "3 yr": a length of time in the unit that fits it, for hints only. */
export function span(t: number, unit: string): string {
  const seconds = Math.abs(t) * (SECONDS[unit] ?? NaN);
  if (!Number.isFinite(seconds)) return `${number(t, 3)} ${unit}`;
  const fitting = ["yr", "d", "h", "min", "s"].find((u) => seconds >= SECONDS[u]!) ?? "s";
  const value = (t * SECONDS[unit]!) / SECONDS[fitting]!;
  return `${number(value, 3)} ${fitting}`;
}
