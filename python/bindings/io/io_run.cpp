// SPDX-License-Identifier: MIT
// A run of a scenario: rows into memory, where columns are views, and into files at the same time.
#include <optional>

#include "charts/states.hpp"
#include "interface/batch.hpp"
#include "interface/signals.hpp"
#include "io/io_parts.hpp"
#include "io/work_loop.hpp"
#include "motion/samples.hpp"
#include "polhode/error.hpp"
#include "polhode/run/scenario_run.hpp"

namespace polhode::python {

namespace {

constexpr std::size_t rows_per_block = 1024;

// What a run leaves in memory.
struct Run {
  std::vector<double> rows;  // one after the other
  std::size_t width;
  io::RunReport report;
  std::int64_t rows_before = 0;  // of an earlier part of the run: in its files only
  bool complete = false;         // nothing was left to do
};

// No page of it is touched before its rows come. More than 64 TiB is not asked for:
// AddressSanitizer would end the process.
void reserve(Run& run, std::int64_t rows) {
  constexpr double most_bytes = 0x1p46;
  const double bytes =
      static_cast<double>(rows) * static_cast<double>(run.width) * double{sizeof(double)};
  try {
    if (bytes > most_bytes) throw std::bad_alloc();
    run.rows.reserve(static_cast<std::size_t>(rows) * run.width);
  } catch (const std::bad_alloc&) {
    PyErr_Format(PyExc_MemoryError,
                 "run: %lld rows of %zu numbers do not fit into memory; expected keep=False, with "
                 "outputs that are files",
                 static_cast<long long>(rows), run.width);
    throw nb::python_error();
  }
}

void warn(const std::string& text) {
  constexpr int caller = 2;  // beyond the function of the package
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), caller) != 0) throw nb::python_error();
}

// Its files are closed at the end.
void run_into(Run& result, const io::Scenario& scenario, const io::RunFiles& files,
              io::RunOptions options, WorkLoop& loop) {
  io::ScenarioRun run(scenario, files, std::move(options));
  result.rows_before = run.is_complete() ? io::row_times(scenario)->size() : run.rows();
  result.complete = run.is_complete();
  loop.do_work_here([&] { result.report = run.run(); });
  for (const std::string& warning : result.report.warnings) warn(warning);
}

Run run_scenario(const io::Scenario& scenario, const nb::list& outputs, nb::handle events,
                 bool keep, bool resume, bool restart, nb::handle progress) {
  if (!io::row_times(scenario))
    throw DomainError(
        scenario.document.name +
        ": time: got nothing; expected a table [time], stop with step or count, or at");
  if (!events.is_none() && !io::has_events(scenario))
    throw DomainError(scenario.document.name +
                      ": event: got nothing; expected tables [[event]] for events");
  Run result{{}, io::row_width(io::row_groups(scenario)), {}};
  io::RunFiles files;
  for (const nb::handle path : outputs) files.outputs.push_back(path_text(path));
  if (!events.is_none()) files.events = path_text(events);
  io::RunOptions options = run_options("run", resume, restart);
  options.keep_events = keep;
  const io::OutputFormats& formats = scenario.output.formats;
  if (resume && keep && !files.outputs.empty() && !io::can_read_rows(formats, files.outputs))
    throw DomainError("run: resume=True with keep=True reads the rows so far from " +
                      readable_paths(formats) + "; expected one of them, or keep=False");
  const Progress told = time_listener(progress);
  WorkLoop loop("the run was stopped", told);
  options.stop = [&loop] { return loop.is_stopped(); };
  if (told)
    options.progress = [&loop, seldom = Seldom()](const io::RunProgress& at) mutable {
      if (seldom()) loop.tell(at.reached);
    };
  if (keep) {
    reserve(result, io::row_times(scenario)->size());  // before any file is there
    options.extra_sink = std::make_unique<TableSink>(result.rows);
  }
  run_into(result, scenario, files, std::move(options), loop);
  if (keep && result.rows_before > 0)
    put_first(result.rows,
              io::first_rows(formats, files.outputs, io::row_groups(scenario), result.rows_before));
  return result;
}

nb::object kept_table(nb::handle_t<Run> self) {
  const Run& r = nb::cast<const Run&>(self);
  return view_of(r.rows.data(), r.rows.size() / r.width, r.width * sizeof(double), {r.width}, self);
}

