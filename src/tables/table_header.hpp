// SPDX-License-Identifier: MIT
// What the lines above the rows of a table say of its numbers: when t = 0 is, along which axes
// vectors are, units. Those of `polhode run`, of polhode.satellites and of Horizons are understood;
// any other comment is a comment.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "tables/number_table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

struct TableHeader {
  struct Note {
    std::string text;  // "2029-04-13T00:00:00.000 UTC"
    std::string at;    // "moon.csv:1: "
  };
  std::optional<Note> epoch;
  std::optional<Note> axes;  // as state.axes has them
  std::optional<Note> time;  // units
  std::optional<Note> length;
  std::optional<Note> speed;
  std::map<std::string, Note, std::less<>> columns;  // units by name
};

// The axes that a scenario knows by name.
bool is_axes(std::string_view text);

// "# t counts from 2029-04-13T00:00:00 UTC; axes: equator-J2000", "# units: t [s], x [km]",
// "# ISS, SGP4; t in s after 2029-04-13T00:00:00.000 UTC; km; equator-J2000", and of Horizons
// "Output units : KM-S", "Reference frame : ICRF".
TableHeader header_of(const NumberTable& table);

// The time scale that the name of a column of dates says: "JDTDB", "Calendar Date (TDB)".
std::optional<std::string_view> scale_of_column(std::string_view name);

// Of a file that can be read: its first lines are a name or none, then "1 25544U ..." and "2 25544
// ...". DomainError as from a table.
bool has_two_line_elements(const std::string& path);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
