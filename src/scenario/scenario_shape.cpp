// SPDX-License-Identifier: MIT
// From the values of a file to its meshes.
#include <filesystem>
#include <utility>

#include "polhode/tables/obj.hpp"
#include "scenario/scenario_parts.hpp"
#include "scenario/value_access.hpp"
#include "scenario/values.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

FacetShape mesh_of(const Values& values, const std::string& path, const std::string& name) {
  const std::string scale_key = path + ".scale", shape_key = path + ".shape";
  if (!has(values, scale_key))
    refuse(values, scale_key, name, "expected the length of one unit of the mesh, such as \"1 m\"");
  require_range(values, scale_key, name);
  const double scale = number(values, scale_key);
  const std::filesystem::path file =
      std::filesystem::path(name).parent_path() / word(values, shape_key);
  return built(values, shape_key, name, [&] {
    const FacetShape mesh = read_obj(file.string());
    return scale == 1.0 ? mesh : mesh.moved({}, scale);
  });
}

std::shared_ptr<const ScenarioShape> shape_of(const Values& values, const std::string& name) {
  if (!has(values, "body.shape")) {
    if (has(values, "body.scale"))
      refuse(values, "body.scale", name, "expected a key shape as well, which it scales");
    return nullptr;
  }
  FacetShape mesh = mesh_of(values, "body", name);
  require_range(values, "body.density", name);
  const double density = number(values, "body.density");
  MassProperties inside =
      built(values, "body.shape", name, [&] { return mass_properties(mesh, density); });
  return std::make_shared<const ScenarioShape>(
      ScenarioShape{word(values, "body.shape"), std::move(mesh), inside});
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
