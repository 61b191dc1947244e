// SPDX-License-Identifier: MIT
#include "dynamics/checked_problem.hpp"

#include <cmath>

#include "dynamics/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/dynamics/detail/run_forms.hpp"
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

RotorState normal(const RotorState& s) { return {normalized(s.q), s.g}; }
DampedRotorState normal(const DampedRotorState& s) { return {normal(s.rotor), s.damper_rate}; }
Vec3 rate_of_damper(const RotorState&) { return {}; }
Vec3 rate_of_damper(const DampedRotorState& s) { return s.damper_rate; }

}  // namespace

template <MotionState S>
BasicProblem<System, S> checked_problem(const std::string& function,
                                        BasicProblem<System, S> problem, DamperState carried) {
  require_state(function, rotor_of(problem.initial));
  require_finite_span(function, problem.start, problem.stop);
  require_squared_moments(function, problem.system.body());
  require_valid(problem.method);
  require_place_of_damper(function, problem.system, rate_of_damper(problem.initial), problem.method,
                          carried);
  problem.initial = normal(problem.initial);
  return problem;
}

template Problem checked_problem(const std::string&, Problem, DamperState);
template DampedProblem checked_problem(const std::string&, DampedProblem, DamperState);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
