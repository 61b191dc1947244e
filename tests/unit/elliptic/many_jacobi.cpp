// SPDX-License-Identifier: MIT
// Jacobi's functions in lanes: beside 50 digits, the same bits whatever the lane, the neighbours,
// the number of arguments and the set of instructions, and what does not go in lanes.
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "polhode/elliptic/jacobi.hpp"
#include "polhode/error.hpp"
#include "unit/elliptic/support.hpp"

namespace polhode::test {
namespace {

struct Arguments {
  std::vector<double> u, m, m1;

  void add(double at, double parameter, double complement) {
    u.push_back(at);
    m.push_back(parameter);
    m1.push_back(complement);
  }
};

struct Columns {
  std::vector<double> sn, cn, dn;

  explicit Columns(std::size_t n) : sn(n), cn(n), dn(n) {}
  elliptic::JacobiSpans spans() { return {sn, cn, dn}; }
};

Columns in_lanes(const Arguments& at, InstructionSet set = widest_instruction_set()) {
  Columns results(at.u.size());
  elliptic::jacobi(at.u, at.m, at.m1, results.spans(), set);
  return results;
}

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(std::isnan(x) ? std::numeric_limits<double>::quiet_NaN() : x);
}
void expect_same(const Columns& a, std::size_t i, const Columns& b, std::size_t j) {
  EXPECT_EQ(bits(a.sn[i]), bits(b.sn[j])) << i << " " << j;
  EXPECT_EQ(bits(a.cn[i]), bits(b.cn[j])) << i << " " << j;
  EXPECT_EQ(bits(a.dn[i]), bits(b.dn[j])) << i << " " << j;
}

class ManyJacobi : public ::testing::Test {
 protected:
  // Of the arguments that are exact in double.
  void sweep(Near where, int count, double reach, std::uint64_t seed) {
    oracle::Draw draw(seed, 0);
    for (int i = 0; i < count; ++i) {
      const ExactModulus mod = drawn_modulus<double>(draw, where);
      const double k = elliptic::complete_k(elliptic::to_double(mod));
      add(short_number(k * draw.uniform(-reach, reach)), mod);
    }
  }
  void add(double u, const ExactModulus& mod) {
    const elliptic::Modulus used = as<double>(mod);
    arguments_.add(u, used.m(), used.m1());
    moduli_.push_back(mod);
  }
  void TearDown() override {
    const Columns got = in_lanes(arguments_);
    WorstUnits<double> worst;
    for (std::size_t i = 0; i < moduli_.size(); ++i) {
      const double u = arguments_.u[i], a = std::abs(u), m = arguments_.m[i];
      const ExactJacobi exact = exact_jacobi(u, moduli_[i]);
      const double s = std::abs(exact.sn.a), c = std::abs(exact.cn.a), d = exact.dn.a;
      const std::string at = listed(u, m, arguments_.m1[i]);
      worst.add(absolute_error(got.sn[i], exact.sn) / (s + a * c * d), "sn " + at);
      worst.add(absolute_error(got.cn[i], exact.cn) / (c + a * s * d), "cn " + at);
      worst.add(absolute_error(got.dn[i], exact.dn) / (d + a * m * s * c), "dn " + at);
    }
    worst.expect_within(budget::elliptic_jacobi_lanes);
  }

