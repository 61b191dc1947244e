// SPDX-License-Identifier: MIT
// [frame.local-vertical].
#include "polhode/frame/local_vertical.hpp"

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
};

constexpr std::array keys = {
    name_key<&Arguments::orbit>("orbit", "The name of a table [orbit.NAME].")
        .required()
        .example("\"earth\""),
};

MadeFrame made(const Arguments&, const FrameContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  return at.built("orbit", [&] {
    return MadeFrame{
        std::visit([&](const auto& motion) { return local_vertical_frame(motion); }, orbit.motion),
        "local vertical of orbit " + orbit.name};
  });
}

}  // namespace

FrameKind local_vertical_kind() {
  return frame_kind<Arguments>("local-vertical",
                               "The local vertical, local horizontal of an orbit (LVLH): axis 3 "
                               "points to the centre, axis 2 against the normal of the orbit, axis "
                               "1 completes them, towards the motion. The columns roll, pitch and "
                               "yaw are the angles about axes 1, 2 and 3.",
                               keys, made);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
