// SPDX-License-Identifier: MIT
#include "polhode/free/prepare.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "free/detail/sorted_state.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Below this ratio of moments squares of rates are beyond double-double.
constexpr double least_moment_ratio = 0x1p-900;

}  // namespace

void require_held_moments(const char* function, const Body& body) {
  const Vec3 I = sorted_doubles(body);
  if (I.x >= least_moment_ratio * I.z) return;
  throw DomainError(std::string(function) + ": moments " + tuple_text({I.x, I.y, I.z}) +
                    " must have a ratio of at least 2^-900, " + number_text(least_moment_ratio));
}

void require_preparable(const char* function, const Body& body, const RotorState& s, double t0) {
  const auto name = [&] { return std::string(function); };
  const Quaternion& q = s.q;
  const bool finite_q =
      std::isfinite(q.w) && std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z);
  if (!finite_q || q == Quaternion{0.0, 0.0, 0.0, 0.0})
    throw DomainError(name() + ": q " + tuple_text({q.w, q.x, q.y, q.z}) +
                      " is not a finite, non-zero quaternion");
  if (!std::isfinite(s.g.x) || !std::isfinite(s.g.y) || !std::isfinite(s.g.z))
    throw DomainError(name() + ": g " + tuple_text({s.g.x, s.g.y, s.g.z}) + " is not finite");
  if (!std::isfinite(t0))
    throw DomainError(name() + ": t0 = " + number_text(t0) + " is not finite");
  require_held_moments(function, body);
  const Vec3& I = body.moments();
  const Scale scale{exponent_of_largest(I), exponent_of_largest(s.g)};
  using Limits = std::numeric_limits<double>;
  // 2^rate is not a normal double
  if (scale.rate() < Limits::min_exponent - 1 || scale.rate() >= Limits::max_exponent)
    throw DomainError(name() + ": g " + tuple_text({s.g.x, s.g.y, s.g.z}) + " over moments " +
                      tuple_text({I.x, I.y, I.z}) + " is a rate too " +
                      (scale.rate() < 0 ? "small" : "large") + " for a double");
}

template FreeKernel prepared_kernel<double>(const Vec3&, const RotorState&, const double&);
template BasicFreeKernel<DoubleDouble> prepared_kernel<DoubleDouble>(
    const BasicVec3<DoubleDouble>&, const BasicRotorState<DoubleDouble>&, const DoubleDouble&);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