// Rows from memory, as a run would have written them.
void write_rows(const io::Scenario& scenario, nb::handle path, nb::handle table) {
  const std::vector<io::ColumnGroup> groups = io::row_groups(scenario);
  const std::size_t width = io::row_width(groups);
  const Numbers rows(table, "table", {width});
  const std::size_t n = size_of(rows.shape());
  const std::unique_ptr<io::Sink> sink = io::open_sink(
      path_text(path), groups, io::provenance(scenario), std::nullopt, scenario.output.formats);
  for (std::size_t k = 0; k < n; k += rows_per_block) {
    const std::size_t more = std::min(rows_per_block, n - k);
    {
      const WithoutGil released;
      sink->push({rows.at(0) + k * width, more * width});
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
  }
  sink->finish();
  for (const std::string& warning : sink->warnings()) warn(path_text(path) + ": " + warning);
}

// The hub states in rows that have q and g, from column numbers `q` and `g` on. Files hold body
// components along the axes of the tensor, states along principal axes.
Batch<RotorState> states_in(const io::Scenario& scenario, nb::handle table, std::size_t q,
                            std::size_t g) {
  const std::size_t width = io::row_width(io::row_groups(scenario));
  const Numbers rows(table, "table", {width});
  const std::size_t n = size_of(rows.shape());
  const Quaternion& q_FB = scenario.rotation().body.q_FB();
  return Batch<RotorState>::filled({n}, [&](RotorState* out) {
    for_each(n, [&](std::size_t k) {
      const double* const row = rows.at(0) + k * width;
      const Quaternion q_SF{row[q], row[q + 1], row[q + 2], row[q + 3]};
      const Vec3 g_F{row[g], row[g + 1], row[g + 2]};
      out[k] = q_FB == Quaternion{} ? RotorState{q_SF, g_F}
                                    : RotorState{q_SF * q_FB, rotate(conj(q_FB), g_F)};
    });
  });
}

}  // namespace

std::string path_text(nb::handle path) {
  const nb::bytes bytes = nb::bytes(nb::object(nb::module_::import_("os").attr("fsencode")(path)));
  return {bytes.c_str(), bytes.size()};
}

void put_first(std::vector<double>& rows, const std::vector<double>& before) {
  rows.insert(rows.begin(), before.begin(), before.end());
}

std::string readable_paths(const io::OutputFormats& formats) {
  return io::paths_in_words(formats,
                            [](const io::OutputFormat& format) { return bool(format.rows); });
}

io::RunOptions run_options(const char* function, bool resume, bool restart) {
  if (resume && restart)
    throw DomainError(std::string(function) +
                      ": got resume=True and restart=True; expected one of them");
  io::RunOptions options;
  options.begin =
      resume ? io::RunBegin::resume : (restart ? io::RunBegin::restart : io::RunBegin::anew);
  options.words = {"resume=True", "restart=True", "any_machine=True"};
  return options;
}

void bind_run(nb::module_& m, nb::class_<io::Scenario>& scenario) {
  nb::class_<Run>(m, "_Run")
      .def_prop_ro("table", kept_table)
      .def_prop_ro("outcome", [](const Run& r) { return r.report.outcome; })
      .def_prop_ro("statistics", [](const Run& r) { return r.report.statistics; })
      .def_prop_ro("events",
                   [](const Run& r) {
                     std::vector<EventRecord> events;
                     for (const io::RunEvent& event : r.report.events)
                       events.push_back(io::record_of<SystemState>(event));
                     return events;
                   })
      .def_prop_ro("energy_change", [](const Run& r) { return r.report.energy_change; })
      .def_prop_ro("end",
                   [](const Run& r) -> std::optional<EventRecord> {
                     if (!r.report.end) return std::nullopt;
                     return EventRecord{"end", r.report.end->t, r.report.end->s, 0};
                   })
      .def_prop_ro("rows", [](const Run& r) { return r.report.rows; })
      .def_prop_ro("rows_before", [](const Run& r) { return r.rows_before; })
      .def_prop_ro("complete", [](const Run& r) { return r.complete; });
  m.def("_readable_paths", [] { return python::readable_paths(io::default_output_formats()); });
  scenario
      .def("run", run_scenario, "outputs"_a, "events"_a.none(), "keep"_a, "resume"_a, "restart"_a,
           "progress"_a.none())
      .def("write", write_rows)
      .def("states_in", states_in)
      .def("report_lines",
           [](const io::Scenario& s, const Outcome& outcome, const Statistics& statistics,
              const std::vector<EventRecord>& events, std::optional<double> energy_change,
              const std::optional<EventRecord>& end) {
             io::RunReport report{outcome, statistics, {}, 0, energy_change, 0};
             if (end) report.end = Sample{end->t, end->s};
             for (const EventRecord& event : events) report.events.push_back(io::event_of(event));
             return lines_of(io::report_lines(s, report, "all in .events"));
           });
}

}  // namespace polhode::python
