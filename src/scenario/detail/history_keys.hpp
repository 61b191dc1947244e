// SPDX-License-Identifier: MIT
// What the kinds of [orbit.NAME] share that are elements over ages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "polhode/math/quaternion.hpp"
#include "polhode/scenario/orbit_kind.hpp"
#include "scenario/kinds/orbits/shared_keys.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// What a column of a file is, by the word that `columns` has for it.
struct ColumnRole {
  std::string_view name;
  Dimension dimension;
  bool is_read = true;  // or may stand there, but nothing needs it
};

// The keys that say what the columns of a file are: by the names that the file gives them, or in
// their order. "-" is a column that is not read.
struct ColumnKeys {
  std::vector<std::string> columns, units;
};

// The columns of a file that a scenario names: in core units, by the places of their roles; empty
// for roles that are not among them.
class DeclaredColumns {
 public:
  // Reads the file of the key `file`.
  DeclaredColumns(const KeyValues& at, std::string_view file, const ColumnKeys& keys,
                  std::span<const ColumnRole> roles);

  bool has(std::size_t role) const { return !columns_.at(role).empty(); }
  const std::vector<double>& of(std::size_t role) const { return columns_.at(role); }
  std::size_t rows() const { return lines_.size(); }
  // What one unit of it is in core units.
  double unit(std::size_t role) const { return units_.at(role); }
  // "mars.csv:17: ", for messages.
  std::string place(std::size_t row) const;

 private:
  std::string file_;
  std::vector<std::vector<double>> columns_;
  std::vector<double> units_;
  std::vector<std::uint32_t> lines_;
};

// What turns components along axes of this name to ecliptic-J2000.
Quaternion ecliptic_from(std::string_view axes);

// Whether angles declared in degrees may be radians: none exceeds 2 pi, and as radians they would
// cover more than half a turn.
bool may_be_radians(std::span<const double> angles, double degree);

// What a rotation needs besides elements: size and place on the orbit.
struct PlaceKeys {
  std::optional<double> gm, semi_major_axis;
  double mean_longitude;
};
// Keys of PlaceKeys for arguments A that derive from it, and the key of column units.
template <class A>
constexpr std::array<KindKey<A>, 3> place_keys = {
    orbit_gm_key<&PlaceKeys::gm, A>(),
    quantity_key<&PlaceKeys::semi_major_axis, A>(
        "semi_major_axis", Dimension::length,
        "Of a rotation's orbit, with gm: it stays, and gives the mean motion.")
        .example("\"1.5237 au\""),
    quantity_key<&PlaceKeys::mean_longitude, A>(
        "mean_longitude", Dimension::angle,
        "Of a rotation's orbit at t = 0: node plus argument plus mean anomaly, along the axes of "
        "the elements as they are in the file.")
        .otherwise("0"),
};
template <class A>
constexpr KindKey<A> column_units_key =
    units_key<&ColumnKeys::units, A>("units",
                                     "The unit of each of these columns; \"1\" of numbers.")
        .required();

// The positions over the run, refused at `key`. `from_file` turned the elements from the axes in
// which the longitude counts.
ScenarioOrbit positions_of(const OrbitContext& at, std::string_view key,
                           const ScenarioHistory& history, const PlaceKeys& place,
                           const Quaternion& from_file = {});

OrbitKind elements_kind();
OrbitKind series_kind();
OrbitKind shipped_kind();

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
