// SPDX-License-Identifier: MIT
// The program `polhode` with a kind of [frame] of its own, "swaying-plane".
#include <cmath>
#include <numbers>
#include <span>

#include "polhode/cli/command_line.hpp"

namespace {

using polhode::io::Dimension;
using polhode::io::KindKey;

struct Arguments {
  double inclination;
  double sway = 0.0;
  double period;
  double node_rate = 0.0;
};

constexpr KindKey<Arguments> keys[] = {
    polhode::io::quantity_key<&Arguments::inclination>("inclination", Dimension::angle,
                                                       "The mean one.")
        .required()
        .example("\"5.145 deg\"")
        .positive(),
    polhode::io::quantity_key<&Arguments::sway>("sway", Dimension::angle,
                                                "By how much it grows and shrinks.")
        .otherwise("0"),
    polhode::io::quantity_key<&Arguments::period>("period", Dimension::time, "Of the sway.")
        .required()
        .example("\"173.3 d\"")
        .positive(),
    polhode::io::quantity_key<&Arguments::node_rate>("node_rate", Dimension::rate, "Of its node.")
        .otherwise("0"),
};

// Functions of any number type: the rate of the frame is their derivative.
polhode::io::MadeFrame made(const Arguments& a, const polhode::io::FrameContext& at) {
  if (!(a.sway < a.inclination)) at.refuse("sway", "expected less than the inclination");
  const double turning = 2.0 * std::numbers::pi / a.period;
  const auto node = [a](const auto& t) { return a.node_rate * t; };
  const auto inclination = [a, turning](const auto& t) {
    using std::cos;
    return a.inclination + a.sway * cos(turning * t);
  };
  return {polhode::Frame::orbit_plane(node, inclination), "a plane that sways"};
}

polhode::io::FrameKind swaying_plane() {
  return polhode::io::frame_kind<Arguments>(
      "swaying-plane", "The plane of an orbit whose inclination swings about a mean.", keys, made);
}

}  // namespace

int main(int argc, char** argv) {
  return polhode::command_line(argc, argv, polhode::io::default_kinds().with(swaying_plane()));
}
