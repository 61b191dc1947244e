// SPDX-License-Identifier: MIT
#include "dynamics/detail/checked_problem.hpp"

#include <cmath>

#include "dynamics/detail/finite.hpp"
#include "math/detail/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
  require_valid(problem.method);
  problem.initial.q = normalized(q);
  return problem;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
