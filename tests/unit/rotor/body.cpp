// SPDX-License-Identifier: MIT
#include "polhode/rotor/body.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/error.hpp"
#include "polhode/rotor/attitude.hpp"
#include "worst.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;
using polhode::test::Worst;
constexpr double eps = std::numeric_limits<double>::epsilon();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string message_of(double I1, double I2, double I3) {
  return message_of([=] { Body(I1, I2, I3); });
}

// A D A^T of a rotation A given by a quaternion
Mat3 tensor_of(const Vec3& moments, const Quaternion& q) {
  const Mat3 A = rotation_matrix(normalized(q));
  Mat3 D{};
  for (int i = 0; i < 3; ++i) D(i, i) = moments[i];
  Mat3 t = A * D * transpose(A);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < i; ++j) t(i, j) = t(j, i);
  return t;
}
double difference(const Mat3& a, const Mat3& b) {
  Worst worst;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) worst.add(std::abs(a(i, j) - b(i, j)));
  return worst.value();
}

TEST(Body, KeepsMomentsInAnyOrderBitForBit) {
  for (const Vec3& m :
       {Vec3{1, 2, 2.5}, Vec3{2.5, 1, 2}, Vec3{2, 2.5, 1}, Vec3{1, 1, 1}, Vec3{0.1, 0.2, 0.3},
        Vec3{1e-300, 1e-300, 1e-300}, Vec3{1e308, 1e308, 1e308}, Vec3{1, 1, 2}}) {
    const Body body(m.x, m.y, m.z);
    EXPECT_EQ(body.moments(), m);
    EXPECT_EQ(body.q_FB(), Quaternion{});
  }
}

TEST(Body, WithAxesIsWhatATensorGave) {
  const Body first = Body::from_tensor(tensor_of({1, 2, 2.5}, {0.9, 0.1, -0.3, 0.2}));
  const Body again = Body::with_axes(first.moments(), first.q_FB());
  EXPECT_EQ(again.moments(), first.moments());
  EXPECT_EQ(again.q_FB(), first.q_FB());
  EXPECT_MESSAGE(Body::with_axes({1, 1, 3}, {1, 0, 0, 0}),
                 "Body::with_axes: moments (1, 1, 3) break I3 <= I1 + I2");
  EXPECT_THROW(Body::with_axes({1, 1, 1}, {0, 0, 0, 0}), DomainError);
}

TEST(Body, FlatBodiesHaveFourEpsOfRoom) {
  EXPECT_NO_THROW(Body(1, 1, 2 * (1 + 3 * eps)));
  EXPECT_NO_THROW(Body(2 * (1 + 3 * eps), 1, 1));
  EXPECT_THROW(Body(1, 1, 2 * (1 + 6 * eps)), DomainError);
  EXPECT_THROW(Body(1, 2 * (1 + 6 * eps), 1), DomainError);
}

TEST(Body, SaysWhichInequalityBreaks) {
  EXPECT_EQ(message_of(1, 1, 3), "Body: moments (1, 1, 3) break I3 <= I1 + I2");
  EXPECT_EQ(message_of(3, 1, 1.5), "Body: moments (3, 1, 1.5) break I1 <= I2 + I3");
  EXPECT_EQ(message_of(0.1, 1, 0.2), "Body: moments (0.1, 1, 0.2) break I2 <= I1 + I3");
  EXPECT_EQ(message_of(0, 1, 1), "Body: moments (0, 1, 1) must be positive and finite");
  EXPECT_EQ(message_of(1, -1, 1), "Body: moments (1, -1, 1) must be positive and finite");
  EXPECT_EQ(message_of(1, 1, nan), "Body: moments (1, 1, nan) must be positive and finite");
  EXPECT_EQ(message_of(inf, 1, 1), "Body: moments (inf, 1, 1) must be positive and finite");
}

