// SPDX-License-Identifier: MIT
// The stages of a term that keeps apart what depends on the time, and of any other.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstring>
#include <memory>
#include <span>

#include "polhode/perturb/detail/law_on_stages.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

inline Setting stage_setting(const Body& body, const StageTimes& times, std::size_t i,
                             std::span<const double> sides) {
  return {body, times.t[i], {}, times.q_IS[i], times.t_rest[i], sides};
}

// A term that answers for many stages by itself.
template <class P>
concept OnStages = requires(const P& term, const Body& body) {
  { term.on_stages(body) } -> std::same_as<std::unique_ptr<StageTerm>>;
};

// The axes of the vectors of a term, which are inertial where it does not say.
template <class P>
SpaceAxes axes_of_vectors(const P& term) {
  if constexpr (requires { term.axes(); }) {
    return term.axes();
  } else {
    return SpaceAxes::inertial;
  }
}

template <Timewise P>
class TimewiseStages final : public StageTerm {
 public:
  using Law = typename P::Law;

  // Both outlive it.
  TimewiseStages(const P& term, const Body& body, InstructionSet set)
      : term_(term),
        body_(body),
        set_(set),
        effect_(law_in_lanes<Law>(set)),
        of_vectors_(lanes_of_vectors(set)) {
    const Vec3& I = body.moments();
    for (std::size_t n = 0; n < 3; ++n)
      std::fill_n(moments_.begin() + n * stage_lanes, stage_lanes, I[static_cast<int>(n)]);
  }

  void begin(const StageTimes& times, std::span<const double> sides) override {
    sides_ = sides;
    count_ = times.count;
    if constexpr (numbers_of_time<Law> > 0) {
      if constexpr (TimewiseTogether<P>) {
        constexpr std::size_t vectors = P::vectors_of_time;
        std::array<StageRow, 3 * vectors> numbers;
        std::array<VectorRows, vectors> rows;
        for (std::size_t k = 0; k < vectors; ++k)
          rows[k] = {numbers[3 * k].data(), numbers[3 * k + 1].data(), numbers[3 * k + 2].data()};
        term_.vectors_at({count_, times.t.data(), times.t_rest.data(), times.known}, rows, set_);
        if constexpr (LawOfVectors<Law, vectors>) {
          fill_up(numbers);
          std::array<StageRow, 4> attitude;
          const bool is_turned =
              !times.is_inertial && axes_of_vectors(term_) == SpaceAxes::inertial;
          if (is_turned) attitude_of_frame(times, attitude);
          of_vectors_(term_.law(), {filled_stages(count_), most_stages, numbers[0].data(),
                                    is_turned ? attitude[0].data() : nullptr, of_time_[0].data()});
          return;
        } else {
          each_stage(times, [&](const Setting& at, std::size_t i) {
            std::array<Vec3, vectors> here;
            for (std::size_t k = 0; k < vectors; ++k) here[k] = rows[k].at(i);
            return term_.of_vectors(at, here);
          });
        }
      } else {
        each_stage(times, [&](const Setting& at, std::size_t) { return term_.of_time(at); });
      }
      fill_up(of_time_);
    }
  }
  void add_to(StageEffects& effects, const StageStates& states) override {
    effect_(term_.law(), sides_,
            {filled_stages(count_), most_stages, first_of_time(), states.rows[0].data(),
             moments_.data(), effects.v[0].data(), effects.u[0].data()});
  }
  bool is_smooth() const override { return LibraryLaw<Law>; }
  bool has_unnamed_kinks() const override { return polhode::has_unnamed_kinks(term_); }
  bool adds_rate() const override { return Law::adds_rate; }

 private:
  template <class Rows>
  void fill_up(Rows& rows) const {
    for (StageRow& row : rows)
      std::fill(row.begin() + count_, row.begin() + filled_stages(count_), row[0]);
  }
  static void attitude_of_frame(const StageTimes& times, std::array<StageRow, 4>& rows) {
    for (std::size_t i = 0; i < filled_stages(times.count); ++i) {
      const Quaternion& q = times.q_IS[i < times.count ? i : 0];
      rows[0][i] = q.w;
      rows[1][i] = q.x;
      rows[2][i] = q.y;
      rows[3][i] = q.z;
    }
  }
  static auto lanes_of_vectors(InstructionSet set) {
    if constexpr (TimewiseTogether<P>) {
      if constexpr (LawOfVectors<Law, P::vectors_of_time>)
        return vectors_in_lanes<Law, P::vectors_of_time>(set);
      else
        return nullptr;
    } else {
      return nullptr;
    }
  }
  // of_time(at, i) of every stage
  template <class F>
  [[gnu::always_inline]] void each_stage(const StageTimes& times, const F& of_time) {
    Setting at = stage_setting(body_, times, 0, sides_);
    for (std::size_t i = 0; i < count_; ++i) {
      at.t = times.t[i];
      at.t_rest = times.t_rest[i];
      at.q_IS = times.q_IS[i];
      const auto numbers = of_time(at, i);
      double parts[numbers_of_time<Law>];
      std::memcpy(parts, &numbers, sizeof parts);
      for (std::size_t n = 0; n < numbers_of_time<Law>; ++n) of_time_[n][i] = parts[n];
    }
  }
  const double* first_of_time() const {
    if constexpr (numbers_of_time<Law> > 0) {
      return of_time_[0].data();
    } else {
      return nullptr;
    }
  }

  const P& term_;
  const Body& body_;
  InstructionSet set_;
  LawOnStages<Law> effect_;
  decltype(lanes_of_vectors(InstructionSet::baseline)) of_vectors_;
  std::span<const double> sides_;
  std::size_t count_ = 0;
  RowsOfTime<Law> of_time_{};
  AlignedRow<3 * stage_lanes> moments_;  // the same in every lane
};

// One stage after the other.
template <Perturbation P>
class SingleStages final : public StageTerm {
 public:
  SingleStages(const P& term, const Body& body) : term_(term), body_(body) {}

  void begin(const StageTimes& times, std::span<const double> sides) override {
    times_ = times;
    sides_ = sides;
  }
  void add_to(StageEffects& effects, const StageStates& states) override {
    for (std::size_t i = 0; i < times_.count; ++i) {
      const auto state = [&](std::size_t n) { return states.rows[n][i]; };
      Setting at = stage_setting(body_, times_, i, sides_);
      at.s = {{state(0), state(1), state(2), state(3)}, {state(4), state(5), state(6)}};
      const Effect e = term_.effect(at);
      for (int n = 0; n < 3; ++n) {
        effects.v[static_cast<std::size_t>(n)][i] += e.v[n];
        effects.u[static_cast<std::size_t>(n)][i] += e.u[n];
      }
    }
  }
  bool adds_rate() const override { return true; }
  bool has_unnamed_kinks() const override { return polhode::has_unnamed_kinks(term_); }

 private:
  const P& term_;
  const Body& body_;
  StageTimes times_;
  std::span<const double> sides_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
