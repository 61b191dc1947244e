// SPDX-License-Identifier: MIT
// Taylor coefficients of Euler's equations and the length of a step.
//
// Equations   dg/dt = g x omega, that is dg_i/dt = c_i g_j g_k, c_1 = 1/I3 - 1/I2 (cyclic). Orders
//             and step lengths after Jorba and Zou, Experimental Mathematics 14 (2005) 99-117.
//             Near the separatrix the unknowns are instead, with lo, mid, hi the axes by moment,
//                 p = a g_hi + b g_lo, m = a g_hi - b g_lo, g_mid,
//                 a^2 = (I_hi - I_mid)/I_hi, b^2 = (I_mid - I_lo)/I_lo,
//                 dp/dt = lambda g_mid p, dm/dt = -lambda g_mid m, p m = G^2 - 2 T I_mid,
//             so that the fast growth and decay next to the middle axis keep relative accuracy; on
//             the separatrix one of p, m is exactly 0.
// Accuracy    every unknown keeps relative accuracy, however small, since the equations are
//             bilinear.
#pragma once

#include <array>
#include <cstddef>

#include "oracle/wide_real.hpp"
#include "worst.hpp"

namespace oracle {

using polhode::test::larger;
using polhode::test::smaller;

// Order of the expansions, and the truncation allowed to one step relative to each unknown.
struct TaylorSettings {
  std::size_t order = 77;
  double log10_tolerance = -66.0;
};

using Series3 = std::array<Series, 3>;

inline const Wide& component(const WideVec3& v, std::size_t i) { return v[static_cast<int>(i)]; }

// The axes sorted by moment, and G^2 - 2 T I_mid with its sign exact.
struct Classification {
  std::size_t lo, mid, hi;
  Wide d2;
};

inline Classification classification(const WideVec3& I, const WideVec3& g) {
  // 4096 bits hold any product of five doubles that differ by less than 1e1000.
  using Exact = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<1233>,
                                              boost::multiprecision::et_off>;
  std::array<std::size_t, 3> order{0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return component(I, a) < component(I, b); });
  const auto [lo, mid, hi] = order;
  const Exact I_lo(component(I, lo)), I_mid(component(I, mid)), I_hi(component(I, hi));
  const Exact g_lo(component(g, lo)), g_hi(component(g, hi));
  const Exact plus = g_hi * g_hi * (I_hi - I_mid) * I_lo;
  const Exact minus = g_lo * g_lo * (I_mid - I_lo) * I_hi;
  return {lo, mid, hi, Wide(Exact((plus - minus) / (I_lo * I_hi)))};
}

class EulerEquations {
 public:
  EulerEquations(const polhode::Vec3& moments, const polhode::Vec3& momentum);

  const WideVec3& moments() const { return moments_; }
  const Classification& axes() const { return axes_; }
  bool saddle_unknowns() const { return saddle_; }
  // Does g change with time? Exact.
  bool moves() const { return moves_; }

  // The unknowns of g at the start, and g of the unknowns (a linear map).
  WideVec3 unknowns() const;
  WideVec3 momentum(const WideVec3& y) const;
  // Appends coefficient k + 1 to each unknown.
  void append_order(Series3& y, std::size_t k) const;

 private:
  void append_order_plain(Series3& y, std::size_t k) const;
  void append_order_saddle(Series3& y, std::size_t k) const;

  WideVec3 moments_, start_;
  Classification axes_;
  std::array<Wide, 3> c_;
  bool moves_ = false, saddle_ = false;
  Wide a_, b_, lambda_, mid_factor_;
};

