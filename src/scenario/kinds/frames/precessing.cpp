// SPDX-License-Identifier: MIT
// [frame.precessing].
#include <array>
#include <optional>
#include <string>

#include "polhode/orbit/kepler_orbit.hpp"
#include "scenario/detail/frame_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

struct Arguments {
  Vec3 axis;
  std::optional<double> rate;
  std::string orbit;
  double turns = 0.0;
  double epoch = 0.0;
};

constexpr std::array keys = {
    quantity_key<&Arguments::axis>("axis", Dimension::number,
                                   "The axis, in inertial axes; its length plays no part.")
        .required()
        .example("[0.0, 0.0, 1.0]"),
    quantity_key<&Arguments::rate>("rate", Dimension::rate,
                                   "The rate of turn, right-handed about the axis.")
        .alternative()
        .example("0.5"),
    name_key<&Arguments::orbit>(
        "orbit",
        "The name of a table [orbit.NAME] whose mean motion gives the rate: the mean rate of "
        "the longitude, node and pericentre included.")
        .alternative()
        .example("\"earth\""),
    quantity_key<&Arguments::turns>(
        "turns", Dimension::number,
        "Turns of the frame per revolution on that orbit: 1 for a body that keeps one face to "
        "the other, 1.5 for the 3:2 resonance.")
        .alternative()
        .example("1.5"),
    quantity_key<&Arguments::epoch>("epoch", Dimension::time,
                                    "When the frame coincides with the inertial axes.")
        .otherwise("0"),
};

// Of the mean longitude, which on a plane that stays is that of the direction to the body.
double mean_rate(const ScenarioOrbit& orbit, const FrameContext& at) {
  const KeplerElements* elements = kepler_elements(orbit);
  if (elements == nullptr || !(elements->eccentricity < 1.0))
    at.refuse("orbit", "expected an ellipse with elements");
  const double n = KeplerOrbit(*elements).mean_motion();
  const auto* moving = std::get_if<PrecessingKeplerOrbit>(&orbit.motion);
  if (moving == nullptr) return n;
  const SecularRates& rates = moving->rates();
  return n + rates.mean_anomaly + rates.argument + rates.node;
}

MadeFrame made(const Arguments& a, const FrameContext& at) {
  const Precession p{a.axis, a.rate ? *a.rate : a.turns * mean_rate(at.orbit("orbit"), at),
                     a.epoch};
  return at.built("axis", [&] {
    return MadeFrame{Frame::precessing(p.axis, p.rate, p.epoch), "precessing", p};
  });
}

}  // namespace

FrameKind precessing_kind() {
  FrameKind kind = frame_kind<Arguments>(
      "precessing", "A frame that turns with a constant rate about a constant axis.", keys, made);
  kind.sets = "rate|orbit+turns";
  return kind;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
