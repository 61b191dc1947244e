// SPDX-License-Identifier: MIT
// A chart that polhode does not have: Andoyer's angles, the logarithm of G and two cosines.
#pragma once

#include <cmath>

#include "polhode/rotor/andoyer.hpp"
#include "polhode/tables/convert.hpp"

namespace polhode::test {

inline constexpr io::ChartVariable spherical_variables[] = {
    {"l", io::Dimension::angle, "Andoyer's l.", "70"},
    {"g", io::Dimension::angle, "Andoyer's g.", "20"},
    {"h", io::Dimension::angle, "Andoyer's h.", "40"},
    {"log_G", io::Dimension::number, "Logarithm of the momentum.", "0.5"},
    {"cos_J", io::Dimension::number, "Cosine of J.", "0.9"},
    {"cos_I", io::Dimension::number, "Cosine of I.", "-0.5"},
};

inline RotorState from_spherical(const io::ChartNumbers& x, const io::ChartPlace&) {
  const double G = std::exp(x[3]);
  return to_rotor(andoyer_state(x[0], x[1], x[2], G * x[4], G, G * x[5]));
}
inline io::ChartNumbers to_spherical(const RotorState& s, const io::ChartPlace&) {
  const AndoyerState a = to_andoyer(s);
  return {a.l, a.g, a.h, std::log(a.G), a.L / a.G, a.H / a.G};
}

inline constexpr io::ChartKind modified_spherical{
    .name = "modified-spherical",
    .help = "Andoyer's angles, the logarithm of the momentum and two cosines.",
    .variables = spherical_variables,
    .to_hub = from_spherical,
    .from_hub = to_spherical,
    .in_scenarios = true};

}  // namespace polhode::test
