// SPDX-License-Identifier: MIT
// Every golden case: what WebAssembly answers, held against what the same interface answers on this
// machine (answers.cpp), bit by bit, and against the exact states.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  Body, FreeRotation, integrate, nearestPoincare, rotorState, toAndoyer, toEuler, toEulerRates, toRollPitchYaw,
} from "polhode";
import { flat, ulps } from "./tools/bits.mjs";

const file = process.env.POLHODE_WEB_ANSWERS ?? new URL("../../build/web/answers.json", import.meta.url);
const native = JSON.parse(readFileSync(file, "utf8"), (_, x) => (typeof x === "string" && !isNaN(Number(x)) || x === "NaN" ? Number(x) : x));
const GRID = { start: 0.25, step: 0.375, count: 20 };
const LIGHT = { semiAxes: [1.3, 1.0, 0.7], toSun: [1.0, 0.1, 0.2], toObserver: [0.8, -0.5, 0.1] };

const REGIMES = ["rest", "steady", "short_axis", "long_axis", "separatrix"];
/** What a motion knows of itself, in the order of polhode_motion_summary. */
function summary(motion) {
  const { longLeast, longMost, shortLeast, shortMost } = motion.tumblingAngles();
  return flat([
    REGIMES.indexOf(motion.regime), motion.momentum, motion.energy, motion.modulus.m, motion.modulus.m1,
    motion.separatrixDistance, motion.polhodePeriod, motion.precessionRateLong, motion.precessionRateShort,
    motion.circulationAction, motion.momentumDirection, motion.sadovFrequencies().nL, motion.sadovFrequencies().nG,
    longLeast, longMost, shortLeast, shortMost,
  ]);
}

/** What the package answers, in the order of answers.cpp. */
function answers({ moments, q0, omega0, times }) {
  const body = new Body(...moments);
  const state = rotorState(body, q0, omega0);
  const motion = new FreeRotation(body, state);
  const asked = (ask) => {
    try {
      return flat(ask());
    } catch (error) {
      if (error.name !== "DomainError") throw error;
      return [];
    }
  };
  const all = {
    state: flat(state),
    summary: summary(motion),
    at: times.flatMap((t) => flat(motion.at(t))),
    rows: motion.states(times),
    grid: motion.states({ start: 0.25, step: 0.375, count: 300 }),
    far_grid: motion.states({ start: 1e9, step: 0.375, count: 70 }),
    body_rates: motion.angularVelocities(GRID, "body"),
    inertial_rates: motion.angularVelocities(GRID, "inertial"),
    herpolhode: motion.herpolhode(GRID),
    andoyer: motion.andoyer(GRID),
    brightness: motion.lightCurve(LIGHT, GRID),
    to_andoyer: asked(() => toAndoyer(state)),
    to_euler: asked(() => toEuler(state)),
    to_euler_rates: asked(() => toEulerRates(body, state)),
    to_poincare: asked(() => nearestPoincare(state)),
    to_roll_pitch_yaw: asked(() => toRollPitchYaw(state.q)),
    serret: asked(() => motion.serret(0.5)),
    sadov: asked(() => motion.sadov(0.5)),
    tumbler: asked(() => motion.tumbler(0.5)),
    curve: motion.polhode(33),
  };
  motion.dispose();
  return all;
}

/** Differing numbers, of how many, and the largest difference in units of the last place. */
function compared(of, names) {
  const total = { numbers: 0, different: 0, ulps: 0, where: "" };
  for (const golden of native.cases) {
    const found = answers(golden);
    for (const name of names) {
      const a = found[name], b = golden[name];
      assert.equal(a.length, b.length, `${golden.name} ${name}: as many numbers`);
      for (let i = 0; i < b.length; ++i) {
        ++total.numbers;
        if (Object.is(a[i], b[i])) continue;
        ++total.different;
        const distance = ulps(a[i], b[i]);
        if (distance > total.ulps) Object.assign(total, { ulps: distance, where: `${golden.name} ${name} ${i}: ${a[i]}, ${b[i]}` });
      }
    }
  }
  console.log(`${of}: ${total.different} of ${total.numbers} differ, by ${total.ulps} ulp at most. ${total.where}`);
  return total;
}

test("states of every golden case have the bits of the library", () => {
  assert.equal(native.cases.length, 43);
  const states = compared("states", ["state", "at", "rows", "grid", "far_grid"]);
  assert.ok(states.numbers > 100_000, `${states.numbers}`);
  assert.equal(states.different, 0);
});

test("what follows from states by arithmetic has the bits of the library", () => {
  assert.equal(compared("rows", ["body_rates", "inertial_rates", "herpolhode"]).different, 0);
});

test("charts differ by what sines and angles of two C libraries differ by", () => {
  const charts = compared("charts", ["andoyer", "to_andoyer", "to_euler", "to_euler_rates", "to_poincare", "to_roll_pitch_yaw"]);
  assert.ok(charts.ulps <= 2, charts.where);
});

test("periods, brightness, flow charts and curves as well", () => {
  const found = compared("summary, brightness, flow charts, curves", ["summary", "brightness", "serret", "sadov", "tumbler", "curve"]);
  assert.ok(found.numbers > 6000, `${found.numbers}`);
  assert.ok(found.ulps <= 4, found.where);
});

test("states are exact", () => {
  let worst = 0;
  for (const { moments, q0, omega0, times, exact } of native.cases) {
    const motion = new FreeRotation(new Body(...moments), rotorState(new Body(...moments), q0, omega0));
    times.forEach((t, i) => {
      const q = motion.at(t).q, e = exact.slice(7 * i, 7 * i + 4);
      const away = (sign) => Math.hypot(...q.map((x, k) => x - sign * e[k]));
      worst = Math.max(worst, Math.min(away(1), away(-1)));
    });
  }
  console.log(`q of golden cases: ${worst.toExponential(1)} from exact`);
  assert.ok(worst < 1e-15);
});

test("perturbed motion is that of the library to rounding", () => {
  const x = native.problem;
  const run = integrate({
    body: new Body(...x.slice(0, 3)),
    state: { q: x.slice(3, 7), g: x.slice(7, 10) },
    start: x[10], stop: x[11], count: 25, tolerance: x[12],
    gravityGradient: {
      gm: x[13], pericentre: x[14], eccentricity: x[15], inclination: x[16], node: x[17], argument: x[18],
      meanAnomaly: x[19], epoch: x[20],
    },
    internalDamping: x[21], linearDamping: x[22],
    precessingFrame: { axis: x.slice(23, 26), rate: x[26] },
  });
  assert.equal(run.ended, "");
  assert.equal(run.times.length, 25);
  let worst = 0;
  for (let i = 0; i < 25; ++i)
    for (let k = 0; k < 7; ++k) {
      const size = k < 4 ? 1 : 1000;
      worst = Math.max(worst, Math.abs(run.states[7 * i + k] - native.perturbed[22 * i + 1 + k]) / size);
    }
  console.log(`perturbed motion: ${worst.toExponential(1)} from the library's`);
  assert.ok(worst < 1e-9);
});
