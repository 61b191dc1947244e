// SPDX-License-Identifier: MIT
// The table of scenario keys: what the rows hold, and what an attitude file says.
#include <string>
#include <vector>

#include "polhode/output/columns.hpp"
#include "scenario/detail/schema_parts.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using enum KeyType;
using enum Presence;

constexpr Key keys[] = {
    {.path = "output", .fallback = "{}", .help = "What the rows hold."},
    {.path = "output.columns",
     .type = choices,
     .fallback = "[\"q\", \"omega\"]",
     .example = "[\"q\", \"omega\", \"andoyer\"]",
     .help = "Groups of columns after t. A column that two groups share is written once."},
    {.path = "output.aem",
     .help = "What a CCSDS Attitude Ephemeris Message, --out PATH.aem, says and how. It needs "
             "state.epoch and the columns q (q_inertial where the frame moves)."},
    {.path = "output.aem.form",
     .type = choice,
     .allowed = "quaternion|quaternion-rate|euler|spin",
     .fallback = "\"quaternion\"",
     .example = "\"quaternion\"",
     .help = "QUATERNION; with the angular velocity (needs the columns omega); EULER_ANGLE, the "
             "angles 3-1-3; or SPIN of body axis 3 (needs omega)."},
    {.path = "output.aem.version",
     .type = integer,
     .allowed = "1|2",
     .fallback = "1",
     .example = "1",
     .help = "CCSDS_AEM_VERS: 1, of 2008, which most programs read, or 2, of 2024."},
    {.path = "output.aem.quaternion_type",
     .type = choice,
     .allowed = "LAST|FIRST",
     .fallback = "\"LAST\"",
     .example = "\"LAST\"",
     .help = "Where the scalar of a quaternion stands; version 2 has LAST alone."},
    {.path = "output.aem.direction",
     .type = choice,
     .allowed = "A2B|B2A",
     .fallback = "\"A2B\"",
     .example = "\"A2B\"",
     .help = "ATTITUDE_DIR; B2A is the inverse rotation, of form quaternion and version 1 alone."},
    {.path = "output.aem.object_name",
     .type = text,
     .example = "\"ENVISAT\"",
     .help = "OBJECT_NAME; left out, the title, or else the name of the file."},
    {.path = "output.aem.object_id",
     .type = text,
     .example = "\"2002-009A\"",
     .help = "OBJECT_ID; left out, UNKNOWN."},
    {.path = "output.aem.originator",
     .type = text,
     .fallback = "\"POLHODE\"",
     .example = "\"POLHODE\"",
     .help = "ORIGINATOR."},
    {.path = "output.aem.creation_date",
     .type = text,
     .example = "\"2026-01-31T12:00:00\"",
     .help = "CREATION_DATE. Left out, 1970-01-01T00:00:00 with a comment: equal runs give equal "
             "files."},
    {.path = "output.aem.center",
     .type = text,
     .example = "\"EARTH\"",
     .help = "CENTER_NAME; left out, none is written."},
    {.path = "output.aem.frame_a",
     .type = text,
     .example = "\"EME2000\"",
     .help = "REF_FRAME_A, a name for state.axes. Left out, EME2000 (ecliptic-J2000 is turned into "
             "it), or INERTIAL."},
    {.path = "output.aem.frame_b",
     .type = text,
     .fallback = "\"SC_BODY_1\"",
     .example = "\"SC_BODY_1\"",
     .help = "REF_FRAME_B, a name for the body axes."},
};

// "q|omega|...": the groups that rows can hold.
const std::string& column_words() {
  static const std::string words = [] {
    std::string joined;
    for (const std::string_view name : column_group_names())
      joined += (joined.empty() ? "" : "|") + std::string(name);
    return joined;
  }();
  return words;
}

}  // namespace

SchemaPart output_keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> made(std::begin(keys), std::end(keys));
    for (Key& key : made)
      if (key.path == "output.columns") key.allowed = column_words();
    return made;
  }();
  return {all, {}};
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
