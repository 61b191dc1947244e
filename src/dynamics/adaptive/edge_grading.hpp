// SPDX-License-Identifier: MIT
// Steps that grow away from an edge and shrink towards it, for methods whose polynomials span whole
// steps.
//
// In a penumbra the light grows like the power 3/2 of the time since its edge: Gauss' quadrature of
// a step of h that begins there errs like h^(5/2), and nothing shows it next to smooth torques. A
// step that is no longer than its distance from the edge converges by a factor of 5.8 a degree. The
// step next to the edge is so short that what it errs is a small part of the tolerance, by the bend
// of the torque there. On the other side of the edge, where there is no power, it is not shorter.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "dynamics/adaptive/edge_search.hpp"
#include "dynamics/adaptive/switch_watch.hpp"
#include "math/larger.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Of a method: its tolerance, and what a step of 1 next to an edge errs, of the bend of the torque.
struct EdgeRule {
  double tolerance;
  double power_error;
};

// Of the borders of penumbras. Other edges, of facets that turn away or of a shadow like a
// cylinder, have smooth sides.
class EdgeGrading {
 public:
  // Before the first step: which functions those are.
  void begin(const SwitchWatch& switches, const DoubleDouble& t, const RotorState& s) {
    if (is_fading_.size() != switches.size()) find_fading(switches, t, s);
  }
  // How long a step from (t, s) may be where the solver would take `wanted`. `rest` is the way to
  // the end of the run.
  double longest(const SwitchWatch& switches, const DoubleDouble& t, const RotorState& s,
                 double wanted, double rest, const EdgeRule& rule) {
    if (!has_any()) return wanted;
    const double usual = larger(usual_, wanted);
    const double behind = last_ ? std::abs((t - last_->t).hi) : usual;
    const double far = std::copysign(std::min(2.0 * usual, std::abs(rest)), rest);
    const std::optional<double> ahead = edge_within(switches, t, s, far);
    double length = usual;
    if (behind < usual) {
      if (!last_->least)
        last_->least = least(switches, *last_, s, std::copysign(usual, rest), rule);
      length = larger(behind, *last_->least);
    }
    if (ahead) {
      if (!next_->least)
        next_->least = least(switches, *next_, s, std::copysign(usual, -rest), rule);
      // the last step goes through the edge, where it is found and the step is made to end
      const double least = *next_->least;
      length = std::min(length, *ahead > 2.0 * least ? 0.5 * *ahead : *ahead + least);
    }
    if (!(length < usual)) {
      // steps next to an edge say nothing of those beyond
      if (!is_near_) usual_ = wanted;
      is_near_ = false;
      return usual_;
    }
    if (usual_ == 0.0) usual_ = wanted;
    is_near_ = true;
    return std::min(wanted, length);
  }
  // A step has ended at the zero of function `which`.
  void cross(std::size_t which, double t) {
    if (!is_fading_[which]) return;
    last_ = Border{which, t, std::nullopt};
    next_.reset();
  }

  template <class Visit>
  void transfer(Visit& visit) {
    std::vector<double> fading(is_fading_.begin(), is_fading_.end());
    visit.all(fading, usual_, is_near_);
    is_fading_.assign(fading.begin(), fading.end());
    for (std::optional<Border>* border : {&last_, &next_}) {
      bool is_there = border->has_value();
      visit(is_there);
      if (!is_there) border->reset();
      if (is_there && !*border) *border = Border{};
      if (is_there) (*border)->transfer(visit);
    }
  }

 private:
  // The longest step next to an edge, of other steps; and what it errs, of the tolerance: edges are
  // many, and what the momentum is off by goes on as a rate.
  static constexpr double most_part = 1.0 / 128.0, error_part = 1e-4;

  // An edge: the zero of function `which` at t.
  struct Border {
    std::size_t which = 0;
    double t = 0.0;
    std::optional<double> least = std::nullopt;  // the step next to it, once it is asked for

    template <class Visit>
    void transfer(Visit& visit) {
      std::int64_t number = static_cast<std::int64_t>(which);
      visit.all(number, t, least);
      which = static_cast<std::size_t>(number);
    }
  };

  // How long the step next to an edge may be, on the side of `usual`, which has its sign. What it
  // errs grows like h^(5/2).
  static double least(const SwitchWatch& switches, const Border& edge, const RotorState& s,
                      double usual, const EdgeRule& rule) {
    constexpr double power = 2.5;
    const double most = error_part * rule.tolerance;
    const auto error = [&](double h) {
      return rule.power_error * std::abs(h) * switches.bend(edge.which, edge.t, s, h);
    };
    double h = most_part * usual, e = error(h);
    if (e * std::pow(1.0 / most_part, power) <= most)
      return std::numeric_limits<double>::infinity();
    for (int trip = 0; trip < 8 && e > most; ++trip) {
      h *= std::max(0.9 * std::pow(most / e, 1.0 / power), 1e-4);
      e = error(h);
    }
    return std::max(std::abs(h), 16.0 * epsilon<double>() * std::abs(edge.t));
  }

  // Functions along the time, of a body that stays as it is.
  class Ahead final : public SwitchCurve {
   public:
    Ahead(const EdgeGrading& of, const SwitchWatch& switches, const DoubleDouble& t,
          const RotorState& s, double h)
        : of_(of), switches_(switches), t_(t), s_(s), h_(h) {}
    std::vector<double> along(double x) const override {
      std::vector<double> values = switches_.values(t_ + x * h_, s_);
      for (std::size_t i = 0; i < values.size(); ++i)
        if (!of_.is_fading_[i]) values[i] = 1.0;
      return values;
    }
    double truly(std::size_t which, double x) const override { return along(x)[which]; }
    double rounding(std::size_t which) const override { return switches_.rounding(which); }

   private:
    const EdgeGrading& of_;
    const SwitchWatch& switches_;
    DoubleDouble t_;
    RotorState s_;
    double h_;
  };

  void find_fading(const SwitchWatch& switches, const DoubleDouble& t, const RotorState& s) {
    is_fading_.resize(switches.size());
    for (std::size_t i = 0; i < is_fading_.size(); ++i) is_fading_[i] = switches.is_fading(i, t, s);
  }
  bool has_any() const {
    return std::find(is_fading_.begin(), is_fading_.end(), true) != is_fading_.end();
  }
  // How far ahead the next one is, if it is nearer than h; looked for where the other end is
  // beyond. Once it is found it stays where it is, for it is one of the time alone.
  std::optional<double> edge_within(const SwitchWatch& switches, const DoubleDouble& t,
                                    const RotorState& s, double h) {
    if (next_) {
      const double way = (DoubleDouble(next_->t) - t).hi;
      if (way * h > 0.0) return std::abs(way);
      next_.reset();
    }
    if (h == 0.0) return std::nullopt;
    const Ahead curve(*this, switches, t, s, h);
    const std::vector<double> end = curve.along(1.0);
    bool is_beyond = false;
    for (std::size_t i = 0; i < end.size(); ++i)
      is_beyond = is_beyond || end[i] < -switches.rounding(i);
    if (!is_beyond) return std::nullopt;
    const std::optional<Edge> edge = search_edges(curve).first;
    if (!edge || edge->is_nan) return std::nullopt;
    next_ = Border{edge->which, (t + edge->x * h).hi, std::nullopt};
    return edge->x * std::abs(h);
  }

  std::vector<bool> is_fading_;
  std::optional<Border> last_, next_;
  double usual_ = 0.0;  // wanted far from all
  bool is_near_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
