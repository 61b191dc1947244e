// SPDX-License-Identifier: MIT
// Charts: every one to and from the hub.
#include "numbers.hpp"
#include "polhode/free/sadov.hpp"
#include "polhode/free/serret.hpp"
#include "polhode/free/tumbler.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/rotor/attitude.hpp"
#include "polhode/rotor/euler.hpp"
#include "polhode/rotor/poincare.hpp"
#include "polhode_web.h"
#include "refusals.hpp"

using namespace polhode;
using namespace polhode::web;

namespace {

Pole pole(double number) { return number > 0.5 ? Pole::pi : Pole::zero; }
double number(Pole p) { return p == Pole::pi ? 1.0 : 0.0; }

PoincareState poincare(const RotorState& s, const double* poles) {
  if (poles[6] < 0.0) return nearest_poincare(s);
  return to_poincare(s, pole(poles[6]), pole(poles[7]));
}

RotorState at_rest(const Quaternion& q) { return {q, {0.0, 0.0, 0.0}}; }

void put_chart(int chart, const double* moments, const RotorState& s, double* to) {
  switch (chart) {
    case POLHODE_ANDOYER: {
      const AndoyerState a = to_andoyer(s);
      put_all(to, a.l, a.g, a.h, a.L, a.G, a.H);
      return;
    }
    case POLHODE_EULER: {
      const EulerState e = to_euler(s);
      put_all(to, e.phi, e.theta, e.psi, e.Phi, e.Theta, e.Psi);
      return;
    }
    case POLHODE_EULER_RATES: {
      const EulerRates e = to_euler_rates(body(moments), s);
      put_all(to, e.phi, e.theta, e.psi, e.phi_dot, e.theta_dot, e.psi_dot);
      return;
    }
    case POLHODE_POINCARE: {
      const PoincareState p = poincare(s, to);
      put_all(to, p.sigma, p.Q1, p.Q2, p.G, p.P1, p.P2, number(p.pole_J), number(p.pole_I));
      return;
    }
    case POLHODE_ROLL_PITCH_YAW: {
      const RollPitchYaw r = roll_pitch_yaw(s.q);
      put_all(to, r.roll, r.pitch, r.yaw);
      return;
    }
    case POLHODE_EULER_ANGLES: {
      const EulerAngles e = euler_angles(s.q);
      put_all(to, e.phi, e.theta, e.psi);
      return;
    }
    default: {
      const Mat3 R = attitude_matrix(s.q);
      for (int i = 0; i < 9; ++i) to[i] = R(i / 3, i % 3);
    }
  }
}

RotorState from_chart(int chart, const double* moments, const double* x) {
  switch (chart) {
    case POLHODE_ANDOYER:
      return to_rotor(andoyer_state(x[0], x[1], x[2], x[3], x[4], x[5]));
    case POLHODE_EULER:
      return to_rotor(euler_state(x[0], x[1], x[2], x[3], x[4], x[5]));
    case POLHODE_EULER_RATES:
      return to_rotor(body(moments), EulerRates{x[0], x[1], x[2], x[3], x[4], x[5]});
    case POLHODE_POINCARE:
      return to_rotor(poincare_state(x[0], x[1], x[2], x[3], x[4], x[5], pole(x[6]), pole(x[7])));
    case POLHODE_ROLL_PITCH_YAW:
      return at_rest(attitude(RollPitchYaw{x[0], x[1], x[2]}));
    case POLHODE_EULER_ANGLES:
      return at_rest(attitude(EulerAngles{x[0], x[1], x[2]}));
    default:
      return at_rest(attitude(matrix(x)));
  }
}

RotorState from_motion_chart(int chart, const Body& of, const double* x, double t) {
  const auto sign = [](double number) { return static_cast<int>(number); };
  switch (chart) {
    case POLHODE_SERRET:
      return to_rotor(of, SerretState{x[0], x[1], x[2], x[3], x[4], x[5], sign(x[6]), sign(x[7])},
                      t);
    case POLHODE_SADOV:
      return to_rotor(of, SadovState{x[0], x[1], x[2], x[3], x[4], x[5],
                                     x[6] > 0.5 ? SadovRegion::long_axis : SadovRegion::short_axis,
                                     sign(x[7])});
    default:
      return to_rotor(of, TumblerState{x[0], x[1], vector(x + 2),
                                       x[5] > 0.5 ? Regime::long_axis : Regime::short_axis, x[6],
                                       x[7], sign(x[8]), sign(x[9])});
  }
}

}  // namespace

int polhode_to_chart(int chart, const double* moments, const double* x, double* numbers) {
  return guarded([&] { put_chart(chart, moments, state(x), numbers); });
}

int polhode_from_chart(int chart, const double* moments, const double* numbers, double* result) {
  return guarded([&] { put(result, from_chart(chart, moments, numbers)); });
}

int polhode_from_motion_chart(int chart, const double* moments, const double* numbers, double t,
                              double* result) {
  return guarded([&] { put(result, from_motion_chart(chart, body(moments), numbers, t)); });
}

int polhode_long_axis_period(double short_axis, double rotation, double* period) {
  return guarded([&] { *period = long_axis_period(short_axis, rotation); });
}

int polhode_least_period_ratio(const double* moments, int is_long, double* ratio) {
  return guarded([&] {
    *ratio =
        least_period_ratio(body(moments), is_long != 0 ? Regime::long_axis : Regime::short_axis);
  });
}
