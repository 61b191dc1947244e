// SPDX-License-Identifier: MIT
#include "dynamics/detail/checked_problem.hpp"

#include <cmath>

#include "dynamics/detail/finite.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "rotor/squared_moments.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// The damper's own state is integrated by Adaptive, and by nothing else.
void require_place_of_damper(const std::string& function, const Problem& problem) {
  const Vec3& s = problem.damper_rate;
  if (!problem.system.damper()) {
    if (s == Vec3{}) return;
    throw DomainError(function + ": damper_rate " + tuple_text({s.x, s.y, s.z}) +
                      " must be zero for a system without a damper");
  }
  if (!is_finite(s))
    throw DomainError(function + ": damper_rate " + tuple_text({s.x, s.y, s.z}) +
                      " must be finite");
  const char* const instead = "InternalDamping, its limit of strong friction, has no state";
  if (function != "integrate")
    throw DomainError(function +
                      ": a Kane damper has a state of its own, which integrate alone "
                      "carries; " +
                      instead);
  if (!std::holds_alternative<Adaptive>(problem.method))
    throw DomainError("integrate: a Kane damper has a state of its own: method must be Adaptive; " +
                      std::string(instead));
}

// Flows and equations of motion use the squares of moments and of their inverses.
void require_squared_moments(const std::string& function, const Body& body) {
  if (squared_moments_are_doubles(body)) return;
  const Vec3& I = body.moments();
  throw DomainError(function + ": moments " + tuple_text({I.x, I.y, I.z}) +
                    " must be within a factor of 1e150 of each other");
}

}  // namespace

Problem checked_problem(const std::string& function, Problem problem) {
  const auto& [q, g] = problem.initial;
  const double size = norm(Vec3{std::hypot(q.w, q.x), q.y, q.z});
  if (!(size > 0.0) || !std::isfinite(size))
    throw DomainError(function + ": quaternion " + tuple_text({q.w, q.x, q.y, q.z}) +
                      " must be finite and not zero");
  if (!is_finite(g))
    throw DomainError(function + ": momentum " + tuple_text({g.x, g.y, g.z}) + " must be finite");
  if (!std::isfinite(problem.start) || !std::isfinite(problem.stop))
    throw DomainError(function + ": start " + number_text(problem.start) + " and stop " +
                      number_text(problem.stop) + " must be finite");
  require_squared_moments(function, problem.system.body());
  require_valid(problem.method);
  require_place_of_damper(function, problem);
  problem.initial.q = normalized(q);
  return problem;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
