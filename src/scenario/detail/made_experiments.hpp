// SPDX-License-Identifier: MIT
// The experiments of kinds "rotation" and "obliquity" from the values of a file.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "polhode/detail/scenario/obliquity.hpp"
#include "polhode/scenario/rotation.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/scenario_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// A table [[perturbation]]: its terms are count ones from number `first` on.
struct TermTable {
  TermUses uses;
  std::size_t first;
  std::size_t count;
};

// A rotation, and what its parts were made of.
struct MadeRotation {
  Rotation rotation;
  std::vector<OrbitUses> orbits;  // one for each orbit
  std::vector<TermTable> tables;  // one for each table
};

// With a base: the values are its own but for the numbers at the paths `changed`. What does not
// stand on these is shared with it. ScenarioError at the place of what is wrong.
MadeRotation made_rotation(const KindContext& at, const MadeRotation* base = nullptr,
                           std::span<const std::string> changed = {});

// With a base, its orbit is used again.
Obliquity made_obliquity(const KindContext& at, const Obliquity* base = nullptr);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
