// SPDX-License-Identifier: MIT
#include "polhode/frame/frame.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// The same axis in I and S: q_IS = exp(axis rate (t - epoch) / 2), mu_S = rate axis.
class UniformPrecession final : public detail::ErasedFrame {
 public:
  UniformPrecession(const Vec3& axis, double rate, double epoch) : rate_(rate), epoch_(epoch) {
    // |axis|^2 in double-double; scaled, as 1e-200 would underflow
    const double scale = norm(axis);
    const BasicVec3<DoubleDouble> a{DoubleDouble(axis.x) / scale, DoubleDouble(axis.y) / scale,
                                    DoubleDouble(axis.z) / scale};
    const DoubleDouble length = sqrt(dot(a, a));
    axis_ = {a.x / length, a.y / length, a.z / length};
    mu_ = DoubleDouble(rate) * axis_;
  }

  FrameMotion at(double t) const override {
    const DoubleDouble half = half_angle(DoubleDouble::sum(t, -epoch_));
    const auto [sine, cosine] = sincos(half.hi);
    const double s = sine + half.lo * cosine, c = cosine - half.lo * sine;
    return {{c, s * axis_.x.hi, s * axis_.y.hi, s * axis_.z.hi}, {mu_.x.hi, mu_.y.hi, mu_.z.hi}};
  }
  BasicFrameMotion<DoubleDouble> at(const DoubleDouble& t) const override {
    const auto [s, c] = sincos(half_angle(t - epoch_));
    return {{c, s * axis_.x, s * axis_.y, s * axis_.z}, mu_};
  }

 private:
  // rate (t - epoch) / 2 in [-pi, pi]; whole turns of it leave the quaternion as it is.
  DoubleDouble half_angle(const DoubleDouble& elapsed) const {
    const DoubleDouble half = (0.5 * rate_) * elapsed, turn = DoubleDouble::two_pi();
    return half - turn * std::rint(half.hi / turn.hi);
  }

  BasicVec3<DoubleDouble> axis_, mu_;
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
  return Frame(std::make_shared<const UniformPrecession>(axis, rate, epoch));
}

}  // namespace v0
}  // namespace polhode
