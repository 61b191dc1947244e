// SPDX-License-Identifier: MIT
// The stages of a rotor: its equations of motion inside one step after the other.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "dynamics/adaptive/breakpoints.hpp"
#include "dynamics/adaptive/rotor_field.hpp"
#include "dynamics/collocation/gauss_scheme.hpp"
#include "math/finite.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// `Stages` are the equations of motion of one kind of state inside one step after the other, as
// RotorStages are: types Field, Rates (a callable with a member `field`), Values, State (members y
// and carry) and Rows (one StageRow for each number), and
//   Stages(std::shared_ptr<const Field>, std::size_t stages, InstructionSet)
//   begin(t, state, h, sides)                the step to come
//   guess_start(), guess(rows, matrix, of)   the stages before the first sweep
//   sweep()                                  the largest change; or solved(enough, sweeps)
//   coefficients(rows), drive(rows)          of the rates, and of the terms where they are known
//   effects(t, y, sides)                     of the same terms
//   is_smooth(), has_unnamed_kinks()         what is known of their jumps and kinks
//   finished(), length(), scheme()           the end of the step
//   blank(numbers)                           rows of as many numbers
class RotorStages {
 public:
  using Field = RotorField<double>;
  using Rates = SmoothField<Field>;
  using Values = Field::Values;
  using State = CompensatedState<double, rotor_size<double>>;
  // Of the rates in Legendre polynomials, or at the stages.
  using Rows = std::array<StageRow, 7>;

  RotorStages(std::shared_ptr<const Field> field, std::size_t stages, InstructionSet set)
      : field_(std::move(field)),
        scheme_(gauss_scheme(stages)),
        lanes_(rotor_lanes(stages, set)),
        constants_(constants(field_->system().body())) {
    for (const AnyPerturbation& term : field_->system().terms()) {
      terms_.push_back(term.on_stages(field_->system().body(), set));
      step_.has_rate = step_.has_rate || terms_.back()->adds_rate();
      is_smooth_ = is_smooth_ && terms_.back()->is_smooth();
      has_unnamed_kinks_ = has_unnamed_kinks_ || terms_.back()->has_unnamed_kinks();
    }
    step_.has_frame = !field_->system().frame().is_inertial();
    times_.count = stages;
    times_.is_inertial = !step_.has_frame;
  }

  // One more term, which the system does not know. It outlives the stages, and moves between
  // sweeps, so that a sweep makes one pass.
  void add(StageTerm& term) {
    more_ = &term;
    step_.passes = 1;
    step_.has_rate = step_.has_rate || term.adds_rate();
  }

  const GaussScheme& scheme() const { return scheme_; }
  static Rows blank(std::size_t) { return {}; }
  const StageTimes& times() const { return times_; }
  const StageRow& weights() const { return step_.hb; }  // h b
  const StageStates& states() const { return step_.Y; }
  const Rows& rates() const { return step_.F; }

  // For a step of h from `start` at t: what depends on the time alone is asked.
  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides* sides) {
    if (h != h_) {
      const StepWeights weights = step_weights(scheme_, h);
      step_.hb = weights.hb;
      length_ = weights.length;
      h_ = h;
    }
    std::copy_n(start.y.begin(), 7, step_.y.begin());
    std::copy_n(start.carry.begin(), 7, step_.carry.begin());
    for (std::size_t i = 0; i < scheme_.stages; ++i) {
      const DoubleDouble at = DoubleDouble::sum(t.hi, t.lo + scheme_.c[i] * h);
      times_.t[i] = at.hi;
      times_.t_rest[i] = at.lo;
      if (!step_.has_frame) continue;
      const FrameMotion frame = field_->equations().frame_motion(at);
      times_.q_IS[i] = frame.q_IS;
      for (int n = 0; n < 3; ++n) step_.mu_S[static_cast<std::size_t>(n)][i] = frame.mu_S[n];
    }
    SharedPlaces known;
    if (terms_.size() > 1) times_.known = &known;
    for (std::size_t k = 0; k < terms_.size(); ++k)
      terms_[k]->begin(times_, sides == nullptr ? std::span<const double>() : sides->of(k));
    times_.known = nullptr;
  }
  // The step that begin was told of, to the last bit.
  const DoubleDouble& length() const { return length_; }

  // The first guess: at the start all along, or at rates that a polynomial gives.
  void guess_start() {
    step_.F = {};
    place();
  }
  // `of` are the stages that the coefficients are of.
  void guess(const Rows& coefficients, const StageMatrix& at_stages, const RotorStages& of) {
    of.lanes_.transform(at_stages, scheme_.stages, coefficients, step_.F);
    place();
  }

  static constexpr double settled = settled_change;

  // The largest change of any stage, relative to |q| = 1 and to |g|.
  double sweep() {
    for (const std::unique_ptr<StageTerm>& term : terms_) term->add_to(step_.effects, step_.Y);
    if (more_ != nullptr) more_->add_to(step_.effects, step_.Y);
    const double change = lanes_.sweep(scheme_, constants_, step_);
    if (!(change < 1.0)) lanes_.measure(step_);  // a body that was at rest
    return change;
  }

  void coefficients(Rows& to) const {
    lanes_.transform(scheme_.coefficient, scheme_.stages, step_.F, to);
  }
  // Of the effects of the terms, u and then v. Whether there are any.
  bool drive(Rows& to) const {
    if (terms_.empty() && more_ == nullptr) return false;
    lanes_.transform(scheme_.coefficient, scheme_.stages, step_.drive, to);
    return true;
  }
  // Whether all terms are known to be smooth.
  bool is_smooth() const { return is_smooth_; }
  bool has_unnamed_kinks() const { return has_unnamed_kinks_; }
  // What the terms of the system do at any time, in the order of `drive`.
  std::array<double, 6> effects(const DoubleDouble& t, const Values& y,
                                const SwitchSides* sides) const {
    const RotorEquations<double>& equations = field_->equations();
    Setting at = equations.setting(t, rotor_state(y));
    if (step_.has_frame) at.q_IS = equations.frame_motion(t).q_IS;
    const Effect e = polhode::sum_of_terms(equations.system(), at, sides);
    return {e.u.x, e.u.y, e.u.z, e.v.x, e.v.y, e.v.z};
  }
  // The state at the end, the padding of an array of Values included.
  State finished() {
    lanes_.finish(step_);
    State s{};
    std::copy_n(step_.y.begin(), 7, s.y.begin());
    std::copy_n(step_.carry.begin(), 7, s.carry.begin());
    return s;
  }

 private:
  void place() {
    lanes_.place(scheme_, step_);
    step_.inverse_momentum = inverse_momentum(step_.y);
  }
  static RotorConstants constants(const Body& body) {
    const Vec3& I = body.moments();
    const auto half_inverse = [](double x) { return DoubleDouble(0.5) / x; };
    const auto euler = [](double a, double b) {  // 1/a - 1/b
      return ((DoubleDouble(b) - DoubleDouble(a)) / (DoubleDouble(a) * b)).hi;
    };
    return {{half_inverse(I.x), half_inverse(I.y), half_inverse(I.z)},
            {euler(I.z, I.y), euler(I.x, I.z), euler(I.y, I.x)}};
  }

  std::shared_ptr<const Field> field_;
  const GaussScheme& scheme_;
  RotorLanes lanes_;
  RotorConstants constants_;
  std::vector<std::unique_ptr<StageTerm>> terms_;
  StageTerm* more_ = nullptr;
  StageTimes times_;
  RotorStep step_;
  bool is_smooth_ = true;
  bool has_unnamed_kinks_ = false;
  double h_ = 0.0;
  DoubleDouble length_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
