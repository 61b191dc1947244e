// SPDX-License-Identifier: MIT
// Perturbed motion for the views of the explorer: gravity gradient, damping, a precessing frame.
//
// The terms that there are here, and not a System of any terms, whose every method and number type
// would be linked. The equations of motion are those of the system, the steps those of Adaptive.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "numbers.hpp"
#include "polhode/detail/ode/adaptive_runge_kutta.hpp"
#include "polhode/detail/ode/verner98.hpp"
#include "polhode/dynamics/method.hpp"
#include "polhode/error.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/free/free_rotation.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/system/system.hpp"
#include "polhode_web.h"
#include "refusals.hpp"

using namespace polhode;
using namespace polhode::web;

namespace {

using Values = std::array<double, 7>;

struct PerturbedRotor {
  Body body;
  Frame frame;
  std::optional<GravityGradient<KeplerOrbit>> gravity;
  std::optional<InternalDamping> internal;
  std::optional<LinearDamping> linear;

  Effect effect(const Setting& at) const {
    Effect sum{};
    if (gravity) sum = sum + gravity->effect(at);
    if (internal) sum = sum + internal->effect(at);
    if (linear) sum = sum + linear->effect(at);
    return sum;
  }
  // dy/dt
  Values operator()(const DoubleDouble& t, const Values& y) const {
    const RotorState s = state(y.data());
    const BasicFrameMotion<double> moved = frame.at(t.hi);
    const Effect e = effect(Setting{body, t.hi, s, moved.q_IS, t.lo});
    RotorRates r = inertial_rates(s, angular_velocity(body, s), e);
    if (!frame.is_inertial()) r = relative_rates(r, s.q, moved.mu_S);
    return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
  }
  // Of what the terms follow: no step is longer.
  double time_scale() const {
    return gravity ? gravity->time_scale() : std::numeric_limits<double>::infinity();
  }

  // One row of the interface.
  double* row(double t, const RotorState& s, double* to) const {
    const BasicFrameMotion<double> moved = frame.at(t);
    const Setting at{body, t, s, moved.q_IS};
    const Vec3 mu = rotate(conj(s.q), moved.mu_S), w = angular_velocity(body, s);
    const Vec3 rate = w + effect(at).v - mu, I = body.moments();
    const double kinetic = kinetic_energy(body, s);
    *to++ = t;
    to = put(to, s);
    to = put_all(to, kinetic + (gravity ? gravity->energy(at) : 0.0) - dot(mu, s.g), kinetic);
    for (const Vec3& g : {s.g, Vec3{I.x * rate.x, I.y * rate.y, I.z * rate.z}}) {
      const AndoyerState a = to_andoyer(RotorState{s.q, g});
      to = put_all(to, a.l, a.g, a.h, a.L, a.G, a.H);
    }
    return to;
  }
};

// Relative to |q| = 1 and to |g|.
double error_size(const Values& error, const Values& y, const Values& /*increment*/) {
  const double turn = std::hypot(std::hypot(error[0], error[1]), std::hypot(error[2], error[3]));
  const double size = norm(vector(&y[4]));
  return std::hypot(turn, size > 0.0 ? norm(vector(&error[4])) / size : 0.0);
}

using Solver = AdaptiveRungeKutta<Verner98, double, 7, PerturbedRotor, decltype(&error_size)>;

std::string time_text(double t) {
  char buffer[32];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, t).ptr);
}

// Steps up to t, of which so many are left; false, with a sentence kept, where that does not do.
bool reaches(Solver& solver, double t, double& left) {
  while (solver.time().hi != t) {
    const bool is_spent = !(left-- > 0.0);
    if (!is_spent && solver.advance(t) == StepOutcome::made) continue;
    keep_refusal("the motion ends at t = " + time_text(solver.time().hi) +
                 (is_spent ? ": it takes more steps than it may"
                           : ": no step from there is short enough; give a larger tolerance"));
    return false;
  }
  return true;
}

Frame frame_of(const double* axis, double rate) {
  return rate == 0.0 ? Frame::inertial() : Frame::precessing(vector(axis), rate);
}

KeplerOrbit orbit(const double* x) {
  return KeplerOrbit(KeplerElements{x[0], x[1], x[2], x[3], x[4], x[5], x[6], x[7]});
}

PerturbedRotor rotor_of(const double* x) {
  PerturbedRotor rotor{body(x), frame_of(x + 23, x[26]), {}, {}, {}};
  if (x[13] != 0.0) rotor.gravity.emplace(x[13], orbit(x + 13));
  if (x[21] != 0.0) rotor.internal.emplace(x[21]);
  if (x[22] != 0.0) rotor.linear.emplace(x[22]);
  return rotor;
}

}  // namespace

int polhode_integrate(const double* x, uint32_t count, double* rows) {
  int made = 0;
  const int failed = guarded([&] {
    keep_refusal("");
    const Adaptive method{.tolerance = x[12]};
    require_valid(method);
    const PerturbedRotor rotor = rotor_of(x);
    const double start = x[10], span = x[11] - x[10];
    const FreeRotation checked(rotor.body, state(x + 3), start);
    if (!std::isfinite(span) || count < 2)
      throw DomainError("integrate: got a stop that is not finite, or fewer than 2 samples");
    const Quaternion q = normalized(checked.initial_state().q);
    const Values y{q.w, q.x, q.y, q.z, x[7], x[8], x[9]};
    Solver solver(rotor, error_size, start, y,
                  {method.tolerance, method.first_step, rotor.time_scale()});
    double left = x[27];
    for (uint32_t k = 0; k < count; ++k) {
      const double t = start + span * (static_cast<double>(k) / (count - 1));
      if (!reaches(solver, t, left)) return;
      const RotorState s = state(solver.state().y.data());
      rows = rotor.row(t, {normalized(s.q), s.g}, rows);
      ++made;
    }
  });
  return failed == done ? made : -1;
}

int polhode_damping_of_wobble(const double* moments, double time, double G, double* k) {
  return guarded([&] { *k = InternalDamping::of_wobble(body(moments), time, G).coefficients().x; });
}

int polhode_orbit_position(const double* elements, double t, double* position) {
  return guarded([&] { put(position, orbit(elements).position(t)); });
}