inline EulerEquations::EulerEquations(const polhode::Vec3& moments, const polhode::Vec3& momentum)
    : moments_(widened(moments)),
      start_(widened(momentum)),
      axes_(classification(moments_, start_)) {
  const auto& [I1, I2, I3] = moments_;
  c_ = {(I2 - I3) / (I2 * I3), (I3 - I1) / (I3 * I1), (I1 - I2) / (I1 * I2)};
  for (std::size_t i = 0; i < 3; ++i)
    moves_ = moves_ || (c_[i] != 0 && component(start_, (i + 1) % 3) != 0 &&
                        component(start_, (i + 2) % 3) != 0);
  const Wide& I_lo = component(moments_, axes_.lo);
  const Wide& I_mid = component(moments_, axes_.mid);
  const Wide& I_hi = component(moments_, axes_.hi);
  const Wide a2 = (I_hi - I_mid) / I_hi, b2 = (I_mid - I_lo) / I_lo;
  const Wide limit = (a2 < b2 ? a2 : b2) * dot(start_, start_) / 10000;
  saddle_ = moves_ && abs(axes_.d2) <= limit;
  if (!saddle_) return;
  a_ = sqrt(a2);
  b_ = sqrt(b2);
  lambda_ = a_ * c_[axes_.hi] / b_;
  mid_factor_ = c_[axes_.mid] / (4 * a_ * b_);
}

inline WideVec3 EulerEquations::unknowns() const {
  if (!saddle_) return start_;
  const Wide hi = a_ * component(start_, axes_.hi), lo = b_ * component(start_, axes_.lo);
  Wide p = hi + lo, m = hi - lo;  // the smaller one cancels: p m = d2 gives it
  if (abs(p) > abs(m))
    m = axes_.d2 / p;
  else
    p = axes_.d2 / m;
  return {p, m, component(start_, axes_.mid)};
}

inline WideVec3 EulerEquations::momentum(const WideVec3& y) const {
  if (!saddle_) return y;
  WideVec3 g;
  g[static_cast<int>(axes_.hi)] = (y.x + y.y) / (2 * a_);
  g[static_cast<int>(axes_.lo)] = (y.x - y.y) / (2 * b_);
  g[static_cast<int>(axes_.mid)] = y.z;
  return g;
}

inline void EulerEquations::append_order(Series3& y, std::size_t k) const {
  if (saddle_)
    append_order_saddle(y, k);
  else
    append_order_plain(y, k);
}

inline void EulerEquations::append_order_plain(Series3& y, std::size_t k) const {
  std::array<Wide, 3> next;
  for (std::size_t i = 0; i < 3; ++i)
    next[i] =
        c_[i] == 0 ? Wide(0) : c_[i] * convolution(y[(i + 1) % 3], y[(i + 2) % 3], k) / (k + 1);
  for (std::size_t i = 0; i < 3; ++i) y[i].push_back(next[i]);
}

inline void EulerEquations::append_order_saddle(Series3& y, std::size_t k) const {
  const auto& [p, m, mid] = y;
  const auto product = [k](const Series& u, const Series& v) {
    return u[0] == 0 ? Wide(0) : Wide(convolution(u, v, k) / (k + 1));
  };
  const Wide next_p = lambda_ * product(p, mid), next_m = -lambda_ * product(m, mid);
  const Wide next_mid = mid_factor_ * (product(p, p) - product(m, m));
  y[0].push_back(next_p);
  y[1].push_back(next_m);
  y[2].push_back(next_mid);
}

// log2 of the step on which the neglected terms of one series stay below the tolerance, relative to
// its value, to its change, or to 2^floor, whichever is largest.
inline double log2_step(const Series& s, const TaylorSettings& settings,
                        double floor = -std::numeric_limits<double>::infinity()) {
  const double tolerance = settings.log10_tolerance * std::log2(10.0);
  const double value = larger(floor, log2_magnitude(s[0]));
  double result = std::numeric_limits<double>::infinity();
  for (std::size_t m = s.size() - 4; m < s.size(); ++m) {
    const double top = log2_magnitude(s[m]);
    if (std::isinf(top)) continue;
    const double by_value = (tolerance + value - top) / static_cast<double>(m);
    const double by_change = (tolerance + log2_magnitude(s[1]) - top) / static_cast<double>(m - 1);
    result = smaller(result, larger(by_value, by_change));
  }
  return result;
}

inline double log2_step(const Series3& y, const TaylorSettings& settings) {
  return smaller(log2_step(y[0], settings), log2_step(y[1], settings), log2_step(y[2], settings));
}

inline WideVec3 polynomial(const Series3& y, const Wide& h) {
  return {polynomial(y[0], h), polynomial(y[1], h), polynomial(y[2], h)};
}

}  // namespace oracle
