// SPDX-License-Identifier: MIT
// Stages: the states inside one step of an implicit method, at which its terms are asked together.
//
// Units       those of Effect.
// Domain      up to most_stages of them, side by side: row[i] is a number of stage i. Rows are
//             filled up to a whole number of lanes with stages that no result depends on.
// Accuracy    the bits of one stage at a time, by every set of instructions.
// Errors      what a term throws passes through.
// Cost        of_time of every stage once a step, and a term's law for all stages at a time.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "polhode/detail/orbit/shared_places.hpp"
#include "polhode/math/quaternion.hpp"
#include "polhode/perturb/detail/stage_row.hpp"

namespace polhode {
inline namespace v0 {

inline constexpr std::size_t most_stages = 32;
inline constexpr std::size_t stage_lanes = 8;  // rows are filled to a multiple of it

constexpr std::size_t filled_stages(std::size_t count) {
  return (count + stage_lanes - 1) / stage_lanes * stage_lanes;
}

// One number of every stage.
struct StageRow : detail::AlignedRow<most_stages> {};

// When they are, and how the reference frame stands then.
struct StageTimes {
  std::size_t count = 0;
  StageRow t{};
  StageRow t_rest{};
  std::array<Quaternion, most_stages> q_IS{};  // identity where the frame is inertial
  // What orbits have said of them: null where each term asks by itself.
  SharedPlaces* known = nullptr;
  bool is_inertial = false;  // said where it is known: q_IS need not be looked at
};

struct StageStates {
  std::array<StageRow, 7> rows{};  // q_SB: w, x, y, z; g_B: x, y, z
};

struct StageEffects {
  std::array<StageRow, 3> v{};
  std::array<StageRow, 3> u{};
};

// One term, for the stages of one step after the other.
class StageTerm {
 public:
  virtual ~StageTerm() = default;
  // For the step to come. `sides` are those of its switching functions.
  virtual void begin(const StageTimes& times, std::span<const double> sides) = 0;
  // Adds what the term does to these states.
  virtual void add_to(StageEffects& effects, const StageStates& states) = 0;
  // Whether v may be other than 0.
  virtual bool adds_rate() const = 0;
  // Whether its torque is known to have no jump but at breakpoints and edges, and no kink but
  // there or of those that it says to have.
  virtual bool is_smooth() const { return false; }
  // Whether it has kinks at places that it does not name, many and small.
  virtual bool has_unnamed_kinks() const { return false; }
};

}  // namespace v0
}  // namespace polhode
