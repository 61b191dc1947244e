// SPDX-License-Identifier: MIT
// From the values of a file to its surfaces.
#include <utility>

#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

Finish finish_of(const Values& values, const std::string& path, const std::string& name) {
  const auto fraction = [&](const char* own) {
    const std::string key = path + "." + own;
    const double x = number(values, key);
    if (!(x >= 0.0 && x <= 1.0)) refuse(values, key, name, "expected a fraction from 0 to 1");
    return x;
  };
  if (fraction("specular") + fraction("diffuse") > 1.0)
    refuse(values, path + ".diffuse", name, "expected at most 1 together with specular");
  return {.specular = fraction("specular"),
          .diffuse = fraction("diffuse"),
          .emitted = fraction("emitted"),
          .normal_accommodation = fraction("normal_accommodation"),
          .tangential_accommodation = fraction("tangential_accommodation")};
}

Surface mesh_surface(Rotation& rotation, const Values& values, const std::string& path,
                     const std::string& name) {
  if (is_explicit(values, path + ".sides"))
    refuse(values, path + ".sides", name, "expected no sides together with a shape");
  Vec3 centre;
  if (has(values, path + ".centre_of_mass"))
    centre = vector(values, path + ".centre_of_mass");
  else if (rotation.shape)
    centre = rotation.shape->inside.centre;
  const FacetShape mesh = mesh_of(values, path, name);
  rotation.surface_meshes.push_back({word(values, path + ".shape"), mesh});
  return built(values, path + ".shape", name,
               [&] { return Surface::of_shape(mesh, centre, finish_of(values, path, name)); });
}

Surface plate_surface(const Values& values, const std::string& path, const std::string& name) {
  for (const char* own : {".scale", ".centre_of_mass"})
    if (has(values, path + own)) refuse(values, path + own, name, "expected a key shape as well");
  const Vec3 normal = vector(values, path + ".normal");
  const double area = number(values, path + ".area");
  if (!(norm(normal) > 0.0))
    refuse(values, path + ".normal", name, "expected a vector that has a direction");
  require_range(values, path + ".area", name);
  const bool both_sides = value_at(values, path + ".sides").whole == 2;
  return built(values, path + ".position", name, [&] {
    return Surface::of_plate(vector(values, path + ".position"), normal, area,
                             finish_of(values, path, name), both_sides);
  });
}

}  // namespace

void add_surface(Rotation& rotation, const Values& values, const std::string& name) {
  std::vector<Surface> parts;
  for (const std::string& path : array_paths(values, "surface"))
    parts.push_back(has(values, path + ".shape") ? mesh_surface(rotation, values, path, name)
                                                 : plate_surface(values, path, name));
  if (parts.empty()) return;
  const Surface all = joined(parts);
  const Quaternion& q_FB = rotation.q_file;
  rotation.surface = std::make_shared<const Surface>(q_FB == Quaternion{} ? all : all.along(q_FB));
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
