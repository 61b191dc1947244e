// SPDX-License-Identifier: MIT
// Numbers of answers, and how far apart two doubles are.

/** The numbers of a value of the package, in order; words as the interface has them. */
export function flat(value) {
  if (typeof value === "number") return [value];
  if (typeof value === "string") return [value === "pi" || value === "long_axis" ? 1 : 0];
  return Object.values(value).flatMap(flat);
}

/** Doubles from a to b; Infinity where one is NaN. */
export function ulps(a, b) {
  if (Object.is(a, b)) return 0;
  if (Number.isNaN(a) || Number.isNaN(b)) return Infinity;
  const order = (x) => {
    const bits = new BigInt64Array(new Float64Array([x]).buffer)[0];
    return bits < 0n ? -(bits & 0x7fffffffffffffffn) : bits;
  };
  const distance = order(a) - order(b);
  return Number(distance < 0n ? -distance : distance);
}
