// SPDX-License-Identifier: MIT
// What a program wrote of its answers, and how far apart two doubles are.
import { readFileSync } from "node:fs";

/** Doubles as web_answers writes them: JSON has neither NaN nor infinities. */
export function written(file) {
  const number = (_, x) => (typeof x === "string" && (x === "NaN" || !isNaN(Number(x))) ? Number(x) : x);
  return JSON.parse(readFileSync(file, "utf8"), number);
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

/** Differing numbers, of how many, and the largest difference in units of the last place. `found`: the
 *  answers of the package, a case each; `expected`: of a program. */
export function compared(found, expected, names) {
  const total = { numbers: 0, different: 0, ulps: 0, where: "" };
  expected.forEach((golden, k) => {
    for (const name of names) {
      const a = found[k][name], b = golden[name];
      if (a.length !== b.length) throw new Error(`${golden.name} ${name}: ${a.length} numbers, expected ${b.length}`);
      for (let i = 0; i < b.length; ++i) {
        ++total.numbers;
        if (Object.is(a[i], b[i])) continue;
        ++total.different;
        const distance = ulps(a[i], b[i]);
        if (!(distance <= total.ulps))
          Object.assign(total, { ulps: distance, where: `${golden.name} ${name} ${i}: ${a[i]}, ${b[i]}` });
      }
    }
  });
  return total;
}
