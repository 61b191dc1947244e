// SPDX-License-Identifier: MIT
// [[surface]]: the plates and meshes that light and air act on.
#pragma once

#include "polhode/scenario/rotation.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

SchemaPart surface_keys();
// Adds all surfaces, along the principal axes, to a rotation that already has body and shape.
void add_surface(Rotation& rotation, const FileValues& file);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
