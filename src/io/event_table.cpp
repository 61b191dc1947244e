// SPDX-License-Identifier: MIT
#include <filesystem>

#include "io/detail/number_text.hpp"
#include "io/detail/part_file.hpp"
#include "io/detail/sinks.hpp"
#include "io/detail/values.hpp"
#include "polhode/error.hpp"
#include "polhode/io/run.hpp"

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

struct EventTable::Parts {
  Parts(const std::string& path, const Scenario& from)
      : scenario(from), layout(row_layout(from)), file(csv_path(path)) {}

  // The columns of a row, t and direction in front.
  std::string header() const {
    std::vector<ColumnGroup> groups = layout.groups();
    groups.insert(groups.begin(), {"name", {{"name", "text"}}});
    groups.insert(groups.begin() + 2, {"direction", {{"direction", "1"}}});
    return detail::csv_head(groups, provenance(scenario));
  }

  std::string line(const RowOrigin& origin, const EventRecord& event) const {
    std::vector<double> row(layout.width());
    const Sample sample{event.t, event.s};
    layout.write_rows(origin, {&sample, 1}, row);
    std::string text = event.name;
    append_number(text, row[0]);
    append_number(text, event.direction);
    for (std::size_t i = 1; i < row.size(); ++i) append_number(text, row[i]);
    return text + "\n";
  }

  const Scenario& scenario;
  RowLayout layout;
  detail::PartFile file;
};

EventTable::EventTable(const std::string& path, const Scenario& scenario)
    : parts_(std::make_unique<Parts>(path, scenario)) {
  parts_->file.write(parts_->header());
}

EventTable::~EventTable() = default;

void EventTable::write(const RunReport& report) {
  const System system = rotor_system(parts_->scenario);
  const double energy_0 =
      system.is_hamiltonian() ? energy(system, 0.0, initial_state(parts_->scenario)) : 0.0;
  for (const EventRecord& event : report.events)
    parts_->file.write(parts_->line({system, energy_0}, event));
  if (report.outcome.ok()) parts_->file.commit();
}

}  // namespace v0
}  // namespace polhode
