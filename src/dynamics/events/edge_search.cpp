// SPDX-License-Identifier: MIT
#include "dynamics/events/edge_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "polhode/dynamics/detail/time_zeros.hpp"

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
struct SideChange {
  std::size_t which;
  Look before, beyond;
  double guess = 0.0;
};

class Search {
 public:
  explicit Search(const SwitchCurve& curve) : curve_(curve) {
    for (std::size_t k = 0; k <= pieces; ++k) values_[k] = curve.along(place(k));
  }

  std::optional<Edge> first() {
    const std::optional<Edge> nan = first_nan();
    std::vector<SideChange> changes;
    for (std::size_t i = 0; i < values_[0].size(); ++i) add_changes(i, changes);
    std::stable_sort(changes.begin(), changes.end(),
                     [](const SideChange& a, const SideChange& b) { return a.guess < b.guess; });
    for (const SideChange& c : changes) {
      if (nan && c.beyond.t > nan->x) continue;
      if (const std::optional<Edge> edge = edge_at(c)) return edge;
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
  TimeFunction rough(std::size_t which) const {
    return [this, which](double x) { return curve_.along(x)[which]; };
  }
  TimeFunction truth(std::size_t which) const {
    return [this, which](double x) { return curve_.truly(which, x); };
  }
  bool below(std::size_t which, double value) const { return value < -curve_.rounding(which); }

  // Every sample below zero, and what dips below it between samples that are not.
  void add_changes(std::size_t i, std::vector<SideChange>& found) {
    for (std::size_t k = 1; k <= pieces; ++k) {
      const Look a{place(k - 1), values_[k - 1][i], 0.0}, b{place(k), values_[k][i], 0.0};
      const bool was_beyond = below(i, a.value);
      if (below(i, b.value)) {
        add({i, a, b}, found);
      } else if (!was_beyond) {
        const std::optional<Look> lowest = dip(k - 1, i, a, b);
        if (lowest && below(i, lowest->value)) add({i, a, *lowest}, found);
      }
    }
  }
  void add(SideChange c, std::vector<SideChange>& found) const {
    // from the middle: at the beginning a step has the zero that the last one ended at
    if (!(c.before.value > curve_.rounding(c.which))) c.before.value = -c.beyond.value;
    const auto root = root_between(rough(c.which), c.before, c.beyond, roughly);
    c.guess = root ? root->t : 0.5 * (c.before.t + c.beyond.t);  // NaN: the truth decides
    found.push_back(c);
  }

  // Where function i is lowest between samples k and k + 1, if it may be below zero there. Where it
  // dips it is convex, a parabola or a V, and then above the lines through the samples on either
  // side. At the ends of a step the line is the tangent.
  std::optional<Look> dip(std::size_t k, std::size_t i, Look a, Look b) {
    // without the tangents first: most steps end here
    if (k > 0 && !below(i, a.value + (a.value - values_[k - 1][i]))) return std::nullopt;
    if (k + 2 <= pieces && !below(i, b.value + (b.value - values_[k + 2][i]))) return std::nullopt;
    a.slope = pieces * (a.value - (k > 0 ? values_[k - 1][i] : before_first(i)));
    b.slope = pieces * ((k + 2 <= pieces ? values_[k + 2][i] : after_last(i)) - b.value);
    return dip_between(rough(i), 1, a, b, -curve_.rounding(i));
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

  // No value if the truth does not change its sign.
  std::optional<Edge> edge_at(const SideChange& c) const {
    const TimeFunction value = truth(c.which), guess = rough(c.which);
    Look a{c.before.t, 0.0, 0.0}, b{c.beyond.t, 0.0, 0.0};
    const double step = 0.01 * (b.t - a.t);
    const double slope = (guess(c.guess + step) - guess(c.guess)) / step;
    // the truth is near: two tries around the zero of the interpolation leave a short bracket
    double x = c.guess;
    for (int trip = 0; trip < 2 && a.t < x && x < b.t; ++trip) {
      const double y = value(x);
      if (y == 0.0) return Edge{c.which, x};
      if (std::isnan(y)) return Edge{c.which, x, true};
      (y < 0.0 ? b : a) = {x, y, 0.0};
      x += std::copysign(std::fmax(2.0 * std::fabs(y / slope), 2.0 * closely), y);
    }
    if (b.value == 0.0) b.value = value(b.t);
    const bool is_seen = below(c.which, b.value) || std::isnan(b.value) ||
                         (b.t < c.beyond.t && below(c.which, value(c.beyond.t)));
    if (!is_seen) return std::nullopt;
    if (a.value == 0.0) a.value = -b.value;
    const auto root = root_between(value, a, b, closely);
    return root ? Edge{c.which, root->t} : Edge{c.which, c.beyond.t, true};
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
