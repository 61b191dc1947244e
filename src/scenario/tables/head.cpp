// SPDX-License-Identifier: MIT
#include "scenario/tables/head.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "output/obliquity_columns.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

constexpr std::array keys_of_head = {
    integer_key<&HeadTable::schema>("schema", "Version of this format.")
        .one_of("1")
        .required()
        .example("1"),
    text_key<&HeadTable::title>("title", "One line that outputs carry along.")
        .example("\"My tumbling body\""),
    word_key<&HeadTable::kind>("kind", "", "What the file describes.").otherwise("\"rotation\""),
};
constexpr Table<HeadTable> head_description = {{}, keys_of_head};

// The reader makes Units of them before it reads anything else.
struct UnitsTable {
  std::string time, angle, moment, length;
};
constexpr std::array keys_of_units = {
    unit_key<&UnitsTable::time>("time", Dimension::time,
                                "Unit of time, a single unit such as s, min, h, d, yr.")
        .otherwise("\"s\"")
        .example("\"h\""),
    unit_key<&UnitsTable::angle>(
        "angle", Dimension::angle,
        "Unit of angles and, per unit of time, of angular rates; momenta always count radians.")
        .otherwise("\"rad\"")
        .example("\"deg\""),
    unit_key<&UnitsTable::moment>(
        "moment", Dimension::moment,
        "Unit of moments of inertia: 1 (scale-free, only ratios matter) or one like kg m2. Momenta "
        "are in moment/time, energies in moment/time^2.")
        .otherwise("\"1\""),
    unit_key<&UnitsTable::length>(
        "length", Dimension::length,
        "Unit of lengths: 1 (scale-free) or one like km. GM is in length^3/time^2.")
        .otherwise("\"1\"")
        .example("\"km\""),
};
constexpr Table<UnitsTable> units_description = {
    {.path = "units",
     .fallback = "{}",
     .help = "Units of every bare number in this file and of every output."},
    keys_of_units};

constexpr std::array keys_of_output = {
    words_key<&OutputTable::columns>(
        "columns", "",
        "Groups of columns after t. A column that two groups share is written once. Kind obliquity "
        "has obliquity, precession, climatic_precession, pericentre, eccentricity, spin, andoyer, "
        "insolation and tides, of which the first three are the default; all else, and andoyer, is "
        "of a rotation.")
        .otherwise("[\"q\", \"omega\"]")
        .example("[\"q\", \"omega\", \"andoyer\"]"),
};
constexpr Table<OutputTable> output_description = {
    {.path = "output", .fallback = "{}", .help = "What the rows hold."}, keys_of_output};

// Sets the allowed words, which are known only when the schema is made.
template <class A>
std::vector<Key> with_words(const Table<A>& table, std::string_view name, std::string_view words) {
  std::vector<Key> keys = keys_of(table.keys);
  std::ranges::find(keys, name, &Key::path)->allowed = words;
  return keys;
}

std::string groups_of(const ColumnKinds& columns) {
  std::vector<std::string_view> names = column_group_names(columns);
  for (const std::string_view name : spin_column_groups())
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  std::string words;
  for (const std::string_view name : names) words += (words.empty() ? "" : "|") + std::string(name);
  return words;
}

}  // namespace

HeadRows::HeadRows(std::string kinds) {
  add(head_description.row, with_words(head_description, "kind", own(std::move(kinds))));
  add(units_description.row, keys_of(units_description.keys));
}
Placed<HeadTable> head_table(const FileValues& file) { return {head_description, file}; }

OutputRows::OutputRows(const ColumnKinds& columns) {
  add(output_description.row, with_words(output_description, "columns", own(groups_of(columns))));
}
Placed<OutputTable> output_table(const FileValues& file) { return {output_description, file}; }
void refuse_columns(const FileValues& file, std::string_view message) {
  output_table(file).refuse<&OutputTable::columns>(message);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
