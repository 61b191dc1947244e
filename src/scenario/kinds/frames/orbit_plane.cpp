// SPDX-License-Identifier: MIT
// [frame.orbit-plane].
#include <array>
#include <string>
#include <type_traits>

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
  const KeplerElements* elements = kepler_elements(orbit);
  if (elements == nullptr) at.refuse("orbit", "expected an orbit with elements");
  const KeplerElements& k = *elements;
  const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion);
  const double node_rate = moving == nullptr ? 0.0 : moving->rates().node;
  return {Frame::orbit_plane(
              [node = k.node, rate = node_rate, epoch = k.epoch](const auto& t) {
                using T = std::remove_cvref_t<decltype(t)>;
                return T(node) + T(rate) * (t - T(epoch));
              },
              [i = k.inclination](const auto& t) { return std::remove_cvref_t<decltype(t)>(i); }),
          "plane of orbit " + orbit.name};
}

}  // namespace

FrameKind orbit_plane_kind() {
  return frame_kind<Arguments>(
      "orbit-plane",
      "The plane of an orbit: axis 1 along its ascending node, axis 3 along its normal. It turns "
      "with the node, not with the body on the orbit.",
      keys, made);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
