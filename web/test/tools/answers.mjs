// SPDX-License-Identifier: MIT
// What the package answers for a golden case, in the order of answers.cpp. The package is handed in: it
// may be that of a browser.
const GRID = { start: 0.25, step: 0.375, count: 20 };
const LIGHT = { semiAxes: [1.3, 1.0, 0.7], toSun: [1.0, 0.1, 0.2], toObserver: [0.8, -0.5, 0.1] };
const REGIMES = ["rest", "steady", "short_axis", "long_axis", "separatrix"];

/** Arithmetic and the library's own sines: the same bits anywhere. */
export const STATES = ["state", "at", "rows", "grid", "far_grid"];
export const RATES = ["body_rates", "inertial_rates", "herpolhode", "derived", "matrix", "semi_axes", "along", "from_matrix", "tensor"];
/** What takes sines and angles from the C library. */
export const CHARTS = [
  "andoyer", "to_andoyer", "to_euler", "to_euler_rates", "to_poincare", "to_roll_pitch_yaw", "to_euler_angles",
];
export const FLOW = ["summary", "brightness", "serret", "sadov", "tumbler", "curve"];
/** What is computed from those: their differences grow in it. */
export const BACK = [
  "from_andoyer", "from_euler", "from_euler_rates", "from_poincare", "from_roll_pitch_yaw", "from_euler_angles",
  "from_serret", "from_sadov", "from_tumbler", "flips", "sensitivity", "curves", "separatrix", "plane",
];

/** The numbers of a value of the package, in order; words as the interface has them. */
export function flat(value) {
  if (typeof value === "number") return [value];
  if (typeof value === "string") return [value === "pi" || value === "long_axis" ? 1 : 0];
  return Object.values(value).flatMap(flat);
}

/** What a motion knows of itself, in the order of polhode_motion_summary. */
function summary(motion) {
  const { longLeast, longMost, shortLeast, shortMost } = motion.tumblingAngles();
  return [
    REGIMES.indexOf(motion.regime), motion.momentum, motion.energy, motion.modulus.m, motion.modulus.m1,
    motion.separatrixDistance, motion.polhodePeriod, motion.precessionRateLong, motion.precessionRateShort,
    motion.circulationAction, motion.momentumDirection, motion.sadovFrequencies().nL, motion.sadovFrequencies().nG,
    longLeast, longMost, shortLeast, shortMost,
  ];
}

export function answers(polhode, { moments, q0, omega0, times }) {
  const body = new polhode.Body(...moments);
  const state = polhode.rotorState(body, q0, omega0);
  const motion = new polhode.FreeRotation(body, state);
  const to = {
    to_andoyer: () => polhode.toAndoyer(state),
    to_euler: () => polhode.toEuler(state),
    to_euler_rates: () => polhode.toEulerRates(body, state),
    to_poincare: () => polhode.nearestPoincare(state),
    to_roll_pitch_yaw: () => polhode.toRollPitchYaw(state.q),
    to_euler_angles: () => polhode.toEulerAngles(state.q),
    matrix: () => polhode.toMatrix(state.q),
    serret: () => motion.serret(0.5),
    sadov: () => motion.sadov(0.5),
    tumbler: () => motion.tumbler(0.5),
  };
  const curves = (found) => found.map(({ energy, points }) => [energy, ...points]);
  const asked = {
    ...to,
    state: () => state,
    summary: () => summary(motion),
    at: () => times.map((t) => motion.at(t)),
    rows: () => motion.states(times),
    grid: () => motion.states({ start: 0.25, step: 0.375, count: 300 }),
    far_grid: () => motion.states({ start: 1e9, step: 0.375, count: 70 }),
    body_rates: () => motion.angularVelocities(GRID, "body"),
    inertial_rates: () => motion.angularVelocities(GRID, "inertial"),
    herpolhode: () => motion.herpolhode(GRID),
    andoyer: () => motion.andoyer(GRID),
    brightness: () => motion.lightCurve(LIGHT, GRID),
    curve: () => motion.polhode(33),
    derived: () => [
      polhode.angularVelocity(body, state), polhode.inertialAngularVelocity(body, state),
      polhode.inertialMomentum(state), polhode.kineticEnergy(body, state),
    ],
    tensor: () => {
      const R = to.matrix(), at = (i, j) => R[i] * moments[0] * R[j] + R[3 + i] * moments[1] * R[3 + j] + R[6 + i] * moments[2] * R[6 + j];
      const found = polhode.Body.fromTensor([0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => at(i, j))));
      return [found.moments, found.axes];
    },
    semi_axes: () => body.semiAxes(),
    along: () => polhode.withMomentumAlong(state, [0.3, -0.2, 0.9]),
    from_andoyer: () => polhode.fromAndoyer(to.to_andoyer()),
    from_euler: () => polhode.fromEuler(to.to_euler()),
    from_euler_rates: () => polhode.fromEulerRates(body, to.to_euler_rates()),
    from_poincare: () => polhode.fromPoincare(to.to_poincare()),
    from_roll_pitch_yaw: () => polhode.fromRollPitchYaw(to.to_roll_pitch_yaw()),
    from_euler_angles: () => polhode.fromEulerAngles(to.to_euler_angles()),
    from_matrix: () => polhode.fromMatrix(to.matrix()),
    from_serret: () => polhode.fromSerret(body, to.serret(), 0.5),
    from_sadov: () => polhode.fromSadov(body, to.sadov()),
    from_tumbler: () => polhode.fromTumbler(body, to.tumbler()),
    flips: () => motion.flips(0, 100, 20),
    sensitivity: () => motion.roundingSensitivity(1000),
    curves: () => curves(polhode.polhodes(body, motion.momentum, 1, 17)),
    separatrix: () => curves(polhode.separatrix(body, motion.momentum, 9)),
    plane: () => polhode.andoyerPlane(motion.polhode(33)),
  };
  const found = {};
  for (const [name, ask] of Object.entries(asked))
    try {
      found[name] = flat(ask());
    } catch (error) {
      if (error.name !== "DomainError") throw error;
      found[name] = [];
    }
  motion.dispose();
  return found;
}

/** The rows of polhode_integrate for its own numbers. */
export function perturbed(polhode, x) {
  const run = polhode.integrate({
    body: new polhode.Body(...x.slice(0, 3)),
    state: { q: x.slice(3, 7), g: x.slice(7, 10) },
    start: x[10], stop: x[11], count: 25, tolerance: x[12],
    gravityGradient: {
      gm: x[13], pericentre: x[14], eccentricity: x[15], inclination: x[16], node: x[17], argument: x[18],
      meanAnomaly: x[19], epoch: x[20],
    },
    internalDamping: x[21], linearDamping: x[22],
    precessingFrame: { axis: x.slice(23, 26), rate: x[26] },
  });
  if (run.ended !== "") throw new Error(run.ended);
  const row = (numbers, size, i) => [...numbers.subarray(size * i, size * (i + 1))];
  return [...run.times].flatMap((t, i) => [
    t, ...row(run.states, 7, i), run.energy[i], run.kineticEnergy[i], ...row(run.andoyer, 6, i),
    ...row(run.osculating, 6, i),
  ]);
}
