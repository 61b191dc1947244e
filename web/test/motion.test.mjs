// SPDX-License-Identifier: MIT
// Periods, charts, curves and light of known bodies.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  Body, FreeRotation, STATE_SIZE, andoyerPlane, brightness, fromAndoyer, fromEuler, fromEulerAngles, fromEulerRates,
  fromMatrix, fromPoincare, fromRollPitchYaw, fromSadov, fromSerret, fromTumbler, inertialMomentum, integrate,
  kineticEnergy, longAxisPeriod, magnitudes, nearestPoincare, phaseAngle, polhodes, rotorState, separatrix, stateAt,
  toAndoyer, toEuler, toEulerAngles, toEulerRates, toMatrix, toPoincare, toRollPitchYaw, version, withMomentum,
  withMomentumAlong,
} from "polhode";
import { flat } from "./tools/answers.mjs";

const near = (a, b, tolerance, what) => {
  const x = flat(a), y = flat(b);
  assert.equal(x.length, y.length);
  x.forEach((value, i) => assert.ok(Math.abs(value - y[i]) <= tolerance, `${what ?? ""} ${value} ${y[i]}`));
};
// docs/index.md
const nut = new Body(30.53, 83.87, 113.3);
const nutMotion = () => new FreeRotation(nut, rotorState(nut, [1, 0, 0, 0], [0.01, 6.28, 0]));
// examples/toutatis.toml
const toutatis = new Body(1, 3.09, 3.22);

test("the wing nut turns over every 3.695488 s", () => {
  const motion = nutMotion();
  const { times, every } = motion.flips(0, 30);
  assert.equal(every.toFixed(6), "3.695488");
  assert.equal(motion.polhodePeriod, 2 * every);
  assert.equal(times.length, 8);
  for (const t of times) near(motion.at(t).g[1], 0, 1e-12 * motion.momentum);
  const far = motion.flips(1e9, 1e9 + 100, 5);
  assert.equal(far.times.length, 5);
  for (const t of far.times) assert.ok(t >= 1e9 && Math.abs(motion.at(t).g[1]) < 1e-6 * motion.momentum);
});

test("Toutatis: 5.37 d about the long axis, 7.41 d about the momentum (Takahashi et al. 2013)", () => {
  const state = fromTumbler(toutatis, {
    precessionPeriod: 7.41, rotationPeriod: 5.37, pole: [-0.6, 0.1, -0.8], mode: "long_axis", phi0: 0.3, psi0: 0.2,
  });
  const motion = new FreeRotation(toutatis, state);
  assert.equal(motion.regime, "long_axis");
  near([motion.precessionPeriodLong, motion.polhodePeriod], [7.41, 5.37], 1e-12);
  near(motion.tumbler(0).phi0, 0.3, 1e-12);
  near(longAxisPeriod(motion.precessionPeriodShort, 5.37), 7.41, 1e-12);
  const { longLeast, longMost } = motion.tumblingAngles();
  assert.ok(longLeast > 0 && longMost > longLeast && longMost < Math.PI / 2);
});

test("charts come back to the state", () => {
  const body = new Body(1, 2, 2.5);
  const s = rotorState(body, [0.8, 0.1, -0.5, 0.3], [0.4, -0.3, 0.9]);
  const motion = new FreeRotation(body, s);
  const same = (t, what) => near(Math.abs(flat(t.q).reduce((sum, x, i) => sum + x * s.q[i], 0)), 1, 1e-14, what) ?? near(t.g, s.g, 1e-13, what);
  same(fromAndoyer(toAndoyer(s)), "Andoyer");
  same(fromEuler(toEuler(s)), "Euler");
  same(fromEulerRates(body, toEulerRates(body, s)), "Euler rates");
  same(fromPoincare(nearestPoincare(s)), "Poincare");
  same(fromPoincare(toPoincare(s, "pi", "zero")), "Poincare");
  same(fromSerret(body, motion.serret(0), 0), "Serret");
  same(fromSadov(body, motion.sadov(0)), "Sadov");
  same(fromTumbler(body, motion.tumbler(0)), "tumbler");
  same({ q: fromRollPitchYaw(toRollPitchYaw(s.q)), g: s.g }, "roll, pitch, yaw");
  same({ q: fromEulerAngles(toEulerAngles(s.q)), g: s.g }, "Euler angles");
  same({ q: fromMatrix(toMatrix(s.q)), g: s.g }, "matrix");
});

test("dragging the momentum keeps its size and its place in space", () => {
  const s = rotorState(nut, [0.5, 0.5, -0.5, 0.5], [0.1, 6, 0.3]);
  const G = Math.hypot(...s.g);
  for (const direction of [[1, 0, 0], [0, -2, 1e-9], [0, -1, 0], s.g.map((x) => -x), s.g]) {
    const moved = withMomentumAlong(s, direction);
    near(Math.hypot(...moved.g), G, 1e-12 * G);
    near(inertialMomentum(moved), inertialMomentum(s), 1e-12 * G, "momentum");
    const size = Math.hypot(...direction);
    near(moved.g, direction.map((x) => (x / size) * G), 1e-12 * G, "direction");
  }
  near(Math.hypot(...withMomentum(s, 7).g), 7, 1e-14);
});

