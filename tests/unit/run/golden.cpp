// SPDX-License-Identifier: MIT
// Every number of the golden cases, as printed, against 76-digit integration.
#include "polhode/run/golden.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "oracle/free_body.hpp"
#include "worst.hpp"

namespace polhode {
namespace {

using oracle::Wide;
using polhode::test::larger;
using polhode::test::smaller;
using polhode::test::Worst;

const std::vector<io::GoldenCase>& cases() {
  static const std::vector<io::GoldenCase> all = io::golden_cases();
  return all;
}

RotorState start(const io::GoldenCase& c) {
  return {c.q0, {c.moments.x * c.omega0.x, c.moments.y * c.omega0.y, c.moments.z * c.omega0.z}};
}

// The last `count` fields of a line, with all their decimals.
std::vector<Wide> last_numbers(const std::string& line, std::size_t count) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  std::vector<Wide> numbers;
  for (std::size_t i = fields.size() - count; i < fields.size(); ++i)
    numbers.emplace_back(fields[i]);
  return numbers;
}

// The rows of the CSV, without the lines before them.
std::vector<std::string> rows() {
  std::istringstream stream(io::golden_csv(cases()));
  std::vector<std::string> found;
  for (std::string line; std::getline(stream, line);)
    if (line[0] != '#' && !line.starts_with("case,")) found.push_back(line);
  return found;
}

Wide distance(const std::vector<Wide>& a, const std::vector<Wide>& b, const Wide& sign) {
  Wide sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Wide d = a[i] - sign * b[i];
    sum += d * d;
  }
  return sqrt(sum);
}

TEST(Golden, EveryPrintedStateIsWithinItsBoundOfTheOracle) {
  const std::vector<std::string> lines = rows();
  auto line = lines.begin();
  Worst<Wide> largest;
  for (const io::GoldenCase& c : cases()) {
    const RotorState s0 = start(c);
    oracle::FreeBody body(c.moments, s0.q, s0.g);
    for (const io::GoldenSample& sample : c.samples) {
      ASSERT_NE(line, lines.end());
      ASSERT_TRUE(line->starts_with(c.name + ","));
      const std::vector<Wide> printed = last_numbers(*line++, 7);
      const oracle::WideState exact = body.at(sample.t, 0.0);
      const std::vector<Wide> q{exact.q.w, exact.q.x, exact.q.y, exact.q.z};
      const std::vector<Wide> w{exact.g.x / c.moments.x, exact.g.y / c.moments.y,
                                exact.g.z / c.moments.z};
      const std::vector<Wide> q_printed(printed.begin(), printed.begin() + 4);
      const std::vector<Wide> w_printed(printed.begin() + 4, printed.end());
      const Wide dq = smaller(distance(q_printed, q, 1), distance(q_printed, q, -1));
      const Wide dw = distance(w_printed, w, 1);
      const Wide size = distance(w, std::vector<Wide>(3, 0), 1);
      EXPECT_LE(dq, c.bound) << c.name << " t = " << sample.t;
      EXPECT_LE(dw, c.bound * size) << c.name << " t = " << sample.t;
      largest.add(larger(dq, Wide(size > 0 ? Wide(dw / size) : Wide(0))));
    }
  }
  EXPECT_EQ(line, lines.end());
  EXPECT_GT(largest.value(), 0.25 * cases().front().bound) << "the bound is idle";
  RecordProperty("largest", largest.value().str(3));
}

TEST(Golden, StartsAreTheSameFromOmegaAndFromMomentum) {
  for (const io::GoldenCase& c : cases())
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(std::fma(c.moments[i], c.omega0[i], -(c.moments[i] * c.omega0[i])), 0.0) << c.name;
}

TEST(Golden, SamplesStartAtTheStartAndTimesRise) {
  for (const io::GoldenCase& c : cases()) {
    EXPECT_EQ(c.samples.front().t, 0.0) << c.name;
    EXPECT_EQ(c.samples.front().q, c.q0) << c.name;
    EXPECT_EQ(c.samples.front().omega, c.omega0) << c.name;
    EXPECT_EQ(
        std::ranges::adjacent_find(c.samples, std::ranges::greater_equal{}, &io::GoldenSample::t),
        c.samples.end())
        << c.name;
  }
}

TEST(Golden, EveryRegimeOccursUnderItsOwnName) {
  std::set<std::string> regimes, names;
  for (const io::GoldenCase& c : cases()) {
    regimes.insert(io::regime_name(c.regime));
    EXPECT_TRUE(names.insert(c.name).second) << c.name;
    if (c.name.starts_with("near-separatrix")) {
      EXPECT_EQ(io::regime_name(c.regime),
                c.name.find("sam") != std::string::npos ? "short_axis" : "long_axis");
    }
  }
  EXPECT_EQ(regimes,
            (std::set<std::string>{"rest", "steady", "short_axis", "long_axis", "separatrix"}));
}

}  // namespace
}  // namespace polhode
