// SPDX-License-Identifier: MIT
// Checks of a problem before its first step: its state, its sample times, and its events.
#include "dynamics/checked_problem.hpp"

#include <algorithm>
#include <cmath>

#include "math/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
#include "polhode/dynamics/event.hpp"
#include "polhode/error.hpp"
#include "rotor/squared_moments.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// The damper's own state is integrated by methods that move any state.
void require_place_of_damper(const std::string& function, const System& system, const Vec3& rate,
                             const Method& method, DamperState carried) {
  const std::string what =
      function + ": damper_rate " + tuple_text({rate.x, rate.y, rate.z}) + " must be ";
  if (!system.damper()) {
    if (rate == Vec3{}) return;
    throw DomainError(what + "zero for a system without a damper");
  }
  if (!is_finite(rate)) throw DomainError(what + "finite");
  const char* const instead = "InternalDamping, its limit of strong friction, has no state";
  if (carried == DamperState::refused)
    throw DomainError(function +
                      ": a Kane damper has a state of its own, which integrate alone "
                      "carries; " +
                      instead);
  if (!moves_any_state(method))
    throw DomainError(
        "integrate: a Kane damper has a state of its own: method must be Adaptive or "
        "Collocation; " +
        std::string(instead));
}

// Flows and equations of motion use the squares of moments and of their inverses.
void require_squared_moments(const std::string& function, const Body& body) {
  if (squared_moments_are_doubles(body)) return;
  const Vec3& I = body.moments();
  throw DomainError(function + ": moments " + tuple_text({I.x, I.y, I.z}) +
                    " must be within a factor of 1e150 of each other");
}

void require_state(const std::string& function, const RotorState& s) {
  const auto& [q, g] = s;
  const double size = norm(Vec3{std::hypot(q.w, q.x), q.y, q.z});
  if (!(size > 0.0) || !std::isfinite(size))
    throw DomainError(function + ": quaternion " + tuple_text({q.w, q.x, q.y, q.z}) +
                      " must be finite and not zero");
  if (!is_finite(g))
    throw DomainError(function + ": momentum " + tuple_text({g.x, g.y, g.z}) + " must be finite");
}

}  // namespace

Problem checked_problem(const std::string& function, Problem problem, DamperState carried) {
  SystemState& initial = problem.initial;
  require_state(function, initial);
  require_finite_span(function, problem.start, problem.stop);
  require_squared_moments(function, problem.system.body());
  require_valid(problem.method);
  require_place_of_damper(function, problem.system, initial.damper_rate, problem.method, carried);
  initial.q = normalized(initial.q);
  return problem;
}

std::vector<double> sample_times(const std::string& function, const Problem& problem,
                                 const SaveAt& samples) {
  const double sign = problem.start <= problem.stop ? 1.0 : -1.0;
  // SaveAt keeps a row that rounding puts beyond stop.
  const double slack =
      8.0 * epsilon<double>() * std::max(std::abs(problem.start), std::abs(problem.stop));
  std::vector<double> times;
  for (std::int64_t k = 0; k < samples.size(); ++k) {
    const double t = samples[k];
    if (!(sign * (t - problem.start) >= 0.0 && sign * (problem.stop - t) >= -slack)) continue;
    if (!times.empty() && sign * (t - times.back()) < 0.0)
      throw DomainError(function + ": sample times must run from start to stop: " + number_text(t) +
                        " comes after " + number_text(times.back()));
    times.push_back(t);
  }
  return times;
}

}  // namespace detail

void require_valid_event(const std::string& event, bool has_function, double period,
                         double interval) {
  const std::string name = "event \"" + event + "\"";
  if (!has_function) throw DomainError(name + " must have a function");
  const auto positive = [&](const char* what, double x) {
    if (!(x >= 0.0) || !std::isfinite(x))
      throw DomainError(name + ": " + what + " " + detail::number_text(x) +
                        " must be positive, or 0 for none");
  };
  positive("period", period);
  positive("interval", interval);
}

}  // namespace v0
}  // namespace polhode
