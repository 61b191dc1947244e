// SPDX-License-Identifier: MIT
// The table of scenario keys: what every file has, the body and the rows of a rotation. The keys of
// a kind stand between the head of a file and its output; their order is that of its row in
// experiment_kinds.cpp, which documents and templates follow.
#include "scenario/detail/schema_table.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key head_keys[] = {
    {.path = "schema",
     .type = integer,
     .presence = required,
     .allowed = "1",
     .example = "1",
     .help = "Version of this format."},
    {.path = "title",
     .type = text,
     .example = "\"My tumbling body\"",
     .help = "One line that outputs carry along."},
    {.path = "kind",
     .type = choice,  // of the kinds there are: see scenario_schema
     .fallback = "\"rotation\"",
     .example = "\"rotation\"",
     .help = "What the file describes."},

    {.path = "units",
     .fallback = "{}",
     .help = "Units of every bare number in this file and of every output."},
    {.path = "units.time",
     .type = unit,
     .dimension = Dimension::time,
     .fallback = "\"s\"",
     .example = "\"h\"",
     .help = "Unit of time, a single unit such as s, min, h, d, yr."},
    {.path = "units.angle",
     .type = unit,
     .dimension = Dimension::angle,
     .fallback = "\"rad\"",
     .example = "\"deg\"",
     .help =
         "Unit of angles and, per unit of time, of angular rates; momenta always count radians."},
    {.path = "units.moment",
     .type = unit,
     .dimension = Dimension::moment,
     .fallback = "\"1\"",
     .example = "\"1\"",
     .help = "Unit of moments of inertia: 1 (scale-free, only ratios matter) or one like kg m2. "
             "Momenta are in moment/time, energies in moment/time^2."},
    {.path = "units.length",
     .type = unit,
     .dimension = Dimension::length,
     .fallback = "\"1\"",
     .example = "\"km\"",
     .help = "Unit of lengths: 1 (scale-free) or one like km. GM is in length^3/time^2."},

};

constexpr Key keys_of_body[] = {
    {.path = "body", .presence = required, .help = "The rigid body."},
    {.path = "body.moments",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::moment,
     .length = 3,
     .example = "[0.61, 0.965, 1.0]",
     .help =
         "Principal moments about the body axes 1, 2, 3, in any order; positive, and none above "
         "the sum of the other two."},
    {.path = "body.tensor",
     .type = matrix,
     .presence = alternative,
     .dimension = Dimension::moment,
     .example = "[[0.7, 0.1, 0.0], [0.1, 0.9, 0.0], [0.0, 0.0, 1.0]]",
     .help = "Symmetric inertia tensor in axes fixed in the body. Element (1, 2) is minus the "
             "integral of x y dm, which other programs may call the product of inertia. "
             "[state.attitude-rate] and the columns q, omega and g then refer to these axes, all "
             "else to the principal axes."},

    {.path = "body.shape",
     .type = text,
     .presence = alternative,
     .example = "\"body.obj\"",
     .help = "A closed mesh, Wavefront OBJ, filled with constant density: gives the tensor about "
             "its centre of mass, in the axes of the mesh. Relative to the folder of this file.",
     .is_file = true},
    {.path = "body.density",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::density,
     .example = "\"2000 kg/m3\"",
     .help = "Its density.",
     .range = Range::positive},
    {.path = "body.scale",
     .type = number,
     .dimension = Dimension::length,
     .example = "\"1 km\"",
     .help = "What one unit of the mesh is; required with shape.",
     .range = Range::positive},
    {.path = "body.column_axes",
     .type = numbers,
     .length = 4,
     .example = "[1.0, 0.0, 0.0, 0.0]",
     .help = "With moments: the attitude [w, x, y, z] of the principal axes in other axes fixed "
             "in the body, which the columns q, omega and g then refer to. Nothing else does."},
};

