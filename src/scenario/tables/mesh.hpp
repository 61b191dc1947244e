// SPDX-License-Identifier: MIT
// A mesh that a table names by the keys shape and scale: [body] and [[surface]].
#pragma once

#include <optional>
#include <string>

#include "polhode/shape/facet_shape.hpp"
#include "polhode/tables/obj.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct MeshKeys {
  std::optional<std::string> shape;
  std::optional<double> scale;
};

template <class A>
consteval KindKey<A> shape_key(std::string_view help) {
  return file_key<&MeshKeys::shape, A>("shape", help).alternative().example("\"body.obj\"");
}
template <class A>
inline constexpr KindKey<A> scale_key =
    quantity_key<&MeshKeys::scale, A>("scale", Dimension::length,
                                      "What one unit of the mesh is; required with shape.")
        .example("\"1 km\"")
        .positive();

template <class A>
shape::FacetShape mesh_of(const Placed<A>& table) {
  if (!table->scale)
    table.template refuse<&MeshKeys::scale>(
        std::string("expected the length of one unit of the mesh, such as ") +
        (table.at().units().length() == "1" ? "1" : "\"1 m\""));
  return table.template built<&MeshKeys::shape>([&] {
    const shape::FacetShape mesh = read_obj(table.template file_at<&MeshKeys::shape>());
    return *table->scale == 1.0 ? mesh : mesh.moved({}, *table->scale);
  });
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
