// SPDX-License-Identifier: MIT
#include "polhode/frame/frame.hpp"

#include <cmath>

#include "math/detail/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// q = exp(axis rate (t - epoch) / 2); the same axis in I and S.
class Precession {
 public:
  Precession(const Vec3& unit_axis, double rate, double epoch)
      : axis_(unit_axis), rate_(rate), epoch_(epoch) {}

  template <Real T>
  BasicQuaternion<T> operator()(const T& t) const {
    using std::cos;
    using std::sin;
    const T half = T(0.5 * rate_) * (t - T(epoch_));
    const T c = cos(half), s = sin(half);
    return {c, T(axis_.x) * s, T(axis_.y) * s, T(axis_.z) * s};
  }

 private:
  Vec3 axis_;
  double rate_;
  double epoch_;
};

}  // namespace

Frame Frame::precessing(const Vec3& axis, double rate, double epoch) {
  const double length = norm(axis);
  if (!(length > 0.0) || !std::isfinite(length))
    throw DomainError("Frame::precessing: axis " + detail::tuple_text({axis.x, axis.y, axis.z}) +
                      " must be finite and not zero");
  if (!std::isfinite(rate) || !std::isfinite(epoch))
    throw DomainError("Frame::precessing: rate " + detail::number_text(rate) + " and epoch " +
                      detail::number_text(epoch) + " must be finite");
  return from_attitude(
      Precession({axis.x / length, axis.y / length, axis.z / length}, rate, epoch));
}

}  // namespace v0
}  // namespace polhode
