// SPDX-License-Identifier: MIT
#include "polhode/dynamics/custom_method.hpp"

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/steppers.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// What an CustomMethod holds.
struct StepperMaker {
  double step;
  StepMap map;
};

namespace {

// The last step may be longer than the others by this, rather than leave a sliver.
constexpr double stretch = 1e-9;

struct Mapped {
  std::shared_ptr<const StepperMaker> maker;
  System system;

  RotorState stepped(double t, const RotorState& s, double h) const {
    RotorState next = maker->map(system, t, s, h);
    next.q = normalized(next.q);
    return next;
  }
};

// A shorter step from the same start.
class CustomDense final : public DenseStep {
 public:
  CustomDense(std::shared_ptr<const Mapped> map, DoubleDouble start, const RotorState& s,
              double end)
      : DenseStep(start.hi, end), map_(std::move(map)), start_(start), s_(s) {}
  RotorState at(double t) const override {
    return map_->stepped(start_.hi, s_, (t - start_.hi) - start_.lo);
  }

 private:
  std::shared_ptr<const Mapped> map_;
  DoubleDouble start_;
  RotorState s_;
};

class CustomStepper final : public Stepper {
 public:
  CustomStepper(const Problem& problem, const CustomMethod& method)
      : map_(std::make_shared<const Mapped>(Mapped{method.maker, problem.system})),
        t_(problem.start),
        before_(t_),
        s_(problem.initial),
        s_before_(s_) {}

  std::string advance(double stop) override {
    const double step = map_->maker->step;
    const double rest = (stop - t_.hi) - t_.lo;
    const bool last = !(std::abs(rest) > step * (1.0 + stretch));
    const double h = last ? rest : std::copysign(step, rest);
    if (!last && t_.hi + h == t_.hi)
      return "step " + number_text(step) + " is below the rounding of t = " + number_text(t_.hi) +
             ": take a larger step or count time from a nearer epoch";
    const RotorState next = map_->stepped(t_.hi, s_, h);
    if (!is_finite(next))
      return "the state is not finite after the step from t = " + number_text(t_.hi) +
             ": take a smaller step, or see whether the map or a term grows without bound";
    before_ = t_;
    s_before_ = s_;
    t_ = last ? DoubleDouble(stop) : t_ + DoubleDouble(h);
    s_ = next;
    ++steps_;
    return "";
  }

  double time() const override { return t_.hi; }
  RotorState state() const override { return s_; }
  std::shared_ptr<const DenseStep> dense(bool) override {
    return std::make_shared<CustomDense>(map_, before_, s_before_, t_.hi);
  }
  Statistics statistics() const override { return {steps_, 0, steps_}; }
  void serialize(Archive& bytes) override {
    bytes.all(t_, before_, steps_);
    bytes(s_);
    bytes(s_before_);
  }

 private:
  static bool is_finite(const RotorState& s) {
    return std::isfinite(s.q.w + s.q.x + s.q.y + s.q.z + s.g.x + s.g.y + s.g.z);
  }

  std::shared_ptr<const Mapped> map_;
  DoubleDouble t_;
  DoubleDouble before_;
  RotorState s_;
  RotorState s_before_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<Stepper> make_stepper(const Problem& problem, const CustomMethod& method) {
  return std::make_unique<CustomStepper>(problem, method);
}

}  // namespace detail

CustomMethod custom_method(FixedStepMap steps) {
  if (steps.kind.empty()) throw DomainError("custom_method: got an empty kind; expected a name");
  const std::string shown = "custom_method: " + steps.kind + ": ";
  if (!(steps.step > 0.0) || !std::isfinite(steps.step))
    throw DomainError(shown + "step " + detail::number_text(steps.step) +
                      " must be positive and finite");
  if (!steps.map) throw DomainError(shown + "got no map; expected one that makes a step");
  MethodTraits traits{.kind = steps.kind,
                      .text = steps.kind + ", step " + detail::number_text(steps.step),
                      .further = std::move(steps.further),
                      .step = steps.step};
  return {std::move(traits), std::make_shared<const detail::StepperMaker>(
                                 detail::StepperMaker{steps.step, std::move(steps.map)})};
}

}  // namespace v0
}  // namespace polhode