 private:
  Arguments arguments_;
  std::vector<ExactModulus> moduli_;
};

TEST_F(ManyJacobi, Generic) { sweep(Near::generic, 800, 2.0, 91); }
TEST_F(ManyJacobi, NearOne) { sweep(Near::one, 40, 2.0, 92); }
TEST_F(ManyJacobi, NearZero) { sweep(Near::zero, 100, 2.0, 93); }
TEST_F(ManyJacobi, ManyPeriods) { sweep(Near::generic, 200, 1e5, 94); }
TEST_F(ManyJacobi, ManyPeriodsNearOne) { sweep(Near::one, 20, 1e3, 95); }
TEST_F(ManyJacobi, SmallArgument) {
  oracle::Draw draw(96, 0);
  for (int i = 0; i < 60; ++i) {
    add(drawn_power(draw, -120, 0), drawn_modulus<double>(draw, Near::generic));
    add(drawn_power(draw, -30, 0), drawn_modulus<double>(draw, Near::one));
  }
}

// Of every kind: on both sides of the border, beyond 0 and 1, NaN, and far away.
Arguments of_all_kinds(std::size_t count) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), far = 3e7;
  oracle::Draw draw(97, 0);
  Arguments all;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = draw.uniform(-8.0, 8.0), kind = draw.uniform(0.0, 1.0);
    if (kind < 0.4) {
      const double m = draw.uniform(0.0, 0.999);
      all.add(u, m, 1.0 - m);
    } else if (kind < 0.8) {
      const double m1 = draw.power_of_ten(-200.0, 0.0);
      all.add(u, 1.0 - m1, m1);
    } else {
      const Arguments odd{{u, u, u, far, nan, u, u, 0.0, -0.0, HUGE_VAL, 1e-320, u},
                          {-2.5, 1.75, 1.0, 0.5, 0.5, nan, 1.0, 0.5, 0.5, 0.5, 0.5, 1.0},
                          {3.5, -0.75, 0.0, 0.5, 0.5, 0.5, nan, 0.5, 0.5, 0.5, 0.5, 1e-300}};
      const std::size_t j = i % odd.u.size();
      all.add(odd.u[j], odd.m[j], odd.m1[j]);
    }
  }
  return all;
}

// Next to the quarter periods, where rounding carried some beyond 1 and arccos to NaN.
TEST(ManyJacobiBits, NoSineOrCosineExceedsOne) {
  oracle::Draw draw(98, 0);
  Arguments all;
  for (int i = 0; i < 20000; ++i) {
    const double m1 = i % 3 == 0   ? draw.power_of_ten(-300.0, 0.0)
                      : i % 3 == 1 ? draw.uniform(0.0, 1.0)
                                   : 1.0 + draw.power_of_ten(-8.0, 8.0);
    const double m = 1.0 - m1, k = elliptic::complete_k(elliptic::Modulus::from_any_pair(m, m1));
    const double near = i % 2 == 0 ? draw.power_of_ten(-18.0, -6.0) : 0.0;
    all.add(k * (static_cast<double>(i % 7) - 3.0) + near, m, m1);
  }
  const Columns got = in_lanes(all);
  for (std::size_t i = 0; i < all.u.size(); ++i) {
    const auto one =
        elliptic::jacobi(all.u[i], elliptic::Modulus::from_any_pair(all.m[i], all.m1[i]));
    for (const double x : {got.sn[i], got.cn[i], one.sn, one.cn})
      ASSERT_LE(std::fabs(x), 1.0) << listed(all.u[i], all.m[i], all.m1[i]);
  }
}

TEST(ManyJacobiBits, SetsOfInstructions) {
  const Arguments all = of_all_kinds(3001);
  const Columns want = in_lanes(all, InstructionSet::baseline);
  for (const InstructionSet set : supported_instruction_sets()) {
    const Columns got = in_lanes(all, set);
    for (std::size_t i = 0; i < all.u.size(); ++i) expect_same(got, i, want, i);
  }
}

TEST(ManyJacobiBits, AloneAndAmongOthers) {
  const Arguments all = of_all_kinds(700);
  const Columns want = in_lanes(all);
  for (std::size_t begin = 0; begin < all.u.size(); begin += 1 + begin % 37) {
    const std::size_t count = 1 + begin % (all.u.size() - begin);
    const auto part = [&](const std::vector<double>& x) {
      return std::vector<double>(x.begin() + static_cast<std::ptrdiff_t>(begin),
                                 x.begin() + static_cast<std::ptrdiff_t>(begin + count));
    };
    const Columns got = in_lanes({part(all.u), part(all.m), part(all.m1)});
    for (std::size_t i = 0; i < count; ++i) expect_same(got, i, want, begin + i);
  }
}

