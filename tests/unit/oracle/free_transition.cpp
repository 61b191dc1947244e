// SPDX-License-Identifier: MIT
// The oracle of the state transition matrix judged by differences of the flow, by symplecticity,
// and by the cases that have a closed form.
#include "oracle/free_transition.hpp"

#include <gtest/gtest.h>

#include "budgets.hpp"
#include "oracle/direct_flow.hpp"
#include "worst.hpp"

namespace {

using namespace oracle;
using polhode::test::larger;
namespace budget = polhode::budget;

struct Motion {
  const char* name;
  polhode::Vec3 moments, g;
  double t;
};

const Motion motions[] = {{"long axis", {1.0, 2.0, 2.5}, {0.7, 0.5, 0.3}, 20.0},
                          {"short axis, backward", {2.5, 2.0, 1.0}, {1.3, 0.5, 0.4}, -12.0},
                          {"small polhode", {1.0, 2.0, 2.5}, {1e-8, 1e-9, 1.0}, 30.0},
                          {"spin about b3", {1.0, 2.0, 2.5}, {0.0, 0.0, 1.0}, 10.0},
                          {"spin about b2", {1.0, 2.0, 2.5}, {0.0, 1.0, 0.0}, 10.0},
                          {"near the separatrix", {3.0, 4.0, 6.0}, {0.3, 0.5, 0.3 + 3e-16}, 100.0},
                          {"separatrix", {3.0, 4.0, 6.0}, {0.3, 0.5, 0.3}, 50.0},
                          {"I1 = I2", {1.0, 1.0, 1.5}, {0.3, 0.5, 0.2}, 100.0},
                          {"I2 = I3", {1.0, 1.5, 1.5}, {0.3, 0.5, 0.2}, -40.0},
                          {"sphere", {2.0, 2.0, 2.0}, {0.3, 0.5, 0.2}, 20.0},
                          {"rest", {1.0, 2.0, 2.5}, {0.0, 0.0, 0.0}, 20.0}};

double largest(const WideMatrix6& m) {
  Wide result = 0;
  for (const auto& row : m.a)
    for (const Wide& x : row) result = larger(result, Wide(abs(x)));
  return static_cast<double>(result);
}

WideMatrix6 difference(const WideMatrix6& a, const WideMatrix6& b) {
  WideMatrix6 d;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) d(i, j) = a(i, j) - b(i, j);
  return d;
}

// {theta, theta} = 0, {theta, g} = 1, {g, g} = hat(g)
WideMatrix6 poisson_tensor(const WideVec3& g) {
  WideMatrix6 p;
  const auto hat = polhode::hat(g);
  for (int i = 0; i < 3; ++i) {
    p(i, 3 + i) = 1;
    p(3 + i, i) = -1;
    for (int j = 0; j < 3; ++j) p(3 + i, 3 + j) = hat(i, j);
  }
  return p;
}

WideState displaced(const WideState& s, int direction, const Wide& step) {
  WideState moved = s;
  if (direction >= 3) {
    moved.g[direction - 3] += step;
  } else {
    WideVec3 half;
    half[direction] = step / 2;
    moved.q = s.q * polhode::normalized(WideQuaternion{1, half.x, half.y, half.z});
  }
  return moved;
}

// Central differences of the direct integration.
WideMatrix6 by_differences(const FreeBody& body, const DirectFlow& flow, const Wide& t) {
  const Wide step("1e-25");
  WideMatrix6 phi;
  for (int j = 0; j < 6; ++j) {
    const WideState plus = flow.after(displaced(body.initial(), j, step), t);
    const WideState minus = flow.after(displaced(body.initial(), j, -step), t);
    const WideQuaternion d = conj(minus.q) * plus.q;
    const Wide column[] = {d.x / step,
                           d.y / step,
                           d.z / step,
                           (plus.g.x - minus.g.x) / (2 * step),
                           (plus.g.y - minus.g.y) / (2 * step),
                           (plus.g.z - minus.g.z) / (2 * step)};
    for (int i = 0; i < 6; ++i) phi(i, j) = column[i];
  }
  return phi;
}

TEST(OracleFreeTransition, AgreesWithDifferencesOfTheFlow) {
  for (const Motion& m : motions) {
    SCOPED_TRACE(m.name);
    FreeBody body(m.moments, {0.5, 0.5, -0.125, 0.75}, m.g);
    const WideMatrix6 phi = FreeTransition(body).at(m.t);
    const WideMatrix6 differences = by_differences(body, DirectFlow(m.moments), m.t);
    EXPECT_LE(largest(difference(phi, differences)), budget::oracle_differences * largest(phi));
  }
}

TEST(OracleFreeTransition, KeepsThePoissonTensor) {
  for (const Motion& m : motions) {
    SCOPED_TRACE(m.name);
    FreeBody body(m.moments, {0.5, 0.5, -0.125, 0.75}, m.g);
    const WideMatrix6 phi = FreeTransition(body).at(m.t);
    const WideMatrix6 mapped = phi * poisson_tensor(body.initial().g) * polhode::transpose(phi);
    const WideMatrix6 there = poisson_tensor(body.at(m.t, 0.0).g);
    EXPECT_LE(largest(difference(mapped, there)),
              budget::oracle_agreement * largest(phi) * largest(phi));
  }
}

// At rest dtheta = I^-1 dg t.
TEST(OracleFreeTransition, DriftsAtRest) {
  FreeBody body({1.0, 2.0, 4.0}, {0.5, 0.5, -0.125, 0.75}, {0.0, 0.0, 0.0});
  WideMatrix6 drift = WideMatrix6::identity();
  drift(0, 3) = 16.0;
  drift(1, 4) = 8.0;
  drift(2, 5) = 4.0;
  EXPECT_LE(largest(difference(FreeTransition(body).at(16.0), drift)), budget::oracle_agreement);
}

}  // namespace
