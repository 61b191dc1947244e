// SPDX-License-Identifier: MIT
#include "polhode/frame/frame.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "budgets.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "oracle/wide_real.hpp"
#include "worst.hpp"

namespace polhode::test {
namespace {

using namespace oracle;
using WideMat3 = BasicMat3<Wide>;

constexpr double eps = std::numeric_limits<double>::epsilon();

Wide wide(double x) { return x; }
Wide wide(const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); }
template <Real T>
WideVec3 wide(const BasicVec3<T>& v) {
  return {wide(v.x), wide(v.y), wide(v.z)};
}
double size(const WideVec3& v) { return static_cast<double>(sqrt(dot(v, v))); }

// Matrices S to I, written out; q_IS and its half angles are not used.
WideMat3 about_x(const Wide& a) { return {{{1, 0, 0}, {0, cos(a), -sin(a)}, {0, sin(a), cos(a)}}}; }
WideMat3 about_z(const Wide& a) { return {{{cos(a), -sin(a), 0}, {sin(a), cos(a), 0}, {0, 0, 1}}}; }
// Rodrigues' formula.
WideMat3 about(const WideVec3& axis, const Wide& a) {
  const WideVec3 n = Wide(1 / sqrt(dot(axis, axis))) * axis;
  WideMat3 m;
  for (int j = 0; j < 3; ++j) {
    WideVec3 e;
    e[j] = 1;
    const WideVec3 column = cos(a) * e + sin(a) * cross(n, e) + Wide((1 - cos(a)) * n[j]) * n;
    for (int i = 0; i < 3; ++i) m(i, j) = column[i];
  }
  return m;
}

using Attitude = std::function<WideMat3(const Wide&)>;

// A^T dA/dt = hat(mu_S), by the difference quotient of fourth order.
WideVec3 rate_of(const Attitude& attitude, const Wide& t) {
  const Wide h = 1e-14;
  const WideMat3 back = transpose(attitude(t));
  const auto slope = [&](int i, int j) {
    const auto entry = [&](const Wide& shift) { return (back * attitude(t + shift))(i, j); };
    return Wide((8 * (entry(h) - entry(-h)) - (entry(2 * h) - entry(-2 * h))) / (12 * h));
  };
  return {slope(2, 1), slope(0, 2), slope(1, 0)};
}

struct Errors {
  double attitude = 0.0;  // rad
  double rate = 0.0;      // over max(1, |mu|)
};
struct WorstErrors {
  Worst<> attitude, rate;
  void add(const Errors& e) {
    attitude.add(e.attitude);
    rate.add(e.rate);
  }
};

template <Real T>
Errors errors(const Frame& frame, const Attitude& attitude, const T& t) {
  const BasicFrameMotion<T> got = frame.at(t);
  const WideMat3 want = attitude(wide(t));
  Worst attitude_error;
  for (int j = 0; j < 3; ++j) {
    BasicVec3<T> axis{T(0.0), T(0.0), T(0.0)};
    axis[j] = T(1.0);
    const BasicQuaternion<Wide> q{wide(got.q_IS.w), wide(got.q_IS.x), wide(got.q_IS.y),
                                  wide(got.q_IS.z)};
    const WideVec3 column = rotate(q, wide(axis));
    attitude_error.add(size(column - WideVec3{want(0, j), want(1, j), want(2, j)}));
  }
  const WideVec3 mu = rate_of(attitude, wide(t));
  return {attitude_error.value(), size(wide(got.mu_S) - mu) / larger(1.0, size(mu))};
}

void expect_frame(const Frame& frame, const Attitude& attitude, double longest) {
  WorstErrors worst, worst_wide;
  for (std::uint64_t i = 0; i < 60; ++i) {
    Draw draw(601, i);
    const double t = draw.sign() * draw.power_of_ten(-3.0, longest);
    worst.add(errors(frame, attitude, t));
    worst_wide.add(errors(frame, attitude, DoubleDouble::sum(t, t * 0x1p-60)));
  }
  EXPECT_FALSE(frame.is_inertial());
  EXPECT_LE(worst.attitude.value(), budget::frame_attitude_eps * eps);
  EXPECT_LE(worst.rate.value(), budget::frame_rate_eps * eps);
  EXPECT_LE(worst_wide.attitude.value(), budget::frame_wide);
  EXPECT_LE(worst_wide.rate.value(), budget::frame_wide);
}

TEST(Frame, InertialDoesNotMove) {
  const Frame frame = Frame::inertial();
  EXPECT_TRUE(frame.is_inertial());
  EXPECT_EQ(frame.at(3.0).q_IS, Quaternion{});
  EXPECT_EQ(frame.at(3.0).mu_S, Vec3{});
}

TEST(Frame, Precessing) {
  const Vec3 axis{0.3, -1.2, 0.7};
  const double rate = -0.37, epoch = 0.25;
  expect_frame(
      Frame::precessing(axis, rate, epoch),
      [&](const Wide& t) { return about(wide(axis), Wide(rate) * (t - epoch)); }, 1.0);
  EXPECT_EQ(Frame::precessing(axis, rate, epoch).at(epoch).q_IS, Quaternion{});
  // The length of the axis says nothing.
  EXPECT_EQ(Frame::precessing({0x1p-500, 0.0, 0x1p-500}, 1.0).at(2.0).q_IS,
            Frame::precessing({1.0, 0.0, 1.0}, 1.0).at(2.0).q_IS);
}

TEST(Frame, PrecessingKeepsItsDigitsForABillionRadians) {
  const Vec3 axis{0.3, -1.2, 0.7};
  const double rate = 1.7, epoch = -3.1;
  Worst worst;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Draw draw(602, i);
    const double t = draw.sign() * draw.power_of_ten(6.0, 9.0);
    const auto attitude = [&](const Wide& time) {
      return about(wide(axis), Wide(rate) * (time - Wide(epoch)));
    };
    worst.add(errors(Frame::precessing(axis, rate, epoch), attitude, t).attitude);
  }
  EXPECT_LE(worst.value(), budget::frame_attitude_eps * eps);
}

