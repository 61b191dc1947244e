// SPDX-License-Identifier: MIT
// The program `polhode` with two kinds of [[perturbation]] of its own, "spin-brake" and
// "comet-jet".
#include <span>

#include "comet_jet.hpp"
#include "polhode/cli/command_line.hpp"
#include "spin_brake.hpp"

namespace {

using polhode::io::Dimension;
using polhode::io::KindKey;
using polhode::io::quantity_key;

struct Arguments {
  polhode::Vec3 axis;
  double damping;
  double limit;
};

constexpr KindKey<Arguments> keys[] = {
    quantity_key<&Arguments::axis>("axis", Dimension::number, "The axis, along the body axes.")
        .otherwise("[0, 0, 1]"),
    quantity_key<&Arguments::damping>("damping", Dimension::damping, "Torque per rate, if small.")
        .required()
        .example("0.01")
        .positive(),
    quantity_key<&Arguments::limit>("limit", Dimension::torque, "The largest torque.")
        .required()
        .example("0.001")
        .positive(),
};

polhode::io::MadeTerms made(const Arguments& a, const polhode::io::TermContext& at) {
  if (a.axis == polhode::Vec3{}) at.refuse("axis", "expected a vector that has a direction");
  return polhode::AnyPerturbation("spin brake",
                                  SpinBrake(at.principal(a.axis), a.damping, a.limit));
}

polhode::io::PerturbationKind spin_brake() {
  return polhode::io::perturbation_kind<Arguments>(
      "spin-brake", "A brake about one axis of the body, of a limited torque.", keys, made,
      {{"brake2026", "A. Author (2026). On brakes. Journal of Examples 1, 1-2.", "the brake"}});
}

}  // namespace

int main(int argc, char** argv) {
  const polhode::io::Kinds kinds =
      polhode::io::default_kinds().with(spin_brake()).with(comet_jet());
  return polhode::command_line(argc, argv, kinds);
}