TEST(ManyJacobiBits, OneModulus) {
  const Arguments all = of_all_kinds(300);
  for (const double m1 : {1.0, 0.75, 0.1400001, 0.13, 2e-9, 1e-250, 0.0, 2.5, -0.5}) {
    const elliptic::Modulus mod = elliptic::Modulus::from_any_pair(1.0 - m1, m1);
    const std::size_t n = all.u.size();
    Columns one(n);
    elliptic::jacobi(all.u, mod, one.spans());
    const Columns each =
        in_lanes({all.u, std::vector<double>(n, mod.m()), std::vector<double>(n, mod.m1())});
    for (std::size_t i = 0; i < n; ++i) expect_same(one, i, each, i);
  }
}

TEST(ManyJacobiBits, ResultsOverArguments) {
  Arguments all = of_all_kinds(333);
  const Columns want = in_lanes(all);
  elliptic::jacobi(all.u, all.m, all.m1, elliptic::JacobiSpans{all.u, all.m, all.m1});
  Columns got(all.u.size());
  got.sn = all.u;
  got.cn = all.m;
  got.dn = all.m1;
  for (std::size_t i = 0; i < all.u.size(); ++i) expect_same(got, i, want, i);
}

TEST(ManyJacobiDomain, OneByOne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Arguments odd{{0.7, 0.7, 0.7, 1e7, 0.7, 0.7, 0.7},
                      {-2.5, 1.75, 1.0, 0.5, 1.0, 1.0, 1e300},
                      {3.5, -0.75, 0.0, 0.5, 1e-200, 5e-324, -1e300}};
  const Columns got = in_lanes(odd);
  for (std::size_t i = 0; i < odd.u.size(); ++i) {
    const elliptic::Jacobi<double> want =
        elliptic::jacobi(odd.u[i], elliptic::Modulus::from_any_pair(odd.m[i], odd.m1[i]));
    EXPECT_EQ(got.sn[i], want.sn) << i;
    EXPECT_EQ(got.cn[i], want.cn) << i;
    EXPECT_EQ(got.dn[i], want.dn) << i;
  }
  const Arguments bad{{nan, 0.7, 0.7, HUGE_VAL, 0.7, 0.7, 0.7},
                      {0.5, nan, 0.5, 0.5, HUGE_VAL, 0.5, -HUGE_VAL},
                      {0.5, 0.5, nan, 0.5, -HUGE_VAL, 0.5, HUGE_VAL}};
  const Columns none = in_lanes(bad);
  for (std::size_t i = 0; i < bad.u.size(); ++i) {
    EXPECT_EQ(std::isnan(none.sn[i]), i != 5) << i;
    EXPECT_EQ(std::isnan(none.cn[i]), i != 5) << i;
    EXPECT_EQ(std::isnan(none.dn[i]), i != 5) << i;
  }
}

TEST(ManyJacobiDomain, Zeros) {
  const Columns got = in_lanes({{0.0, -0.0, 0.0}, {0.5, 0.5, 0.999}, {0.5, 0.5, 0.001}});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(got.sn[i], 0.0);
    EXPECT_NEAR(got.cn[i], 1.0, budget::elliptic_jacobi_lanes * epsilon<double>());
    EXPECT_NEAR(got.dn[i], 1.0, budget::elliptic_jacobi_lanes * epsilon<double>());
  }
  EXPECT_FALSE(std::signbit(got.sn[0]));
  EXPECT_TRUE(std::signbit(got.sn[1]));
}

TEST(ManyJacobiErrors, SpansAndPairs) {
  const std::vector<double> three(3, 0.5), two(2, 0.5), one(1, 0.5), quarter(3, 0.25);
  Columns results(3), few(2);
  EXPECT_NO_THROW(elliptic::jacobi(three, one, one, results.spans()));
  EXPECT_THROW(elliptic::jacobi(three, two, three, results.spans()), DomainError);
  EXPECT_THROW(elliptic::jacobi(three, three, one, results.spans()), DomainError);
  EXPECT_THROW(elliptic::jacobi(three, three, three, few.spans()), DomainError);
  EXPECT_THROW(elliptic::jacobi(three, three, quarter, results.spans()), DomainError);
  elliptic::jacobi({}, {}, {}, elliptic::JacobiSpans{});
}

}  // namespace
}  // namespace polhode::test
