// SPDX-License-Identifier: MIT
// FreeRotation: the exact torque-free motion of a rigid body, prepared once, evaluated at any time
// in constant time, in every regime.
//
// Equations   [SA (12), (A15)-(A24), (A33)-(A40)]; regimes and frequencies docs/theory/regimes.md;
//             the series docs/design/0002-free-rotation.md; the state transition matrix
//             docs/design/0003-transition-matrix.md.
// Units       any consistent set: moments, momentum = moment x rate, time = 1 / rate; angles in
//             rad.
// Domain      any Body, any finite state with a non-zero quaternion, any finite time; G = 0 rests.
//             Units are rescaled by powers of two inside; the rate g / I must be in double range,
//             the least moment at least 2^-900 of the greatest.
//             Beyond 2^52 periods the phase loses digits (some 2^-104 of it); beyond 2^90 rad it is
//             lost, and the state is some state of the same orbit.
// Accuracy    budgets free_* in tests/budgets.hpp; measured table docs/accuracy/free-rotation.md.
//             Rates are prepared, and long phases reduced, in double-double, so that accuracy does
//             not decay with time.
// Errors      DomainError for a non-finite state or epoch, a zero quaternion, a rate g / I beyond
//             double range, moments of a smaller ratio. Evaluation never throws; NaN or infinite
//             time in, NaN out.
// Cost        preparation tens of microseconds (short_arc: about one), one state tens of
//             nanoseconds.
#pragma once

#include <cstdint>
#include <span>

#include "polhode/detail/free/free_kernel.hpp"
#include "polhode/detail/free/states_at.hpp"
#include "polhode/detail/free/states_on_grid.hpp"
#include "polhode/elliptic/modulus.hpp"
#include "polhode/free/detail/normalized_arc_declared.hpp"
#include "polhode/math/vector.hpp"
#include "polhode/rotor/body.hpp"
#include "polhode/rotor/rotor_state.hpp"

namespace polhode {
inline namespace v0 {

// Which way the momentum moves in the body. Closed: a constant of the motion.
enum class Regime {
  rest,        // G = 0
  steady,      // omega parallel to g: spin about a principal axis (b2 included), or a sphere
  short_axis,  // circulation about the axis of the largest moment (SAM)
  long_axis,   // circulation about the axis of the smallest moment (LAM)
  separatrix   // G^2 = 2 T I2 exactly
};

class FreeRotation {
 public:
  // The motion with state s0 at time t0, with long-arc (double-double) rates.
  FreeRotation(const Body& body, const RotorState& s0, double t0 = 0.0);
  // The same, prepared in double precision throughout: for arcs of a few turns.
  static FreeRotation short_arc(const Body& body, const RotorState& s0, double t0 = 0.0);

  // The state at time t; q is normalised. The momentum is that of [SA (12), (A15)-(A19),
  // (A21)-(A24), (A33), (A34), (A36), (A37), (A39), "U2", "abcd", "SerTointerm", "LSadov",
  // "changeAction"], the node that of [SA (52)].
  RotorState at(double t) const noexcept { return evaluate(kernel_, t); }
  // The states at many times, bit for bit the same and several times as fast: states[i] that at
  // times[i]. DomainError unless there are as many. More in states_at.hpp.
  void at(std::span<const double> times, std::span<RotorState> states) const {
    states_at(kernel_, times, states);
  }
  // The states at evenly spaced times, again several times as fast: states[i] is state first + i of
  // the grid. Not the bits of at(t): states_on_grid.hpp.
  void at(const TimeGrid& grid, std::span<RotorState> states, std::uint64_t first = 0) const {
    states_on_grid(kernel_, grid, first, states);
  }

  // d(dtheta_B, dg_B)(t) / d(dtheta_B, dg_B)(t0): attitude changes in body axes, q -> q
  // exp(dtheta_B / 2). On the separatrix and for spin about b2 it grows like exp(n t); NaN once n t
  // passes about 180, where fewer than nine digits are left of what a flip takes back (g within
  // 1e-25 of b2), for moments with a ratio below 1e-150, and for a time that is not finite.
  Matrix6 state_transition(double t) const;

  const Body& body() const { return body_; }
  const RotorState& initial_state() const { return s0_; }
  double epoch() const { return kernel_.epoch; }
  Regime regime() const { return summary_.regime; }
  const FreeKernel& kernel() const { return kernel_; }

  // G  [SA "sphere", (A13)]
  double momentum() const { return kernel_.G; }
  // T  [SA "Haminterm, second form", "SadovH"]
  double energy() const { return summary_.energy; }
  // m and 1 - m, m <= 1; m = 0 when steady  [SA (A20), "SadovPar"]
  elliptic::Modulus modulus() const { return summary_.modulus; }
  // G^2 - 2 T I2 to its last digit: > 0 in short-axis mode, < 0 in long-axis mode; like [SA (A14)],
  // with the second moment. 0 too where it is below the least double.
  double separatrix_distance() const { return summary_.D2; }

  // The axis of circulation and the signs of the momentum along sorted axes 1 and 3 at the epoch.
  bool circulates_long_axis() const { return summary_.long_axis; }
  int sign_g1() const { return summary_.sign_g1; }
  int sign_g3() const { return summary_.sign_g3; }
  // Action of the circulation, (1/2pi) of the integral of g3' dl' over a polhode, and G minus it;
  // each to its own full accuracy. Both 0 where there is no polhode: a sphere, spin about b2, an
  // axisymmetric body spinning across its axis.
  double circulation_action() const { return summary_.action; }
  double circulation_deficit() const { return summary_.deficit; }

  // Period of the momentum in the body, 4K/|n|; the limit of small polhodes for spin about b1 or
  // b3; infinite on the separatrix, for a sphere, for an axisymmetric body spinning across its
  // axis, for spin about b2, and at rest. [SA (A35)]
  double polhode_period() const { return summary_.polhode_period; }
  // Mean rates of precession about the momentum of the long (least moment) and the short (greatest
  // moment) axis; both G / I2 on the separatrix. Observers' P_phi is 2 pi / precession_rate_long().
  double precession_rate_long() const { return summary_.rate_long; }
  double precession_rate_short() const { return summary_.rate_short; }

 private:
  struct Summary {
    Regime regime = Regime::rest;
    double energy = 0.0;
    double D2 = 0.0;
    double polhode_period = 0.0;
    double rate_long = 0.0;
    double rate_short = 0.0;
    double action = 0.0;
    double deficit = 0.0;
    bool long_axis = false;
    int sign_g1 = 1;
    int sign_g3 = 1;
    elliptic::Modulus modulus = elliptic::Modulus::from_ratio(0.0, 1.0);
  };
  struct Parts {
    FreeKernel kernel;
    Summary summary;
  };
  template <Real T>
  static Summary summarized(const Body& body, const detail::NormalizedArc<T>& arc,
                            const FreeKernel& kernel, const Vec3& g_B);
  template <Real T>
  static Parts prepared(const Body& body, const RotorState& s0, double t0);
  FreeRotation(const Body& body, const RotorState& s0, const Parts& parts)
      : body_(body), s0_(s0), kernel_(parts.kernel), summary_(parts.summary) {}

  Body body_;
  RotorState s0_;
  FreeKernel kernel_;
  Summary summary_;
};

}  // namespace v0
}  // namespace polhode
