// SPDX-License-Identifier: MIT
#include <filesystem>
#include <optional>

#include "output/formats/formats.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/experiment_parts.hpp"
#include "scenario/scenario_parts.hpp"
#include "text/number_text.hpp"
#include "text/printable.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr std::size_t longest_path = 500;

const std::string& csv_path(const std::string& path) {
  if (std::filesystem::path(path).extension() == ".csv") return path;
  throw DomainError(detail::printable(path, longest_path) +
                    ": events are written as CSV; expected PATH.csv");
}

void append_number(std::string& text, double number) {
  char digits[detail::longest_number];
  text += ',';
  text.append(digits, detail::write_number(digits, number));
}

}  // namespace

std::vector<ColumnGroup> detail::event_groups(const RowLayout& layout) {
  std::vector<ColumnGroup> groups = layout.groups();
  groups.insert(groups.begin(), {"name", {{"name", "text"}}});
  groups.insert(groups.begin() + 2, {"direction", {{"direction", "1"}}});
  return groups;
}

struct EventTable::Parts {
  Parts(const std::string& path, const Scenario& of, const std::optional<SinkPosition>& from)
      : scenario(of),
        layout(row_layout(of)),
        problem(polhode::problem(of.experiment)),
        energy_0(detail::initial_energy(problem)),
        motion(detail::constant_motion(of)),
        file(csv_path(path),
             from ? std::optional(detail::PartState{from->bytes, header()}) : std::nullopt),
        rows(from ? from->rows : 0) {}

  std::string header() const {
    return detail::csv_head(detail::event_groups(layout), provenance(scenario));
  }

  std::string line(const DampedEventRecord& event) const {
    std::vector<double> row(layout.width());
    if (motion) {
      layout.write_rows(*motion, {&event.t, 1}, row);
    } else {
      const DampedSample sample{event.t, event.s};
      layout.write_rows(RowOrigin{problem.system, energy_0}, {&sample, 1}, row);
    }
    std::string text = event.name;
    append_number(text, row[0]);
    append_number(text, event.direction);
    for (std::size_t i = 1; i < row.size(); ++i) append_number(text, row[i]);
    return text + "\n";
  }

  const Scenario& scenario;
  RowLayout layout;
  DampedProblem problem;
  double energy_0;
  std::optional<FreeRotation> motion;  // of a free body: its rows are those of a run
  detail::PartFile file;
  std::int64_t rows;
};

EventTable::EventTable(const std::string& path, const Scenario& scenario,
                       const std::optional<SinkPosition>& from)
    : parts_(std::make_unique<Parts>(path, scenario, from)) {
  if (!from) parts_->file.write(parts_->header());
}

EventTable::~EventTable() = default;

void EventTable::push(const DampedEventRecord& event) {
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
