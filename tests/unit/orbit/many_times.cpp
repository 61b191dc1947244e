// SPDX-License-Identifier: MIT
// An orbit at many times gives the bits of the orbit at one, by every set of instructions.
#include "polhode/detail/orbit/many_times.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "oracle/random_draw.hpp"
#include "polhode/error.hpp"
#include "polhode/orbit/any_orbit.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "polhode/orbit/table_orbit.hpp"

namespace polhode::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(std::isnan(x) ? nan : x); }

struct Times {
  std::vector<double> t, rest;
};

// Of every order of magnitude and both signs, some far from any use.
Times drawn_times(std::size_t count, std::uint64_t seed) {
  Times times;
  for (std::size_t i = 0; i < count; ++i) {
    oracle::Draw draw(seed, i);
    const double odd[] = {nan, HUGE_VAL, -HUGE_VAL, 0.0, -0.0, 1e-300, 1e17, -3e40, 1e305, -1e308};
    const double t = draw.sign() * draw.power_of_ten(-8.0, 12.0);
    times.t.push_back(i % 13 == 5 ? odd[(i / 13 + seed) % 10] : t);
    times.rest.push_back(draw.uniform(-1.0, 1.0) * 1e-16 * t);
  }
  return times;
}

struct Rows {
  explicit Rows(std::size_t count) : x(count), y(count), z(count) {}
  std::vector<double> x, y, z;
  VectorRows rows() { return {x.data(), y.data(), z.data()}; }
};

template <class O>
bool has_velocity(const O& orbit) {
  if constexpr (requires { orbit.supports_velocity(); }) return orbit.supports_velocity();
  return true;
}

template <class O>
void expect_bits(const std::string& name, const O& orbit, InstructionSet set, std::size_t count) {
  const Times times = drawn_times(count, 31 + count);
  Rows x(count), v(count);
  const auto same = [&](Rows& rows, std::size_t i, const Vec3& alone, const char* what) {
    for (int n = 0; n < 3; ++n)
      EXPECT_EQ(bits(rows.rows().at(i)[n]), bits(alone[n]))
          << what << ' ' << n << " of " << name << " at " << times.t[i] << ", "
          << instruction_set_name(set);
  };
  for (const double* rest : {static_cast<const double*>(nullptr), times.rest.data()}) {
    const TimeRows rows{count, times.t.data(), rest};
    positions_at(orbit, rows, x.rows(), set);
    for (std::size_t i = 0; i < count; ++i)
      same(x, i, position_at(orbit, times.t[i], rows.rest_of(i)), "position");
  }
  if constexpr (OrbitOn<O, Dual<double, 1>>) {
    if (!has_velocity(orbit)) return;
    motions_at(orbit, {count, times.t.data(), times.rest.data()}, x.rows(), v.rows(), set);
    for (std::size_t i = 0; i < count; ++i) {
      const auto alone = orbit.position(Dual<double, 1>::variable(times.t[i], 0));
      same(x, i, {alone.x.value, alone.y.value, alone.z.value}, "place");
      same(v, i, {alone.x.derivative[0], alone.y.derivative[0], alone.z.derivative[0]}, "velocity");
    }
  }
}

template <class O>
void expect_bits(const std::string& name, const O& orbit) {
  for (const InstructionSet set : supported_instruction_sets())
    for (const std::size_t count : {1U, 3U, 8U, 16U, 21U, 60U}) {
      expect_bits(name, orbit, set, count);
      if (count == 8) expect_bits("any " + name, AnyOrbit(name, orbit), set, count);
    }
}

KeplerElements elements(double e, double scale) {
  return {scale, std::abs(1.0 - e) * scale, e, 0.4, 1.0, 2.0, 0.7, 0.3};
}

TEST(ManyTimes, KeplerOrbitsHaveTheBitsOfOne) {
  for (const double e : {0.0, 1e-9, 0.1, 0.3, 0.5, 0.50001, 0.7, 0.9, 0.999, 1.0 - 1e-12, 1.2})
    for (const double scale : {1.0, 2e4})
      expect_bits("e = " + std::to_string(e), KeplerOrbit(elements(e, scale)));
}

// Beyond what a table's phases can hold: Kepler's equation for small e too.
TEST(ManyTimes, AFarPericentreHasTheBitsOfOne) {
  KeplerElements k = elements(0.2, 1.0);
  k.epoch = 1e15;
  expect_bits("far pericentre", KeplerOrbit(k));
}

