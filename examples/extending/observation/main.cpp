// SPDX-License-Identifier: MIT
// The program `polhode` with a kind of observation of its own, "sun-angle".
#include <cmath>
#include <span>

#include "polhode/cli/command_line.hpp"

namespace {

using polhode::Vec3;
using polhode::io::Dimension;
using polhode::io::KindKey;
using polhode::io::quantity_key;

struct SunAngle {
  Vec3 axis;
  Vec3 sun;
  double sigma;
};

constexpr KindKey<SunAngle> keys[] = {
    quantity_key<&SunAngle::axis>("axis", Dimension::number, "The body axis of the sensor.")
        .otherwise("[0, 0, 1]"),
    quantity_key<&SunAngle::sun>("sun", Dimension::number, "Inertial direction of the Sun.")
        .required()
        .example("[1, 0, 0]"),
    quantity_key<&SunAngle::sigma>("sigma", Dimension::angle, "The standard error of an angle.")
        .required()
        .positive()
        .example("\"0.1 deg\""),
};

polhode::io::ObservedRows made(const SunAngle& a, const polhode::io::TermContext& at) {
  if (!(norm(a.sun) > 0.0)) at.refuse("sun", "expected a vector that is not 0");
  // q takes body axes of the file to inertial ones
  const auto angle = [a](double, const polhode::Quaternion& q, const Vec3&,
                         std::span<double> numbers) {
    const Vec3 axis = rotate(q, a.axis);
    numbers[0] = std::atan2(norm(cross(axis, a.sun)), dot(axis, a.sun));
  };
  return observed_rows(
      {.columns = {{"angle", Dimension::angle}}, .sigmas = {a.sigma}, .numbers = angle}, at);
}

}  // namespace

int main(int argc, char** argv) {
  const polhode::io::ObservationKind sun_angle = polhode::io::observation_kind<SunAngle>(
      "sun-angle", "Angles from a body axis to the Sun.", keys, made);
  return polhode::command_line(argc, argv, polhode::io::default_kinds().with(sun_angle));
}
