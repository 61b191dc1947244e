// SPDX-License-Identifier: MIT
// The run of a map into files.
#include "polhode/run/map_run.hpp"

#include <algorithm>
#include <exception>
#include <limits>
#include <map>
#include <utility>

#include "polhode/ensemble/cells.hpp"
#include "polhode/error.hpp"
#include "polhode/run/run.hpp"
#include "polhode/trajectory/state_bytes.hpp"
#include "run/detail/checkpoint.hpp"
#include "text/words.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// Rows wait for their block to fill, in checkpoints too: blocks do not depend on when these were
// made.
constexpr std::size_t numbers_per_block = 65536;
constexpr std::size_t longest_reason = 1000;

// Ends the loop over the cells, from within.
struct Stopped {};

detail::KeptSetup setup_of(const ScenarioMap& map, const std::vector<std::string>& paths,
                           const MapOptions& options) {
  detail::KeptSetup setup =
      detail::setup_of_tables({"map", "runs this one anew"}, map.scenario(), map.groups(), paths);
  setup.begin = options.begin;
  setup.words = options.words;
  setup.seconds = options.checkpoint_seconds;
  return setup;
}

// Cells of a section have several rows.
Provenance provenance_of(const ScenarioMap& map) {
  Provenance origin = provenance(map.scenario());
  const MapPlan& plan = map.plan();
  const bool is_section =
      plan.kind == MapKind::andoyer_section || plan.kind == MapKind::spin_orbit_section;
  if (plan.axes.size() == 1 && !is_section) origin.row_dimension = plan.axes.front().key;
  return origin;
}

// Each reason once: many cells fail for the same one.
void transfer_failures(StateBytes& bytes, std::vector<MapReport::Failure>& failures) {
  std::vector<std::string> reasons;
  std::map<std::string, std::uint64_t> numbers;
  if (!bytes.reads())
    for (const MapReport::Failure& failure : failures)
      if (numbers.try_emplace(failure.why, reasons.size()).second) reasons.push_back(failure.why);
  bytes(reasons);
  bytes.list(failures, [&](MapReport::Failure& failure) {
    std::uint64_t number = bytes.reads() ? 0 : numbers.at(failure.why);
    bytes.all(failure.cell, number);
    if (bytes.reads()) failure.why = reasons.at(number);
  });
}

// Where a map is between two cells: all that its checkpoint holds.
struct MapState {
  MapReport report;
  std::int64_t rows = 0;        // in the outputs
  std::vector<double> waiting;  // rows that are not

  void transfer(StateBytes& bytes) {
    bytes.all(report.cells, report.points);
    bytes.list(report.ranges, [&](MapReport::Range& r) { bytes.all(r.least, r.most); });
    transfer_failures(bytes, report.failures);
    bytes.list(report.groups, [&](MapReport::Group& g) { bytes.all(g.cells, g.rows); });
    bytes.all(rows, waiting);
  }
};

// What is reported of a map, cell after cell.
void add(MapReport& report, const MapCell& cell, std::size_t width) {
  const auto rows = static_cast<std::int64_t>(cell.numbers.size() / width);
  if (report.groups.empty() || report.groups.back().rows != rows)
    report.groups.push_back({0, rows});
  ++report.groups.back().cells;
  if (cell.failure.empty()) {
    report.points += rows;
    for (std::size_t k = 0; k < cell.numbers.size(); ++k) {
      MapReport::Range& range = report.ranges[k % width];
      if (cell.numbers[k] < range.least) range.least = cell.numbers[k];
      if (cell.numbers[k] > range.most) range.most = cell.numbers[k];
    }
  } else {
    report.failures.push_back({report.cells, detail::printable(cell.failure, longest_reason)});
  }
  ++report.cells;
}

}  // namespace

