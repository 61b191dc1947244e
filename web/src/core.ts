// SPDX-License-Identifier: MIT
// Everything, to be used after `await load()`.
export { DomainError, load, loadSync, version } from "./module.js";
export type { Source } from "./module.js";
export {
  Body, angularVelocity, checkedState, inertialAngularVelocity, inertialMomentum, kineticEnergy, rotorState,
  rotorStateInertial, withMomentum, withMomentumAlong,
} from "./state.js";
export type { Matrix3, Quaternion, RotorState, Vec3 } from "./state.js";
export {
  fromAndoyer, fromEuler, fromEulerAngles, fromEulerRates, fromMatrix, fromPoincare, fromRollPitchYaw, fromSadov,
  fromSerret, fromTumbler, leastPeriodRatio, longAxisPeriod, nearestPoincare, toAndoyer, toEuler, toEulerAngles,
  toEulerRates, toMatrix, toPoincare, toRollPitchYaw,
} from "./charts.js";
export type {
  Andoyer, Euler, EulerAngles, EulerRates, Mode, Poincare, Pole, RollPitchYaw, Sadov, Serret, Sign, Tumbler,
} from "./charts.js";
export * from "./motion.js";
export * from "./light.js";
export * from "./curves.js";
export * from "./perturbed.js";
export * from "./copies.js";
