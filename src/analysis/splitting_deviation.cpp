// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "analysis/detail/deviated_state.hpp"
#include "dynamics/splitting/splitting_map.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace analysis {
namespace detail {
namespace {

// The motion, its deviation of length one (or a neighbour), and what has grown.
struct DeviationOfSplitting : polhode::detail::SplittingState, GrownDeviation {
  std::optional<polhode::detail::SplittingState> neighbour =
      {};  // where the deviation is that to it
};

class DeviationMap {
 public:
  using State = DeviationOfSplitting;
  using Shown = DeviatedState;

  DeviationMap(const Problem& problem, SplittingScheme scheme, const ChaosOptions& options,
               DeviationBy by)
      : map_(problem.system, scheme),
        by_(by),
        scale_(options.momentum_scale),
        target_(by == DeviationBy::variational ? 1.0 : options.distance),
        start_(problem.start),
        jumps_(problem.system, unknown_jump) {}

  State start(const RotorState& s, const Deviation& deviation) const {
    return brought_back({map_.start(start_, s), {deviation}});
  }
  State stepped(const State& from, double h) const {
    State to = from;
    polhode::detail::SplittingState& motion = to;
    if (by_ == DeviationBy::variational) {
      const Deviation& d = from.deviation;
      const polhode::detail::DeviationStep step =
          map_.step_deviation(from, {d.turn, scale_ * d.momentum}, h);
      motion = step.end;
      to.deviation = {step.along.turn, (1.0 / scale_) * step.along.momentum};
    } else {
      motion = map_.stepped(from, h);
      to.neighbour->t = from.t;
      to.neighbour = map_.stepped(*to.neighbour, h);
      to.deviation = difference(to, *to.neighbour);
    }
    to.growth = from.growth + std::log(length(to.deviation) / length(from.deviation));
    to = brought_back(to);
    // trapezoids: of a function without a trend over equal steps they converge as fast as the
    // function is smooth
    const double half = 0.5 * std::abs(h);
    to.growth_integral = from.growth_integral + half * (from.growth + to.growth);
    to.megno_integral = from.megno_integral +
                        half * (megno(from.growth, from.growth_integral, elapsed(from)) +
                                megno(to.growth, to.growth_integral, elapsed(from) + std::abs(h)));
    return to;
  }

  Shown state(const State& at) const { return {map_.state(at), at}; }
  std::string obstacle(const State& from, double h) const { return map_.obstacle(from, h); }
  std::string failure(const State& from, const State& to) {
    std::string why = map_.failure(from, to);
    if (!why.empty()) return why;
    if (!std::isfinite(to.growth))
      return "the deviation is not finite near t = " + polhode::detail::number_text(to.t.hi) +
             ": take a smaller step, or see whether a term is finite there";
    return jumps_.seen(map_, from, to);
  }
  static std::int64_t evaluations(const State& at, std::int64_t) { return at.evaluations; }
  static void serialize(Archive& bytes, State& at) {
    polhode::detail::SplittingMap::serialize(bytes, at);
    each_number(static_cast<GrownDeviation&>(at), bytes);
    if (at.neighbour) polhode::detail::SplittingMap::serialize(bytes, *at.neighbour);
  }
  void serialize(Archive& bytes) { jumps_.serialize(bytes); }

 private:
  double elapsed(const State& at) const { return std::abs((at.t.hi - start_) + at.t.lo); }

  State brought_back(State run) const {
    const double size = length(run.deviation);
    const bool is_near = target_ < neighbour_reach * size && size < neighbour_reach * target_;
    if (run.neighbour && is_near) return run;
    run.deviation = scaled(run.deviation, target_ / size);
    if (by_ == DeviationBy::neighbour) {
      run.neighbour = neighbour_of(run);
      run.deviation = difference(run, *run.neighbour);  // as it is after rounding
    }
    return run;
  }
  polhode::detail::SplittingState neighbour_of(const State& run) const {
    const RotorState s = moved_by({run.q_IB, run.g.hi}, run.deviation, scale_);
    polhode::detail::SplittingState other = run;
    other.q_IB = s.q;
    other.g = {s.g, run.g.lo};
    other.torque.reset();
    return other;
  }
  Deviation difference(const polhode::detail::SplittingState& a,
                       const polhode::detail::SplittingState& b) const {
    return deviation({a.q_IB, a.g.hi}, {b.q_IB, b.g.hi}, scale_);
  }

  polhode::detail::SplittingMap map_;
  DeviationBy by_;
  double scale_;
  double target_;
  double start_;
  polhode::detail::StepJumps jumps_;
};

}  // namespace

std::unique_ptr<polhode::detail::BasicStepper<DeviatedState>> splitting_deviation(
    const Problem& problem, const Splitting& method, const ChaosOptions& options, DeviationBy by) {
  DeviationMap map(problem, method.scheme, options, by);
  const DeviationOfSplitting start = map.start(problem.initial, options.deviation);
  return std::make_unique<polhode::detail::FixedStepper<DeviationMap>>(std::move(map), start,
                                                                       method.step);
}

}  // namespace detail
}  // namespace analysis
}  // namespace v0
}  // namespace polhode
