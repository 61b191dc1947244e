// SPDX-License-Identifier: MIT
// MapPlan: the table [map] of a scenario, which wraps whatever the scenario describes: one run for
// every cell of a grid of its numbers.
//
// Equations   those of chaos_indicator, of sections and of spectrum.
// Units       `from` and `to` in the unit that their key has in the file; the rest in core units.
// Domain      1 to 1e9 cells, counted with the last axis the fastest.
// Errors      none; what is no map is refused when the file is read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "polhode/analysis/section.hpp"

namespace polhode {
inline namespace v0 {
namespace io {

// The last one is of a spin axis over ages; the others but `column` are of a rotation.
enum class MapKind { chaos, column, andoyer_section, spin_orbit_section, frequency };

struct MapAxis {
  std::string key;
  double from;
  double to;
  std::int64_t count;
  std::string unit;
};

struct MapPlan {
  MapKind kind;
  std::string column = {};  // of MapKind::column, with its unit
  std::string unit = {};
  analysis::SectionSurface surface = {};  // of MapKind::andoyer_section
  std::string orbit = {};                 // of MapKind::spin_orbit_section
  std::vector<MapAxis> axes = {};         // a section may have none: one start
};

}  // namespace io
}  // namespace v0
}  // namespace polhode