// A node that regresses with a wobble, an inclination that nods: any functions of time.
constexpr auto node = [](const auto& t) {
  using std::sin;
  return 1.0 - 0.3 * t + 0.1 * sin(2.0 * t);
};
constexpr auto tilt = [](const auto& t) {
  using std::cos;
  return 0.4 + 0.05 * cos(t);
};

TEST(Frame, OrbitPlane) {
  expect_frame(
      Frame::orbit_plane(node, tilt),
      [](const Wide& t) { return about_z(node(t)) * about_x(tilt(t)); }, 0.5);
}

TEST(Frame, OrbitPlaneWithoutANode) {
  const auto p = [](const auto& t) {
    using std::sin;
    return sin(tilt(t)) * sin(node(t));
  };
  const auto q = [](const auto& t) {
    using std::cos;
    using std::sin;
    return sin(tilt(t)) * cos(node(t));
  };
  const Frame frame = Frame::orbit_plane_pq(p, q);
  expect_frame(
      frame, [](const Wide& t) { return about_z(node(t)) * about_x(tilt(t)) * about_z(-node(t)); },
      0.5);
  // The same plane as with a node.
  const Vec3 pole{0.0, 0.0, 1.0};
  for (const double t : {-2.0, 0.0, 1.5}) {
    const Vec3 a = rotate(frame.at(t).q_IS, pole);
    const Vec3 b = rotate(Frame::orbit_plane(node, tilt).at(t).q_IS, pole);
    EXPECT_LE(norm(a - b), budget::frame_attitude_eps * eps);
  }
}

// Through i = 0, where the node form has a node that jumps.
TEST(Frame, OrbitPlaneThroughTheReferencePlane) {
  const Frame frame = Frame::orbit_plane_pq([](const auto& t) { return 0.2 * t; },
                                            [](const auto& t) { return 0.1 * t * t; });
  EXPECT_EQ(frame.at(0.0).q_IS, Quaternion{});
  EXPECT_LE(norm(frame.at(0.0).mu_S - Vec3{0.0, 0.2, 0.0}), budget::frame_rate_eps * eps);
}

TEST(Frame, PlanesThatDoNotExistAreNotANumber) {
  const auto steep = [](const auto& t) { return 0.9 + 0.0 * t; };
  const FrameMotion m = Frame::orbit_plane_pq(steep, steep).at(0.0);
  EXPECT_TRUE(std::isnan(m.q_IS.w));
  EXPECT_TRUE(std::isnan(m.mu_S.x));
}

// A user's quaternion need not be of length 1, and its length may change.
TEST(Frame, FromAttitude) {
  const auto growing = [](const auto& t) {
    using T = std::decay_t<decltype(t)>;
    const BasicQuaternion<T> q = rotation_z(node(t)) * rotation_x(tilt(t));
    const T length = T(2.0) + t * t;
    return BasicQuaternion<T>{length * q.w, length * q.x, length * q.y, length * q.z};
  };
  expect_frame(
      Frame::from_attitude(growing),
      [](const Wide& t) { return about_z(node(t)) * about_x(tilt(t)); }, 0.5);
}

TEST(Frame, DualTimesCarryNoDerivative) {
  const Frame frame = Frame::precessing({0.0, 0.0, 1.0}, 0.5);
  const auto at = frame.at(Dual<double, 6>(1.5));
  EXPECT_EQ(at.q_IS.z.value, frame.at(1.5).q_IS.z);
  EXPECT_EQ(at.mu_S.z.value, 0.5);
  EXPECT_TRUE(at.q_IS.z.is_constant());
}

TEST(Frame, ExceptionsOfTheUserPassThrough) {
  const Frame frame = Frame::orbit_plane(
      [](const auto& t) {
        if (t > 1.0) throw std::runtime_error("table ends");
        return t;
      },
      tilt);
  EXPECT_NO_THROW(frame.at(0.5));
  EXPECT_THROW(frame.at(1.5), std::runtime_error);
}

TEST(Frame, RefusesBadInput) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_MESSAGE(Frame::precessing({0.0, 0.0, 0.0}, 1.0),
                 "Frame::precessing: axis (0, 0, 0) must be finite and not zero");
  EXPECT_MESSAGE(Frame::precessing({0.0, nan, 1.0}, 1.0),
                 "Frame::precessing: axis (0, nan, 1) must be finite and not zero");
  EXPECT_MESSAGE(Frame::precessing({0.0, 0.0, 1.0}, HUGE_VAL),
                 "Frame::precessing: rate inf and epoch 0 must be finite");
  EXPECT_MESSAGE(Frame::precessing({0.0, 0.0, 1.0}, 1.0, nan),
                 "Frame::precessing: rate 1 and epoch nan must be finite");
}

}  // namespace
}  // namespace polhode::test
