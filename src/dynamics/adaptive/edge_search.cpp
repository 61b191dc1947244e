// SPDX-License-Identifier: MIT
#include "dynamics/adaptive/edge_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/adaptive/falling_root.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// Samples of a step: between them a switching function has one dip at most.
constexpr int pieces = 4;
// Its slopes at the ends of a step are differences over this fraction of a piece.
constexpr double aside = 0x1p-12;
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

class Search {
 public:
  explicit Search(const SwitchCurve& curve) : curve_(curve) {
    for (std::size_t k = 0; k <= pieces; ++k) values_[k] = curve.along(place(k));
  }

  std::optional<Edge> first() {
    const std::optional<Edge> nan = first_nan();
    std::vector<Crossing> crossings;
    for (std::size_t i = 0; i < values_[0].size(); ++i) add_crossings(i, crossings);
    std::stable_sort(crossings.begin(), crossings.end(),
                     [](const Crossing& a, const Crossing& b) { return a.guess < b.guess; });
    for (const Crossing& c : crossings) {
      if (nan && c.beyond > nan->x) continue;
      if (!below(c.which, curve_.truly(c.which, c.beyond))) continue;  // the interpolation errs
      const double step = 0.01 * (c.beyond - c.before), x = c.guess;
      const double slope = (rough(c.which, x + step) - rough(c.which, x)) / step;
      const auto truth = [&](double at) { return curve_.truly(c.which, at); };
      return Edge{c.which, falling_root(truth, c.before, c.beyond, x, slope, closely)};
    }
    return nan;
  }

  const std::vector<double>& at_end() const { return values_.back(); }

 private:
  std::optional<Edge> first_nan() const {
    for (std::size_t k = 0; k <= pieces; ++k)
      for (std::size_t i = 0; i < values_[k].size(); ++i)
        if (std::isnan(values_[k][i])) return Edge{i, place(k), true};
    return std::nullopt;
  }

  static double place(std::size_t k) { return static_cast<double>(k) / pieces; }
  double rough(std::size_t which, double x) const { return curve_.along(x)[which]; }
  bool below(std::size_t which, double value) const { return value < -curve_.rounding(which); }

  // Every sample below zero, and what dips below it between samples that are not.
  void add_crossings(std::size_t i, std::vector<Crossing>& found) {
    double before = 0.0;
    bool was_beyond = false;
    for (std::size_t k = 1; k <= pieces; ++k) {
      const bool beyond = below(i, values_[k][i]);
      if (beyond) {
        add({i, before, place(k), 0.0}, found);
      } else if (!was_beyond && may_dip(k - 1, i)) {
        const double x = lowest_in(before, place(k), i);
        if (below(i, rough(i, x))) add({i, before, x, 0.0}, found);
      }
      was_beyond = beyond;
      before = place(k);
    }
  }
  void add(Crossing c, std::vector<Crossing>& found) const {
    const auto f = [&](double x) { return rough(c.which, x); };
    // from the middle: at the beginning a step has the zero that the last one ended at
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    c.guess = falling_root(f, c.before, c.beyond, 0.5 * (c.before + c.beyond), unknown, roughly);
    found.push_back(c);
  }

  // Whether function i may be below zero between samples k and k + 1. Where it dips it is convex, a
  // parabola or a V, and then above the lines through the samples on either side. At the ends of a
  // step the line is the tangent.
  bool may_dip(std::size_t k, std::size_t i) {
    const double a = values_[k][i], b = values_[k + 1][i];
    // without the tangents first: most steps end here
    if (k > 0 && !below(i, a + (a - values_[k - 1][i]))) return false;
    if (k + 2 <= pieces && !below(i, b + (b - values_[k + 2][i]))) return false;
    const double falls = a - (k > 0 ? values_[k - 1][i] : before_first(i));
    const double rises = (k + 2 <= pieces ? values_[k + 2][i] : after_last(i)) - b;
    if (!(falls < 0.0 && rises > 0.0)) return false;
    // a + falls x and b - rises (1 - x) meet
    const double x = std::clamp((a - b + rises) / (rises - falls), 0.0, 1.0);
    return below(i, a + falls * x);
  }
  // The values that the tangents at the ends have one piece outside.
  double before_first(std::size_t i) {
    if (near_first_.empty()) near_first_ = curve_.along(aside / pieces);
    return values_[0][i] - (near_first_[i] - values_[0][i]) / aside;
  }
  double after_last(std::size_t i) {
    if (near_last_.empty()) near_last_ = curve_.along(1.0 - aside / pieces);
    return values_[pieces][i] + (values_[pieces][i] - near_last_[i]) / aside;
  }

  // Where function i is lowest, by golden sections, or a place where it is below zero.
  double lowest_in(double from, double to, std::size_t i) const {
    constexpr double golden = 0.6180339887498949;
    double low = to - golden * (to - from), high = from + golden * (to - from);
    double at_low = rough(i, low), at_high = rough(i, high);
    for (int trip = 0; trip < 32; ++trip) {
      if (below(i, at_low)) return low;
      if (below(i, at_high)) return high;
      if (at_low < at_high) {
        to = std::exchange(high, low);
        at_high = at_low;
        low = to - golden * (to - from);
        at_low = rough(i, low);
      } else {
        from = std::exchange(low, high);
        at_low = at_high;
        high = from + golden * (to - from);
        at_high = rough(i, high);
      }
    }
    return at_low < at_high ? low : high;
  }

  const SwitchCurve& curve_;
  std::array<std::vector<double>, pieces + 1> values_;
  std::vector<double> near_first_, near_last_;  // once they are asked for
};

}  // namespace

EdgeSearch search_edges(const SwitchCurve& curve) {
  Search search(curve);
  std::optional<Edge> first = search.first();
  return {first, search.at_end()};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
