// SPDX-License-Identifier: MIT
// [body]: moments of inertia, a tensor, or a mesh of constant density.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "polhode/scenario/rotation.hpp"
#include "scenario/tables/mesh.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct BodyTable : MeshKeys {
  std::optional<Vec3> moments;
  std::optional<Mat3> tensor;
  double density = 0.0;
  std::optional<std::array<double, 4>> column_axes;
};
SchemaPart body_keys();
Placed<BodyTable> body_table(const FileValues& file);

// The mesh of the body; null where it has none.
std::shared_ptr<const ScenarioShape> shape_of(const Placed<BodyTable>& table);
Body body_of(const Placed<BodyTable>& table, const ScenarioShape* shape);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
