// SPDX-License-Identifier: MIT
// The state transition matrix of FreeRotation over up to ten turns, against 76-digit variational
// equations, in every regime: J = 0, the separatrix, axisymmetric bodies and the sphere included.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "budgets.hpp"
#include "oracle/free_cases.hpp"
#include "oracle/free_transition.hpp"
#include "polhode/free/free_rotation.hpp"
#include "worst.hpp"

namespace {

using polhode::test::Worst;

namespace budget = polhode::budget;
using namespace oracle;

constexpr std::uint64_t seed = 1923;  // the year of Andoyer's book

// The largest over the four 3x3 blocks of |block - exact| / |exact|, Frobenius norms; the block of
// d(g)/d(theta), which is 0, counts relative to G. Infinite for what is not finite.
double relative_error(const polhode::Matrix6& m, const WideMatrix6& exact, double G) {
  Worst worst;
  for (int block = 0; block < 4; ++block) {
    const int row = 3 * (block / 2), column = 3 * (block % 2);
    Wide error = 0, size = row == 3 && column == 0 ? Wide(G) * G : Wide(0);
    for (int i = row; i < row + 3; ++i) {
      for (int j = column; j < column + 3; ++j) {
        if (!std::isfinite(m(i, j))) return std::numeric_limits<double>::infinity();
        const Wide d = Wide(m(i, j)) - exact(i, j);
        error += d * d;
        size += exact(i, j) * exact(i, j);
      }
    }
    worst.add(error == 0 ? 0.0 : static_cast<double>(Wide(sqrt(error / size))));
  }
  return worst.value();
}

double transition_error(const FreeCase& c) {
  FreeBody body(c.moments, c.start.q, c.start.g);
  const polhode::FreeRotation rotation(polhode::Body(c.moments.x, c.moments.y, c.moments.z),
                                       c.start, c.t0);
  const auto exact = FreeTransition(body).at(Wide(c.t) - Wide(c.t0));
  return relative_error(rotation.state_transition(c.t), exact,
                        static_cast<double>(body.momentum()));
}

void expect_transitions(const std::vector<FreeCase>& cases) {
  std::vector<double> errors;
  Worst worst;
  for (const FreeCase& c : cases) {
    const double error = transition_error(c);
    errors.push_back(error);
    worst.add(error, description(c));
  }
  std::sort(errors.begin(), errors.end());
  std::array<char, 32> text{};
  testing::Test::RecordProperty("cases", std::to_string(errors.size()));
  std::snprintf(text.data(), text.size(), "%.2g", errors[errors.size() / 2]);
  testing::Test::RecordProperty("transition_median", text.data());
  std::snprintf(text.data(), text.size(), "%.2g", worst.value());
  testing::Test::RecordProperty("transition_max", text.data());
  EXPECT_LE(worst.value(), budget::free_transition) << worst.where();
}

bool is_full() { return std::getenv("POLHODE_TEST_FULL") != nullptr; }

// Drawn like the accuracy sets, over -10 .. 10 turns.
std::vector<FreeCase> drawn_cases(CaseMaker maker, std::uint64_t stream, std::size_t sample,
                                  std::size_t full) {
  const std::size_t count = is_full() ? full : sample;
  std::vector<FreeCase> cases;
  for (std::size_t i = 0; i < count; ++i) {
    Draw draw(seed + (stream << 32U), i);
    FreeCase c = maker(draw);
    set_time(c, draw.uniform(-10.0, 10.0));
    cases.push_back(c);
  }
  return cases;
}

// Next to the middle axis at times up to four half periods: the growth exp(nt) of one passage is
// taken away by the next.
std::vector<FreeCase> flipping_cases() {
  const auto across_by = [](double across, double share, const std::vector<double>& half_periods) {
    std::vector<FreeCase> cases;
    FreeCase c{
        {1.0, 1.7, 2.1}, {{0.5, 0.5, -0.125, 0.75}, {across, 1.0, share * across}}, 0.0, 0.0};
    const double period =
        polhode::FreeRotation(polhode::Body(1.0, 1.7, 2.1), c.start).polhode_period();
    for (const double n : half_periods) {
      c.t = 0.5 * n * period;
      cases.push_back(c);
    }
    return cases;
  };
  std::vector<FreeCase> cases = across_by(1e-6, 2.0, {-1.0, 0.8, 2.9});
  // with as many digits as the oracle has left of such growth
  const std::vector<double> few{1.0}, all{0.5, 1.0, 2.9};
  for (const FreeCase& c : across_by(1e-15, 0.3, is_full() ? all : few)) cases.push_back(c);
  for (const FreeCase& c : across_by(1e-24, 0.3, {0.5, 0.55})) cases.push_back(c);
  // 4e-21 from the separatrix by the last bits of the moments
  FreeCase near{{0.32200176517297396, 0.3789751609709488, 0.661517593383879},
                {{1, 0, 0, 0}, {0.8233251531952871, -0.3, 0.5299161674818204}},
                0.0,
                0.0};
  for (const double turns : {5.0, is_full() ? 40.0 : 10.0}) {
    set_time(near, turns);
    cases.push_back(near);
  }
  return cases;
}

// The states where derivatives of the coordinates do not exist, ten turns either way.
std::vector<FreeCase> degenerate_cases() {
  struct Start {
    polhode::Vec3 moments, g;
  };
  const double next = std::nextafter(0.3, 1.0);
  const Start starts[] = {
      {{1.0, 2.0, 2.5}, {0.0, 0.0, 1.0}},    {{1.0, 2.0, 2.5}, {0.0, 0.0, -1.0}},
      {{1.0, 2.0, 2.5}, {1.0, 0.0, 0.0}},    {{1.0, 2.0, 2.5}, {0.0, 1.0, 0.0}},
      {{2.5, 1.0, 2.0}, {0.0, 0.0, 1.0}},    {{1.0, 2.0, 2.5}, {1e-150, 1e-160, 1.0}},
      {{1.0, 2.0, 2.5}, {1e-8, 1e-9, -1.0}}, {{3.0, 4.0, 6.0}, {0.3, 0.5, 0.3}},
      {{3.0, 4.0, 6.0}, {0.3, -0.5, 0.3}},   {{6.0, 3.0, 4.0}, {0.3, 0.3, -0.1}},
      {{3.0, 4.0, 6.0}, {next, 0.5, 0.3}},   {{3.0, 4.0, 6.0}, {0.3, 0.5, next}},
      {{1.0, 1.0, 1.5}, {0.3, 0.5, 0.2}},    {{1.0, 1.0, 1.5}, {0.0, 0.0, 0.7}},
      {{1.0, 1.0, 1.5}, {0.3, 0.5, 0.0}},    {{1.0, 1.5, 1.5}, {0.3, 0.5, 0.2}},
      {{1.0, 1.5, 1.5}, {0.0, 0.5, 0.2}},    {{1.0, 1.5, 1.5}, {0.7, 0.0, 0.0}},
      {{2.0, 2.0, 2.0}, {0.3, 0.5, 0.2}},    {{2.0, 2.0, 2.0}, {0.0, 0.0, 0.2}},
      {{1.0, 2.0, 2.5}, {0.0, 0.0, 0.0}},    {{2.0, 2.0, 2.0}, {0.0, 0.0, 0.0}}};
  std::vector<FreeCase> cases;
  for (const Start& s : starts) {
    FreeCase c{s.moments, {{0.5, 0.5, -0.125, 0.75}, s.g}, 0.0, 0.0};
    const bool rest = s.g == polhode::Vec3{};
    for (const double turns : {-10.0, 0.0, 3.7, 10.0}) {
      if (rest)
        c.t = turns;
      else
        set_time(c, turns);
      cases.push_back(c);
    }
  }
  return cases;
}

TEST(FreeTransition, RandomBodies) { expect_transitions(drawn_cases(random_case, 1, 40, 300)); }

TEST(FreeTransition, NearPrincipalAxes) {
  expect_transitions(drawn_cases(near_axis_case, 2, 20, 200));
}

TEST(FreeTransition, NearlyEqualMoments) {
  expect_transitions(drawn_cases(nearly_equal_case, 3, 40, 300));
}

TEST(FreeTransition, NearTheSeparatrix) {
  expect_transitions(drawn_cases(near_separatrix_case, 4, 20, 200));
}

TEST(FreeTransition, OnTheSeparatrix) {
  expect_transitions(drawn_cases(exact_separatrix_case, 5, 20, 100));
}

TEST(FreeTransition, FromFlipToFlip) { expect_transitions(flipping_cases()); }

// Where no digit is left the matrix says so: either its momenta keep |g|, and it is right, or NaN.
TEST(FreeTransition, IsRightOrNotANumber) {
  const polhode::Body body(1.0, 1.7, 2.1);
  int judged = 0;
  const std::vector<double> sample{1e-30, 1e-60, 1e-170}, all{1e-30, 1e-45, 1e-60, 1e-100, 1e-170};
  for (const double across : is_full() ? all : sample) {
    const polhode::FreeRotation motion(body, {{1, 0, 0, 0}, {across, 1.0, 0.7 * across}});
    for (const double n : {0.2, 0.5, 0.9, 1.0, 1.3, 2.0, 7.5}) {
      const double t = 0.5 * n * motion.polhode_period();
      const polhode::Matrix6 m = motion.state_transition(t);
      if (std::isnan(m(0, 3))) continue;
      ++judged;
      FreeBody exact({1.0, 1.7, 2.1}, {1, 0, 0, 0}, {across, 1.0, 0.7 * across});
      const auto g = exact.at(Wide(t)).g;
      for (int j = 3; j < 6; ++j) {
        Wide kept = 0, largest = 0;
        for (int i = 0; i < 3; ++i) {
          kept += g[i] * m(3 + i, j);
          largest = largest < abs(g[i] * m(3 + i, j)) ? Wide(abs(g[i] * m(3 + i, j))) : largest;
        }
        const double miss = static_cast<double>(Wide(abs(kept - motion.initial_state().g[j - 3])));
        EXPECT_LE(miss, budget::free_transition * (1.0 + static_cast<double>(largest)))
            << across << " " << n;
      }
    }
  }
  EXPECT_GE(judged, is_full() ? 27 : 15);
}

TEST(FreeTransition, Degenerate) { expect_transitions(degenerate_cases()); }

}  // namespace
