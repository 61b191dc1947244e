// SPDX-License-Identifier: MIT
// Members of an ensemble that are integrated side by side.
#pragma once

#include <span>

#include "polhode/run/ensemble.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Whether members like this may go by integrate_many: rotations without damper and events that
// start at their first row, by a method that takes several bodies at a time.
bool goes_in_lockstep(const Experiment& experiment);

// The rotation of a member, and where its rows go.
struct LockstepMember {
  const Rotation* rotation;
  EnsembleMember* member;
};
// The rows that each would have alone, to the last bit.
void run_in_lockstep(std::span<const LockstepMember> members, const RowLayout& layout,
                     const Progress& progress);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
