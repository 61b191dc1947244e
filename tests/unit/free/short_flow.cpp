// SPDX-License-Identifier: MIT
// The flow inside splittings where its numbers leave the range of a double: the result is NaN, and
// nothing is thrown.
#include "free/short_flow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using polhode::detail::FlowTangent;
using polhode::detail::ShortFlow;

constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_not_numbers(const Vec3& v, const std::string& what) {
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isnan(v[i])) << what << ", component " << i;
}

struct Beyond {
  std::string name;
  Vec3 moments;
  Vec3 g;
  double time;
};

// Arcs of less than a quarter of a period, and of many.
std::vector<Beyond> beyond_the_range() {
  const Vec3 usual{3.0, 4.0, 6.0};
  std::vector<Beyond> all = {
      {"|g|^2 overflows", usual, {1e160, 2e160, 3e160}, 1e-161},
      {"|g|^2 overflows over a long arc", usual, {1e160, 2e160, 3e160}, 1.0},
      {"the rates overflow", {3e-200, 4e-200, 6e-200}, {1.0, 2.0, 3.0}, 1.0},
      {"the difference of the rates overflows", {1e-150, 4e-150, 4.5e-150}, {1e8, 1e8, 1e8}, 1.0},
      {"an infinite time", usual, {1.0, 2.0, 3.0}, infinity},
      {"an infinite time backwards", usual, {1.0, 2.0, 3.0}, -infinity},
      {"no time", usual, {1.0, 2.0, 3.0}, not_a_number},
  };
  for (int i = 0; i < 3; ++i)
    for (const double bad : {not_a_number, infinity, -infinity}) {
      Vec3 g{1.0, 2.0, 3.0};
      g[i] = bad;
      for (const double time : {1e-3, 100.0})
        all.push_back({"g" + std::to_string(i + 1) + " is no number", usual, g, time});
    }
  return all;
}

TEST(ShortFlow, BeyondTheRangeOfADoubleIsNaN) {
  for (const Beyond& b : beyond_the_range()) {
    const ShortFlow flow(Body(b.moments.x, b.moments.y, b.moments.z));
    const ShortFlow::Arc arc = flow.after({b.g, {}}, b.time);
    expect_not_numbers(arc.g.hi, b.name);
    EXPECT_TRUE(std::isnan(arc.turn.w)) << b.name;
    const ShortFlow::PlainArc plain = flow.plain(b.g, b.time);
    expect_not_numbers(plain.g, b.name + ", plain");
    EXPECT_TRUE(std::isnan(plain.turn.w)) << b.name << ", plain";
    const FlowTangent<double> t = flow.tangent(b.g, {1.0, 1.0, 1.0}, b.time, arc.turn);
    expect_not_numbers(t.momentum, b.name + ", tangent");
    expect_not_numbers(t.attitude, b.name + ", tangent");
  }
}

}  // namespace
