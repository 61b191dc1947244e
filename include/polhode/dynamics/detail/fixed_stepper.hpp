// SPDX-License-Identifier: MIT
// FixedStepper: steps of one length by a map of the state. The last step of a run may be shorter,
// and dense output is a shorter step from the same start.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "polhode/dynamics/detail/stepper.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// A state with the time to which it belongs, in two parts so that many steps lose nothing.
template <MotionState S>
struct TimedState {
  DoubleDouble t;
  S s;
};

template <MotionState S>
bool has_finite_numbers(S s) {
  double sum = 0.0;
  each_number(s, [&sum](double& x) { sum += x; });
  return std::isfinite(sum);
}

// Why steps of this length cannot be made at t.
std::string below_rounding_text(double step, double t);

// `Map` has
//   State, with a time t = {hi, lo}, and Shown, the state of samples;
//   State stepped(State, double h) const, a step of any length, h of either sign;
//   Shown state(const State&) const, normalised;
//   std::string obstacle(const State& from, double h) const, optional: why no step is tried;
//   std::string failure(const State& from, State& to): why `to` is no state, or empty;
//   std::int64_t evaluations(const State&, std::int64_t steps) const;
//   void serialize(Archive&, State&) const, and optional void serialize(Archive&), its own state.
template <class Map>
class FixedStepper final : public BasicStepper<typename Map::Shown> {
  using State = typename Map::State;
  using Shown = typename Map::Shown;

  class Dense final : public BasicDenseStep<Shown> {
   public:
    Dense(std::shared_ptr<const Map> map, const State& start, const State& end)
        : BasicDenseStep<Shown>(start.t.hi, end.t.hi), map_(std::move(map)), start_(start) {}
    Shown at(double t) const override {
      return map_->state(map_->stepped(start_, (t - start_.t.hi) - start_.t.lo));
    }

   private:
    std::shared_ptr<const Map> map_;
    State start_;
  };

 public:
  FixedStepper(Map map, State start, double step)
      : map_(std::make_shared<Map>(std::move(map))),
        step_(step),
        now_(std::move(start)),
        before_(now_) {}

  std::string advance(double stop) override {
    constexpr double stretch = 1e-9;  // the last step may be longer, rather than leave a sliver
    const double rest = (stop - now_.t.hi) - now_.t.lo;
    const bool last = !(std::abs(rest) > step_ * (1.0 + stretch));
    const double h = last ? rest : std::copysign(step_, rest);
    if (!last && now_.t.hi + h == now_.t.hi) return below_rounding_text(step_, now_.t.hi);
    if constexpr (requires { map_->obstacle(now_, h); })
      if (std::string why = map_->obstacle(now_, h); !why.empty()) return why;
    State next = map_->stepped(now_, h);
    if (std::string why = map_->failure(now_, next); !why.empty()) return why;
    if (last) next.t = {stop, 0.0};
    before_ = std::exchange(now_, std::move(next));
    ++steps_;
    return {};
  }

  double time() const override { return now_.t.hi; }
  Shown state() const override { return map_->state(now_); }
  std::shared_ptr<const BasicDenseStep<Shown>> dense(bool) override {
    return std::make_shared<Dense>(map_, before_, now_);
  }
  Statistics statistics() const override { return {steps_, 0, map_->evaluations(now_, steps_)}; }
  void serialize(Archive& bytes) override {
    map_->serialize(bytes, now_);
    map_->serialize(bytes, before_);
    if constexpr (requires { map_->serialize(bytes); }) map_->serialize(bytes);
    bytes(steps_);
  }

 private:
  std::shared_ptr<Map> map_;  // shared with dense output, which does not change it
  double step_;
  State now_;
  State before_;
  std::int64_t steps_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
