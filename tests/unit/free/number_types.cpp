// SPDX-License-Identifier: MIT
// One kernel in other numbers: 32 digits of a state in double-double, and its derivatives by
// moments, momentum, epoch and time in dual numbers, against Taylor integration with 76 digits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "free/evaluate.hpp"
#include "free/prepare.hpp"
#include "oracle/free_accuracy.hpp"
#include "polhode/math/dual.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using namespace oracle;
using namespace polhode;
using polhode::test::Worst;

// --- DoubleDouble ---

Wide wide(const DoubleDouble& x) { return Wide(x.hi) + Wide(x.lo); }

double wide_error(const FreeCase& c) {
  const BasicFreeKernel<DoubleDouble> kernel =
      prepare<DoubleDouble>(Body(c.moments.x, c.moments.y, c.moments.z), c.start, c.t0);
  const BasicRotorState<DoubleDouble> s = evaluate(kernel, DoubleDouble(c.t));
  FreeBody body(c.moments, c.start.q, c.start.g);
  const WideState exact = body.at(c.t, c.t0);
  const WideQuaternion d =
      conj(exact.q) * WideQuaternion{wide(s.q.w), wide(s.q.x), wide(s.q.y), wide(s.q.z)};
  const WideVec3 dg = WideVec3{wide(s.g.x), wide(s.g.y), wide(s.g.z)} - exact.g;
  const Wide angle = 2 * sqrt(Wide(d.x * d.x + d.y * d.y + d.z * d.z));
  const Wide momentum = sqrt(dot(dg, dg)) / body.momentum();
  return larger(static_cast<double>(angle), static_cast<double>(momentum));
}

TEST(NumberTypes, DoubleDoubleHasItsDigits) {
  std::uint64_t stream = 0;
  for (const CaseMaker maker : {random_case, near_axis_case, near_separatrix_case,
                                exact_separatrix_case, nearly_equal_case}) {
    ++stream;
    Worst<> worst;
    for (std::size_t i = 0; i < 15; ++i) {
      Draw draw(91 + (stream << 32U), i);
      FreeCase c = maker(draw);
      set_time(c, draw.uniform(-3.0, 3.0));
      worst.add(wide_error(c), description(c));
    }
    EXPECT_LE(worst.value(), budget::free_double_double) << stream << ": " << worst.where();
  }
}

TEST(NumberTypes, DoubleDoubleKernelsRoundToTheState) {
  for (const NamedMotion& m : motions()) {
    const BasicFreeKernel<DoubleDouble> kernel = prepare<DoubleDouble>(m.body(), m.start());
    for (const double t : {0.0, 0.3, -12.5, 777.0}) {
      const BasicRotorState<DoubleDouble> s = evaluate(kernel, DoubleDouble(t));
      const RotorState rounded{{s.q.w.hi, s.q.x.hi, s.q.y.hi, s.q.z.hi},
                               {s.g.x.hi, s.g.y.hi, s.g.z.hi}};
      EXPECT_LE(difference(rounded, m.motion().at(t)), budget::free_state) << m.name << " " << t;
    }
  }
}

// --- Dual ---

constexpr int variables = 8;  // I1, I2, I3, g1, g2, g3, t0, t
using Dual8 = polhode::Dual<double, variables>;

struct Point {
  std::array<double, variables> x{};
  Quaternion q{0.6, -0.3, 0.7, 0.2};

  Vec3 moments() const { return {x[0], x[1], x[2]}; }
  RotorState start() const { return {q, {x[3], x[4], x[5]}}; }
};

BasicRotorState<Dual8> dual_state(const Point& p) {
  std::array<Dual8, variables> d;
  for (int j = 0; j < variables; ++j)
    d[static_cast<std::size_t>(j)] = Dual8::variable(p.x[static_cast<std::size_t>(j)], j);
  const BasicRotorState<Dual8> start{{p.q.w, p.q.x, p.q.y, p.q.z}, {d[3], d[4], d[5]}};
  return evaluate(prepare(BasicVec3<Dual8>{d[0], d[1], d[2]}, start, d[6]), d[7]);
}

// The change of attitude in body axes, and of momentum, by one variable.
struct Column {
  WideVec3 turn, momentum;
};

