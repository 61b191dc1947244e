// SPDX-License-Identifier: MIT
// Perturbed motion for the views of the explorer: gravity gradient, damping, a precessing frame.
//
// A model of the two or three terms that there are here, and not a System of any terms, whose every
// method and number type would be linked: the equations of motion are those of the system.
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "numbers.hpp"
#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/frame/frame.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/perturb/gravity_gradient.hpp"
#include "polhode/perturb/internal_damping.hpp"
#include "polhode/perturb/linear_damping.hpp"
#include "polhode/rotor/andoyer.hpp"
#include "polhode/system/system.hpp"
#include "polhode_web.h"
#include "refusals.hpp"

using namespace polhode;
using namespace polhode::web;

namespace {

struct PerturbedRotor {
  using State = RotorState;
  using Values = std::array<double, 7>;
  static constexpr std::string_view name = "a perturbed rotor";

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

  template <Real T>
  std::array<T, 7> values(const RotorState& s) const {
    return {s.q.w, s.q.x, s.q.y, s.q.z, s.g.x, s.g.y, s.g.z};
  }
  RotorState state(const Values& y) const {
    const RotorState s = web::state(y.data());
    return {normalized(s.q), s.g};
  }
  Values rates(const DoubleDouble& t, const Values& y) const {
    const RotorState s = web::state(y.data());
    const FrameMotion moved = frame.at(t.hi);
    const Effect e = effect(Setting{body, t.hi, s, moved.q_IS, t.lo});
    RotorRates r = inertial_rates(s, angular_velocity(body, s), e);
    if (!frame.is_inertial()) r = relative_rates(r, s.q, moved.mu_S);
    return {r.q.w, r.q.x, r.q.y, r.q.z, r.g.x, r.g.y, r.g.z};
  }
  double error_size(const Values& error, const Values& y, const Values& /*increment*/) const {
    const double turn = std::hypot(std::hypot(error[0], error[1]), std::hypot(error[2], error[3]));
    const double size = norm(vector(&y[4]));
    return std::hypot(turn, size > 0.0 ? norm(vector(&error[4])) / size : 0.0);
  }
  RotorState started(const RotorState& s) const { return {normalized(s.q), s.g}; }
  double time_scale(double /*t*/) const {
    return gravity ? gravity->time_scale() : std::numeric_limits<double>::infinity();
  }

  // One row of the interface.
  double* row(double t, const RotorState& s, double* to) const {
    const FrameMotion moved = frame.at(t);
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

Frame frame_of(const double* axis, double rate) {
  return rate == 0.0 ? Frame::inertial() : Frame::precessing(vector(axis), rate);
}

PerturbedRotor rotor_of(const double* x) {
  PerturbedRotor rotor{body(x), frame_of(x + 23, x[26]), {}, {}, {}};
  if (x[13] != 0.0)
    rotor.gravity.emplace(x[13], KeplerOrbit(KeplerElements{x[13], x[14], x[15], x[16], x[17],
                                                            x[18], x[19], x[20]}));
  if (x[21] != 0.0) rotor.internal.emplace(x[21]);
  if (x[22] != 0.0) rotor.linear.emplace(x[22]);
  return rotor;
}

}  // namespace

int polhode_integrate(const double* x, uint32_t count, double* rows) {
  int rows_made = 0;
  const int failed = guarded([&] {
    const RotorState initial = FreeRotation(body(x), state(x + 3)).initial_state();  // checked
    const BasicProblem<PerturbedRotor> problem{.system = rotor_of(x),
                                               .initial = initial,
                                               .start = x[10],
                                               .stop = x[11],
                                               .method = Adaptive{.tolerance = x[12]}};
    const BasicTrajectory<RotorState> run =
        integrate(problem, Keep{SaveAt::count(x[10], x[11], count), false});
    for (const Sample& sample : run.samples()) {
      rows = problem.system.row(sample.t, sample.s, rows);
      ++rows_made;
    }
    keep_refusal(run.outcome().advice);
  });
  return failed == done ? rows_made : -1;
}

int polhode_damping_of_wobble(const double* moments, double time, double G, double* k) {
  return guarded(
      [&] { *k = InternalDamping::of_wobble(body(moments), time, G).coefficients().x; });
}
