// SPDX-License-Identifier: MIT
// What the library refuses comes through in its own words.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  Body, DomainError, FreeRotation, andoyerPlane, checkedState, fromAndoyer, fromEuler, fromMatrix, fromTumbler,
  integrate, leastPeriodRatio, longAxisPeriod, phaseAngle, polhodes, rotorState, separatrix, withMomentumAlong,
} from "polhode";

const REST = { q: [1, 0, 0, 0], g: [0, 0, 0] };
const refuses = (call, sentence) =>
  assert.throws(call, (error) => {
    assert.ok(error instanceof DomainError && error instanceof Error, `${error}`);
    if (sentence instanceof RegExp) assert.match(error.message, sentence);
    else assert.equal(error.message, sentence);
    return true;
  });

test("moments that no body has", () => {
  refuses(() => new Body(1, 1, 3), "Body: moments (1, 1, 3) break I3 <= I1 + I2");
  refuses(() => new Body(0, 1, 1), "Body: moments (0, 1, 1) must be positive and finite");
  refuses(() => new Body(NaN, 1, 1), "Body: moments (nan, 1, 1) must be positive and finite");
  refuses(() => new Body(1, -Infinity, 1), "Body: moments (1, -inf, 1) must be positive and finite");
});

test("tensors that are none", () => {
  refuses(() => Body.fromTensor([1, 0.1, 0, 0, 2, 0, 0, 0, 2.5]), "Body::from_tensor: entries (0.1, 0) at 12 and its mirror must be equal");
  refuses(() => Body.fromTensor([1, 0, 0, 0, 1, 0, 0, 0, 3]), "Body::from_tensor: moments (1, 1, 3) break I3 <= I1 + I2");
  refuses(() => Body.fromTensor(new Array(9).fill(NaN)), "Body::from_tensor: entry nan must be finite");
  assert.throws(() => Body.fromTensor([1, 2, 3]), RangeError);
});

test("numbers are written as std::to_chars writes them", () => {
  const written = (x) => {
    try {
      new Body(x, 1, -1);
    } catch (error) {
      return error.message.slice("Body: moments (".length, -", 1, -1) must be positive and finite".length);
    }
  };
  const texts = {
    0.1: "0.1", 1e5: "1e+05", 100001: "100001", 1.5e-5: "1.5e-05", 0.001: "0.001", 0.00012: "0.00012",
    123456789: "123456789", 1e21: "1e+21", 5e-324: "5e-324", 1.7976931348623157e308: "1.7976931348623157e+308",
    0.3333333333333333: "0.3333333333333333", 1e-7: "1e-07", 9007199254740993: "9007199254740992",
    123456789012345680000: "123456789012345683968", 6.02e23: "6.02e+23",
  };
  for (const [x, text] of Object.entries(texts)) assert.equal(written(Number(x)), text);
  assert.equal(written(-0), "-0");
});

test("states that are none", () => {
  const body = new Body(1, 2, 2.5);
  refuses(() => new FreeRotation(body, { q: [0, 0, 0, 0], g: [1, 0, 0] }), /q|quaternion/);
  refuses(() => new FreeRotation(body, { q: [1, 0, 0, 0], g: [NaN, 0, 0] }), /nan/);
  refuses(() => checkedState({ q: [1, 0, 0, Infinity], g: [1, 0, 0] }), /inf/);
  refuses(() => checkedState({ q: [1, 0, 0, 0], g: [Infinity, 0, 0] }), /inf/);
  refuses(() => rotorState(body, [0, 0, 0, 0], [1, 0, 0]), /0, 0, 0, 0/);
  refuses(() => withMomentumAlong({ q: [1, 0, 0, 0], g: [1, 0, 0] }, [0, 0, 0]), /direction/);
  assert.deepEqual(checkedState({ q: [2, 0, 0, 0], g: [1, 2, 3] }), { q: [1, 0, 0, 0], g: [1, 2, 3] });
});

test("charts outside their domain", () => {
  refuses(() => fromAndoyer({ l: 0, g: 0, h: 0, L: 2, G: 1, H: 0 }), /L/);
  refuses(() => fromEuler({ phi: 0, theta: 0, psi: 0, Phi: 1, Theta: 0, Psi: 2 }), /Phi|theta/);
  const tumbler = { precessionPeriod: 10, rotationPeriod: 1, pole: [0, 0, 1], mode: "long_axis", phi0: 0, psi0: 0 };
  refuses(() => fromTumbler(new Body(1, 3.09, 3.22), tumbler), /P_psi\/P_phi = 0.1 is impossible/);
  refuses(() => longAxisPeriod(3, 2), /period/);
  refuses(() => leastPeriodRatio(new Body(1, 1, 1.5), "long_axis"), /have no LAM/);
  const resting = new FreeRotation(new Body(1, 2, 2.5), REST);
  assert.equal(resting.regime, "rest");
  refuses(() => resting.tumbler(0), /tumbler/);
});

