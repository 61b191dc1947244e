// SPDX-License-Identifier: MIT
#include "polhode/perturb/torque_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "budgets.hpp"
#include "message_of.hpp"
#include "polhode/perturb/any_perturbation.hpp"
#include "unit/perturb/support.hpp"

namespace perturb_test {
namespace {

using namespace polhode;
using Between = TorqueTable::Between;
using Outside = TorqueTable::Outside;
using Real = long double;

const std::vector<TorqueRow> rows = {{1.0, {1.0, 0.0, 2.0}},
                                     {2.0, {3.0, 0.0, 2.0}},
                                     {4.0, {7.0, -8.0, 2.0}},
                                     {5.0, {6.0, -8.0, 2.0}}};

Vec3 value(const TorqueTable& table, double t) {
  const Case c = drawn_case(1101, 0);
  return table.effect(Setting{c.body, t, c.s, c.q_IS}).u;
}

TEST(TorqueTable, StepHoldsTheRowBefore) {
  const TorqueTable table(rows, {Between::step, Outside::zero, {}});
  EXPECT_EQ(value(table, 1.0), rows[0].torque);
  EXPECT_EQ(value(table, 1.999), rows[0].torque);
  EXPECT_EQ(value(table, 2.0), rows[1].torque);
  EXPECT_EQ(value(table, 5.0), rows[3].torque);
  EXPECT_EQ(value(table, 5.001), Vec3{});
  EXPECT_EQ(value(table, 0.999), Vec3{});
  EXPECT_EQ(value(TorqueTable(rows, {Between::step, Outside::hold, {}}), -7.0), rows[0].torque);
  EXPECT_EQ(value(TorqueTable(rows, {Between::step, Outside::hold, {}}), 70.0), rows[3].torque);
}

// A row alone: of that moment, or of all times.
TEST(TorqueTable, OneRowOfAStep) {
  const std::vector<TorqueRow> one = {{1.0, {0.0, 0.0, 3.0}}};
  const TorqueTable moment(one, {Between::step, Outside::zero, {}});
  EXPECT_EQ(value(moment, 1.0), one[0].torque);
  EXPECT_EQ(value(moment, 1.001), Vec3{});
  const TorqueTable always(one, {Between::step, Outside::hold, {}});
  for (const double t : {-9.0, 1.0, 9.0}) EXPECT_EQ(value(always, t), one[0].torque);
}

TEST(TorqueTable, LinearIsTheStraightLine) {
  const TorqueTable table(rows, {Between::linear, Outside::zero, {}});
  EXPECT_EQ(value(table, 1.25), (Vec3{1.5, 0.0, 2.0}));
  EXPECT_EQ(value(table, 3.0), (Vec3{5.0, -4.0, 2.0}));
  EXPECT_EQ(value(table, 5.0), rows[3].torque);
}

// Slopes of Fritsch and Butland by hand: at t = 2, h = 1 and 2, d = 2 and 2: 2; at t = 4 the first
// component turns: 0. Of the second: at t = 2 one side is flat: 0. In the middle of [2, 4] a cubic
// has the mean of its ends plus h (m0 - m1) / 8.
TEST(TorqueTable, CubicKeepsTheShape) {
  const TorqueTable table(rows, {Between::cubic, Outside::zero, {}});
  for (const TorqueRow& row : rows)
    EXPECT_LE(norm(value(table, row.t) - row.torque), budget::perturb_eps * eps * 8.0);
  const Vec3 middle = value(table, 3.0);
  EXPECT_NEAR(middle.x, 5.0 + 2.0 * (2.0 - 0.0) / 8.0, budget::perturb_eps * eps * 8.0);
  EXPECT_NEAR(middle.y, -4.0, budget::perturb_eps * eps * 8.0);
  EXPECT_EQ(middle.z, 2.0);
  for (double t = 2.0; t < 3.985; t += 0.01) {
    EXPECT_GE(value(table, t + 0.01).x, value(table, t).x);
    EXPECT_LE(value(table, t + 0.01).y, value(table, t).y);
  }
}

TEST(TorqueTable, EveryNumberType) {
  const TorqueTable table(rows, {Between::cubic, Outside::zero, SpaceAxes::inertial});
  const Case c = drawn_case(1102, 0);
  Case in_table = c;
  in_table.t = 2.7;
  const Effect plain = table.effect(in_table.on<double>());
  const BasicEffect<DoubleDouble> wider = table.effect(in_table.on<DoubleDouble>());
  EXPECT_LE(largest(wide(plain.u) - wide(wider.u)), budget::perturb_eps * eps * 8.0);
  const BasicEffect<Tangent> e = table.effect(in_table.on<Tangent>());
  EXPECT_EQ(e.u.x.value, plain.u.x);
  const TorqueTable in_body(rows, {Between::cubic, Outside::zero, {}});
  const WideQuaternion q = normalized(c.on<Wide>().q_IS) * normalized(c.on<Wide>().s.q);
  EXPECT_LE(largest(rotate(q, wide(plain.u)) - wide(in_body.effect(in_table.on<double>()).u)),
            budget::perturb_eps * eps * 16.0);
}

TEST(TorqueTable, BreaksWhereItIsNotSmooth) {
  const std::vector<TorqueRow> pulse = {{0.0, {}},  {10.0, {}}, {20.0, {1.0, 0.0, 0.0}},
                                        {21.0, {}}, {30.0, {}}, {40.0, {}}};
  EXPECT_EQ(TorqueTable(pulse, {Between::step, Outside::zero, {}}).breakpoints(),
            (std::vector<double>{20.0, 21.0, 40.0}));
  EXPECT_EQ(TorqueTable(pulse, {Between::linear, Outside::zero, {}}).breakpoints(),
            (std::vector<double>{0.0, 10.0, 20.0, 21.0, 40.0}));
  const AnyPerturbation term("wheel", TorqueTable(pulse, {}));
  EXPECT_EQ(term.breakpoints().size(), 5U);
}

TEST(TorqueTable, RefusesRowsOutOfOrderAndTimesOutside) {
  EXPECT_MESSAGE(TorqueTable({}, {}), "TorqueTable: rows must not be empty");
  EXPECT_MESSAGE(TorqueTable({{1.0, {}}, {1.0, {}}}, {}),
                 "TorqueTable: time 1 of row 2 must be later than 1 of the row before");
  EXPECT_MESSAGE(TorqueTable({{1.0, {0.0, HUGE_VAL, 0.0}}}, {}),
                 "TorqueTable: row 1 (1, 0, inf, 0) must be finite");
  const TorqueTable strict(rows, {Between::step, Outside::refuse, {}});
  EXPECT_EQ(value(strict, 5.0), rows[3].torque);
  EXPECT_MESSAGE(value(strict, 5.5),
                 "TorqueTable: time 5.5 is after the last row, 5: give rows for all of the run, or "
                 "outside = zero or hold");
}

// The cubic of a TorqueTable between its rows, everywhere, against Hermite's basis on slopes that
// are formed another way: Brodlie's mean inside, the parabola of three rows at the ends.

// Rising in x, falling in y, with bends that the rule for ends leaves alone.
const std::vector<TorqueRow> bent = {{-1.0, {0.0, 9.0, 1.0}},
                                     {0.5, {1.0, 5.0, 1.75}},
                                     {1.25, {2.0, 4.0, 2.25}},
                                     {4.0, {3.5, 1.0, 5.0}},
                                     {4.5, {4.25, 0.75, 5.75}}};

Real quotient(std::size_t k, int i) {
  return (Real(bent[k + 1].torque[i]) - bent[k].torque[i]) / (Real(bent[k + 1].t) - bent[k].t);
}

// Fritsch & Butland (1984): d0 d1 / (a d1 + (1 - a) d0), a = (1 + h1 / (h0 + h1)) / 3.
Real inner_slope(std::size_t k, int i) {
  const Real h0 = Real(bent[k].t) - bent[k - 1].t, h1 = Real(bent[k + 1].t) - bent[k].t;
  const Real a = (1 + h1 / (h0 + h1)) / 3, d0 = quotient(k - 1, i), d1 = quotient(k, i);
  return d0 * d1 / (a * d1 + (1 - a) * d0);
}

// Of Newton's parabola through three rows, at row `at`, the first or the last of them.
Real end_slope(std::size_t first, std::size_t at, int i) {
  const Real bend =
      (quotient(first + 1, i) - quotient(first, i)) / (Real(bent[first + 2].t) - bent[first].t);
  const Real t = bent[at].t;
  return quotient(first, i) + bend * ((t - bent[first].t) + (t - bent[first + 1].t));
}

Real slope(std::size_t k, int i) {
  if (k == 0) return end_slope(0, 0, i);
  if (k + 1 == bent.size()) return end_slope(k - 2, k, i);
  return inner_slope(k, i);
}

Real hermite(std::size_t k, Real x, int i) {
  const Real h = Real(bent[k + 1].t) - bent[k].t, y = 1 - x;
  return y * y * (1 + 2 * x) * bent[k].torque[i] + x * x * (1 + 2 * y) * bent[k + 1].torque[i] +
         h * x * y * (y * slope(k, i) - x * slope(k + 1, i));
}

TEST(TorqueTable, CubicIsHermitesBetweenAllRows) {
  const TorqueTable table(bent, {TorqueTable::Between::cubic, TorqueTable::Outside::refuse, {}});
  const Case c = drawn_case(1103, 0);
  for (std::size_t k = 0; k + 1 < bent.size(); ++k) {
    for (const double x : {0.0625, 0.25, 0.5, 0.8125, 0.9375}) {
      const double h = bent[k + 1].t - bent[k].t;
      const Vec3 u = table.effect(Setting{c.body, bent[k].t + x * h, c.s, c.q_IS}).u;
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(u[i], static_cast<double>(hermite(k, x, i)), budget::cubic_table_eps * eps)
            << "row " << k << " at " << x << ", component " << i;
    }
  }
}

}  // namespace
}  // namespace perturb_test