TEST(ManyTimes, PrecessingOrbitsHaveTheBitsOfOne) {
  const SecularRates steady{1e-3, -2e-3, 3e-4}, tilted{1e-3, 2e-3, 3e-4, 1e-4};
  const SecularRates changing{1e-3, 2e-3, 3e-4, 1e-4, 1e-9}, still{};
  for (const double e : {0.001, 0.3, 0.7, 0.99})
    for (const SecularRates& rates : {still, steady, tilted, changing}) {
      const PrecessingKeplerOrbit orbit(elements(e, 1.0), rates);
      expect_bits("precessing, e = " + std::to_string(e), orbit);
      expect_bits("turned, e = " + std::to_string(e), TurnedKeplerOrbit::from_equator(orbit));
    }
  expect_bits("precessing hyperbola", PrecessingKeplerOrbit(elements(1.5, 1.0), steady));
}

TEST(ManyTimes, AnglesHaveTheBitsOfOne) {
  for (const double rate : {0.0, 1.0, -7.3e-5, 1e-300}) {
    const UniformAngle angle(0.3, rate, 12.0);
    for (const InstructionSet set : supported_instruction_sets())
      for (const std::size_t count : {1U, 8U, 37U}) {
        const Times times = drawn_times(count, 5);
        std::vector<double> sine(count), cosine(count);
        angle.at(TimeRows{count, times.t.data(), times.rest.data()}, sine.data(), cosine.data(),
                 set);
        for (std::size_t i = 0; i < count; ++i) {
          const SinCos<double> alone = angle.at(times.t[i], times.rest[i]);
          EXPECT_EQ(bits(sine[i]), bits(alone.sin)) << times.t[i];
          EXPECT_EQ(bits(cosine[i]), bits(alone.cos)) << times.t[i];
        }
      }
  }
}

// One that knows nothing of lanes, for double and double-double alone.
struct Line {
  template <Real T>
    requires(std::same_as<T, double> || std::same_as<T, DoubleDouble>)
  BasicVec3<T> position(const T& t) const {
    return {t, T(2.0) * t, T(1.0)};
  }
};

TEST(ManyTimes, OtherOrbitsAreAskedTimeByTime) {
  expect_bits("line", Line{});
  PositionTable table;
  for (int i = 0; i < 40; ++i) {
    table.times.push_back(0.1 * i);
    table.positions.push_back({std::cos(0.1 * i), std::sin(0.1 * i), 0.01 * i});
  }
  expect_bits("table", TableOrbit(table));
}

// One that counts how often it is asked, the same as any of its number.
struct Counted {
  int number;
  int* asked;

  bool shares_with(const Counted& other) const { return number == other.number; }
  template <Real T>
  BasicVec3<T> position(const T& t) const {
    ++*asked;
    return {t, T(static_cast<double>(number)), T(0.0)};
  }
};

TEST(ManyTimes, AnOrbitThatIsSharedIsAskedOnce) {
  int asked = 0;
  const Counted first{1, &asked}, same{1, &asked}, other{2, &asked};
  SharedPlaces known;
  const std::vector<double> t{1.0, 2.0, 3.0}, rest{0.0, 0.0, 0.0};
  const TimeRows times{3, t.data(), rest.data(), &known};
  const auto ask = [&](const auto& orbit, double y) {
    Rows x(3), v(3);
    positions_at(orbit, times, x.rows(), InstructionSet::baseline);
    EXPECT_EQ(x.x, t);
    EXPECT_EQ(x.y[2], y);
    motions_at(orbit, times, x.rows(), v.rows(), InstructionSet::baseline);
    EXPECT_EQ(x.x, t);
    EXPECT_EQ(v.x[2], 1.0);
  };
  ask(first, 1.0);
  EXPECT_EQ(asked, 6);
  ask(same, 1.0);
  ask(AnyOrbit("same", same), 1.0);
  EXPECT_EQ(asked, 6);
  ask(other, 2.0);
  EXPECT_EQ(asked, 12);
  // no room for more: computed as often as asked
  const Counted third{3, &asked}, fourth{4, &asked};
  ask(third, 3.0);
  for (int i = 0; i < 2; ++i) ask(fourth, 4.0);
  EXPECT_EQ(asked, 12 + 6 + 2 * 6);
}

TEST(ManyTimes, AnOrbitWithoutAVelocityHasNoMotions) {
  double t = 1.0, row[6];
  EXPECT_THROW(AnyOrbit("line", Line{})
                   .motions({1, &t}, {row, row + 1, row + 2}, {row + 3, row + 4, row + 5},
                            InstructionSet::baseline),
               DomainError);
}

}  // namespace
}  // namespace polhode::test
