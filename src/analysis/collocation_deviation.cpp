// SPDX-License-Identifier: MIT
#include <utility>

#include "analysis/detail/swept_deviation.hpp"
#include "dynamics/collocation/collocation_stepper.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

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

class VariationStages : public TangentStages<SweptDeviation<SweptVariation>, 1, 3> {
 public:
  using TangentStages::TangentStages;

 protected:
  SweepsEnd motions_solved(double enough, std::int64_t& sweeps) {
    return TangentStages::solved(enough, sweeps);
  }
  RotorState first_at(std::size_t i) const { return rotor_at_stage(rotor_.states(), i); }
  RotorState beside_at(std::size_t i) const {
    const auto n = [&](std::size_t k) { return rest_.Y[k][i]; };
    return {{n(0), n(1), n(2), n(3)}, {n(4), n(5), n(6)}};
  }
};

// Both on the sides of the first: they part by less than a step can see.
class NeighbourStages : public JoinedStages<SweptDeviation<SweptNeighbour>, 10> {
 public:
  static constexpr int motions = 2;

  NeighbourStages(const std::shared_ptr<const Field>& field, std::size_t stages, InstructionSet set)
      : JoinedStages(field, stages, set),
        other_(std::shared_ptr<const RotorStages::Field>(field, &field->rotor_alone()), stages,
               set) {}

  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides* sides) {
    JoinedStages::begin(t, start, h, sides);
    RotorStages::State s{};
    std::copy_n(start.y.begin() + Field::beside, 7, s.y.begin());
    std::copy_n(start.carry.begin() + Field::beside, 7, s.carry.begin());
    other_.begin(t, s, h, sides);
  }
  void guess_start() {
    JoinedStages::guess_start();
    other_.guess_start();
  }
  void guess(const Rows& coefficients, const StageMatrix& at_stages, const NeighbourStages& of) {
    JoinedStages::guess(coefficients, at_stages, of);
    RotorStages::Rows rows{};
    std::copy_n(coefficients.begin() + Field::beside, 7, rows.begin());
    other_.guess(rows, at_stages, of.other_);
  }
  void coefficients(Rows& to) const {
    JoinedStages::coefficients(to);
    RotorStages::Rows rows{};
    other_.coefficients(rows);
    std::copy(rows.begin(), rows.end(), to.begin() + Field::beside);
  }
  State finished() {
    State s = JoinedStages::finished();
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
      SmoothSteps(problem.system, unknown_jump), problem.start, y, method,
      collocation_control(problem.system, problem.start, method));
}

}  // namespace

std::unique_ptr<BasicStepper<DeviatedState>> deviation_stepper(const Problem& problem,
                                                               const Collocation& method,
                                                               const ChaosOptions& options,
                                                               DeviationBy by) {
  if (by == DeviationBy::variational)
    return stepper_by<GrowthOnStages<VariationStages>>(problem, method, options, 1.0);
  return stepper_by<GrowthOnStages<NeighbourStages>>(problem, method, options, options.distance);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
