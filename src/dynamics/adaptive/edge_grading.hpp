// SPDX-License-Identifier: MIT
// Steps that grow away from an edge and shrink towards it, for methods whose polynomials span whole
// steps.
//
// In a penumbra the light grows like the power 3/2 of the time since its edge: Gauss' quadrature of
// a step of h that begins there errs like h^(5/2), and nothing shows it next to smooth torques. A
// step that is no longer than its distance from the edge converges by a factor of 5.8 a degree.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "dynamics/adaptive/edge_search.hpp"
#include "dynamics/adaptive/switch_watch.hpp"
#include "math/larger.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

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
                 double wanted, double rest) {
    if (!has_any()) return wanted;
    const double usual = larger(usual_, wanted), least = least_part * usual;
    const double behind = last_ ? std::abs((t - *last_).hi) : usual;
    const double far = std::copysign(std::min(2.0 * usual, std::abs(rest)), rest);
    const std::optional<double> ahead = edge_within(switches, t, s, far);
    if (behind >= usual && !ahead) {
      // steps next to an edge say nothing of those beyond
      if (!is_near_) usual_ = wanted;
      is_near_ = false;
      return usual_;
    }
    if (usual_ == 0.0) usual_ = wanted;
    is_near_ = true;
    double length = std::min(wanted, larger(behind, least));
    // the last step goes through the edge, where it is found and the step is made to end
    if (ahead) length = std::min(length, *ahead > 2.0 * least ? 0.5 * *ahead : *ahead + least);
    return length;
  }
  // A step has ended at the zero of function `which`.
  void cross(std::size_t which, double t) {
    if (!is_fading_[which]) return;
    last_ = t;
    next_.reset();
  }

  template <class Visit>
  void transfer(Visit& visit) {
    std::vector<double> fading(is_fading_.begin(), is_fading_.end());
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    double last = last_.value_or(none), next = next_.value_or(none);
    visit.all(fading, last, next, usual_, is_near_);
    is_fading_.assign(fading.begin(), fading.end());
    last_ = std::isnan(last) ? std::nullopt : std::optional<double>(last);
    next_ = std::isnan(next) ? std::nullopt : std::optional<double>(next);
  }

 private:
  // Of the length of other steps: 128^(-5/2) of the error is left.
  static constexpr double least_part = 1.0 / 128.0;

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
      const double way = (DoubleDouble(*next_) - t).hi;
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
    next_ = (t + edge->x * h).hi;
    return edge->x * std::abs(h);
  }

  std::vector<bool> is_fading_;
  std::optional<double> last_, next_;  // when the last one was, and the next will be
  double usual_ = 0.0;                 // wanted far from all
  bool is_near_ = false;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