TEST(Body, DiagonalTensorKeepsItsOrderAndHasNoRotation) {
  const Body body = Body::from_tensor({{{3, 0.0, -0.0}, {0.0, 1, 0.0}, {-0.0, 0.0, 2.5}}});
  EXPECT_EQ(body.moments(), (Vec3{3, 1, 2.5}));
  EXPECT_EQ(body.q_FB(), Quaternion{});
}

// The eigenvalues of a solver would be a rounding off.
TEST(Body, DiagonalTensorKeepsEveryBit) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> moment(1.0, 1.5);
  for (int k = 0; k < 100; ++k) {
    const Vec3 I{moment(random), moment(random), moment(random)};
    const Body body = Body::from_tensor({{{I.x, 0.0, 0.0}, {0.0, I.y, 0.0}, {0.0, 0.0, I.z}}});
    EXPECT_EQ(body.moments(), I);
    EXPECT_EQ(body.q_FB(), Quaternion{});
  }
}

TEST(Body, TensorGivesMomentsAndTheRotationToPrincipalAxes) {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> n;
  const std::array<Vec3, 6> bodies{Vec3{1, 2, 2.5}, Vec3{3, 1, 2.5}, Vec3{1, 1, 1.5},
                                   Vec3{1.5, 2, 2}, Vec3{1, 1, 1},   Vec3{1, 2, 3}};
  for (int k = 0; k < 3000; ++k) {
    const Vec3 m = bodies[static_cast<std::size_t>(k) % bodies.size()];
    const Quaternion q{n(engine), n(engine), n(engine), n(engine)};
    const Mat3 t = tensor_of(m, q);
    const Body body = Body::from_tensor(t);
    std::array<double, 3> found{body.moments().x, body.moments().y, body.moments().z};
    std::array<double, 3> expected{m.x, m.y, m.z};
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found[i], expected[i], budget::body_tensor * expected[2]);
    }
    EXPECT_LE(difference(tensor_of(body.moments(), body.q_FB()), t),
              budget::body_tensor * expected[2]);
    // what from_tensor gives, Body takes
    EXPECT_NO_THROW(Body(body.moments().x, body.moments().y, body.moments().z));
  }
}

// A plate's tensor about another point and back, as the parallel axis theorem has it: what is left
// of it is rounded to the size that it had there.
TEST(Body, PlateMovedAndBackIsAPlate) {
  std::mt19937_64 engine(13);
  std::normal_distribution<double> n;
  std::uniform_real_distribution<double> decade(0.0, 2.0);
  const double mass = 100.0;
  for (int k = 0; k < 1000; ++k) {
    const Mat3 plate = tensor_of({1, 2, 3}, {n(engine), n(engine), n(engine), n(engine)});
    const Vec3 away{n(engine), n(engine), n(engine)};
    const Vec3 to = (std::pow(10.0, decade(engine)) / norm(away)) * away;
    Mat3 t = plate;
    for (const double sign : {1.0, -1.0})
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          t(i, j) += sign * mass * ((i == j ? dot(to, to) : 0.0) - to[i] * to[j]);
    const Vec3 m = Body::from_tensor(t).moments();
    EXPECT_NEAR(m.x + m.y + m.z, 6.0, budget::body_tensor * mass * dot(to, to)) << k;
  }
  EXPECT_NO_THROW(Body::from_tensor({{{1, 0, 0}, {0, 1, 0}, {0, 0, 2 * (1 + 9e-10)}}}));
  EXPECT_THROW(Body::from_tensor({{{1, 0, 0}, {0, 1, 0}, {0, 0, 2 * (1 + 3e-9)}}}), DomainError);
}

TEST(Body, PrincipalAxesAreTheOnesNearestToTheTensorsAxes) {
  for (const Vec3& m : {Vec3{1, 2, 2.5}, Vec3{2.5, 1, 2}, Vec3{2, 2.5, 1}, Vec3{2.5, 2, 1}}) {
    const Quaternion q = normalized(Quaternion{1.0, 0.1, -0.2, 0.15});
    const Body body = Body::from_tensor(tensor_of(m, q));
    const Quaternion d = conj(q) * body.q_FB();
    EXPECT_LE(norm(Vec3{d.x, d.y, d.z}), budget::body_axes);
    EXPECT_LE(norm(body.moments() - m), budget::body_tensor * 2.5);
  }
}

