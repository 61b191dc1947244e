// SPDX-License-Identifier: MIT
// The same motion as text: a scenario for the command line, Python, C++. Numbers are written with the
// digits that read back as the same doubles.
import type { Body, RotorState } from "./state.js";

export interface Copies {
  readonly toml: string;
  readonly python: string;
  readonly cpp: string;
}
export interface CopyOptions {
  readonly t0?: number;
  readonly title?: string;
  /** Units as scenario files name them, "s", "kg m2"; without them numbers have none. */
  readonly time?: string;
  readonly moment?: string;
}

// TOML and C++ tell 3 from 3.0.
function decimal(x: number): string {
  if (!Number.isFinite(x)) throw new RangeError(`copies: ${x} is not finite`);
  const text = Object.is(x, -0) ? "-0" : String(x);
  return /[.e]/.test(text) ? text : `${text}.0`;
}
const list = (values: readonly number[]): string => values.map(decimal).join(", ");

/** Text that makes the same motion, to the last bit. */
export function copies(body: Body, state: RotorState, options: CopyOptions = {}): Copies {
  return { toml: toml(body, state, options), python: python(body, state, options), cpp: cpp(body, state, options) };
}

function toml(body: Body, { q, g }: RotorState, { t0 = 0, title, time, moment }: CopyOptions): string {
  const units = [time && `time = ${JSON.stringify(time)}`, moment && `moment = ${JSON.stringify(moment)}`];
  return [
    "schema = 1",
    ...(title === undefined ? [] : [`title = ${JSON.stringify(title)}`]),
    ...(time || moment ? ["", "[units]", ...units.filter((line) => line !== undefined && line !== "")] : []),
    "",
    "[body]",
    `moments = [${list(body.moments)}]`,
    "",
    ...(t0 === 0 ? [] : [`# t = 0 below is t = ${decimal(t0)} of the explorer`]),
    "[state.attitude-rate]",
    `quaternion = [${list(q)}]`,
    `momentum_body = [${list(g)}]`,
    "",
    "[time]",
    "stop = 100.0",
    "count = 1001",
    "",
    "[output]",
    'columns = ["q", "omega", "g"]',
    "",
  ].join("\n");
}

function python(body: Body, { q, g }: RotorState, { t0 = 0 }: CopyOptions): string {
  return `import polhode

body = polhode.Body(${list(body.moments)})
state = polhode.RotorState(q=[${list(q)}], g=[${list(g)}])
motion = polhode.FreeRotation(body, state, t0=${decimal(t0)})
print(motion.at(${decimal(t0)}).q)
`;
}

function cpp(body: Body, { q, g }: RotorState, { t0 = 0 }: CopyOptions): string {
  return `#include <polhode/free/free_rotation.hpp>

#include <cstdio>

int main() {
  const polhode::Body body(${list(body.moments)});
  const polhode::RotorState state{{${list(q)}}, {${list(g)}}};
  const polhode::FreeRotation motion(body, state, ${decimal(t0)});
  const polhode::Quaternion q = motion.at(${decimal(t0)}).q;
  std::printf("%.17g %.17g %.17g %.17g\\n", q.w, q.x, q.y, q.z);
}
`;
}
