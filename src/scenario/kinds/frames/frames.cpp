// SPDX-License-Identifier: MIT
// The kinds of [frame.NAME].
#include <array>
#include <optional>
#include <string>
#include <variant>

#include "polhode/frame/local_vertical.hpp"
#include "polhode/frame/orbit_plane.hpp"
#include "polhode/orbit/kepler_orbit.hpp"
#include "scenario/detail/built_in_kinds.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

struct PrecessingArguments {
  Vec3 axis;
  std::optional<double> rate;
  std::string orbit;
  double turns = 0.0;
  double epoch = 0.0;
};

constexpr std::array precessing_keys = {
    quantity_key<&PrecessingArguments::axis>(
        "axis", Dimension::number, "The axis, in inertial axes; its length plays no part.")
        .required()
        .example("[0.0, 0.0, 1.0]"),
    quantity_key<&PrecessingArguments::rate>("rate", Dimension::rate,
                                             "The rate of turn, right-handed about the axis.")
        .alternative()
        .example("0.5"),
    name_key<&PrecessingArguments::orbit>(
        "orbit",
        "The name of a table [orbit.NAME] whose mean motion gives the rate: the mean rate of "
        "the longitude, node and pericentre included.")
        .alternative()
        .example("\"earth\""),
    quantity_key<&PrecessingArguments::turns>(
        "turns", Dimension::number,
        "Turns of the frame per revolution on that orbit: 1 for a body that keeps one face to "
        "the other, 1.5 for the 3:2 resonance.")
        .alternative()
        .example("1.5"),
    quantity_key<&PrecessingArguments::epoch>("epoch", Dimension::time,
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

MadeFrame made_precessing(const PrecessingArguments& a, const FrameContext& at) {
  const Precession p{a.axis, a.rate ? *a.rate : a.turns * mean_rate(at.orbit("orbit"), at),
                     a.epoch};
  return at.built("axis", [&] {
    return MadeFrame{Frame::precessing(p.axis, p.rate, p.epoch), "precessing", p};
  });
}

}  // namespace

FrameKind precessing_kind() {
  FrameKind kind = frame_kind<PrecessingArguments>(
      "precessing", "A frame that turns with a constant rate about a constant axis.",
      precessing_keys, made_precessing);
  kind.sets = "rate|orbit+turns";
  return kind;
}

namespace {

struct OrbitPlaneArguments {
  std::string orbit;
  PlaneOrigin axis_1 = PlaneOrigin::node;
};

constexpr std::array orbit_plane_keys = {
    name_key<&OrbitPlaneArguments::orbit>("orbit", "The name of a table [orbit.NAME].")
        .required()
        .example("\"earth\""),
    choice_key<&OrbitPlaneArguments::axis_1, PlaneOrigin::node, PlaneOrigin::shortest_turn>(
        "axis_1", "node|shortest-turn",
        "What axis 1 is: the ascending node, or, for orbits next to inertial axes 1 and 2, which "
        "have no node that stays, where the shortest turn to the plane brings inertial axis 1.")
        .otherwise("\"node\"")
        .example("\"shortest-turn\""),
};

MadeFrame made_orbit_plane(const OrbitPlaneArguments& a, const FrameContext& at) {
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
  return frame_kind<OrbitPlaneArguments>(
      "orbit-plane",
      "The plane of an orbit of date: axis 1 along its ascending node, axis 3 along its normal. It "
      "turns with the plane, not with the body on the orbit. Of elements the plane is theirs, of a "
      "table and of an ephemeris that of position and velocity.",
      orbit_plane_keys, made_orbit_plane);
}

namespace {

struct LocalVerticalArguments {
  std::string orbit;
};

constexpr std::array local_vertical_keys = {
    name_key<&LocalVerticalArguments::orbit>("orbit", "The name of a table [orbit.NAME].")
        .required()
        .example("\"earth\""),
};

MadeFrame made_local_vertical(const LocalVerticalArguments&, const FrameContext& at) {
  const ScenarioOrbit& orbit = at.orbit("orbit");
  return at.built("orbit", [&] {
    return MadeFrame{
        std::visit([&](const auto& motion) { return local_vertical_frame(motion); }, orbit.motion),
        "local vertical of orbit " + orbit.name};
  });
}

}  // namespace

FrameKind local_vertical_kind() {
  return frame_kind<LocalVerticalArguments>(
      "local-vertical",
      "The local vertical, local horizontal of an orbit (LVLH): axis 3 "
      "points to the centre, axis 2 against the normal of the orbit, axis "
      "1 completes them, towards the motion. The columns roll, pitch and "
      "yaw are the angles about axes 1, 2 and 3.",
      local_vertical_keys, made_local_vertical);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
