// SPDX-License-Identifier: MIT
// [light], [fit.scan] and [[fit.periods]]: how bright the body is, and the periods of light curves.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "polhode/detail/scenario/light_plan.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

enum class LightLaw { lommel_seeliger, lambert, mixed };

struct LightTable : ConvexPlan {
  LightPlan::Shape shape = LightPlan::Shape::ellipsoid;
  std::optional<std::string> mesh;
  std::optional<Vec3> semiaxes;
  fit::MomentSource source = fit::MomentSource::shape;
  bool convex = false;  // the table of its keys
  LightLaw law = LightLaw::lommel_seeliger;
  double multiple = 0.0;
};
struct ScanTable : ScanPlan {
  std::size_t pairs = 0, readings = 0;
  std::vector<double> periods;  // first and second of each pair
  std::optional<std::size_t> own_order;
};
SchemaPart light_keys();
Placed<LightTable> light_table(const FileValues& file);
Placed<ScanTable> scan_table(const FileValues& file);
std::vector<Placed<fit::TumblerPeriods>> periods_tables(const FileValues& file);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
