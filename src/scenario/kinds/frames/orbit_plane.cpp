// SPDX-License-Identifier: MIT
// [frame.orbit-plane].
#include "polhode/frame/orbit_plane.hpp"

#include <array>
#include <string>
#include <variant>

#include "scenario/detail/frame_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments {
  std::string orbit;
  PlaneOrigin axis_1 = PlaneOrigin::node;
};

constexpr std::array keys = {
    name_key<&Arguments::orbit>("orbit", "The name of a table [orbit.NAME].")
        .required()
        .example("\"earth\""),
    choice_key<&Arguments::axis_1, PlaneOrigin::node, PlaneOrigin::shortest_turn>(
        "axis_1", "node|shortest-turn",
        "What axis 1 is: the ascending node, or, for orbits next to inertial axes 1 and 2, which "
        "have no node that stays, where the shortest turn to the plane brings inertial axis 1.")
        .otherwise("\"node\"")
        .example("\"shortest-turn\""),
};

MadeFrame made(const Arguments& a, const FrameContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  return at.built("orbit", [&] {
    return MadeFrame{
        std::visit([&](const auto& motion) { return orbit_plane_frame(motion, a.axis_1); },
                   orbit.motion),
        "plane of orbit " + orbit.name};
  });
}

}  // namespace

FrameKind orbit_plane_kind() {
  return frame_kind<Arguments>(
      "orbit-plane",
      "The plane of an orbit of date: axis 1 along its ascending node, axis 3 along its normal. It "
      "turns with the plane, not with the body on the orbit. Of elements the plane is theirs, of a "
      "table and of an ephemeris that of position and velocity.",
      keys, made);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