class MapRun::Parts {
 public:
  Parts(const ScenarioMap& map, const std::vector<std::string>& paths, MapOptions options)
      : map_(map),
        width_(map.width()),
        options_(std::move(options)),
        outputs_(setup_of(map, paths, options_), provenance_of(map)) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    state_.report.ranges.assign(width_, {infinity, -infinity});
    if (outputs_.is_complete()) return;
    if (outputs_.continues()) {
      StateBytes bytes(outputs_.state());
      state_.transfer(bytes);
    }
    outputs_.with_remedy([&] { open(); });
    cells_before_ = state_.report.cells;
    rows_before_ = state_.rows;
  }

  MapReport run() {
    if (outputs_.is_complete()) return state_.report;
    outputs_.with_remedy([&] {
      compute();
      push_waiting();
      for (const std::unique_ptr<Sink>& sink : sinks_) sink->finish();
      outputs_.forget();
    });
    return std::move(state_.report);
  }

  const detail::KeptOutputs& outputs() const { return outputs_; }
  std::int64_t cells() const { return cells_before_; }
  std::int64_t rows() const { return rows_before_; }

 private:
  void open() {
    sinks_ = detail::opened_tables(outputs_, map_.scenario(), map_.groups(), provenance_of(map_));
    if (options_.extra_sink) sinks_.push_back(std::move(options_.extra_sink));
  }

  bool is_stopped() const { return options_.stop && options_.stop(); }

  void compute() {
    const int threads = options_.threads > 0 ? options_.threads : hardware_threads();
    const auto look = [this](double) {
      if (is_stopped()) throw Stopped();
    };
    try {
      run_cells(
          state_.report.cells, map_.size(), threads,
          [&](std::int64_t index) { return map_.cell(index, look); },
          [&](std::int64_t index, const MapCell& cell) { take(index, cell); });
    } catch (const Stopped&) {
      keep();
      if (raised_) std::rethrow_exception(raised_);
      throw MapInterrupted(map_.scenario().document.name + ": stopped after " + done_text(),
                           state_.report.cells, outputs_.keeps());
    }
  }

  // The next one, in order.
  void take(std::int64_t index, const MapCell& cell) {
    const std::vector<double> place = map_.axis_values(index);
    for (std::size_t k = 0; k < cell.numbers.size(); k += width_) {
      const auto row = cell.numbers.begin() + static_cast<std::ptrdiff_t>(k);
      state_.waiting.insert(state_.waiting.end(), place.begin(), place.end());
      state_.waiting.insert(state_.waiting.end(), row, row + static_cast<std::ptrdiff_t>(width_));
    }
    add(state_.report, cell, width_);
    if (state_.waiting.size() >= numbers_per_block) push_waiting();
    try {
      if (options_.progress) options_.progress(state_.report.cells);
    } catch (...) {
      raised_ = std::current_exception();
      throw Stopped();
    }
    if (state_.report.cells == map_.size()) return;
    if (is_stopped()) throw Stopped();
    if (outputs_.is_due()) keep();
  }

  void push_waiting() {
    if (state_.waiting.empty()) return;
    for (const std::unique_ptr<Sink>& sink : sinks_) sink->push(state_.waiting);
    state_.rows +=
        static_cast<std::int64_t>(state_.waiting.size() / (map_.plan().axes.size() + width_));
    state_.waiting.clear();
  }

  std::string done_text() const {
    return std::to_string(state_.report.cells) + " of " + std::to_string(map_.size()) + " cells";
  }

  void keep() {
    StateBytes bytes;
    state_.transfer(bytes);
    outputs_.keep({bytes.bytes(), done_text(), "after " + done_text()});
  }

  const ScenarioMap& map_;
  std::size_t width_;
  MapOptions options_;
  detail::KeptOutputs outputs_;
  MapState state_;
  std::int64_t cells_before_ = 0;
  std::int64_t rows_before_ = 0;
  std::vector<std::unique_ptr<Sink>> sinks_;
  std::exception_ptr raised_;  // by `progress`
};

MapRun::MapRun(const ScenarioMap& map, const std::vector<std::string>& outputs, MapOptions options)
    : parts_(std::make_unique<Parts>(map, outputs, std::move(options))) {}
MapRun::~MapRun() = default;
bool MapRun::continues() const { return parts_->outputs().continues(); }
bool MapRun::is_complete() const { return parts_->outputs().is_complete(); }
std::int64_t MapRun::cells() const { return parts_->cells(); }
std::int64_t MapRun::rows() const { return parts_->rows(); }
MapReport MapRun::run() { return parts_->run(); }

}  // namespace v0
}  // namespace polhode
