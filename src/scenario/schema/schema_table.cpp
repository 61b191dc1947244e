// SPDX-License-Identifier: MIT
// The table of scenario keys: the body and the rows. Order here is the order in documents and
// templates; the state and what moves the body (schema_parts.hpp) stand between body and rows.
#include <vector>

#include "polhode/scenario/schema.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key body_keys[] = {
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
     .type = choice,
     .allowed = "rotation",
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
     .help = "Symmetric inertia tensor in axes fixed in the body. [state.attitude-rate] and the "
             "columns q, omega and g then refer to these axes, all else to the principal axes."},

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
     .help = "Its density."},
    {.path = "body.scale",
     .type = number,
     .dimension = Dimension::length,
     .example = "\"1 km\"",
     .help = "What one unit of the mesh is; left out, the unit of length of this file."},
    {.path = "body.column_axes",
     .type = numbers,
     .length = 4,
     .example = "[1.0, 0.0, 0.0, 0.0]",
     .help = "Beside moments: the attitude [w, x, y, z] of the principal axes in other axes fixed "
             "in the body, which the columns q, omega and g then refer to. Nothing else does."},
};

constexpr Key row_keys[] = {
    {.path = "time", .help = "When to write rows; needed by `polhode run`."},
    {.path = "time.start",
     .type = number,
     .dimension = Dimension::time,
     .fallback = "0",
     .example = "0",
     .help = "First row, counted from the epoch."},
    {.path = "time.stop",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "720",
     .help = "No row lies beyond it."},
    {.path = "time.step",
     .type = number,
     .presence = alternative,
     .dimension = Dimension::time,
     .example = "0.5",
     .help = "Rows at start + k step, each rounded once; its sign is that of stop - start."},
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
     .help = "Exactly these times, in this order; leave start out."},
};

constexpr Alternatives alternatives[] = {
    {"body", "moments|tensor|shape+density"},
    {"time", "stop+step|stop+count|at"},
};

// The parts of the table in one piece.
template <class Row>
std::vector<Row> concatenated(std::initializer_list<std::span<const Row>> parts) {
  std::vector<Row> all;
  for (const std::span<const Row> part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace

const Schema& scenario_schema() {
  static const std::vector<Key> keys = concatenated<Key>(
      {body_keys, detail::state_keys().keys, detail::frame_keys().keys, detail::orbit_keys().keys,
       detail::perturbation_keys().keys, detail::surface_keys().keys, detail::method_keys().keys,
       row_keys, detail::output_keys().keys, detail::map_keys().keys});
  static const std::vector<Alternatives> choices = concatenated<Alternatives>(
      {alternatives, detail::state_keys().alternatives, detail::frame_keys().alternatives,
       detail::orbit_keys().alternatives, detail::perturbation_keys().alternatives,
       detail::surface_keys().alternatives, detail::method_keys().alternatives,
       detail::map_keys().alternatives});
  static const Schema schema{keys, choices};
  return schema;
}

}  // namespace v0
}  // namespace polhode
