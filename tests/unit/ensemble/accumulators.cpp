// SPDX-License-Identifier: MIT
// What all accumulators promise: chunks merged in order give the same bits whoever computed them,
// whether they went through numbers and back, wherever a run was cut; and bad numbers are refused.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "ensemble/accumulator.hpp"
#include "ensemble/angle_moments.hpp"
#include "ensemble/attitude_moments.hpp"
#include "ensemble/attitude_spread.hpp"
#include "ensemble/first_events.hpp"
#include "ensemble/fractions.hpp"
#include "ensemble/histogram.hpp"
#include "ensemble/number_moments.hpp"
#include "message_of.hpp"
#include "oracle/random_draw.hpp"
#include "polhode/ensemble/bins.hpp"

namespace {

using namespace polhode;
using polhode::test::message_of;

// A member has numbers a statistic may take as it likes; some fail.
struct AnyMember {
  std::int64_t index;
  double a, b, c;
  Quaternion q;
};
AnyMember member(std::int64_t index) {
  oracle::Draw draw(3918, static_cast<std::uint64_t>(index));
  AnyMember m{index,
              draw.normal(),
              draw.normal(),
              draw.uniform(-9.0, 9.0),
              {1.0, 0.3 * draw.normal(), 0.3 * draw.normal(), 0.3 * draw.normal()}};
  if (index % 11 == 3) m.a = m.c = m.q.x = std::numeric_limits<double>::quiet_NaN();
  return m;
}

struct ToLeftOut {
  static ensemble::LeftOut empty() { return {}; }
  static void add(ensemble::LeftOut& to, const AnyMember& m) {
    if (std::isnan(m.a)) to.add(m.index);
  }
};
struct ToNumbers {
  static ensemble::NumberMoments empty() { return ensemble::NumberMoments(3); }
  static void add(ensemble::NumberMoments& to, const AnyMember& m) {
    to.add(m.index, std::vector{m.a, m.b, 1e3 + m.c});
  }
};
struct ToAttitudes {
  static ensemble::AttitudeMoments empty() { return {}; }
  static void add(ensemble::AttitudeMoments& to, const AnyMember& m) { to.add(m.index, m.q); }
};
struct ToSpread {
  static ensemble::AttitudeSpread empty() { return ensemble::AttitudeSpread({1.0, 0.1, 0.0, 0.0}); }
  static void add(ensemble::AttitudeSpread& to, const AnyMember& m) { to.add(m.index, m.q); }
};
struct ToAngles {
  static ensemble::AngleMoments empty() { return {}; }
  static void add(ensemble::AngleMoments& to, const AnyMember& m) { to.add(m.index, m.c); }
};
struct ToHistogram {
  static ensemble::Histogram empty() {
    return ensemble::Histogram(ensemble::Bins::linear(-2.0, 2.0, 12));
  }
  static void add(ensemble::Histogram& to, const AnyMember& m) { to.add(m.index, m.a); }
};
struct ToHistogram2D {
  static ensemble::Histogram2D empty() {
    return {ensemble::Bins::linear(-2.0, 2.0, 12), ensemble::Bins::linear(-3.0, 3.0, 40)};
  }
  static void add(ensemble::Histogram2D& to, const AnyMember& m) { to.add(m.index, m.a, m.b); }
};
struct ToExact {
  static ensemble::Quantiles empty() { return {ensemble::Bins::linear(-2.0, 2.0, 12), 1000}; }
  static void add(ensemble::Quantiles& to, const AnyMember& m) { to.add(m.index, m.a); }
};
struct ToBins {
  static ensemble::Quantiles empty() { return {ensemble::Bins::linear(-2.0, 2.0, 120), 20}; }
  static void add(ensemble::Quantiles& to, const AnyMember& m) { to.add(m.index, m.a); }
};
struct ToFractions {
  static ensemble::Fractions empty() { return ensemble::Fractions(3); }
  static void add(ensemble::Fractions& to, const AnyMember& m) {
    if (std::isnan(m.a)) return to.leave_out(m.index);
    to.add(m.index, m.a < 0.0 ? 0 : m.a < 1.0 ? 1 : 2);
  }
};
struct ToFirstEvents {
  static ensemble::FirstEvents empty() { return {ensemble::Bins::linear(0.0, 3.0, 30), 15}; }
  static void add(ensemble::FirstEvents& to, const AnyMember& m) {
    if (m.a < 0.0) return to.add_without();
    to.add(m.index, m.a);
  }
};

template <class Statistic>
class Accumulators : public testing::Test {};
using Statistics =
    testing::Types<ToLeftOut, ToNumbers, ToAttitudes, ToSpread, ToAngles, ToHistogram,
                   ToHistogram2D, ToExact, ToBins, ToFractions, ToFirstEvents>;
TYPED_TEST_SUITE(Accumulators, Statistics);

std::vector<std::uint64_t> bits(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> all;
  for (const double x : numbers) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

template <class Statistic>
auto chunk(std::int64_t begin, std::int64_t end) {
  auto found = Statistic::empty();
  for (std::int64_t k = begin; k < end; ++k) Statistic::add(found, member(k));
  return found;
}

TYPED_TEST(Accumulators, HaveTheBitsOfTheListOfChunksWhoeverComputedThem) {
  using A = decltype(TypeParam::empty());
  static_assert(ensemble::Accumulator<A>);
  constexpr std::int64_t each = 25, chunks = 12;
  A straight = TypeParam::empty();
  for (std::int64_t k = 0; k < chunks; ++k)
    straight.merge(chunk<TypeParam>(k * each, (k + 1) * each));
  const auto expected = bits(straight.numbers());
  // computed last to first, sent as numbers, stopped and resumed after `cut` chunks
  std::vector<std::vector<double>> sent(chunks);
  for (std::int64_t k = chunks; k-- > 0;)
    sent[static_cast<std::size_t>(k)] = chunk<TypeParam>(k * each, (k + 1) * each).numbers();
  for (std::size_t cut = 0; cut <= sent.size(); ++cut) {
    A before = TypeParam::empty();
    for (std::size_t k = 0; k < cut; ++k) before.merge(TypeParam::empty().restored(sent[k]));
    A after = TypeParam::empty().restored(before.numbers());
    EXPECT_EQ(bits(after.numbers()), bits(before.numbers()));
    for (std::size_t k = cut; k < sent.size(); ++k)
      after.merge(TypeParam::empty().restored(sent[k]));
    EXPECT_EQ(bits(after.numbers()), expected) << cut;
  }
}

TYPED_TEST(Accumulators, MergedWithNothingAreThemselves) {
  const auto some = chunk<TypeParam>(0, 60);
  auto first = TypeParam::empty(), second = some;
  first.merge(some);
  second.merge(TypeParam::empty());
  EXPECT_EQ(bits(first.numbers()), bits(some.numbers()));
  EXPECT_EQ(bits(second.numbers()), bits(some.numbers()));
  // and what is restored goes on like what was there
  auto more = some, restored = TypeParam::empty().restored(some.numbers());
  for (std::int64_t k = 60; k < 90; ++k) {
    TypeParam::add(more, member(k));
    TypeParam::add(restored, member(k));
  }
  EXPECT_EQ(bits(more.numbers()), bits(restored.numbers()));
}

// What no accumulator wrote: too short, too long, counts that are none. Every refusal says so.
TYPED_TEST(Accumulators, RefuseNumbersThatTheyDidNotWrite) {
  const auto some = chunk<TypeParam>(0, 60);
  std::vector<double> numbers = some.numbers();
  for (std::size_t size = 0; size < numbers.size(); ++size) {
    const std::string message =
        message_of([&] { (void)TypeParam::empty().restored(std::span(numbers).first(size)); });
    EXPECT_NE(message.find("expected"), std::string::npos) << size << " of " << numbers.size();
  }
  numbers.push_back(0.0);
  EXPECT_NE(message_of([&] { (void)TypeParam::empty().restored(numbers); }), "");
  numbers.pop_back();
  // the last is the index of a member left out; each accumulator has counts before
  for (const double bad : {-1.0, 0.5, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<double> changed = numbers;
    changed.back() = bad;
    EXPECT_REJECTED(TypeParam::empty().restored(changed), "expected an integer from 0 to 2^53")
        << bad;
  }
  for (std::size_t k = 0; k < numbers.size(); ++k)
    for (const double bad : {-3.5, 1e18, std::numeric_limits<double>::quiet_NaN(), 7.0, 0.0}) {
      std::vector<double> changed = numbers;
      changed[k] = bad;
      try {  // is refused, or makes an accumulator that writes what it read
        const auto found = TypeParam::empty().restored(changed);
        EXPECT_EQ(bits(found.numbers()), bits(changed)) << k << ": " << bad;
      } catch (const DomainError& error) {
        EXPECT_NE(std::string(error.what()).find("expected"), std::string::npos) << error.what();
      }
    }
}

TEST(LeftOut, NamesTheFirst) {
  ensemble::LeftOut early, late;
  for (std::int64_t k = 0; k < 5; ++k) early.add(10 * k);
  for (std::int64_t k = 5; k < 20; ++k) late.add(10 * k);
  early.merge(late);
  EXPECT_EQ(early.count(), 20);
  ASSERT_EQ(early.first().size(), ensemble::LeftOut::kept);
  for (std::size_t i = 0; i < ensemble::LeftOut::kept; ++i)
    EXPECT_EQ(early.first()[i], static_cast<std::int64_t>(10 * i));
}

}  // namespace
