// SPDX-License-Identifier: MIT
#include "dynamics/detail/edge_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Samples of a step: what a switching function does between them is a parabola or nearly so.
constexpr int pieces = 4;
// The interpolation is solved to this, the truth to rounding: fractions of a step.
constexpr double roughly = 1e-7;
constexpr double closely = std::numeric_limits<double>::epsilon();

// A change of sign that the interpolation shows: at or above zero at `before`, below at `beyond`.
struct Crossing {
  std::size_t which;
  double before;
  double beyond;
  double guess;
};

// f is taken for positive at a; it is negative at b. x is the first try, `slope` that of f there or
// NaN. Secants, and a bisection where they leave the bracket and at every fourth trip: at most 200,
// and three as a rule.
template <class F>
double root(const F& f, double a, double b, double x, double slope, double close) {
  if (!(a < x && x < b)) x = 0.5 * (a + b);
  double last = x, f_last = 0.0;
  for (int trip = 0; trip < 200; ++trip) {
    const double y = f(x);
    if (y == 0.0) return x;
    (y < 0.0 ? b : a) = x;
    if (trip > 0) slope = (y - f_last) / (x - last);
    double next = x - y / slope;
    if (trip % 4 == 3 || !(a < next && next < b)) next = 0.5 * (a + b);
    if (std::fabs(next - x) <= close || b - a <= close) return next;
    last = std::exchange(x, next);
    f_last = y;
  }
  return x;
}

class Search {
 public:
  explicit Search(const SwitchCurve& curve) : curve_(curve) {
    for (std::size_t k = 0; k <= pieces; ++k) values_[k] = curve.along(place(k));
  }

  std::optional<Edge> first() const {
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < values_[0].size(); ++i) add_crossings(i, crossings);
    std::stable_sort(crossings.begin(), crossings.end(),
                     [](const Crossing& a, const Crossing& b) { return a.guess < b.guess; });
    for (const Crossing& c : crossings) {
      if (!below(c.which, curve_.truly(c.which, c.beyond))) continue;  // the interpolation errs
      const double step = 0.01 * (c.beyond - c.before), x = c.guess;
      const double slope = (rough(c.which, x + step) - rough(c.which, x)) / step;
      const auto truth = [&](double at) { return curve_.truly(c.which, at); };
      return Edge{c.which, root(truth, c.before, c.beyond, x, slope, closely)};
    }
    return std::nullopt;
  }

 private:
  static double place(std::size_t k) { return static_cast<double>(k) / pieces; }
  double rough(std::size_t which, double x) const { return curve_.along(x)[which]; }
  bool below(std::size_t which, double value) const { return value < -curve_.rounding(which); }

  // Every sample below zero, and what dips below it between samples that are not.
  void add_crossings(std::size_t i, std::vector<Crossing>& found) const {
    double before = 0.0;
    for (std::size_t k = 1; k <= pieces; ++k) {
      const bool beyond = below(i, values_[k][i]);
      if (!beyond && k < pieces) {
        const double x = lowest_about(k, i);
        if (below(i, rough(i, x))) add({i, before, x, 0.0}, found);
      }
      if (beyond) add({i, before, place(k), 0.0}, found);
      before = place(k);
    }
  }
  void add(Crossing c, std::vector<Crossing>& found) const {
    const auto f = [&](double x) { return rough(c.which, x); };
    // from the middle: at the beginning a step has the zero that the last one ended at
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    c.guess = root(f, c.before, c.beyond, 0.5 * (c.before + c.beyond), unknown, roughly);
    found.push_back(c);
  }

  // Where the function is lowest about sample k, or the sample where the parabola through it and
  // its neighbours stays well above zero.
  double lowest_about(std::size_t k, std::size_t i) const {
    const double a = values_[k - 1][i], b = values_[k][i], c = values_[k + 1][i];
    const double bend = a - 2.0 * b + c, tilt = 0.5 * (c - a);
    if (!(bend > std::fabs(tilt)) || b - 0.5 * tilt * tilt / bend > 0.25 * bend) return place(k);
    constexpr double golden = 0.6180339887498949;
    double from = place(k - 1), to = place(k + 1);
    for (int trip = 0; trip < 24; ++trip) {
      const double low = to - golden * (to - from), high = from + golden * (to - from);
      const double at_low = rough(i, low), at_high = rough(i, high);
      if (below(i, at_low)) return low;
      if (below(i, at_high)) return high;
      (at_low < at_high ? to : from) = at_low < at_high ? high : low;
    }
    return 0.5 * (from + to);
  }

  const SwitchCurve& curve_;
  std::array<std::vector<double>, pieces + 1> values_;
};

}  // namespace

std::optional<Edge> first_edge(const SwitchCurve& curve) { return Search(curve).first(); }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