test("a grid, a list and single times agree; rows go where one says", () => {
  const motion = nutMotion();
  const grid = { start: 0.25, step: 0.125, count: 400 };
  const times = Float64Array.from({ length: 400 }, (_, i) => 0.25 + 0.125 * i);
  const out = new Float64Array(400 * STATE_SIZE);
  assert.equal(motion.states(grid, out), out);
  near(motion.states(times), out, 1e-11);
  near(motion.at(times[37]), stateAt(motion.states(times), 37), 0);
  assert.throws(() => motion.states(grid, new Float64Array(3)), RangeError);
  const w = motion.angularVelocities(grid, "inertial"), h = motion.herpolhode(grid);
  for (let i = 0; i < 400; ++i) {
    near(h[3 * i + 2], (2 * motion.energy) / motion.momentum, 1e-12);
    near(Math.hypot(...h.subarray(3 * i, 3 * i + 3)), Math.hypot(...w.subarray(3 * i, 3 * i + 3)), 1e-12);
  }
});

test("polhodes lie on the sphere and on the ellipsoid of their energy", () => {
  const G = 3;
  const lines = [...polhodes(nut, G, 3, 33), ...separatrix(nut, G, 33)];
  assert.equal(lines.length, 2 * 2 * 3 + 4);
  for (const { energy, points, mode } of lines)
    for (let i = 0; i < points.length; i += 3) {
      const g = points.subarray(i, i + 3);
      near(Math.hypot(...g), G, 1e-14 * G * 10);
      near(kineticEnergy(nut, { q: [1, 0, 0, 0], g: [...g] }), energy, 1e-14, mode);
    }
  assert.equal(separatrix(new Body(1, 1, 1.5), 1).length, 0);
  assert.ok(polhodes(new Body(1, 1, 1.5), 1, 2).every((c) => c.mode === "short_axis"));
  // the motion's own goes through its state
  const motion = nutMotion(), own = motion.polhode(2049);
  let nearest = Infinity;
  for (let i = 0; i < own.length; i += 3) {
    const away = Math.hypot(...motion.initialState.g.map((x, k) => x - own[i + k]));
    nearest = Math.min(nearest, away / motion.momentum);
  }
  assert.ok(nearest < 2e-3, `${nearest}`);
  near(own.subarray(0, 3), own.subarray(own.length - 3), 0);
  const plane = andoyerPlane(own);
  assert.equal(plane.length, (2 * own.length) / 3);
  const turn = plane[plane.length - 2] - plane[0];
  near(Math.abs(turn), motion.regime === "short_axis" ? 2 * Math.PI : 0, 1e-9);
});

test("light: a sphere does not vary, an ellipsoid does", () => {
  const light = { semiAxes: [1, 1, 1], toSun: [1, 0, 0], toObserver: [0, 2, 0] };
  near(phaseAngle(light.toSun, light.toObserver), Math.PI / 2, 1e-15);
  const times = { start: 0, step: 0.02, count: 200 };
  const motion = nutMotion();
  const even = motion.lightCurve(light, times);
  for (const flux of even) near(flux, even[0], 1e-14);
  const curve = motion.lightCurve({ ...light, semiAxes: nut.semiAxes() }, times);
  near(curve[30], brightness({ ...light, semiAxes: nut.semiAxes() }, motion.at(0.6).q), 1e-9);
  const m = magnitudes(curve);
  assert.ok(Math.max(...m) - Math.min(...m) > 0.5);
  near(Body.ofEllipsoid(nut.semiAxes(), 1).moments, nut.moments, 1e-10);
});

test("perturbed motion: free without terms, energy kept by a gradient, lost by damping", () => {
  const body = new Body(1, 2, 2.5);
  const state = rotorState(body, [1, 0, 0, 0], [0.4, -0.3, 0.9]);
  const free = integrate({ body, state, stop: 20, count: 41 });
  near(free.states, new FreeRotation(body, state).states({ start: 0, step: 0.5, count: 41 }), 1e-9);
  near(free.andoyer, free.osculating, 1e-12);
  const damped = integrate({ body, state, stop: 20, count: 41, internalDamping: 0.01 });
  assert.ok(damped.kineticEnergy[40] < damped.kineticEnergy[0]);
  near(damped.andoyer[6 * 40 + 4], damped.andoyer[4], 1e-9); // G
  const frame = { axis: [0, 0, 1], rate: 0.1 };
  const precessing = integrate({ body, state, stop: 20, count: 41, precessingFrame: frame });
  near(precessing.energy[40], precessing.energy[0], 1e-10);
  assert.ok(Math.abs(precessing.andoyer[4] - precessing.osculating[4]) > 1e-3);
  const orbit = { gm: 1, pericentre: 4, eccentricity: 0 };
  const pulled = integrate({ body, state, stop: 20, count: 3, gravityGradient: orbit });
  assert.ok(Math.abs(pulled.andoyer[2 * 6 + 4] - pulled.andoyer[4]) > 1e-4);
});

test("a body of its tensor: moments, and the turn from its principal axes", () => {
  assert.deepEqual(Body.fromTensor([1, 0, 0, 0, 2, 0, 0, 0, 2.5]).axes, [1, 0, 0, 0]);
  const q = [0.9, 0.1, -0.3, 0.2];
  const R = toMatrix(q); // principal axes to those of the tensor are its rows' turn back
  const entry = (i, j) => [1, 2, 2.5].reduce((sum, I, k) => sum + R[3 * k + i] * I * R[3 * k + j], 0);
  const tensor = [0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => entry(i, j)));
  const found = Body.fromTensor(tensor);
  near(found.moments, [1, 2, 2.5], 1e-14);
  near(found.axes, q.map((x) => x / Math.hypot(...q)), 1e-14);
});

test("the version is that of the library", () => assert.match(version(), /^\d+\.\d+\.\d+/));