constexpr Key keys_of_time[] = {
    {.path = "time", .help = "When to write rows; needed by `polhode run`."},
    {.path = "time.start",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "First row, counted from the epoch.",
     .takes_date = true},
    {.path = "time.stop",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "720",
     .help = "Where the run ends. No row lies beyond it.",
     .takes_date = true},
    {.path = "time.step",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .allowed = "auto",
     .example = "0.5",
     .help = "Rows at start + k step, each rounded once; negative where stop is before start. In "
             "files of kind obliquity either sign will do. \"auto\": even rows from start to stop, "
             "as many as error asks for and at most a radian of rotation apart."},
    {.path = "time.error",
     .type = number,
     .dimension = Dimension::angle,
     .example = "\"0.01 deg\"",
     .help = "With step = \"auto\": how far the attitude may be from a rotation about a fixed axis "
             "at a fixed rate between two rows, which is how SPICE interpolates. Left out, 0.01 "
             "degrees.",
     .range = Range::positive},
    {.path = "time.count",
     .type = integer,
     .presence = alternative,
     .example = "1441",
     .help = "Number of rows, evenly from start to stop, both included."},
    {.path = "time.at",
     .type = numbers,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "[0.0, 1.0, 10.0]",
     .help = "Exactly these times, in this order; leave start out.",
     .takes_date = true},
};

constexpr Alternatives of_body[] = {{"body", "moments|tensor|shape+density"}};
constexpr Alternatives of_time[] = {{"time", "stop+step|stop+count|at"}};

// The parts of all kinds, each once, with the words of the kinds that have it.
struct PartOfKinds {
  detail::SchemaPart part;
  std::string kinds;
};

void join(std::string& words, std::string_view word) {
  words += (words.empty() ? "" : "|") + std::string(word);
}

std::vector<PartOfKinds> parts_of(std::span<const detail::ExperimentRow> kinds) {
  std::vector<PartOfKinds> parts;
  for (const detail::ExperimentRow& kind : kinds)
    for (const detail::SchemaPart& part : kind.parts) {
      const auto same = std::find_if(parts.begin(), parts.end(), [&](const PartOfKinds& other) {
        return other.part.keys.data() == part.keys.data();
      });
      join(same == parts.end() ? parts.emplace_back(PartOfKinds{part, {}}).kinds : same->kinds,
           kind.name);
    }
  return parts;
}

}  // namespace

detail::SchemaPart detail::body_keys() { return {keys_of_body, of_body}; }
detail::SchemaPart detail::time_keys() { return {keys_of_time, of_time}; }

detail::SchemaTable::SchemaTable(std::span<const ExperimentRow> kinds, const SchemaPart& output,
                                 const OutputFormats& formats) {
  std::string& all = words_.emplace_back();
  for (const ExperimentRow& kind : kinds) join(all, kind.name);
  add({head_keys, {}}, {});
  for (Key& key : keys_)
    if (key.path == "kind") key.allowed = all;
  for (const PartOfKinds& one : parts_of(kinds))
    add(one.part, one.kinds == all ? std::string_view() : words_.emplace_back(one.kinds));
  add(output, {});
  for (const OutputFormat& format : formats.all()) add(format);
  add(map_keys(), {});
  add(ensemble_keys(), {});
}

// [output.NAME] of a format that has keys.
void detail::SchemaTable::add(const OutputFormat& format) {
  if (format.keys.empty()) return;
  const std::string& table = words_.emplace_back("output." + format.name);
  keys_.push_back({.path = table, .help = words_.emplace_back(format.help)});
  for (const OptionKey& option : format.keys) {
    keys_.push_back(option.key());
    keys_.back().path = words_.emplace_back(table + "." + std::string(option.key().path));
  }
}

void detail::SchemaTable::add(const SchemaPart& part, std::string_view kinds) {
  for (const Key& key : part.keys) {
    keys_.push_back(key);
    if (key_table(key.path).empty() && !kinds.empty()) keys_.back().kinds = kinds;
  }
  for (const Alternatives& row : part.alternatives) {
    alternatives_.push_back(row);
    if (row.table.empty() && !kinds.empty()) alternatives_.back().kinds = kinds;
  }
  texts_.insert(texts_.end(), part.kinds.begin(), part.kinds.end());
}

}  // namespace v0
}  // namespace polhode
