// SPDX-License-Identifier: MIT
// Draws of arguments that are exact in binary, and the worst error over a sweep.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <type_traits>

#include "oracle/random_draw.hpp"
#include "polhode/math/dual.hpp"
#include "unit/elliptic/exact.hpp"
#include "worst.hpp"

namespace polhode::test {

using Real2 = ::testing::Types<double, DoubleDouble>;

// 24 significant bits: exact in float, and squares and sums of a few are exact in double.
inline double short_number(double x) {
  int e = 0;
  const double f = std::frexp(x, &e);
  return std::ldexp(std::nearbyint(std::ldexp(f, 24)), e - 24);
}
inline double drawn(oracle::Draw& draw, double lo, double hi) {
  return short_number(draw.uniform(lo, hi));
}
inline double drawn_power(oracle::Draw& draw, double lo, double hi) {
  return short_number(draw.power_of_ten(lo, hi));
}

template <class T>
T as(DoubleDouble x) {
  if constexpr (std::is_same_v<T, double>) {
    return x.hi;
  } else {
    return T(x);
  }
}
inline DoubleDouble wide(double x) { return x; }
inline DoubleDouble wide(DoubleDouble x) { return x; }

template <class T>
elliptic::BasicModulus<T> as(const ExactModulus& mod) {
  return elliptic::BasicModulus<T>::from_pair(as<T>(mod.m()), as<T>(mod.m1()));
}

// The least m or m1 of a sweep: below, a DoubleDouble has no room for its low part.
template <class T>
double least_exponent() {
  return std::is_same_v<T, double> ? -300.0 : -230.0;
}

enum class Near { generic, one, zero };
// The member near 0 is a short number; the other is 1 minus that.
template <class T>
ExactModulus drawn_modulus(oracle::Draw& draw, Near where) {
  const double small =
      where == Near::generic ? drawn(draw, 0.01, 0.99) : drawn_power(draw, least_exponent<T>(), -1);
  const DoubleDouble rest = 1.0 - DoubleDouble(small);
  return where == Near::one ? ExactModulus::from_pair(rest, small)
                            : ExactModulus::from_pair(small, rest);
}

template <class... Numbers>
std::string listed(const Numbers&... x) {
  std::ostringstream text;
  text.precision(17);
  ((text << to_double(x) << ' '), ...);
  return text.str();
}

// The largest error in units of epsilon<T>(), and where.
template <class T>
class WorstUnits {
 public:
  void add(double error, const std::string& where) { worst_.add(error / epsilon<T>(), where); }
  double units() const { return worst_.value(); }
  const std::string& where() const { return worst_.where(); }
  // Of a fixture: not every test of it measures everything.
  void expect_within(double budget, const std::string& name = "") const {
    if (worst_.measured()) {
      EXPECT_LE(units(), budget) << name << " " << where();
    }
  }

 private:
  Worst<> worst_;
};

}  // namespace polhode::test
