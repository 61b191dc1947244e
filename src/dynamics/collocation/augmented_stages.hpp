// SPDX-License-Identifier: MIT
// The stages of a state that begins with a rotor and goes on with further numbers.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "dynamics/collocation/gauss_scheme.hpp"
#include "dynamics/collocation/rotor_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline RotorState rotor_at_stage(const StageStates& at, std::size_t i) {
  const auto n = [&](std::size_t k) { return at.rows[k][i]; };
  return {{n(0), n(1), n(2), n(3)}, {n(4), n(5), n(6)}};
}

// What the kinds of them share. `F` is a field whose values are 7 + more doubles, and which knows
// the field of its rotor alone.
template <class F, std::size_t more>
class AugmentedStages {
 public:
  static constexpr std::size_t numbers = 7 + more;
  using Field = F;
  using Rates = SmoothField<F>;
  using Values = std::array<double, numbers>;
  using State = CompensatedState<double, numbers>;
  using Rows = std::array<StageRow, numbers>;

  AugmentedStages(std::shared_ptr<const F> field, std::size_t stages, InstructionSet set)
      : field_(std::move(field)),
        rotor_(std::shared_ptr<const RotorStages::Field>(field_, &field_->rotor_alone()), stages,
               set),
        lanes_(number_lanes(stages, set)),
        rest_(more) {}
  // The stages of the rotor know where a term of them is.
  AugmentedStages(const AugmentedStages&) = delete;
  AugmentedStages& operator=(const AugmentedStages&) = delete;

  const GaussScheme& scheme() const { return rotor_.scheme(); }
  const DoubleDouble& length() const { return rotor_.length(); }
  static Rows blank(std::size_t) { return {}; }

  void begin(const DoubleDouble& t, const State& start, double h, const SwitchSides* sides) {
    RotorStages::State first{};
    std::copy_n(start.y.begin(), 7, first.y.begin());
    std::copy_n(start.carry.begin(), 7, first.carry.begin());
    rotor_.begin(t, first, h, sides);
    std::copy(start.y.begin() + 7, start.y.end(), rest_.y.begin());
    std::copy(start.carry.begin() + 7, start.carry.end(), rest_.carry.begin());
    sides_ = sides;
  }
  void guess_start() {
    rotor_.guess_start();
    for (StageRow& row : rest_.F) row = {};
    place();
  }
  void guess(const Rows& coefficients, const StageMatrix& at_stages, const AugmentedStages& of) {
    RotorStages::Rows first{};
    std::copy_n(coefficients.begin(), 7, first.begin());
    rotor_.guess(first, at_stages, of.rotor_);
    of.lanes_.transform(at_stages, scheme().stages, coefficients.data() + 7, more, rest_.F.data());
    place();
  }
  void coefficients(Rows& to) const {
    RotorStages::Rows first{};
    rotor_.coefficients(first);
    std::copy(first.begin(), first.end(), to.begin());
    lanes_.transform(scheme().coefficient, scheme().stages, rest_.F.data(), more, to.data() + 7);
  }
  bool drive(RotorStages::Rows& to) const { return rotor_.drive(to); }
  bool is_smooth() const { return rotor_.is_smooth(); }
  bool has_unnamed_kinks() const { return rotor_.has_unnamed_kinks(); }
  std::array<double, 6> effects(const DoubleDouble& t, const Values& y,
                                const SwitchSides* sides) const {
    RotorStages::Values first{};
    std::copy_n(y.begin(), 7, first.begin());
    return rotor_.effects(t, first, sides);
  }
  State finished() {
    const RotorStages::State first = rotor_.finished();
    lanes_.finish(rotor_.weights(), rest_);
    State s;
    std::copy_n(first.y.begin(), 7, s.y.begin());
    std::copy_n(first.carry.begin(), 7, s.carry.begin());
    std::copy(rest_.y.begin(), rest_.y.end(), s.y.begin() + 7);
    std::copy(rest_.carry.begin(), rest_.carry.end(), s.carry.begin() + 7);
    return s;
  }

 protected:
  // Further numbers `first` to `last` from their rates; by how much each changed at most.
  const std::array<double, more>& move(std::size_t first, std::size_t last) {
    lanes_.move(scheme(), rotor_.weights(), rest_, first, last, changes_.data());
    return changes_;
  }
  double at_stage(std::size_t i, std::size_t n) const { return rotor_.states().rows[n][i]; }
  DoubleDouble time(std::size_t i) const { return {rotor_.times().t[i], rotor_.times().t_rest[i]}; }

  std::shared_ptr<const F> field_;
  RotorStages rotor_;
  NumberLanes lanes_;
  NumberStep rest_;
  const SwitchSides* sides_ = nullptr;

 private:
  void place() { move(0, more); }

  std::array<double, more> changes_{};
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
