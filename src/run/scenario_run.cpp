// SPDX-License-Identifier: MIT
// The run of a scenario into files, and the table of its events.
#include "polhode/run/scenario_run.hpp"

#include <filesystem>
#include <optional>
#include <utility>

#include "math/number_text.hpp"
#include "output/formats/formats.hpp"
#include "output/part_file.hpp"
#include "polhode/error.hpp"
#include "polhode/run/detail/run_state.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/output_checks.hpp"
#include "run/detail/sweep.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
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

namespace {

constexpr std::size_t events_shown = 20;

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

detail::CheckpointSetup setup_of(const Scenario& scenario, const RunFiles& files) {
  std::vector<std::string> paths = files.outputs;
  if (!files.events.empty()) paths.push_back(files.events);
  detail::require_own_files(scenario.document, paths);
  const std::vector<ColumnGroup> groups = row_groups(scenario);
  std::vector<detail::PlannedOutput> planned;
  for (const std::string& path : files.outputs) planned.push_back({path, groups});
  if (!files.events.empty()) planned.push_back({files.events, detail::event_groups(groups)});
  return {{"run", "runs the scenario anew"},
          detail::identity_of(scenario, {files.outputs, files.events, scenario.output.columns}),
          std::move(planned),
          scenario.output.formats};
}

// As a report keeps it: its row is in the table of events.
RunEvent without_row(RunEvent event) {
  event.row.clear();
  return event;
}

}  // namespace

// A sweep of one cell, which is kept between its steps.
class ScenarioRun::Parts final : public detail::Sweep {
 public:
  Parts(const Scenario& scenario, RunFiles files, RunOptions options)
      : Sweep(scenario, setup_of(scenario, files), row_groups(scenario), provenance(scenario),
              std::move(options)),
        files_(std::move(files)) {
    if (outputs_.is_complete()) return;
    resume();
    require_room();
    open([this](
             const std::string& path,
             const std::optional<SinkPosition>& from) -> std::optional<detail::CheckpointedOutput> {
      if (sinks_.size() < files_.outputs.size()) return std::nullopt;
      events_.emplace(path, scenario_, from);
      return detail::CheckpointedOutput{[this] { return events_->position(); }, [] {}};
    });
  }

  RunReport run() {
    if (outputs_.is_complete()) return complete_report();
    RunReport report;
    try {
      outputs_.with_remedy([&] {
        report = detail::run_rows(scenario_, sinks_, control());
        if (report.outcome.ok() && events_) events_->finish();
      });
    } catch (const DomainError&) {
      outputs_.forget();  // what a term or an orbit refuses, it would refuse again
      throw;
    }
    for (std::size_t i = 0; report.outcome.ok() && i < files_.outputs.size(); ++i)
      for (const std::string& warning : sinks_[i]->warnings())
        report.warnings.push_back(detail::printable(files_.outputs[i], 500) + ": " + warning);
    report.events_met = events_met_;
    report.events = std::move(events_so_far_);
    outputs_.forget();
    return report;
  }

 private:
  // The bytes of what moves are the last: those of a run that is resumed wait for its motion.
  void serialize(Archive& bytes) override {
    bytes.all(t_, rows_);
    bytes.list(events_so_far_, [&](RunEvent& e) { bytes.all(e.name, e.t, e.direction, e.state); });
    bytes(events_met_);
    if (write_motion_ != nullptr) (*write_motion_)(bytes);
  }
  double reached() const override { return t_; }
  detail::CheckpointPlace place() const override {
    const std::string at = "t = " + time_text(t_);
    std::string reached = detail::printable(scenario_.document.name, 200) + " at " + at + ", " +
                          std::to_string(rows_) + " rows, in ";
    std::vector<std::string> paths = files_.outputs;
    if (!files_.events.empty()) paths.push_back(files_.events);
    for (const std::string& path : paths)
      reached += (path == paths.front() ? "" : ", ") + detail::printable(file_name(path), 200);
    return {reached, "at " + at, "from " + at};
  }

  // Before anything is written: days of work would end with a disk that is full.
  void require_room() const {
    if (may_end_early(scenario_)) return;
    for (const DiskNeed& need : disk_needs(scenario_, files_.outputs, rows_))
      if (need.least > need.available)
        throw OutputError(scenario_.document.name + ": got " +
                          disk_text(scenario_, need, need.least, rows_) +
                          "; expected fewer rows or columns, or another disk");
  }

  detail::RunControl control() {
    detail::RunControl control;
    if (options_.progress)
      control.progress = [this, from = reached_before(),
                          end = row_times(scenario_)->end()](double t) {
        options_.progress({t, end == from ? 1.0 : (t - from) / (end - from)});
      };
    control.event = [this](const RunEvent& event) {
      if (events_) events_->push(event);
      ++events_met_;
      if (options_.keep_events || events_so_far_.size() < events_shown)
        events_so_far_.push_back(without_row(event));
    };
    control.events_have_rows = events_.has_value();
    control.due = [this](double) {
      stopping_ = is_stopped();
      return stopping_ || outputs_.is_due();
    };
    control.keep = [this](const detail::RunState& state, const detail::WriteMotion& motion) {
      t_ = state.t;
      rows_ = state.rows;
      write_motion_ = &motion;
      if (stopping_) interrupt();
      keep();
    };
    control.rows = rows_;
    if (outputs_.continues()) control.motion = &outputs_.state();
    return control;
  }

  std::string time_text(double t) const {
    return polhode::detail::number_text(scenario_.units().from_core(t, Dimension::time)) + " " +
           scenario_.units().time();
  }

  RunReport complete_report() const {
    RunReport report;
    report.rows = row_times(scenario_)->size();
    report.outcome.t = row_times(scenario_)->end();
    return report;
  }

  RunFiles files_;
  double t_ = 0.0;
  std::vector<RunEvent> events_so_far_;
  std::int64_t events_met_ = 0;
  std::optional<EventTable> events_;
  const detail::WriteMotion* write_motion_ = nullptr;
  bool stopping_ = false;
};

namespace {

const Scenario& with_rows(const Scenario& scenario) {
  if (row_times(scenario)) return scenario;
  throw DomainError(scenario.document.name + ": time: got nothing; expected [time]");
}

}  // namespace

ScenarioRun::ScenarioRun(const Scenario& scenario, RunFiles files, RunOptions options)
    : ResumableRun(
          std::make_unique<Parts>(with_rows(scenario), std::move(files), std::move(options))) {}
RunReport ScenarioRun::run() { return static_cast<Parts&>(*sweep_).run(); }

}  // namespace io
}  // namespace v0
}  // namespace polhode
