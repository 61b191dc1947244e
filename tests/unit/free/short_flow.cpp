// SPDX-License-Identifier: MIT
// The flow inside splittings where its numbers leave the range of a double: the result is NaN, and
// nothing is thrown.
#include "free/short_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "lanes.hpp"
#include "oracle/free_edge_cases.hpp"
#include "unit/free/support.hpp"

namespace {

using namespace free_test;
using polhode::BasicVec3;
using polhode::detail::BasicShortFlow;
using polhode::detail::BasicTwoPartMomentum;
using polhode::detail::FlowTangent;
using polhode::detail::ShortFlow;
using polhode::detail::TwoPartMomentum;

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

// The flow inside splittings, of a pack of bodies: every lane has the bits that its body has alone,
// over arcs of any length, next to the separatrix, at spin and at rest.

constexpr std::size_t lanes = 5;
using Pack = polhode::test::Lanes<double, lanes>;

struct Arc {
  Vec3 moments;
  TwoPartMomentum g;
  double time;
  std::string what;
};

std::vector<Arc> arcs() {
  std::vector<Arc> all;
  Draw draw(95, 0);
  const auto add = [&](const Vec3& moments, const Vec3& g, double turn, const std::string& what) {
    const double lo = draw.uniform(-0.5, 0.5) * eps;
    for (const double turns : {1e-9, 1e-3, 0.02, 0.11, -0.2, 0.7, 30.0, 0.0})
      all.push_back({moments, {g, {lo * g.x, -lo * g.y, lo * g.z}}, turns * turn, what});
  };
  for (const NamedMotion& m : motions()) add(m.moments, m.g, 6.0, m.name);
  for (const FreeCase& c : drawn_cases(96, 30))
    add(c.moments, c.start.g, oracle::detail::turn_length(c), description(c));
  for (std::size_t i = 0; i < 30; ++i) {  // needles and discs, in units that a splitting takes
    Draw of_case(97, i);
    FreeCase c = oracle::extreme_case(of_case);
    const double G = norm(c.start.g), I = larger(c.moments.x, larger(c.moments.y, c.moments.z));
    for (int k = 0; k < 3; ++k) {
      c.start.g[k] /= G;
      c.moments[k] /= I;
    }
    add(c.moments, c.start.g, oracle::detail::turn_length(c), description(c));
  }
  all.push_back({{3.0, 4.0, 6.0}, {{1.0, 0.5, 1.0}, {}}, not_a_number, "NaN"});
  all.push_back({{3.0, 4.0, 6.0}, {{1.0, not_a_number, 1.0}, {}}, 1.0, "NaN"});
  std::mt19937_64 random(98);
  std::shuffle(all.begin(), all.end(), random);
  while (all.size() % lanes != 0) all.push_back(all[all.size() % lanes]);
  return all;
}

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(std::isnan(x) ? not_a_number : x);
}

void expect_bits(const BasicVec3<Pack>& pack, const Vec3& alone, std::size_t lane, const Arc& arc) {
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(bits(pack[i].lane[lane]), bits(alone[i])) << arc.what << ", time " << arc.time;
}
void expect_bits(const polhode::BasicQuaternion<Pack>& pack, const Quaternion& alone,
                 std::size_t lane, const Arc& arc) {
  EXPECT_EQ(bits(pack.w.lane[lane]), bits(alone.w)) << arc.what << ", time " << arc.time;
  expect_bits(BasicVec3<Pack>{pack.x, pack.y, pack.z}, Vec3{alone.x, alone.y, alone.z}, lane, arc);
}

TEST(ShortFlowLanes, HaveTheBitsOfOneBody) {
  const std::vector<Arc> all = arcs();
  for (std::size_t first = 0; first < all.size(); first += lanes) {
    BasicVec3<Pack> moments;
    BasicTwoPartMomentum<Pack> g;
    Pack time, low;
    for (std::size_t j = 0; j < lanes; ++j) {
      const Arc& arc = all[first + j];
      for (int i = 0; i < 3; ++i) {
        moments[i].lane[j] = arc.moments[i];
        g.hi[i].lane[j] = arc.g.hi[i];
        g.lo[i].lane[j] = arc.g.lo[i];
      }
      time.lane[j] = arc.time;
      low.lane[j] = 0.3 * eps * arc.time;
    }
    const BasicShortFlow<Pack> flow(moments);
    const auto pack = flow.after(g, time, low);
    const auto plain = flow.plain(g.hi, time);
    const Pack rate = flow.polhode_rate(g.hi);
    for (std::size_t j = 0; j < lanes; ++j) {
      const Arc& arc = all[first + j];
      const ShortFlow alone(Body(arc.moments.x, arc.moments.y, arc.moments.z));
      const ShortFlow::Arc one = alone.after(arc.g, arc.time, low.lane[j]);
      expect_bits(pack.turn, one.turn, j, arc);
      expect_bits(pack.g.hi, one.g.hi, j, arc);
      expect_bits(pack.g.lo, one.g.lo, j, arc);
      const ShortFlow::PlainArc same = alone.plain(arc.g.hi, arc.time);
      expect_bits(plain.turn, same.turn, j, arc);
      expect_bits(plain.g, same.g, j, arc);
      EXPECT_EQ(bits(rate.lane[j]), bits(alone.polhode_rate(arc.g.hi))) << arc.what;
    }
  }
}

}  // namespace