Column column_of(const BasicRotorState<Dual8>& s, std::size_t j) {
  const WideQuaternion q{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value};
  const WideQuaternion dq{s.q.w.derivative[j], s.q.x.derivative[j], s.q.y.derivative[j],
                          s.q.z.derivative[j]};
  const WideQuaternion half = conj(q) * dq;
  return {{2 * half.x, 2 * half.y, 2 * half.z},
          {s.g.x.derivative[j], s.g.y.derivative[j], s.g.z.derivative[j]}};
}

WideState exact_state(const Point& p) {
  FreeBody body(p.moments(), p.q, p.start().g);
  return body.at(p.x[7], p.x[6]);
}

// The central difference of two points h before and after; the attitude is that in between.
Column central(Point p, const WideState& at, std::size_t j, double h) {
  const double x = p.x[j];
  p.x[j] = x + h;
  const WideState after = exact_state(p);
  p.x[j] = x - h;
  const WideState before = exact_state(p);
  const Wide two_h = 2 * Wide(h);
  const WideQuaternion a = conj(at.q) * after.q, b = conj(at.q) * before.q;
  const Wide f = 2 / two_h;
  return {{f * (a.x - b.x), f * (a.y - b.y), f * (a.z - b.z)},
          {(after.g.x - before.g.x) / two_h, (after.g.y - before.g.y) / two_h,
           (after.g.z - before.g.z) / two_h}};
}

// Two differences make one whose error is of the fourth order.
Column extrapolated(const Point& p, const WideState& at, std::size_t j, double h) {
  const Column coarse = central(p, at, j, h), fine = central(p, at, j, 0.5 * h);
  const auto better = [](const WideVec3& c, const WideVec3& f) {
    const Wide third = Wide(1) / 3;
    return WideVec3{f.x + third * (f.x - c.x), f.y + third * (f.y - c.y),
                    f.z + third * (f.z - c.z)};
  };
  return {better(coarse.turn, fine.turn), better(coarse.momentum, fine.momentum)};
}

// A power of two that is small against every distance at which the motion changes its kind, and by
// which each variable changes exactly.
double step_of(const Point& p, std::size_t j, double closest) {
  return std::ldexp(1.0, std::ilogb(closest * std::abs(p.x[j])) - 20);
}

void expect_derivatives(const Point& p, double closest, const std::string& what,
                        double allowed = budget::free_dual) {
  const BasicRotorState<Dual8> s = dual_state(p);
  const Vec3 g = p.start().g;
  const double G = norm(g);
  const WideState at = exact_state(p);
  for (std::size_t j = 0; j < variables; ++j) {
    const Column exact = extrapolated(p, at, j, step_of(p, j, closest)), got = column_of(s, j);
    const WideVec3 turn = got.turn - exact.turn, momentum = got.momentum - exact.momentum;
    const double size = larger(static_cast<double>(norm(exact.turn)),
                               static_cast<double>(Wide(norm(exact.momentum) / G)));
    EXPECT_LE(static_cast<double>(norm(turn)), allowed * size) << what << ", by " << j;
    EXPECT_LE(static_cast<double>(Wide(norm(momentum) / G)), allowed * size)
        << what << ", by " << j;
  }
}

TEST(NumberTypes, DualsGiveDerivativesByMomentsStateAndTime) {
  for (std::size_t i = 0; i < 8; ++i) {
    Draw draw(92, i);
    const FreeCase c = long_time_case(draw);
    Point p;
    const Vec3& I = c.moments;
    const Vec3& g = c.start.g;
    const double t0 = draw.uniform(0.1, 1.0) * oracle::detail::turn_length(c);
    p.x = {I.x, I.y, I.z, g.x,
           g.y, g.z, t0,  t0 + draw.uniform(0.5, 2.0) * oracle::detail::turn_length(c)};
    expect_derivatives(p, 1e-3, description(c));
  }
}

