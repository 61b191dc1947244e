// SPDX-License-Identifier: MIT
#include <filesystem>
#include <optional>

#include "output/formats/formats.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/run/detail/run_state.hpp"
#include "polhode/run/run.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

const std::string& csv_path(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".csv") return path;
  throw DomainError(detail::printable(path, detail::longest_path) +
                    ": events are written as CSV; expected PATH.csv");
}

void append_number(std::string& text, double number) {
  char digits[detail::longest_number];
  text += ',';
  text.append(digits, detail::write_number(digits, number));
}

}  // namespace

std::vector<ColumnGroup> detail::event_groups(std::vector<ColumnGroup> groups) {
  groups.insert(groups.begin(), {"name", {{"name", "text"}}});
  groups.insert(groups.begin() + 2, {"direction", {{"direction", "1"}}});
  return groups;
}

struct EventTable::Parts {
  Parts(const std::string& path, const Scenario& scenario, const std::optional<SinkPosition>& from)
      : groups(detail::event_groups(row_groups(scenario))),
        header(detail::csv_head(groups, provenance(scenario))),
        dates(row_groups(scenario), run_facts(scenario)),
        file(csv_path(path),
             from ? std::optional(detail::PartState{from->bytes, header}) : std::nullopt),
        rows(from ? from->rows : 0) {}

  std::string line(const RunEvent& event) const {
    const std::size_t width = row_width(groups) - 2;  // but for name and direction
    if (event.row.size() != width)
      throw DomainError("EventTable: event \"" + event.name + "\" has a row of " +
                        std::to_string(event.row.size()) + " numbers; expected " +
                        std::to_string(width));
    std::string text = event.name;
    append_number(text, event.row[0]);
    append_number(text, event.direction);
    for (std::size_t i = 1; i < event.row.size(); ++i) {
      if (dates.is_date(i)) {
        text += ',' + dates.text(event.row[i]);
      } else {
        append_number(text, event.row[i]);
      }
    }
    return text + "\n";
  }

  std::vector<ColumnGroup> groups;
  std::string header;
  RowDates dates;
  detail::PartFile file;
  std::int64_t rows;
};

EventTable::EventTable(const std::string& path, const Scenario& scenario,
                       const std::optional<SinkPosition>& from)
    : parts_(std::make_unique<Parts>(path, scenario, from)) {
  if (!from) parts_->file.write(parts_->header);
}

EventTable::~EventTable() = default;

void EventTable::push(const RunEvent& event) {
  parts_->file.write(parts_->line(event));
  ++parts_->rows;
}

std::optional<SinkPosition> EventTable::position() {
  const std::optional<std::int64_t> bytes = parts_->file.synced_bytes();
  return bytes ? std::optional(SinkPosition{*bytes, parts_->rows}) : std::nullopt;
}

void EventTable::finish() { parts_->file.commit(); }

}  // namespace v0
}  // namespace polhode
