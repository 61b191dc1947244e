// SPDX-License-Identifier: MIT
// The parts of the table of scenario keys, one concept each.
#pragma once

#include <span>

#include "polhode/scenario/schema.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct SchemaPart {
  std::span<const Key> keys;
  std::span<const Alternatives> alternatives;
  std::span<const KindText> kinds = {};
};

// The parts that the descriptions of kinds make.
struct DescribedParts {
  SchemaPart state;
  SchemaPart perturbations;
  SchemaPart methods;
  SchemaPart orbit_table;
  SchemaPart orbits;
  SchemaPart frames;
  SchemaPart observations;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
