// SPDX-License-Identifier: MIT
// The mass properties of a shape as lines of a summary, and as a table [body] of a scenario.
#include "polhode/run/shape_report.hpp"

#include <cstddef>
#include <string>
#include <vector>

#include "math/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

std::string power(const std::string& unit, int exponent) {
  return unit == "1" ? "" : unit + std::to_string(exponent);
}

}  // namespace

std::vector<SummaryLine> shape_summary(const shape::FacetShape& shape,
                                       const shape::MassProperties& properties,
                                       const Units& units) {
  const auto count = [](std::size_t n) { return static_cast<double>(n); };
  const auto unit = [&](Dimension dimension) {
    const std::string label = units.label(dimension);
    if (label == "1") return std::string();
    return label == "kg m2/m2" ? std::string("kg") : label;
  };
  const Body principal = shape::body(properties);
  const Vec3& I = principal.moments();
  const Quaternion& q = principal.q_FB();
  const Vec3& c = properties.centre;
  const shape::MassMoments m = shape::principal_moments(properties, principal);
  const std::string length = units.length();
  return {
      {"vertices", "vertices", {count(shape.vertices().size())}, "", ""},
      {"facets", "facets", {count(shape.triangles().size())}, "", ""},
      {"area", "area", {shape.area()}, "", power(length, 2)},
      {"volume", "volume", {properties.volume}, "", power(length, 3)},
      {"mass", "mass", {properties.mass}, "", unit(Dimension::mass)},
      {"centre",
       "centre of mass, in the axes of the file",
       {c.x, c.y, c.z},
       "",
       length == "1" ? "" : length},
      {"moments", "principal moments I1, I2, I3", {I.x, I.y, I.z}, "", unit(Dimension::moment)},
      {"principal_axes",
       "principal axes in those of the file (quaternion)",
       {q.w, q.x, q.y, q.z},
       "",
       ""},
      {"third",
       "third moments xxx ... zzz, principal axes",
       {m.third.begin(), m.third.end()},
       "",
       unit(Dimension::moment3)},
      {"fourth",
       "fourth moments xxxx ... zzzz",
       {m.fourth.begin(), m.fourth.end()},
       "",
       unit(Dimension::moment4)},
  };
}

std::string body_table(const shape::MassProperties& properties, const Units& units) {
  const Mat3& I = properties.inertia;
  const bool is_plain = units.moment() == "1";
  std::string table = std::string("[body]\ntensor = ") + (is_plain ? "[" : "{ value = [");
  for (int i = 0; i < 3; ++i) {
    table += i == 0 ? "[" : ", [";
    for (int j = 0; j < 3; ++j)
      table += (j == 0 ? "" : ", ") + polhode::detail::number_text(I(i, j));
    table += "]";
  }
  return table + (is_plain ? "]\n" : "], unit = \"" + units.moment() + "\" }\n");
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
