// SPDX-License-Identifier: MIT
// A chart of your own: Andoyer's angles, the logarithm of the momentum, and the cosines of J and I.
#pragma once

#include <cmath>

#include "polhode/rotor/andoyer.hpp"
#include "polhode/tables/convert.hpp"

namespace spherical {

using polhode::io::ChartNumbers;
using polhode::io::ChartPlace;
using polhode::io::Dimension;

// A number without a dimension, a sentence or an example does not compile.
constexpr polhode::io::ChartVariable variables[] = {
    {"l", Dimension::angle, "Andoyer's l.", "70"},
    {"g", Dimension::angle, "Andoyer's g.", "20"},
    {"h", Dimension::angle, "Andoyer's h.", "40"},
    {"log_G", Dimension::number, "Logarithm of the angular momentum.", "0.5"},
    {"cos_J", Dimension::number, "Cosine of the angle from body axis 3 to the momentum.", "0.9"},
    {"cos_I", Dimension::number, "Cosine of the angle from inertial axis 3 to it.", "-0.5"},
};

// What it throws is a message with the file and the line.
inline polhode::RotorState to_hub(const ChartNumbers& x, const ChartPlace&) {
  const double G = std::exp(x[3]);
  return to_rotor(polhode::andoyer_state(x[0], x[1], x[2], G * x[4], G, G * x[5]));
}
inline ChartNumbers from_hub(const polhode::RotorState& s, const ChartPlace&) {
  const polhode::AndoyerState a = polhode::to_andoyer(s);
  return {a.l, a.g, a.h, std::log(a.G), a.L / a.G, a.H / a.G};
}

constexpr polhode::io::ChartKind chart{
    .name = "spherical",
    .help = "Andoyer's angles, the logarithm of the momentum and two cosines.",
    .variables = variables,
    .to_hub = to_hub,
    .from_hub = from_hub,
    .in_scenarios = true,  // [state.spherical], and a group of columns of this name
};

}  // namespace spherical
