// SPDX-License-Identifier: MIT
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/splitting/splitting_map.hpp"
#include "dynamics/steppers.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// A step beyond this many radians has lost its phase to rounding, and no kick can follow.
constexpr double largest_arc = 0x1p20;
// The last step may be longer than the others by this, rather than leave a sliver.
constexpr double stretch = 1e-9;

bool finite(const SplittingState& s) {
  const double sum = s.q_IB.w + s.q_IB.x + s.q_IB.y + s.q_IB.z + s.g.hi.x + s.g.hi.y + s.g.hi.z;
  return std::isfinite(sum);
}

// A shorter step of the same scheme from the same start.
class SplittingDense final : public DenseStep {
 public:
  SplittingDense(std::shared_ptr<const SplittingMap> map, const SplittingState& start,
                 const SplittingState& end)
      : DenseStep(start.t.hi, end.t.hi), map_(std::move(map)), start_(start) {}
  RotorState at(double t) const override {
    return map_->state(map_->stepped(start_, (t - start_.t.hi) - start_.t.lo));
  }

 private:
  std::shared_ptr<const SplittingMap> map_;
  SplittingState start_;
};

class SplittingStepper final : public Stepper {
 public:
  SplittingStepper(const Problem& problem, const Splitting& method)
      : map_(std::make_shared<const SplittingMap>(problem.system, method.scheme)),
        step_(method.step),
        now_(map_->start(problem.start, problem.initial)),
        before_(now_) {}

  std::string advance(double stop) override {
    const double rest = (stop - now_.t.hi) - now_.t.lo;
    const bool last = !(std::abs(rest) > step_ * (1.0 + stretch));
    const double h = last ? rest : std::copysign(step_, rest);
    if (!last && now_.t.hi + h == now_.t.hi)
      return "step " + number_text(step_) +
             " is below the rounding of t = " + number_text(now_.t.hi) +
             ": take a larger step or count time from a nearer epoch";
    const double arc = map_->rate(now_) * std::abs(h);
    if (arc > largest_arc)
      return "step " + number_text(step_) + " is " + number_text(std::rint(arc)) +
             " radians of rotation at t = " + number_text(now_.t.hi) +
             ": take a step of less than a turn";
    SplittingState next = map_->stepped(now_, h);
    if (!finite(next)) return not_finite(next);
    if (last) next.t = {stop, 0.0};
    before_ = now_;
    now_ = next;
    ++steps_;
    return "";
  }

  double time() const override { return now_.t.hi; }
  RotorState state() const override { return map_->state(now_); }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<SplittingDense>(map_, before_, now_);
  }
  Statistics statistics() const override { return {steps_, 0, now_.evaluations}; }
  void serialize(Archive& bytes) override {
    detail::serialize(bytes, now_);
    detail::serialize(bytes, before_);
    bytes(steps_);
  }

 private:
  // The step that failed is gone through again in small pieces: which term was it?
  std::string not_finite(const SplittingState& next) const {
    const double piece = (next.t.hi - now_.t.hi) / 16.0;
    SplittingState s = now_;
    std::string name = map_->term_not_finite(s);
    for (int i = 0; name.empty() && i < 16; ++i) {  // 16 trips
      SplittingState tried = map_->stepped(s, piece);
      if (finite(tried)) {
        s = tried;
        name = map_->term_not_finite(s);
      } else {
        s.t.hi += piece;
        name = map_->term_not_finite(s);
        break;
      }
    }
    const std::string place = "t = " + number_text(s.t.hi);
    if (name.empty() && map_->may_grow_backwards())
      return "the state is not finite near " + place +
             ": a part of a step of this scheme goes back in time, where a strong damping grows: "
             "take a smaller step, or the scheme order 2";
    if (name.empty())
      return "the state is not finite near " + place +
             ": take a smaller step, or see whether a term grows without bound";
    return "term \"" + name + "\" is not finite near " + place + ": check it there, or stop before";
  }

  std::shared_ptr<const SplittingMap> map_;
  double step_;
  SplittingState now_;
  SplittingState before_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const Splitting& method) {
  return std::make_unique<SplittingStepper>(problem, method);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
