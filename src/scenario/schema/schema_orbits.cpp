// SPDX-License-Identifier: MIT
// The table of scenario keys: orbits.
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr Key keys[] = {{.path = "orbit", .help = "Orbits, by names that the file chooses."}};

}  // namespace

SchemaPart orbit_keys() { return {keys, {}}; }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
