// SPDX-License-Identifier: MIT
#include "output/obliquity_columns.hpp"

#include <algorithm>
#include <cmath>

#include "polhode/error.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// I, h, H as of Andoyer: of the angular momentum against the axes of reference, per unit of G.
constexpr SpinColumn columns_table[] = {
    {"obliquity", "obliquity", Dimension::angle,
     [](const SpinRow& r) { return r.angles.obliquity; }},
    {"precession", "precession", Dimension::angle,
     [](const SpinRow& r) { return r.angles.precession; }},
    {"climatic_precession", "climatic_precession", Dimension::number,
     [](const SpinRow& r) { return r.angles.climatic_precession; }},
    {"pericentre", "pericentre", Dimension::angle,
     [](const SpinRow& r) { return r.angles.pericentre; }},
    {"eccentricity", "eccentricity", Dimension::number,
     [](const SpinRow& r) { return secular::eccentricity(r.orbit); }},
    {"spin", "sx", Dimension::number, [](const SpinRow& r) { return r.axis.s.x; }},
    {"spin", "sy", Dimension::number, [](const SpinRow& r) { return r.axis.s.y; }},
    {"spin", "sz", Dimension::number, [](const SpinRow& r) { return r.axis.s.z; }},
    {"andoyer", "I", Dimension::angle,
     [](const SpinRow& r) { return std::atan2(std::hypot(r.axis.s.x, r.axis.s.y), r.axis.s.z); }},
    {"andoyer", "h", Dimension::angle,
     [](const SpinRow& r) { return std::atan2(r.axis.s.x, -r.axis.s.y); }},
    {"andoyer", "H", Dimension::number, [](const SpinRow& r) { return r.axis.s.z; }},
    {"insolation", "insolation", Dimension::number, [](const SpinRow& r) { return r.insolation; },
     "W/m2"},
    // over what they are at t = 0
    {"tides", "rotation_rate", Dimension::number, [](const SpinRow& r) { return r.axis.spin; }},
    {"tides", "satellite_distance", Dimension::number,
     [](const SpinRow& r) { return r.axis.distance; }},
};

}  // namespace

SpinRow spin_row(const secular::TidalSpin& axis, const secular::OrbitElements& orbit,
                 const std::optional<secular::InsolationPlace>& place) {
  const secular::SpinAngles angles = secular::spin_angles({axis.s}, orbit);
  return {axis, orbit, angles,
          place ? secular::daily_insolation(angles, secular::eccentricity(orbit), *place)
                : std::nan("")};
}

std::string unit_of(const SpinColumn& column, const Units& units) {
  return column.unit.empty() ? units.label(column.dimension) : std::string(column.unit);
}

const SpinColumn* spin_column(std::string_view name) {
  for (const SpinColumn& column : columns_table)
    if (column.name == name) return &column;
  return nullptr;
}

std::vector<std::string_view> spin_column_names() {
  std::vector<std::string_view> names;
  for (const SpinColumn& column : columns_table) names.push_back(column.name);
  return names;
}

std::vector<std::string_view> spin_column_groups() {
  std::vector<std::string_view> names;
  for (const SpinColumn& column : columns_table)
    if (names.empty() || names.back() != column.group) names.push_back(column.group);
  return names;
}

SpinLayout::SpinLayout(std::span<const std::string> groups, const Units& units) : units_(units) {
  groups_ = {{"t", {{"t", units.time()}}}};
  for (const std::string& name : groups) {
    ColumnGroup group{name, {}};
    for (const SpinColumn& column : columns_table) {
      if (column.group != name) continue;
      group.columns.push_back({std::string(column.name), unit_of(column, units)});
      cells_.push_back({column.value, column.dimension});
    }
    if (group.columns.empty())
      throw DomainError("columns: got \"" + name + "\"; expected " + one_of(spin_column_groups()));
    for (const ColumnGroup& other : groups_)
      if (other.name == name) throw DomainError("columns: got \"" + name + "\" twice");
    groups_.push_back(std::move(group));
  }
}

void SpinLayout::write(double t, const SpinRow& row, std::span<double> out) const {
  out[0] = units_.from_core(t, Dimension::time);
  for (std::size_t i = 0; i < cells_.size(); ++i)
    out[i + 1] = units_.from_core(cells_[i].value(row), cells_[i].dimension);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
