// SPDX-License-Identifier: MIT
// Splitting of a model that knows its motion while time stands still: that motion and the passing
// of time, in turn. Both are exact, so that a step keeps what the frozen motion keeps.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "polhode/dynamics/detail/splitting_scheme.hpp"
#include "polhode/dynamics/detail/stepper.hpp"
#include "polhode/dynamics/model.hpp"
#include "polhode/math/double_double.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Why a step from t of this length cannot be made; empty: it can.
std::string frozen_failure_text(std::string_view name, double t, double step, bool is_finite);

// One step of any length, h of either sign.
template <FrozenModel M>
struct FrozenMap {
  using S = typename M::State;

  M model;
  // Motions are its drifts, the passing of time its kicks.
  SplittingCoefficients parts;

  S operator()(DoubleDouble t, S s, double h) const {
    if constexpr (requires { model.frozen(std::span<const FrozenPart>(), s); }) {
      std::array<FrozenPart, most_frozen_parts> all;
      std::size_t count = 0;
      each_part(t, h, [&](const DoubleDouble& at, double part) { all[count++] = {at.hi, part}; });
      return model.frozen(std::span<const FrozenPart>(all.data(), count), s);
    } else {
      each_part(t, h, [&](const DoubleDouble& at, double part) { s = model.frozen(at, s, part); });
      return s;
    }
  }

 private:
  template <class Move>
  void each_part(DoubleDouble t, double h, const Move& move) const {
    const std::size_t later = parts.drift_first ? 0 : 1;
    for (std::size_t k = 0; k < parts.drifts.size() + later; ++k) {
      if (k >= later) move(t, parts.drifts[k - later] * h);
      if (k < parts.kicks.size()) t = t + DoubleDouble(parts.kicks[k] * h);
    }
  }
};

// A shorter step from the same start.
template <FrozenModel M>
class FrozenDense final : public BasicDenseStep<typename M::State> {
  using S = typename M::State;

 public:
  FrozenDense(std::shared_ptr<const FrozenMap<M>> map, DoubleDouble start, const S& s, double end)
      : BasicDenseStep<S>(start.hi, end), map_(std::move(map)), start_(start), s_(s) {}
  S at(double t) const override { return (*map_)(start_, s_, (t - start_.hi) - start_.lo); }

 private:
  std::shared_ptr<const FrozenMap<M>> map_;
  DoubleDouble start_;
  S s_;
};

template <FrozenModel M>
class FrozenStepper final : public BasicStepper<typename M::State> {
  using S = typename M::State;

 public:
  FrozenStepper(const M& model, double start, const S& initial, const Splitting& method)
      : map_(std::make_shared<const FrozenMap<M>>(
            FrozenMap<M>{model, splitting_coefficients(method.scheme, false)})),
        step_(method.step),
        t_(start),
        before_(start),
        s_(initial),
        s_before_(initial) {}

  std::string advance(double stop) override {
    constexpr double stretch = 1e-9;  // the last step may be longer, rather than leave a sliver
    const double rest = (stop - t_.hi) - t_.lo;
    const bool last = !(std::abs(rest) > step_ * (1.0 + stretch));
    const double h = last ? rest : std::copysign(step_, rest);
    if (!last && t_.hi + h == t_.hi) return frozen_failure_text(M::name, t_.hi, step_, true);
    S next = (*map_)(t_, s_, h);
    if (!goes_on(next)) return frozen_failure_text(M::name, t_.hi, step_, false);
    before_ = t_;
    s_before_ = s_;
    t_ = last ? DoubleDouble(stop) : t_ + DoubleDouble(h);
    s_ = next;
    ++steps_;
    return "";
  }

  double time() const override { return t_.hi; }
  S state() const override { return s_; }
  std::shared_ptr<const BasicDenseStep<S>> dense(bool) override {
    return std::make_shared<FrozenDense<M>>(map_, before_, s_before_, t_.hi);
  }
  Statistics statistics() const override {
    return {steps_, 0, steps_ * static_cast<std::int64_t>(map_->parts.drifts.size())};
  }
  void serialize(Archive& bytes) override {
    bytes.all(t_, before_, steps_);
    bytes(s_);
    bytes(s_before_);
  }

 private:
  bool goes_on(S& next) const {
    if constexpr (requires { map_->model.goes_on(next); }) return map_->model.goes_on(next);
    double sum = 0.0;
    each_number(next, [&sum](double& x) { sum += x; });
    return std::isfinite(sum);
  }

  std::shared_ptr<const FrozenMap<M>> map_;
  double step_;
  DoubleDouble t_;
  DoubleDouble before_;
  S s_;
  S s_before_;
  std::int64_t steps_ = 0;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
