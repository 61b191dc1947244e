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
#include "polhode/run/disk_space.hpp"
#include "polhode/run/run.hpp"
#include "run/detail/checkpoint.hpp"
#include "run/detail/output_checks.hpp"
#include "text/number_text.hpp"
#include "text/words.hpp"

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

namespace {

constexpr std::size_t events_shown = 20;

std::string file_name(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

std::vector<detail::PlannedOutput> planned(const RunFiles& files,
                                           const std::vector<ColumnGroup>& groups) {
  std::vector<detail::PlannedOutput> all;
  for (const std::string& path : files.outputs) all.push_back({path, groups});
  if (!files.events.empty()) all.push_back({files.events, detail::event_groups(groups)});
  return all;
}

detail::KeptSetup setup_of(const Scenario& scenario, const RunFiles& files,
                           const std::vector<ColumnGroup>& groups, const RunOptions& options) {
  std::vector<std::string> paths = files.outputs;
  if (!files.events.empty()) paths.push_back(files.events);
  detail::require_own_files(scenario.document, paths);
  return {{"run", "runs the scenario anew"},
          detail::identity_of(scenario, {files.outputs, files.events, scenario.output.columns}),
          planned(files, groups),
          scenario.output.formats,
          options.begin,
          options.words,
          options.checkpoint_seconds};
}

// As a report keeps it: its row is in the table of events.
RunEvent without_row(RunEvent event) {
  event.row.clear();
  return event;
}

// All that the checkpoint of a run holds.
struct Kept {
  detail::RunState run;
  std::vector<RunEvent> events;
  std::int64_t events_met = 0;

  void transfer(StateBytes& bytes) {
    run.transfer(bytes);
    bytes.list(events, [&](RunEvent& e) { bytes.all(e.name, e.t, e.direction, e.state); });
    bytes(events_met);
  }
};

}  // namespace

class ScenarioRun::Parts {
 public:
  Parts(const Scenario& scenario, RunFiles files, RunOptions options)
      : scenario_(scenario),
        files_(std::move(files)),
        options_(std::move(options)),
        groups_(row_groups(scenario)),
        outputs_(setup_of(scenario, files_, groups_, options_), provenance(scenario)) {
    if (outputs_.is_complete()) return;
    if (outputs_.continues()) {
      StateBytes bytes(outputs_.state());
      kept_.transfer(bytes);
      from_ = kept_.run;
    }
    require_room();
    outputs_.with_remedy([&] { open(); });
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
    report.events_met = kept_.events_met;
    report.events = std::move(kept_.events);
    outputs_.forget();
    return report;
  }

  const detail::KeptOutputs& outputs() const { return outputs_; }
  const detail::RunState& state() const { return from_; }

 private:
  // Before anything is written: days of work would end with a disk that is full.
  void require_room() const {
    if (may_end_early(scenario_)) return;
    for (const DiskNeed& need : disk_needs(scenario_, files_.outputs, from_.pushed))
      if (need.least > need.available)
        throw OutputError(scenario_.document.name + ": got " +
                          disk_text(scenario_, need, need.least, from_.pushed) +
                          "; expected fewer rows or columns, or another disk");
  }

  void open() {
    const Provenance origin = provenance(scenario_);
    outputs_.open([&](const std::string& path, const std::optional<SinkPosition>& from) {
      if (sinks_.size() < files_.outputs.size()) {
        sinks_.push_back(open_sink(path, groups_, origin, from, scenario_.output.formats));
        return detail::kept_output(*sinks_.back());
      }
      events_.emplace(path, scenario_, from);
      return detail::KeptOutput{[this] { return events_->position(); }, [] {}};
    });
    if (options_.extra_sink) sinks_.push_back(std::move(options_.extra_sink));
  }

  detail::RunControl control() {
    detail::RunControl control;
    control.progress = options_.progress;
    control.event = [this](const RunEvent& event) {
      if (events_) events_->push(event);
      ++kept_.events_met;
      if (options_.keep_events || kept_.events.size() < events_shown)
        kept_.events.push_back(without_row(event));
    };
    control.events_have_rows = events_.has_value();
    control.due = [this](double) {
      stopping_ = options_.stop && options_.stop();
      return stopping_ || outputs_.is_due();
    };
    control.keep = [this](const detail::RunState& state) {
      if (outputs_.keeps()) keep(state);
      if (stopping_)
        throw RunInterrupted(scenario_.document.name + ": stopped at t = " + time_text(state.t),
                             state.t, outputs_.keeps());
    };
    if (outputs_.continues()) control.from = &from_;
    return control;
  }

  std::string time_text(double t) const {
    return detail::number_text(scenario_.units().from_core(t, Dimension::time)) + " " +
           scenario_.units().time();
  }

  void keep(const detail::RunState& state) {
    kept_.run = state;
    StateBytes bytes;
    kept_.transfer(bytes);
    const std::string at = "t = " + time_text(state.t);
    std::string reached = detail::printable(scenario_.document.name, 200) + " at " + at + ", " +
                          std::to_string(state.pushed) + " rows, in ";
    const std::vector<detail::PlannedOutput> all = planned(files_, groups_);
    for (const detail::PlannedOutput& output : all)
      reached += (output.path == all.front().path ? "" : ", ") +
                 detail::printable(file_name(output.path), 200);
    outputs_.keep({bytes.bytes(), reached, "from " + at});
  }

  RunReport complete_report() const {
    RunReport report;
    report.rows = row_times(scenario_)->size();
    report.outcome.t = row_times(scenario_)->end();
    return report;
  }

  const Scenario& scenario_;
  RunFiles files_;
  RunOptions options_;
  std::vector<ColumnGroup> groups_;
  detail::KeptOutputs outputs_;
  Kept kept_;
  detail::RunState from_;
  std::vector<std::unique_ptr<Sink>> sinks_;
  std::optional<EventTable> events_;
  bool stopping_ = false;
};

ScenarioRun::ScenarioRun(const Scenario& scenario, RunFiles files, RunOptions options) {
  if (!row_times(scenario))
    throw DomainError(scenario.document.name + ": time: got nothing; expected [time]");
  parts_ = std::make_unique<Parts>(scenario, std::move(files), std::move(options));
}
ScenarioRun::~ScenarioRun() = default;
bool ScenarioRun::continues() const { return parts_->outputs().continues(); }
bool ScenarioRun::is_complete() const { return parts_->outputs().is_complete(); }
double ScenarioRun::t() const { return parts_->state().t; }
std::int64_t ScenarioRun::rows() const { return parts_->state().pushed; }
RunReport ScenarioRun::run() { return parts_->run(); }

}  // namespace v0
}  // namespace polhode
