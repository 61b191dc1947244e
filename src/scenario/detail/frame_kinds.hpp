// SPDX-License-Identifier: MIT
// The kinds of [frame.NAME] that polhode has: one source of kinds/frames/ each. A new one is a
// source there, a line here and one in kinds.cpp.
#pragma once

#include <variant>

#include "polhode/scenario/frame_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

FrameKind precessing_kind();
FrameKind orbit_plane_kind();
FrameKind local_vertical_kind();

// The rate of a frame along a table takes the second derivative of its path: refuses, at the key
// `orbit`, rows that straight lines connect.
inline void require_curved(const ScenarioOrbit& orbit, const FrameContext& at) {
  const auto* const table = std::get_if<TableOrbit>(&orbit.motion);
  if (table != nullptr && table->order() < 4)
    at.refuse("orbit", "expected a table of order 4 or more, whose path has a curvature");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
