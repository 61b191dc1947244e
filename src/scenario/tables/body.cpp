// SPDX-License-Identifier: MIT
#include "scenario/tables/body.hpp"

#include <utility>

#include "polhode/rotor/attitude.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::array keys_of_body = {
    quantity_key<&BodyTable::moments>(
        "moments", Dimension::moment,
        "Principal moments about the body axes 1, 2, 3, in any order; positive, and none above the "
        "sum of the other two.")
        .alternative()
        .example("[0.61, 0.965, 1.0]"),
    quantity_key<&BodyTable::tensor>(
        "tensor", Dimension::moment,
        "Symmetric inertia tensor in axes fixed in the body. Element (1, 2) is minus the integral "
        "of x y dm, which other programs may call the product of inertia. [state.attitude-rate] "
        "and the columns q, omega and g then refer to these axes, all else to the principal axes.")
        .alternative()
        .example("[[0.7, 0.1, 0.0], [0.1, 0.9, 0.0], [0.0, 0.0, 1.0]]"),
    shape_key<BodyTable>(
        "A closed mesh, Wavefront OBJ, filled with constant density: gives the tensor about its "
        "centre of mass, in the axes of the mesh. Relative to the folder of this file."),
    quantity_key<&BodyTable::density>("density", Dimension::density, "Its density.")
        .alternative()
        .example("\"2000 kg/m3\"")
        .positive(),
    scale_key<BodyTable>,
    quantity_key<&BodyTable::column_axes>(
        "column_axes", Dimension::number,
        "With moments: the attitude [w, x, y, z] of the principal axes in other axes fixed in the "
        "body, which the columns q, omega and g then refer to. Nothing else does.")
        .example("[1.0, 0.0, 0.0, 0.0]"),
};
constexpr Alternatives sets_of_body[] = {{"body", "moments|tensor|shape+density"}};
constexpr Table<BodyTable> body_description = {
    {.path = "body", .presence = Presence::required, .help = "The rigid body."},
    keys_of_body,
    sets_of_body};

}  // namespace

SchemaPart body_keys() { return part_of<body_description>(); }

Placed<BodyTable> body_table(const FileValues& file) { return {body_description, file}; }

std::shared_ptr<const ScenarioShape> shape_of(const Placed<BodyTable>& table) {
  if (!table->shape) {
    if (table->scale)
      table.refuse<&BodyTable::scale>("expected a key shape as well, which it scales");
    return nullptr;
  }
  shape::FacetShape mesh = mesh_of(table);
  shape::MassProperties inside =
      table.built<&BodyTable::shape>([&] { return shape::mass_properties(mesh, table->density); });
  return std::make_shared<const ScenarioShape>(
      ScenarioShape{*table->shape, std::move(mesh), inside});
}

Body body_of(const Placed<BodyTable>& table, const ScenarioShape* shape) {
  if (table->column_axes && !table->moments)
    table.refuse<&BodyTable::column_axes>("expected a key moments as well");
  if (shape != nullptr)
    return table.built<&BodyTable::shape>([&] { return shape::body(shape->inside); });
  if (!table->moments)
    return table.built<&BodyTable::tensor>([&] { return Body::from_tensor(*table->tensor); });
  return table.built<&BodyTable::moments>([&] {
    const Vec3& I = *table->moments;
    if (!table->column_axes) return Body(I.x, I.y, I.z);
    const auto& [w, x, y, z] = *table->column_axes;
    return Body::with_axes(I, unit_quaternion(w, x, y, z));
  });
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
