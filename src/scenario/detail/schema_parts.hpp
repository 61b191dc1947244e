// SPDX-License-Identifier: MIT
// The parts of the table of scenario keys that say what moves the body and how it is integrated.
#pragma once

#include <span>

#include "polhode/scenario/schema.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct SchemaPart {
  std::span<const Key> keys;
  std::span<const Alternatives> alternatives;
};
SchemaPart state_keys();
SchemaPart frame_keys();
SchemaPart orbit_keys();
SchemaPart perturbation_keys();
SchemaPart surface_keys();
SchemaPart method_keys();
SchemaPart output_keys();
SchemaPart map_keys();

}  // namespace detail
}  // namespace v0
}  // namespace polhode