test("perturbed motion", () => {
  const body = new Body(1, 2, 2.5);
  const problem = { body, state: { q: [1, 0, 0, 0], g: [1, 0.5, 2] }, stop: 10, count: 5 };
  refuses(() => integrate({ ...problem, internalDamping: -1 }), /-1/);
  refuses(() => integrate({ ...problem, tolerance: 1 }), /tolerance/);
  refuses(() => integrate({ ...problem, gravityGradient: { gm: 1, pericentre: 1, eccentricity: 1 } }), /parabola/);
  refuses(() => integrate({ ...problem, start: Infinity }), /inf/);
  refuses(() => integrate({ ...problem, stop: NaN }), /stop/);
});

// Each term finite, each run longer than anyone waits.
test("a run that needs too many steps ends, and says where", () => {
  const body = new Body(1, 2, 2.5);
  const problem = { body, state: { q: [1, 0, 0, 0], g: [1, 0.5, 2] }, stop: 100, count: 5 };
  for (const more of [
    { precessingFrame: { axis: [0, 0, 1], rate: 1e12 } },
    { internalDamping: 0.01, stop: 1e12 },
    { gravityGradient: { gm: 1e20, pericentre: 1, eccentricity: 0.5 } },
  ]) {
    const run = integrate({ ...problem, ...more, mostSteps: 10_000 });
    assert.match(run.ended, /^the motion ends at t = [0-9.e+-]+: it takes more steps than it may$/);
    assert.equal(run.times.length, 1);
    assert.equal(run.states.length, 7);
  }
  const none = integrate({ ...problem, count: 101, precessingFrame: { axis: [0, 0, 1], rate: 1e12 }, mostSteps: 0 });
  assert.equal(none.times.length, 1);
  assert.equal(integrate({ ...problem, count: 3 }).ended, "");
});

test("counts that count no rows, and vectors of a wrong length", () => {
  const motion = new FreeRotation(new Body(1, 2, 2.5), { q: [1, 0, 0, 0], g: [1, 0.5, 2] });
  const grid = (count) => motion.states({ start: 0, step: 1, count });
  const problem = { body: motion.body, state: motion.initialState, stop: 10 };
  const count = (call, said) =>
    assert.throws(call, { name: "RangeError", message: `polhode: got a count of ${said}` });
  count(() => grid(-1), "-1, expected a whole number from 0 to 38347922");
  count(() => grid(2.5), "2.5, expected a whole number from 0 to 38347922");
  count(() => grid(NaN), "NaN, expected a whole number from 0 to 38347922");
  count(() => grid(2 ** 29), "536870912, expected a whole number from 0 to 38347922");
  for (const points of [0, 1, -1]) {
    const said = `${points}, expected a whole number from 2 to 89478485`;
    count(() => motion.polhode(points), said);
    count(() => polhodes(motion.body, 1, 4, points), said);
    count(() => separatrix(motion.body, 1, points), said);
  }
  count(() => motion.flips(0, 1, -1), "-1, expected a whole number from 0 to 268435456");
  for (const few of [-1, 1]) count(() => integrate({ ...problem, count: few }), `${few}, expected a whole number from 2 to 12201611`);
  count(() => andoyerPlane(new Float64Array(4)), "1.3333333333333333, expected a whole number from 0 to 134217728");
  assert.equal(grid(0).length, 0);
  assert.equal(motion.polhode(2).length, 6);

  const length = (call, got, expected) =>
    assert.throws(call, (error) => error instanceof RangeError && error.message.startsWith(`polhode: got ${got} numbers, expected ${expected}; `));
  length(() => new FreeRotation(motion.body, { q: [1, 0, 0], g: [1, 0.5, 2] }), 9, 10);
  length(() => checkedState({ q: [1, 0, 0, 0], g: [1, 0.5] }), 6, 7);
  length(() => rotorState(motion.body, [1, 0, 0, 0], [1, 0]), 9, 10);
  length(() => fromMatrix([1, 0, 0, 0, 1, 0]), 9, 12);
  length(() => phaseAngle([1, 0, 0], [1]), 4, 6);
  length(() => integrate({ ...problem, count: 2, state: { q: [1, 0, 0], g: [1, 0.5, 2] } }), 27, 28);
  assert.ok(Math.abs(motion.at(0).g[2] - 2) < 1e-14);
});

test("the module goes on after a refusal", () => {
  for (let i = 0; i < 1000; ++i) assert.throws(() => new Body(1, 1, 3 + i), DomainError);
  assert.deepEqual(new Body(1, 2, 2.5).moments, [1, 2, 2.5]);
});

test("NaN in, NaN out; a motion that was disposed of says so", () => {
  const motion = new FreeRotation(new Body(1, 2, 2.5), { q: [1, 0, 0, 0], g: [1, 0.5, 2] });
  assert.ok(motion.at(NaN).q.every(Number.isNaN));
  motion.dispose();
  motion.dispose();
  assert.throws(() => motion.at(0), /dispose/);
});