TEST(NumberTypes, DualsGiveDerivativesNextToEveryEdge) {
  const double near = 0x1p-26;
  const Point next_to_spin{{3.0, 4.0, 6.0, near, -0.5 * near, 1.0, 0.25, 9.5}};
  const Point next_to_long_spin{{3.0, 4.0, 6.0, 1.0, -0.5 * near, near, 0.25, 9.5}};
  const Point next_to_oblate{{3.0, 3.0 + near, 5.0, 0.3, 0.2, 1.0, 0.25, 9.5}};
  const Point next_to_prolate{{2.0, 5.0, 5.0 + near, 1.0, 0.2, 0.3, 0.25, 9.5}};
  const Point above{{3.0, 4.0, 6.0, 1.0, 0.5, 1.0 + near, 0.25, 9.5}};
  const Point below{{3.0, 4.0, 6.0, 1.0 + near, 0.5, 1.0, 0.25, 9.5}};
  expect_derivatives(next_to_spin, near, "next to b3");
  expect_derivatives(next_to_long_spin, near, "next to b1");
  expect_derivatives(next_to_oblate, near, "next to an oblate body");
  expect_derivatives(next_to_prolate, near, "next to a prolate body");
  expect_derivatives(above, near, "above the separatrix", budget::free_dual_near_separatrix);
  expect_derivatives(below, near, "below the separatrix", budget::free_dual_near_separatrix);
}

// A momentum that lies in the plane of two axes: am = pi/2 and 0.
TEST(NumberTypes, DualsGiveDerivativesWhereAComponentIsZero) {
  Point p{{3.0, 4.0, 6.0, 0.0, 0.5, 1.0, 0.25, 9.5}};
  const auto by_momentum = [](const Point& at) { return column_of(dual_state(at), 3); };
  const Column exact = extrapolated(p, exact_state(p), 3, 0x1p-20), got = by_momentum(p);
  EXPECT_LE(static_cast<double>(norm(WideVec3(got.turn - exact.turn))),
            budget::free_dual * static_cast<double>(norm(exact.turn)));
  EXPECT_LE(static_cast<double>(norm(WideVec3(got.momentum - exact.momentum))),
            budget::free_dual * static_cast<double>(norm(exact.momentum)));
}

TEST(NumberTypes, DualsHaveTheValuesOfTheState) {
  for (const NamedMotion& m : motions()) {
    for (const double t : {0.0, 0.3, -12.5, 1e4}) {
      const Point p{{m.moments.x, m.moments.y, m.moments.z, m.g.x, m.g.y, m.g.z, 0.0, t},
                    m.start().q};
      const BasicRotorState<Dual8> s = dual_state(p);
      const RotorState values{{s.q.w.value, s.q.x.value, s.q.y.value, s.q.z.value},
                              {s.g.x.value, s.g.y.value, s.g.z.value}};
      EXPECT_LE(difference(values, m.motion().at(t)), budget::free_state) << m.name << " " << t;
    }
  }
}

// Where the form of the arc differs for neighbouring bodies or states there is no derivative by
// moments and momentum; by time there is: the angular velocity, and g x w.
TEST(NumberTypes, DualsSayWhereTheyHaveNoDerivative) {
  for (const NamedMotion& m : motions()) {
    const bool smooth = (m.regime == Regime::short_axis || m.regime == Regime::long_axis) &&
                        m.moments.x != m.moments.y && m.moments.y != m.moments.z;
    const Point p{{m.moments.x, m.moments.y, m.moments.z, m.g.x, m.g.y, m.g.z, 0.0, 1.5},
                  m.start().q};
    const BasicRotorState<Dual8> s = dual_state(p);
    for (std::size_t j = 0; j < 6; ++j) {
      EXPECT_EQ(std::isnan(s.q.w.derivative[j]), !smooth) << m.name << " " << j;
      EXPECT_EQ(std::isnan(s.g.x.derivative[j]), !smooth) << m.name << " " << j;
    }
    const Vec3 g{s.g.x.value, s.g.y.value, s.g.z.value};
    const Vec3 w{g.x / m.moments.x, g.y / m.moments.y, g.z / m.moments.z};
    const Vec3 torque = cross(g, w);
    const Column by_time = column_of(s, 7);
    const WideVec3 turn = by_time.turn - WideVec3{w.x, w.y, w.z};
    const WideVec3 momentum = by_time.momentum - WideVec3{torque.x, torque.y, torque.z};
    EXPECT_LE(static_cast<double>(norm(turn)), budget::free_dual * norm(w)) << m.name;
    EXPECT_LE(static_cast<double>(norm(momentum)), budget::free_dual * norm(g) * norm(w)) << m.name;
  }
}

}  // namespace
