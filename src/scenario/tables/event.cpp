// SPDX-License-Identifier: MIT
#include "scenario/tables/event.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "scenario/scenario_parts.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

struct EventTable {
  std::string name;  // empty: that of the column
  std::string column;
  double value = 0.0;  // in the unit of the column
  Crossing crossing = Crossing::both;
  bool stops = false;
  double interval = 0.0;  // 0: looks follow the rotation
};

constexpr std::array keys_of_event = {
    name_key<&EventTable::name>("name", "What outputs call it; left out, the name of the column.")
        .example("\"flip\""),
    text_key<&EventTable::column>("column",
                                  "Any column but t, of any group; it need not be written.")
        .required()
        .example("\"w3\""),
    quantity_key<&EventTable::value>(
        "value", Dimension::number, "In the unit of the column; angles are compared modulo a turn.")
        .otherwise("0"),
    choice_key<&EventTable::crossing, Crossing::both, Crossing::rising, Crossing::falling>(
        "crossing", "both|rising|falling", "Which passages count.")
        .otherwise("\"both\""),
    flag_key<&EventTable::stops>("stops", "Whether the run ends there, with a last row.")
        .otherwise("false"),
    quantity_key<&EventTable::interval>(
        "interval", Dimension::time,
        "The column is looked at this often at least. Left out: twelve times in the fastest turn "
        "of the body and its frame, which finds what varies as fast as these.")
        .example("1")
        .positive(),
};
constexpr Table<EventTable> event_description = {
    {.path = "event[]",
     .help = "A time to find: when a column passes a value. `polhode run --events` writes them."},
    keys_of_event};

}  // namespace

SchemaPart event_keys() { return part_of<event_description>(); }

std::vector<ScenarioEvent> events_of(const FileValues& file, const ColumnKinds& columns) {
  const std::vector<std::string_view> known = column_names(columns);
  std::vector<ScenarioEvent> events;
  for (const Placed<EventTable>& one : placed_tables(event_description, file)) {
    if (std::find(known.begin(), known.end(), one->column) == known.end())
      one.refuse<&EventTable::column>(
          "expected a column such as \"theta\", \"L\" or \"w3\" (docs/reference/files.md)" +
          did_you_mean(one->column, known));
    const std::string own = one->name.empty() ? one->column : one->name;
    if (std::ranges::find(events, own, &ScenarioEvent::name) != events.end()) {
      const std::string message =
          "expected a name of its own, since an event before it is called " + own;
      if (one->name.empty()) one.refuse<&EventTable::column>(message);
      one.refuse<&EventTable::name>(message);
    }
    events.push_back({own, one->column,
                      file.units.to_core(one->value, column_dimension(one->column, columns)),
                      one->crossing, one->stops, one->interval});
  }
  return events;
}

void refuse_event_column(const FileValues& file, std::size_t i, std::string_view message) {
  placed_tables(event_description, file).at(i).refuse<&EventTable::column>(message);
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
