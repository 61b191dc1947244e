// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <string>

#include "analysis/detail/deviated_state.hpp"
#include "dynamics/splitting/splitting_map.hpp"
#include "math/finite.hpp"
#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double largest_arc = 0x1p20;  // radians a step: as for the motion itself
constexpr double stretch = 1e-9;        // the last step to a sample may be longer by this

// Where a run is: the motion, its deviation of length one (or a neighbour), and what has grown.
struct RunState {
  SplittingState motion;
  Deviation deviation;
  std::optional<SplittingState> neighbour = {};  // where the deviation is that to it
  double growth = 0.0;                           // L
  double integral = 0.0;                         // of L
  double megno_total = 0.0;                      // integral of Y
};

class SplittingDeviation final : public BasicStepper<DeviatedState> {
 public:
  SplittingDeviation(const Problem& problem, const Splitting& method, const ChaosOptions& options,
                     DeviationBy by)
      : map_(problem.system, method.scheme),
        by_(by),
        scale_(options.momentum_scale),
        target_(by == DeviationBy::variational ? 1.0 : options.distance),
        step_(method.step),
        start_(problem.start),
        jumps_(problem.system, unknown_jump),
        grid_(brought_back({map_.start(problem.start, problem.initial), options.deviation})),
        now_(grid_) {}

  // Samples between two steps are parts of a step, which the run does not keep.
  std::string advance(double t) override {
    const double rest = (t - grid_.motion.t.hi) - grid_.motion.t.lo;
    const bool last = !(std::abs(rest) > step_ * (1.0 + stretch));
    const double h = last ? rest : std::copysign(step_, rest);
    if (!last && grid_.motion.t.hi + h == grid_.motion.t.hi)
      return "step " + number_text(step_) +
             " is below the rounding of t = " + number_text(grid_.motion.t.hi) +
             ": take a larger step";
    if (map_.rate(grid_.motion) * std::abs(h) > largest_arc)
      return "a step is more than 1e6 radians of rotation at t = " +
             number_text(grid_.motion.t.hi) + ": take a step of less than a turn";
    RunState next = stepped(grid_, h);
    const RotorState s = map_.state(next.motion);
    if (!is_finite(s.g) || !std::isfinite(s.q.w + s.q.x + s.q.y + s.q.z) ||
        !std::isfinite(next.growth))
      return "the state or its deviation is not finite near t = " + number_text(t) +
             ": take a smaller step, or see whether a term is finite there";
    const bool is_whole = !last || std::abs(std::abs(h) - step_) <= stretch * step_;
    std::string refused = is_whole ? jumps_.seen(map_, grid_.motion, h, next.motion)
                                   : jumps_.seen_in_part(map_, grid_.motion, h, next.motion);
    if (!refused.empty()) return refused;
    ++steps_;
    if (last) next.motion.t = {t, 0.0};
    if (next.neighbour) next.neighbour->t = next.motion.t;
    now_ = next;
    if (is_whole) grid_ = now_;
    return {};
  }
  double time() const override { return now_.motion.t.hi; }
  DeviatedState state() const override {
    return {map_.state(now_.motion), now_.deviation, now_.growth, now_.integral, now_.megno_total};
  }
  std::shared_ptr<const BasicDenseStep<DeviatedState>> dense(bool) override { return nullptr; }
  Statistics statistics() const override { return {steps_, 0, now_.motion.evaluations}; }
  void serialize(Archive& bytes) override {
    for (RunState* run : {&grid_, &now_}) {
      detail::serialize(bytes, run->motion);
      bytes.all(run->deviation.turn, run->deviation.momentum, run->growth, run->integral,
                run->megno_total);
      if (run->neighbour) detail::serialize(bytes, *run->neighbour);
    }
    jumps_.serialize(bytes);
    bytes(steps_);
  }

 private:
  double elapsed(const RunState& run) const {
    return std::abs((run.motion.t.hi - start_) + run.motion.t.lo);
  }

  RunState stepped(const RunState& from, double h) const {
    RunState to = from;
    if (by_ == DeviationBy::variational) {
      const Vec3 dg = scale_ * from.deviation.momentum;
      const Vec3& turn = from.deviation.turn;
      const DeviationStep step =
          map_.step_deviation(from.motion, {turn.x, turn.y, turn.z, dg.x, dg.y, dg.z}, h);
      const std::array<double, 6>& x = step.x;
      to.motion = step.end;
      to.deviation = {{x[0], x[1], x[2]}, (1.0 / scale_) * Vec3{x[3], x[4], x[5]}};
    } else {
      to.motion = map_.stepped(from.motion, h);
      to.neighbour = map_.stepped(*from.neighbour, h);
      to.deviation = difference(to.motion, *to.neighbour);
    }
    to.growth = from.growth + std::log(length(to.deviation) / length(from.deviation));
    to = brought_back(to);
    // trapezoids: of a function without a trend over equal steps they converge as fast as the
    // function is smooth
    const double half = 0.5 * std::abs(h);
    to.integral = from.integral + half * (from.growth + to.growth);
    to.megno_total =
        from.megno_total + half * (megno(from.growth, from.integral, elapsed(from)) +
                                   megno(to.growth, to.integral, elapsed(from) + std::abs(h)));
    return to;
  }

  RunState brought_back(RunState run) const {
    const double size = length(run.deviation);
    const bool is_near = target_ < neighbour_reach * size && size < neighbour_reach * target_;
    if (run.neighbour && is_near) return run;
    run.deviation = scaled(run.deviation, target_ / size);
    if (by_ == DeviationBy::neighbour) {
      run.neighbour = neighbour_of(run);
      run.deviation = difference(run.motion, *run.neighbour);  // as it is after rounding
    }
    return run;
  }
  SplittingState neighbour_of(const RunState& run) const {
    const RotorState s = moved_by({run.motion.q_IB, run.motion.g.hi}, run.deviation, scale_);
    SplittingState other = run.motion;
    other.q_IB = s.q;
    other.g = {s.g, run.motion.g.lo};
    other.torque.reset();
    return other;
  }
  Deviation difference(const SplittingState& a, const SplittingState& b) const {
    return deviation({a.q_IB, a.g.hi}, {b.q_IB, b.g.hi}, scale_);
  }

  SplittingMap map_;
  DeviationBy by_;
  double scale_;
  double target_;
  double step_;
  double start_;
  StepJumps jumps_;  // after whole steps
  RunState grid_;    // after whole steps
  RunState now_;
  std::int64_t steps_ = 0;
};

}  // namespace

std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Splitting& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by) {
  return std::make_unique<SplittingDeviation>(problem, method, options, by);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
