// SPDX-License-Identifier: MIT
// The program `polhode` with a group of columns of its own, "wobble".
#include <array>
#include <cmath>

#include "polhode/cli/command_line.hpp"

namespace {

using polhode::io::Dimension;
using polhode::io::RowSample;

// Rate of rotation, and the angle from the angular momentum to the axis of rotation.
std::array<double, 2> numbers(const RowSample& row) {
  const polhode::Vec3 w = angular_velocity(row.system, row.t, row.state).inertial;
  const polhode::Vec3& g = row.state.g;
  return {norm(w), std::atan2(norm(cross(g, w)), dot(g, w))};
}

}  // namespace

int main(int argc, char** argv) {
  const polhode::io::ColumnKind wobble = polhode::io::column_kind(
      "wobble", "Rate of rotation, and the angle from the angular momentum to its axis.",
      {{"spin_rate", Dimension::rate}, {"wobble_angle", Dimension::angle}}, numbers);
  return polhode::command_line(argc, argv, polhode::io::default_kinds().with(wobble));
}