// Of the 24 proper ways to name axes and their directions: the smallest angle to the file's.
TEST(Body, NoOtherNamesOfItsAxesAreNearer) {
  const double half = 0.5, root = std::sqrt(0.5);
  std::vector<Quaternion> names;
  for (int i = 0; i < 4; ++i) {
    std::array<double, 4> one{}, two{};
    one[static_cast<std::size_t>(i)] = 1.0;
    names.push_back({one[0], one[1], one[2], one[3]});
    for (int j = 0; j < i; ++j)
      for (const double sign : {-root, root}) {
        two = {};
        two[static_cast<std::size_t>(j)] = root;
        two[static_cast<std::size_t>(i)] = sign;
        names.push_back({two[0], two[1], two[2], two[3]});
      }
  }
  for (int signs = 0; signs < 8; ++signs)
    names.push_back({half, (signs & 1) != 0 ? -half : half, (signs & 2) != 0 ? -half : half,
                     (signs & 4) != 0 ? -half : half});
  ASSERT_EQ(names.size(), 24U);
  std::mt19937_64 engine(12);
  std::normal_distribution<double> n;
  for (int k = 0; k < 300; ++k) {
    const Quaternion q{n(engine), n(engine), n(engine), n(engine)};
    const Quaternion found = Body::from_tensor(tensor_of({1, 2, 2.5}, q)).q_FB();
    for (const Quaternion& p : names)
      EXPECT_LE(std::abs((p * found).w), std::abs(found.w) + budget::chart_rounding) << k;
  }
}

TEST(Body, EveryEntryOfATensorMustBeFinite) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (const double bad : {nan, inf, -inf}) {
        Mat3 t{{{2, 0.1, 0.1}, {0.1, 2, 0.1}, {0.1, 0.1, 2}}};
        t(i, j) = bad;
        EXPECT_THAT(message_of([&] { Body::from_tensor(t); }),
                    testing::StartsWith("Body::from_tensor: entry "))
            << i << j;
      }
}

TEST(Body, TensorErrorsNameTheEntries) {
  EXPECT_MESSAGE(Body::from_tensor({{{2, 0.1, 0}, {0.2, 2, 0}, {0, 0, 2}}}),
                 "Body::from_tensor: entries (0.1, 0.2) at 12 and its mirror must be equal");
  EXPECT_NO_THROW(Body::from_tensor({{{2, 0.1, 0}, {0.1 + 8 * eps, 2, 0}, {0, 0, 2}}}));
  EXPECT_MESSAGE(Body::from_tensor({{{2, 0, 0}, {0, nan, 0}, {0, 0, 2}}}),
                 "Body::from_tensor: entry nan must be finite");
  EXPECT_MESSAGE(Body::from_tensor({{{1, 0, 0}, {0, 1, 0}, {0, 0, 3}}}),
                 "Body::from_tensor: moments (1, 1, 3) break I3 <= I1 + I2");
  EXPECT_REJECTED(Body::from_tensor({{{1, 2, 0}, {2, 1, 0}, {0, 0, 2}}}),
                  "must be positive and finite");
}

TEST(Body, RatesAndEnergyOfAKnownState) {
  const Body body(1, 2, 2.5);
  const RotorState s{{0.5, 0.5, 0.5, 0.5}, {2, 3, 5}};  // b1 -> s2 -> s3 -> s1
  EXPECT_EQ(angular_velocity(body, s), (Vec3{2, 1.5, 2}));
  EXPECT_EQ(inertial_angular_velocity(body, s), (Vec3{2, 2, 1.5}));
  EXPECT_EQ(kinetic_energy(body, s), 0.5 * (4 + 4.5 + 10));
}

}  // namespace
