// SPDX-License-Identifier: MIT
#include "scenario/tables/surface.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scenario/tables/mesh.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct SurfaceTable : MeshKeys {
  Vec3 position, normal;
  double area = 0.0;
  std::int64_t sides = 1;
  std::optional<Vec3> centre_of_mass;
  double specular = 0.0, diffuse = 0.0, emitted = 0.0;
  double normal_accommodation = 1.0, tangential_accommodation = 1.0;
};

template <auto member>
consteval KindKey<SurfaceTable> fraction_key(std::string_view name, std::string_view help) {
  return quantity_key<member>(name, Dimension::number, help);
}

constexpr std::array keys_of_surface = {
    quantity_key<&SurfaceTable::position>(
        "position", Dimension::length,
        "Centre of a plate, from the centre of mass along the body axes of this file.")
        .alternative()
        .example("[0.001, 0.0, 0.0]"),
    quantity_key<&SurfaceTable::normal>("normal", Dimension::number,
                                        "Its normal, away from the body; of any length.")
        .alternative()
        .example("[1.0, 0.0, 0.0]"),
    quantity_key<&SurfaceTable::area>("area", Dimension::area, "Its area.")
        .alternative()
        .example("\"10 m2\"")
        .positive(),
    integer_key<&SurfaceTable::sides>("sides", "2 for a plate whose back is free too.")
        .one_of("1|2")
        .otherwise("1"),
    shape_key<SurfaceTable>(
        "A mesh, Wavefront OBJ, along the body axes of this file; relative to its folder."),
    scale_key<SurfaceTable>,
    quantity_key<&SurfaceTable::centre_of_mass>(
        "centre_of_mass", Dimension::length,
        "Where the centre of mass is in the mesh; left out, that of the mesh of [body], or where "
        "that has none, its origin.")
        .example("[0.0, 0.0, 0.0]"),
    fraction_key<&SurfaceTable::specular>("specular", "Fraction of the light that is mirrored.")
        .otherwise("0")
        .example("0.1"),
    fraction_key<&SurfaceTable::diffuse>(
        "diffuse", "Fraction that is scattered by Lambert's law; what is left is absorbed.")
        .otherwise("0")
        .example("0.3"),
    fraction_key<&SurfaceTable::emitted>(
        "emitted",
        "Fraction of the absorbed light that is given back at once as heat, by Lambert's law.")
        .otherwise("0"),
    fraction_key<&SurfaceTable::normal_accommodation>(
        "normal_accommodation",
        "Of air: 1 where molecules leave with the speed of the wall, 0 where they are mirrored.")
        .otherwise("1"),
    fraction_key<&SurfaceTable::tangential_accommodation>(
        "tangential_accommodation", "The same for their momentum along the wall.")
        .otherwise("1"),
};
constexpr Alternatives sets_of_surface[] = {{"surface[]", "position+normal+area|shape"}};
constexpr Table<SurfaceTable> surface_description = {
    {.path = "surface[]",
     .help = "What light and air act on: flat plates, or the facets of a mesh; any number of "
             "tables. Facets do not shade each other."},
    keys_of_surface,
    sets_of_surface};

template <auto member>
double fraction(const Placed<SurfaceTable>& from) {
  const double x = (*from).*member;
  if (!(x >= 0.0 && x <= 1.0)) from.refuse<member>("expected a fraction from 0 to 1");
  return x;
}

Finish finish_of(const Placed<SurfaceTable>& from) {
  const Finish finish = {
      .specular = fraction<&SurfaceTable::specular>(from),
      .diffuse = fraction<&SurfaceTable::diffuse>(from),
      .emitted = fraction<&SurfaceTable::emitted>(from),
      .normal_accommodation = fraction<&SurfaceTable::normal_accommodation>(from),
      .tangential_accommodation = fraction<&SurfaceTable::tangential_accommodation>(from)};
  if (finish.specular + finish.diffuse > 1.0)
    from.refuse<&SurfaceTable::diffuse>("expected at most 1 together with specular");
  return finish;
}

Surface mesh_surface(Rotation& rotation, const Placed<SurfaceTable>& from) {
  if (from.is_explicit<&SurfaceTable::sides>())
    from.refuse<&SurfaceTable::sides>("expected no sides together with a shape");
  const Vec3 of_shape = rotation.shape ? rotation.shape->inside.centre : Vec3{};
  const shape::FacetShape mesh = mesh_of(from);
  rotation.surface_meshes.push_back({*from->shape, mesh});
  return from.built<&SurfaceTable::shape>([&] {
    return Surface::of_shape(mesh, from->centre_of_mass.value_or(of_shape), finish_of(from));
  });
}

Surface plate_surface(const Placed<SurfaceTable>& from) {
  if (from->scale) from.refuse<&SurfaceTable::scale>("expected a key shape as well");
  if (from->centre_of_mass)
    from.refuse<&SurfaceTable::centre_of_mass>("expected a key shape as well");
  if (!(norm(from->normal) > 0.0))
    from.refuse<&SurfaceTable::normal>("expected a vector that has a direction");
  return from.built<&SurfaceTable::position>([&] {
    return Surface::of_plate(from->position, from->normal, from->area, finish_of(from),
                             from->sides == 2);
  });
}

}  // namespace

SchemaPart surface_keys() { return part_of<surface_description>(); }

void add_surface(Rotation& rotation, const FileValues& file) {
  std::vector<Surface> parts;
  for (const Placed<SurfaceTable>& one : placed_tables(surface_description, file))
    parts.push_back(one->shape ? mesh_surface(rotation, one) : plate_surface(one));
  if (parts.empty()) return;
  const Surface all = polhode::joined(parts);
  const Quaternion& q_FB = rotation.q_file;
  rotation.surface = std::make_shared<const Surface>(q_FB == Quaternion{} ? all : all.along(q_FB));
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
