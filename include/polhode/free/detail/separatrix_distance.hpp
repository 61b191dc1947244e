// SPDX-License-Identifier: MIT
// G^2 - 2 T I2 of moments and momenta given as doubles, with its sign exact and its digits complete
// however much cancels and however small it is: the exponent is kept apart.
//
// Next to the separatrix a polhode's period and phase hang on the logarithm of this number, so that
// its relative error returns as an error of the phase in every period. Method:
// docs/design/0013-separatrix-distance.md.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "polhode/math/double_double.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// mantissa 2^exponent, |mantissa.hi| in [1/2, 1), or 0.
struct FloatingDoubleDouble {
  DoubleDouble mantissa;
  int exponent = 0;
};

inline FloatingDoubleDouble floating(const DoubleDouble& x, int exponent = 0) {
  int e = 0;
  std::frexp(x.hi, &e);
  return {ldexp(x, -e), x.hi == 0.0 ? 0 : exponent + e};
}

// An exact sum of doubles times a power of two: nonoverlapping parts of rising magnitude, none of
// them 0 [Shewchuk 1997].
class ExactSum {
 public:
  ExactSum() = default;
  // The product of four doubles; 212 bits, whatever their exponents.
  static ExactSum product(std::initializer_list<double> factors) {
    ExactSum p;
    p.add(1.0);
    for (const double factor : factors) {
      int e = 0;
      const double mantissa = std::frexp(factor, &e);
      ExactSum next;
      for (std::size_t i = 0; i < p.size_; ++i) {
        const TwoTerms<double> t = two_prod(p.parts_[i], mantissa);
        next.add(t.lo);
        next.add(t.hi);
      }
      next.exponent_ = p.exponent_ + e;
      p = next;
    }
    return p;
  }
  ExactSum operator-() const {
    ExactSum r = *this;
    for (std::size_t i = 0; i < size_; ++i) r.parts_[i] = -r.parts_[i];
    return r;
  }
  bool is_zero() const { return size_ == 0; }
  int exponent() const { return exponent_; }

  // Terms must come in the order of falling exponents. One that is 2^-700 of the sum so far changes
  // neither its sign nor its first 600 bits, and is left out.
  void add(const ExactSum& term) {
    if (term.is_zero()) return;
    if (is_zero()) {
      *this = term;
      return;
    }
    normalise();
    const int shift = term.exponent_ - exponent_;
    if (shift < -700) return;
    for (std::size_t i = 0; i < term.size_; ++i) add(std::ldexp(term.parts_[i], shift));
  }

  FloatingDoubleDouble rounded() const {
    DoubleDouble sum = 0.0;
    for (std::size_t i = 0; i < size_; ++i) sum += parts_[i];
    return floating(sum, exponent_);
  }

 private:
  void add(double x) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoTerms<double> s = two_sum(x, parts_[i]);
      if (s.lo != 0.0) parts_[n++] = s.lo;
      x = s.hi;
    }
    if (x != 0.0) parts_[n++] = x;
    size_ = n;
  }
  // The largest part to [1, 2), after a cancellation.
  void normalise() {
    const int e = std::ilogb(parts_[size_ - 1]);
    for (std::size_t i = 0; i < size_; ++i) parts_[i] = std::ldexp(parts_[i], -e);
    exponent_ += e;
  }

  // Four products have at most 8 parts each, and each addition makes at most one more.
  std::array<double, 40> parts_{};
  std::size_t size_ = 0;
  int exponent_ = 0;
};

// I1 I3 (G^2 - 2 T I2) = g3^2 I1 (I3 - I2) - g1^2 I3 (I2 - I1), multiplied out: no difference of
// moments is rounded.
inline FloatingDoubleDouble exact_separatrix_distance(const Vec3& I, double g1, double g3) {
  std::array<ExactSum, 4> terms{
      ExactSum::product({g3, g3, I.x, I.z}), -ExactSum::product({g3, g3, I.x, I.y}),
      -ExactSum::product({g1, g1, I.z, I.y}), ExactSum::product({g1, g1, I.z, I.x})};
  // the largest first; equals stay in their order
  for (std::size_t i = 1; i < terms.size(); ++i)
    for (std::size_t j = i; j > 0 && terms[j - 1].exponent() < terms[j].exponent(); --j)
      std::swap(terms[j - 1], terms[j]);
  ExactSum sum;
  for (const ExactSum& term : terms) sum.add(term);
  int e1 = 0, e3 = 0;
  const double I1 = std::frexp(I.x, &e1), I3 = std::frexp(I.z, &e3);
  const FloatingDoubleDouble numerator = sum.rounded();
  return floating(numerator.mantissa / DoubleDouble::product(I1, I3), numerator.exponent - e1 - e3);
}

// D2 over a common denominator: exact zeros (moments (3, 4, 6), g1 = g3) come out as zeros.
template <Number S, Number T>
T separatrix_discriminant(const BasicVec3<S>& I, const T& g1_squared, const T& g3_squared) {
  return (g3_squared * ((I.z - I.y) * I.x) - g1_squared * ((I.y - I.x) * I.z)) / (I.x * I.z);
}

// The same where little cancels and nothing is near the ends of double range, in double-double
// arithmetic: a tenth of the time, and at most 2^-98 off. I, g in sorted axes, the largest of each
// in [1, 2).
inline bool plain_separatrix_distance(const Vec3& I, const Vec3& g) {
  const double plus = g.z * g.z * (I.z - I.y) * I.x, minus = g.x * g.x * (I.y - I.x) * I.z;
  return std::abs(plus - minus) > 0.0625 * (plus + minus) && plus + minus > 0x1p-600 &&
         I.x > 0x1p-300;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
