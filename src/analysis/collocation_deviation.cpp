// SPDX-License-Identifier: MIT
// Chaos indicators by Collocation: the stages of a motion with a deviation from it.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "analysis/detail/deviation_field.hpp"
#include "dynamics/collocation/collocation_stepper.hpp"
#include "dynamics/collocation/variational_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

// At 7: dq and dg, of the derivative of the steps.
class SweptVariation {
 public:
  static constexpr double reach = 0x1p200;

  SweptVariation(const System& system, double momentum_scale)
      : jacobian_(system), scale_(momentum_scale) {}

  const RotorJacobian& jacobian() const { return jacobian_; }
  Deviation deviation(const RotorState& s, const RotorState& d) const {
    const double square = (s.q.w * s.q.w + s.q.x * s.q.x) + (s.q.y * s.q.y + s.q.z * s.q.z);
    const Quaternion half = conj(s.q) * d.q;
    const double two = 2.0 / square;
    return {{two * half.x, two * half.y, two * half.z}, (1.0 / scale_) * d.g};
  }
  RotorState moved(const RotorState& s, const Deviation& d) const {
    const Vec3 half = 0.5 * d.turn;
    return {s.q * Quaternion{0.0, half.x, half.y, half.z}, scale_ * d.momentum};
  }
  double error_size(const RotorState& s, const RotorState& error, const RotorState& d,
                    const RotorState&) const {
    return length(deviation(s, error)) / length(deviation(s, d));
  }

 private:
  RotorJacobian jacobian_;
  double scale_;
};

// At 7: a second motion.
class SweptNeighbour {
 public:
  static constexpr double reach = neighbour_reach;

  SweptNeighbour(const System&, double momentum_scale) : scale_(momentum_scale) {}

  Deviation deviation(const RotorState& s, const RotorState& other) const {
    return detail::deviation(s, other, scale_);
  }
  RotorState moved(const RotorState& s, const Deviation& d) const { return moved_by(s, d, scale_); }
  double error_size(const RotorState&, const RotorState& error, const RotorState& other,
                    const RotorState& increment) const {
    return RotorErrorSize()(rotor_values(error), rotor_values(other), rotor_values(increment));
  }

 private:
  double scale_;
};

// A motion with a deviation from it, as Collocation sees them: the rotor, at 7 the deviation `By`
// one of the two above, at 14 the integral of the growth L, at 15 that of MEGNO; and the logarithm
// of the factor that the deviation was scaled down by.
template <class By>
class SweptDeviation {
 public:
  static constexpr std::size_t size = 17;
  static constexpr std::size_t beside = 7, growth_place = 14, megno_place = 15, behind = 16;
  using Values = std::array<double, size>;
  using State = DeviatedState;

  SweptDeviation(const System& system, const Growth& growth)
      : rotor_(system), by_(system, growth.momentum_scale), growth_(growth) {}

  const RotorField<double>& watched() const { return rotor_; }
  const RotorField<double>& rotor_alone() const { return rotor_; }
  const RotorJacobian& jacobian() const { return by_.jacobian(); }
  const Growth& growth() const { return growth_; }

  // Of the rotor alone: how long the first step is.
  Values operator()(const DoubleDouble& t, const Values& y, const SwitchSides* sides) const {
    const RotorValues<double> f = rotor_(t, rotor_at(y, 0), sides);
    Values r{};
    std::copy_n(f.begin(), 7, r.begin());
    return r;
  }
  Values start(const RotorState& s, const Deviation& d) const {
    Values y{};
    const RotorValues<double> first = rotor_values(s);
    std::copy_n(first.begin(), 7, y.begin());
    put(y, d);
    return y;
  }
  Deviation deviation_of(const Values& y) const {
    return by_.deviation(rotor_state<double>(y), rotor_state<double>(y, beside));
  }
  // L.
  double grown(const RotorState& s, const RotorState& next_to, double scaled_down) const {
    return scaled_down + std::log(length(by_.deviation(s, next_to)) / growth_.initial_length);
  }
  static RotorState rotor(const Values& y) { return rounded(rotor_state<double>(y)); }
  DeviatedState state(const Values& y) const {
    const double L = grown(rotor_state<double>(y), rotor_state<double>(y, beside), y[behind]);
    return {rotor(y), deviation_of(y), L, y[growth_place], y[megno_place]};
  }
  // The error of a motion and that of its deviation, relative to each. The integrals follow: they
  // hold nothing that the rest does not.
  double error_size(const Values& error, const Values& y, const Values& increment) const {
    return larger(
        RotorErrorSize()(rotor_at(error, 0), rotor_at(y, 0), rotor_at(increment, 0)),
        by_.error_size(rotor_state<double>(y), rotor_state<double>(error, beside),
                       rotor_state<double>(y, beside), rotor_state<double>(increment, beside)));
  }
  // After a step: a deviation that is not too long or too short.
  template <class Compensated>
  void rescale(Compensated& s) const {
    const Deviation d = deviation_of(s.y);
    const double length_now = length(d), target = growth_.target;
    if (target < By::reach * length_now && length_now < By::reach * target) return;
    if (!(length_now > 0.0) || !std::isfinite(length_now)) return;  // state() says it
    put(s.y, scaled(d, target / length_now));
    s.y[behind] += std::log(length_now / length(deviation_of(s.y)));
    for (std::size_t i = beside; i < growth_place; ++i) s.carry[i] = 0.0;
  }

 private:
  void put(Values& y, const Deviation& d) const {
    const RotorValues<double> next_to = rotor_values(by_.moved(rotor_state<double>(y), d));
    std::copy_n(next_to.begin(), 7, y.begin() + beside);
  }

