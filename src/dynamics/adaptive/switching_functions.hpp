// SPDX-License-Identifier: MIT
// Switching functions of a system: on which side of each a run is, and steps that shrink towards an
// edge.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/events/edge_search.hpp"
#include "math/finite.hpp"
#include "polhode/detail/trajectory/archive.hpp"
#include "system/rotor_equations.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The side of every switching function of a system on which a run is.
class SwitchWatch {
 public:
  // `jumps`, where it is not null, says why no torque may jump at an edge that the state decides:
  // the end of the sentence that refuses it.
  explicit SwitchWatch(const System& system, const char* jumps = nullptr);

  // Whether any term may name a switching function.
  bool is_needed() const { return needed_; }
  // Before the first step: the sides are those of the values. Nothing later. Empty, or which
  // function is NaN.
  std::string begin(const DoubleDouble& t, const RotorState& s);
  // Of the step to come; nullptr where no term has a switching function.
  const std::shared_ptr<const SwitchSides>& sides() const { return sides_; }
  std::size_t size() const { return sides_ ? sides_->values.size() : 0; }

  // The values times their sides: negative where a function has changed its sign. q is a unit
  // quaternion. DomainError when a term does not have as many as before.
  std::vector<double> values(const DoubleDouble& t, const RotorState& s) const;

  // In which the body turns little enough that a facet that turns away and back is seen: within a
  // step the sides are frozen, and light or air would go on from behind.
  double longest_step(const RotorState& s) const;

  // A step has ended where function `which` is zero: its other side holds.
  void cross(std::size_t which);
  // The same without a step between. False when that is said repeatedly: the motion is held
  // at the zero.
  bool cross_at_once(std::size_t which);
  void stepped() { crossed_at_once_ = 0; }
  // Values at the end of a step: how large each function is, and so what of it is rounding.
  void see(const std::vector<double>& values);
  // Below minus this a function has changed its sign; nearer to zero it may stay.
  double rounding(std::size_t which) const;
  // The term of a function and its number in it.
  std::string text(std::size_t which) const;
  std::string nan_text(std::size_t which, double t) const;
  // Why a step may not end at the zero of function `which` at t, in state s; empty when it may, and
  // always without `jumps`. `before` are states of the step: what a kink does to the torque grows
  // away from the zero, and what a jump does is there already.
  std::string refused_jump(std::size_t which, const DoubleDouble& t, const RotorState& s,
                           std::initializer_list<RotorState> before) const;
  // Whether function `which` is the border of a penumbra: one of time alone, at which the torque
  // begins like a fractional power.
  bool is_fading(std::size_t which, const DoubleDouble& t, const RotorState& s) const;

  // By how much the effect of its term is off a straight line in the time from t to t + h, on the
  // sides that hold, per momentum: the largest of a body as it is and turned. Of a fractional power
  // that begins at t.
  double bend(std::size_t which, const DoubleDouble& t, const RotorState& s, double h) const;

  void serialize(Archive& bytes);
  // Sides that the dense output of a step keeps.
  void serialize(Archive& bytes, std::shared_ptr<const SwitchSides>& sides) const;

 private:
  std::size_t term_of(std::size_t which) const;
  bool depends_on_state(std::size_t which, const DoubleDouble& t, const RotorState& s) const;
  // What the change of side adds to the torque and the rate of its term.
  Effect change(std::size_t which, const DoubleDouble& t, const RotorState& s) const;

  System system_;
  const char* jumps_;
  bool needed_;
  bool begun_ = false;
  std::shared_ptr<const SwitchSides> sides_;
  int crossed_at_once_ = 0;
  std::vector<double> largest_;  // of each function, so far
};

// Of a method: its tolerance, and what a step of 1 next to an edge errs, of the bend of the torque.
struct EdgeRule {
  double tolerance;
  double power_error;
};

// Steps that grow away from an edge and shrink towards it, for methods whose polynomials span whole
// steps.
//
// In a penumbra the light grows like the power 3/2 of the time since its edge: Gauss' quadrature of
// a step of h that begins there errs like h^(5/2), and nothing shows it next to smooth torques. A
// step that is no longer than its distance from the edge converges by a factor of 5.8 a degree. The
// step next to the edge is so short that what it errs is a small part of the tolerance, by the bend
// of the torque there. On the other side of the edge, where there is no power, it is not shorter.
//
// The edges are the borders of penumbras. Others, of facets that turn away or of a shadow like a
// cylinder, have smooth sides.
class SwitchStepControl {
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
  void serialize(Visit& visit) {
    std::vector<double> fading(is_fading_.begin(), is_fading_.end());
    visit.all(fading, usual_, is_near_);
    is_fading_.assign(fading.begin(), fading.end());
    for (std::optional<Border>* border : {&last_, &next_}) {
      bool is_there = border->has_value();
      visit(is_there);
      if (!is_there) border->reset();
      if (is_there && !*border) *border = Border{};
      if (is_there) (*border)->serialize(visit);
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
    void serialize(Visit& visit) {
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
    Ahead(const SwitchStepControl& of, const SwitchWatch& switches, const DoubleDouble& t,
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
    const SwitchStepControl& of_;
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
