// SPDX-License-Identifier: MIT
// Ensembles of scenarios, and the keys of their tables as Python's classes are made of them.
#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>

#include "interface/arrays.hpp"
#include "io/io_parts.hpp"
#include "io/python_executor.hpp"
#include "motion/samples.hpp"
#include "polhode/error.hpp"
#include "polhode/run/ensemble_run.hpp"
#include "polhode/scenario/schema.hpp"
#include "polhode/text/separated.hpp"

namespace polhode::python {

namespace {

constexpr double most_bytes = 0x1p46;  // AddressSanitizer would end the process

// What an ensemble leaves in memory.
struct Ensemble {
  std::vector<double> rows;  // one after the other
  std::size_t width;
  io::EnsembleReport report;
  std::vector<io::ColumnGroup> groups = {};  // of the rows
  bool is_whole = true;                      // no rows of an earlier part are in the files alone
  bool was_done = false;                     // nothing was left to do

  // Rows of the index of files of chunks.
  bool has_index() const { return groups.front().name == "chunk"; }
};

nb::str schema_text(std::string_view words) { return nb::str(words.data(), words.size()); }

bool is_statistics(const io::ScenarioEnsemble& ensemble) {
  return ensemble.plan().keep == io::EnsembleKeep::statistics;
}

// Room for all rows of all members, so that what does not fit is known before anything runs. No
// page of it is touched before its rows come.
void reserve(const io::ScenarioEnsemble& ensemble, Ensemble& result) {
  if (is_statistics(ensemble) || result.has_index()) return;
  const double each = ensemble.plan().keep == io::EnsembleKeep::final
                          ? 1.0
                          : static_cast<double>(io::row_times(ensemble.scenario())->size());
  const double numbers =
      each * static_cast<double>(ensemble.size()) * static_cast<double>(result.width);
  try {
    if (numbers * double{sizeof(double)} > most_bytes) throw std::bad_alloc();
    result.rows.reserve(static_cast<std::size_t>(numbers));
  } catch (const std::bad_alloc&) {
    PyErr_Format(PyExc_MemoryError,
                 "ensemble: rows of %lld members do not fit into memory; expected fewer, or "
                 "another keep: statistics do not grow with the members",
                 static_cast<long long>(ensemble.size()));
    throw nb::python_error();
  }
}

Ensemble run_ensemble(const io::ScenarioEnsemble& ensemble, const nb::list& outputs, int threads,
                      nb::handle executor, bool resume, bool restart, bool any_machine,
                      nb::handle progress) {
  Ensemble result{{}, 0, {}};
  std::vector<std::string> paths;
  for (const nb::handle path : outputs) paths.push_back(path_text(path));
  if (resume && !io::can_read_rows(ensemble.scenario().output.formats, paths))
    throw DomainError("ensemble: resume=True reads the rows so far from " +
                      readable_paths(ensemble.scenario().output.formats) +
                      "; expected one of them");
  ExecutorLoop loop("the ensemble was stopped", count_to(progress, ensemble.size()), executor);
  io::RunOptions options = run_options("ensemble", resume, restart);
  options.threads = threads;
  options.any_machine = any_machine;
  loop.listen(options);
  options.extra_sink = std::make_unique<TableSink>(result.rows);
  io::EnsembleRun run(ensemble, paths, std::move(options));
  result.groups = run.groups();
  result.width = io::row_width(result.groups);
  result.was_done = run.is_complete();
  // statistics come at the end
  result.is_whole = !result.was_done && (!run.continues() || is_statistics(ensemble));
  if (result.is_whole) reserve(ensemble, result);
  loop.do_work([&] { result.report = run.run(); });
  return result;
}

nb::object ensemble_table(nb::handle_t<Ensemble> self) {
  const Ensemble& e = nb::cast<const Ensemble&>(self);
  return view_of(e.rows.data(), e.rows.size() / e.width, e.width * sizeof(double), {e.width}, self);
}

nb::list ensemble_failures(const Ensemble& e) {
  nb::list failures;
  for (const io::EnsembleReport::Failure& failure : e.report.failures)
    failures.append(nb::make_tuple(failure.member, failure.why));
  return failures;
}

// [(group, [(column, unit), ...]), ...]
nb::list group_list(const std::vector<io::ColumnGroup>& of) {
  nb::list groups;
  for (const io::ColumnGroup& group : of) {
    nb::list columns;
    for (const io::Column& column : group.columns)
      columns.append(nb::make_tuple(column.name, column.unit));
    groups.append(nb::make_tuple(group.name, columns));
  }
  return groups;
}

// [(event, part, times of the quantiles), ...]
nb::list first_times_list(const Ensemble& e) {
  nb::list events;
  for (const io::EnsembleReport::FirstTimes& one : e.report.events)
    events.append(nb::make_tuple(one.event, one.part, one.times));
  return events;
}

// [(name, groups, rows), ...]
nb::list histogram_list(nb::handle_t<Ensemble> self) {
  nb::list histograms;
  for (const io::EnsembleReport::Histogram& one :
       nb::cast<const Ensemble&>(self).report.histograms) {
    const std::size_t width = io::row_width(one.groups);
    histograms.append(nb::make_tuple(
        one.name, group_list(one.groups),
        view_of(one.rows.data(), one.rows.size() / width, width * sizeof(double), {width}, self)));
  }
  return histograms;
}

// [(name, columns), ...] of the histograms that an ensemble makes.
nb::list planned_histograms(const io::ScenarioEnsemble& ensemble) {
  nb::list histograms;
  if (!is_statistics(ensemble)) return histograms;
  for (const io::EnsembleHistogram& one : ensemble.plan().histograms) {
    nb::list columns;
    for (const io::EnsembleHistogram::Axis& axis : one.axes) columns.append(nb::cast(axis.column));
    histograms.append(nb::make_tuple(one.name, columns));
  }
  return histograms;
}

// (members, keys): what members begin to end - 1 have.
FloatArray drawn_by(const io::ScenarioEnsemble& ensemble, std::int64_t begin, std::int64_t end) {
  const std::size_t width = ensemble.plan().keys().size();
  const auto numbers = std::make_shared<std::vector<double>>();
  {
    const WithoutGil released;
    for (std::int64_t k = std::max<std::int64_t>(begin, 0); k < std::min(end, ensemble.size());
         ++k) {
      const std::vector<double> drawn = ensemble.plan().numbers(k);
      numbers->insert(numbers->end(), drawn.begin(), drawn.end());
    }
  }
  return view_of(numbers->data(), numbers->size() / width, width * sizeof(double), {width},
                 keeper(numbers));
}

const char* keep_word(const io::ScenarioEnsemble& ensemble) {
  switch (ensemble.plan().keep) {
    case io::EnsembleKeep::final:
      return "final";
    case io::EnsembleKeep::rows:
      return "rows";
    default:
      return "statistics";
  }
}

// The kinds of a table: [(kind, what it is, [(key, help, required, fallback, several), ...]), ...],
// keys in the order of the schema. `several`: a list of values.
nb::list kinds_of_table(const std::string& table) {
  const io::Schema& schema = io::scenario_schema();
  nb::list kinds;
  for (const io::KindText& kind : schema.kinds) {
    if (kind.table != table) continue;
    nb::list keys;
    for (const io::Key* key : io::keys_of(schema, table)) {
      if (io::key_name(key->path) == "kind" || !io::belongs(*key, kind.kind)) continue;
      keys.append(nb::make_tuple(schema_text(io::key_name(key->path)), schema_text(key->help),
                                 io::is_required(*key, kind.kind), schema_text(key->fallback),
                                 key->type == io::KeyType::key_list));
    }
    kinds.append(nb::make_tuple(schema_text(kind.kind), schema_text(kind.text), keys));
  }
  return kinds;
}

}  // namespace

void bind_ensemble(nb::module_& m, nb::class_<io::Scenario>& scenario) {
  nb::class_<Ensemble>(m, "_EnsembleRows")
      .def_prop_ro("table", ensemble_table)
      .def_prop_ro("is_whole", [](const Ensemble& e) { return e.is_whole; })
      .def_prop_ro("was_done", [](const Ensemble& e) { return e.was_done; })
      .def_prop_ro("groups", [](const Ensemble& e) { return group_list(e.groups); })
      .def_prop_ro("first_times", first_times_list)
      .def_prop_ro("histograms", histogram_list)
      .def_prop_ro("failed", [](const Ensemble& e) { return e.report.failed; })
      .def_prop_ro("failures", ensemble_failures);
  nb::class_<io::ScenarioEnsemble>(m, "_Ensemble")
      .def_prop_ro("size", &io::ScenarioEnsemble::size)
      .def_prop_ro("seed", [](const io::ScenarioEnsemble& e) { return e.plan().seed; })
      .def_prop_ro("chunk", [](const io::ScenarioEnsemble& e) { return e.plan().chunk; })
      .def_prop_ro("keep", keep_word)
      .def_prop_ro("keys", [](const io::ScenarioEnsemble& e) { return e.plan().keys(); })
      .def_prop_ro("key_units", [](const io::ScenarioEnsemble& e) { return e.plan().units(); })
      .def_prop_ro("quantiles", [](const io::ScenarioEnsemble& e) { return e.plan().quantiles; })
      .def_prop_ro("groups",
                   [](const io::ScenarioEnsemble& e) { return group_list(io::ensemble_groups(e)); })
      .def_prop_ro("histograms", planned_histograms)
      .def("drawn", drawn_by, "begin"_a, "end"_a)
      .def(
          "member",
          [](const io::ScenarioEnsemble& e, std::int64_t index) {
            return e.member_scenario(index);
          },
          "index"_a)
      .def("run", run_ensemble, "outputs"_a, "threads"_a, "executor"_a.none(), "resume"_a,
           "restart"_a, "any_machine"_a, "progress"_a.none());
  scenario.def_prop_ro("has_ensemble",
                       [](const io::Scenario& s) { return s.ensemble.has_value(); });
  scenario.def(
      "ensemble", [](const io::Scenario& s) { return new io::ScenarioEnsemble(s); },
      nb::rv_policy::take_ownership);
  scenario.def(
      "ensemble_work",
      [](const io::Scenario& s, bool any_machine) {
        return new WorkerCells{io::ensemble_work(s, any_machine)};
      },
      nb::rv_policy::take_ownership, "any_machine"_a);
  scenario.def(
      "with_ensemble",
      [](const io::Scenario& s, const std::string& tables) { return io::with_ensemble(s, tables); },
      "tables"_a);
  m.def("_kinds_of_table", kinds_of_table, "table"_a);
}

}  // namespace polhode::python
