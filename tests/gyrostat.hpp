// SPDX-License-Identifier: MIT
// A state of another shape, defined here and nowhere in the library: a gyrostat, a body with a
// wheel that turns about an axis fixed in it with a constant momentum relative to the body.
#pragma once

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "polhode/dynamics/integrate_model.hpp"
#include "polhode/error.hpp"
#include "worst.hpp"

namespace polhode::test {

// The wheel's angle relative to the body counts turns: it is no attitude.
struct GyrostatState {
  Quaternion q;
  Vec3 g;  // of body and wheel together, body axes
  double wheel = 0.0;

  bool operator==(const GyrostatState&) const = default;
};

template <class Visit>
void each_number(GyrostatState& s, Visit&& visit) {
  for (double* x : {&s.q.w, &s.q.x, &s.q.y, &s.q.z, &s.g.x, &s.g.y, &s.g.z, &s.wheel}) visit(*x);
}

// dg/dt = g x w, w = I^-1 (g - h); h = J_w times the rate of the wheel relative to the body, which
// is constant.
class Gyrostat {
 public:
  using State = GyrostatState;
  static constexpr std::string_view name = "a gyrostat";

  Gyrostat(const Vec3& moments, const Vec3& h, double wheel_moment)
      : I_(moments), h_(h), wheel_rate_(norm(h) / wheel_moment) {}

  template <Real T>
  std::array<T, 8> values(const State& s) const {
    const BasicQuaternion<T> q =
        normalized(BasicQuaternion<T>{T(s.q.w), T(s.q.x), T(s.q.y), T(s.q.z)});
    return {q.w, q.x, q.y, q.z, T(s.g.x), T(s.g.y), T(s.g.z), T(s.wheel)};
  }
  template <Real T>
  State state(const std::array<T, 8>& y) const {
    const BasicQuaternion<T> q = normalized(BasicQuaternion<T>{y[0], y[1], y[2], y[3]});
    return {{to_double(q.w), to_double(q.x), to_double(q.y), to_double(q.z)},
            {to_double(y[4]), to_double(y[5]), to_double(y[6])},
            to_double(y[7])};
  }
  template <Real T>
  std::array<T, 8> rates(const DoubleDouble&, const std::array<T, 8>& y) const {
    const BasicQuaternion<T> q{y[0], y[1], y[2], y[3]};
    const BasicVec3<T> g{y[4], y[5], y[6]};
    const BasicVec3<T> w{(g.x - T(h_.x)) / T(I_.x), (g.y - T(h_.y)) / T(I_.y),
                         (g.z - T(h_.z)) / T(I_.z)};
    const T half(0.5);
    const BasicQuaternion<T> dq =
        q * BasicQuaternion<T>{T(0.0), half * w.x, half * w.y, half * w.z};
    const BasicVec3<T> dg = cross(g, w);
    return {dq.w, dq.x, dq.y, dq.z, dg.x, dg.y, dg.z, T(wheel_rate_)};
  }
  template <Real T>
  double error_size(const std::array<T, 8>& error, const std::array<T, 8>& y,
                    const std::array<T, 8>&) const {
    const auto size = [](const std::array<T, 8>& v, std::size_t i, std::size_t j) {
      double sum = 0.0;
      for (; i < j; ++i) sum += to_double(v[i]) * to_double(v[i]);
      return std::sqrt(sum);
    };
    const double turned = 1.0 + size(y, 7, 8);
    return size(error, 0, 4) + size(error, 4, 7) / size(y, 4, 7) + size(error, 7, 8) / turned;
  }
  template <Real T>
  void settle(CompensatedState<T, 8>& s) const {
    T excess = T(-1.0);
    for (std::size_t i = 0; i < 4; ++i) excess = excess + s.y[i] * s.y[i];
    std::array<T, 8> change{};
    for (std::size_t i = 0; i < 4; ++i) change[i] = T(-0.5) * excess * s.y[i];
    s.add(change);
  }

  State started(const State& s) const {
    if (!std::isfinite(s.wheel)) throw DomainError("gyrostat: the angle of the wheel is no number");
    return {normalized(s.q), s.g, s.wheel};
  }
  // |g| and the largest rate that it can make.
  double turning_rate(double, const State& s) const {
    return (norm(s.g) + norm(h_)) / smaller_moment();
  }
  static State near(const State& to, State s) {
    const double cosine = to.q.w * s.q.w + to.q.x * s.q.x + to.q.y * s.q.y + to.q.z * s.q.z;
    if (cosine < 0.0) s.q = {-s.q.w, -s.q.x, -s.q.y, -s.q.z};
    return s;
  }
  std::vector<double> parameters() const {
    return {I_.x, I_.y, I_.z, h_.x, h_.y, h_.z, wheel_rate_};
  }

  Vec3 rate_of_body(const State& s) const {
    return {(s.g.x - h_.x) / I_.x, (s.g.y - h_.y) / I_.y, (s.g.z - h_.z) / I_.z};
  }
  double energy(const State& s) const { return 0.5 * dot(s.g - h_, rate_of_body(s)); }

 private:
  double smaller_moment() const { return smaller(I_.x, I_.y, I_.z); }

  Vec3 I_;
  Vec3 h_;
  double wheel_rate_;
};

static_assert(Model<Gyrostat> && ModelOn<Gyrostat, DoubleDouble>);

}  // namespace polhode::test