  RotorField<double> rotor_;
  By by_;
  Growth growth_;
};

// The integrals of the growth, at the stages of a step whose motions are solved.
template <class Stages>
class GrowthOnStages : public Stages {
 public:
  using Stages::Stages;

  SweepsEnd solved(double enough, std::int64_t& sweeps) {
    const SweepsEnd end = this->motions_solved(enough, sweeps);
    if (end == SweepsEnd::converged) follow();
    return end;
  }

 private:
  using Places = typename Stages::Field;
  static constexpr std::size_t growth = Places::growth_place - 7;
  static constexpr std::size_t megno_integral = Places::megno_place - 7;
  static constexpr std::size_t behind = Places::behind - 7;

  void follow() {
    const Growth& how = this->field_->growth();
    std::array<double, most_stages> L;
    for (std::size_t i = 0; i < this->scheme().stages; ++i) {
      L[i] = this->field_->grown(this->first_at(i), this->beside_at(i), this->rest_.y[behind]);
      this->rest_.F[growth][i] = how.forward * L[i];
      this->rest_.F[behind][i] = 0.0;
    }
    this->move(growth, growth + 1);
    for (std::size_t i = 0; i < this->scheme().stages; ++i)
      this->rest_.F[megno_integral][i] =
          how.forward * megno(L[i], this->rest_.Y[growth][i], how.elapsed(this->time(i)));
    this->move(megno_integral, behind + 1);
  }
};

class DeviationStages : public VariationalStages<SweptDeviation<SweptVariation>, 1, 3> {
 public:
  using VariationalStages::VariationalStages;

 protected:
  SweepsEnd motions_solved(double enough, std::int64_t& sweeps) {
    return VariationalStages::solved(enough, sweeps);
  }
  RotorState first_at(std::size_t i) const { return rotor_at_stage(rotor_.states(), i); }
  RotorState beside_at(std::size_t i) const {
    const auto n = [&](std::size_t k) { return rest_.Y[k][i]; };
    return {{n(0), n(1), n(2), n(3)}, {n(4), n(5), n(6)}};
  }
};

// Both on the sides of the first: they part by less than a step can see.
class NeighbourStages : public AugmentedStages<SweptDeviation<SweptNeighbour>, 10> {
 public:
  static constexpr int motions = 2;

  NeighbourStages(const std::shared_ptr<const Field>& field, std::size_t stages, InstructionSet set)
      : AugmentedStages(field, stages, set),
        other_(std::shared_ptr<const RotorStages::Field>(field, &field->rotor_alone()), stages,
               set) {}

  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides* sides) {
    AugmentedStages::begin(t, start, h, sides);
    RotorStages::State s{};
    std::copy_n(start.y.begin() + Field::beside, 7, s.y.begin());
    std::copy_n(start.carry.begin() + Field::beside, 7, s.carry.begin());
    other_.begin(t, s, h, sides);
  }
  void guess_start() {
    AugmentedStages::guess_start();
    other_.guess_start();
  }
  void guess(const Rows& coefficients, const StageMatrix& at_stages, const NeighbourStages& of) {
    AugmentedStages::guess(coefficients, at_stages, of);
    RotorStages::Rows rows{};
    std::copy_n(coefficients.begin() + Field::beside, 7, rows.begin());
    other_.guess(rows, at_stages, of.other_);
  }
  void coefficients(Rows& to) const {
    AugmentedStages::coefficients(to);
    RotorStages::Rows rows{};
    other_.coefficients(rows);
    std::copy(rows.begin(), rows.end(), to.begin() + Field::beside);
  }
  State finished() {
    State s = AugmentedStages::finished();
    const RotorStages::State other = other_.finished();
    std::copy_n(other.y.begin(), 7, s.y.begin() + Field::beside);
    std::copy_n(other.carry.begin(), 7, s.carry.begin() + Field::beside);
    return s;
  }

 protected:
  SweepsEnd motions_solved(double enough, std::int64_t& sweeps) {
    const SweepsEnd end = swept(rotor_, enough, sweeps);
    return end == SweepsEnd::converged ? swept(other_, enough, sweeps) : end;
  }
  RotorState first_at(std::size_t i) const { return rotor_at_stage(rotor_.states(), i); }
  RotorState beside_at(std::size_t i) const { return rotor_at_stage(other_.states(), i); }

 private:
  RotorStages other_;
};

template <class Stages>
std::unique_ptr<BasicStepper<DeviatedState>> stepper_by(const Problem& problem,
                                                        const Collocation& method,
                                                        const ChaosOptions& options,
                                                        double target) {
  using Field = typename Stages::Field;
  const Deviation first = scaled(options.deviation, target / length(options.deviation));
  Growth growth{problem.start, problem.stop < problem.start ? -1.0 : 1.0, options.momentum_scale,
                target, 1.0};
  const Field unscaled(problem.system, growth);
  const typename Field::Values y = unscaled.start(problem.initial, first);
  growth.initial_length = length(unscaled.deviation_of(y));  // after rounding, of a neighbour
  return std::make_unique<CollocationStepper<Stages>>(
      std::make_shared<const Field>(problem.system, growth),
      SwitchingSteps(problem.system, unknown_jump), problem.start, y, method,
      collocation_control(problem.system, problem.start, method));
}

}  // namespace

std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Collocation& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by) {
  if (by == DeviationBy::variational)
    return stepper_by<GrowthOnStages<DeviationStages>>(problem, method, options, 1.0);
  return stepper_by<GrowthOnStages<NeighbourStages>>(problem, method, options, options.distance);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
