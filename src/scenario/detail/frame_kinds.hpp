// SPDX-License-Identifier: MIT
// The kinds of [frame.NAME] that polhode has: one source of kinds/frames/ each. A new one is a
// source there, a line here and one in kinds.cpp.
#pragma once

#include "polhode/scenario/frame_kind.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

FrameKind precessing_kind();
FrameKind orbit_plane_kind();
FrameKind local_vertical_kind();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
