// SPDX-License-Identifier: MIT
// Maps of scenarios. The loop over the cells is the library's and runs in threads of its own; the
// thread that called waits for it, and alone runs Python: the function that hears of each cell,
// and handlers of signals.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "interface/arrays.hpp"
#include "interface/gil.hpp"
#include "interface/signals.hpp"
#include "io/io_parts.hpp"
#include "motion/samples.hpp"
#include "polhode/run/map_run.hpp"

namespace polhode::python {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_looks(20);

// What a map leaves in memory.
struct Map {
  std::vector<double> rows;  // one after the other
  std::size_t width;
  std::vector<ColumnGroup> groups;
  std::size_t axes;
  MapReport report;
  std::int64_t rows_before = 0;  // of an earlier part of the map: in its files only
};

// Between the loop and the thread that waits for it.
class Loop {
 public:
  explicit Loop(nb::handle progress) : progress_(progress.is_none() ? nullptr : progress.ptr()) {}

  bool is_stopped() const { return stopped_.load(std::memory_order_relaxed); }
  // In the loop: goes on when the function has returned; throws where it has not.
  void reach(std::int64_t cells) {
    std::unique_lock<std::mutex> lock(mutex_);
    reached_ = cells;
    if (progress_ == nullptr) return;
    changed_.notify_all();
    changed_.wait(lock, [&] { return told_ == reached_ || is_stopped(); });
    if (is_stopped()) throw std::runtime_error("the map was stopped");
  }
  void end(std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::move(failure);
    ended_ = true;
    changed_.notify_all();
  }

  // In the thread that called, without the GIL, until the loop has ended. What Python raises stops
  // the loop.
  void wait(std::int64_t of) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto tells = [&] { return progress_ != nullptr && told_ != reached_ && !is_stopped(); };
    while (!ended_) {
      changed_.wait_for(lock, between_looks, [&] { return ended_ || tells(); });
      if (ended_ || is_stopped()) continue;
      const bool tell = tells();
      const std::int64_t cells = reached_;
      lock.unlock();
      const std::exception_ptr raised = asked(tell, cells, of);
      lock.lock();
      if (tell) told_ = cells;
      if (raised) {
        raised_ = raised;
        stopped_ = true;
      }
      changed_.notify_all();
    }
  }
  void raise() const {
    if (raised_) std::rethrow_exception(raised_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::exception_ptr asked(bool tell, std::int64_t cells, std::int64_t of) {
    try {
      if (tell) {
        const WithGil acquired;
        staying_put([&] { return nb::handle(progress_)(cells, of); });
      }
      ask_signals();
    } catch (...) {
      return std::current_exception();
    }
    return nullptr;
  }

  // By the clock, since the thread also wakes for every cell.
  void ask_signals() {
    if (!handles_signals_ || Clock::now() - asked_ < between_looks) return;
    const WithGil acquired;
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    asked_ = Clock::now();  // the GIL may have been waited for
  }

  PyObject* progress_;
  bool handles_signals_ = handles_signals();
  Clock::time_point asked_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t reached_ = 0;
  std::int64_t told_ = 0;
  std::atomic<bool> stopped_ = false;
  bool ended_ = false;
  std::exception_ptr raised_;
  std::exception_ptr failure_;
};

MapReport report_of(MapRun& run, Loop& loop, std::int64_t cells) {
  MapReport report;
  {
    const WithoutGil released;
    std::thread thread([&] {
      std::exception_ptr failure;
      try {
        report = run.run();
      } catch (...) {
        failure = std::current_exception();
      }
      loop.end(std::move(failure));
    });
    loop.wait(cells);
    thread.join();
  }
  loop.raise();
  return report;
}

Map run_map(const Scenario& scenario, const nb::list& outputs, int threads, bool resume,
            bool restart, nb::handle progress) {
  const ScenarioMap map(scenario);
  Map result{{}, map.plan().axes.size() + map.width(), map.groups(), map.plan().axes.size(), {}};
  std::vector<std::string> paths;
  for (const nb::handle path : outputs) paths.push_back(path_text(path));
  Loop loop(progress);
  const auto begun = [&](RunBegin begin) {
    MapOptions options;
    options.begin = begin;
    options.words = begin_words();
    options.threads = threads;
    options.stop = [&loop] { return loop.is_stopped(); };
    options.progress = [&loop](std::int64_t cells) { loop.reach(cells); };
    options.extra_sink = std::make_unique<TableSink>(result.rows);
    return std::make_unique<MapRun>(map, paths, std::move(options));
  };
  std::unique_ptr<MapRun> run = begun(begin_of("map", resume, restart));
  if (run->is_complete()) run = begun(RunBegin::restart);  // its rows are wanted all the same
  result.rows_before = run->rows();
  result.report = report_of(*run, loop, map.size());
  run.reset();  // closes its files
  if (result.rows_before > 0)
    put_first(result.rows,
              first_rows(scenario.output.formats, paths, map.groups(), result.rows_before));
  return result;
}

nb::object table_of_map(nb::handle_t<Map> self) {
  const Map& m = nb::cast<const Map&>(self);
  return view_of(m.rows.data(), m.rows.size() / m.width, m.width * sizeof(double), {m.width}, self);
}

// [(name, unit), ...]
nb::list column_list(const Map& m) {
  nb::list columns;
  for (const ColumnGroup& group : m.groups)
    for (const Column& column : group.columns)
      columns.append(nb::make_tuple(column.name, column.unit));
  return columns;
}

nb::list group_names(const Map& m) {
  nb::list names;
  for (const ColumnGroup& group : m.groups) names.append(group.name);
  return names;
}

// [(cells, rows of each), ...]
nb::list cells_and_rows(const Map& m) {
  nb::list list;
  for (const MapReport::Group& group : m.report.groups)
    list.append(nb::make_tuple(group.cells, group.rows));
  return list;
}

nb::list failures_of(const Map& m) {
  nb::list failures;
  for (const MapReport::Failure& failure : m.report.failures)
    failures.append(nb::make_tuple(failure.cell, failure.why));
  return failures;
}

}  // namespace

void bind_map(nb::module_& m, nb::class_<Scenario>& scenario) {
  nb::class_<Map>(m, "_Map")
      .def_prop_ro("table", table_of_map)
      .def_prop_ro("columns", column_list)
      .def_prop_ro("groups", group_names)
      .def_prop_ro("axes", [](const Map& of) { return of.axes; })
      .def_prop_ro("rows_before", [](const Map& of) { return of.rows_before; })
      .def_prop_ro("cells_and_rows", cells_and_rows)
      .def_prop_ro("failures", failures_of);
  scenario.def("map", run_map, "outputs"_a, "threads"_a, "resume"_a, "restart"_a,
               "progress"_a.none());
}

}  // namespace polhode::python
