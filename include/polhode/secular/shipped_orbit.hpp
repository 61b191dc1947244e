// SPDX-License-Identifier: MIT
// The orbits of the Earth and Mars over 40 million years, which the library brings along.
//
// Equations   k, h, q, p as polhode/secular/orbit_elements.hpp, every 1,000 years, from an
//             integration of the eight planets with REBOUND from the states of DE440 at J2000; the
//             Earth stands for the barycentre of Earth and Moon (tools/orbits/, data/orbits/).
//             What is faster than some 4,000 years is filtered out.
// Units       Julian years from J2000, rad; axes ecliptic-J2000.
// Domain      -20 to 20 million years; beyond some 50 the planets are chaotic anyway.
// Accuracy    the eccentricity of the Earth against La2004: budgets shipped_orbit_*.
// Errors      DomainError for a name that is not among shipped_orbit_names().
// Cost        3 ms; some 10 MB.
#pragma once

#include <span>
#include <string_view>

#include "polhode/secular/orbit_elements.hpp"

namespace polhode {
inline namespace v0 {

std::span<const std::string_view> shipped_orbit_names();
// `year` is what a Julian year is in the unit of time of the table.
ElementTable shipped_orbit(std::string_view name, double year = 1.0);

}  // namespace v0
}  // namespace polhode
