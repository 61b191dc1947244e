// SPDX-License-Identifier: MIT
// Maps of scenarios.
#include "interface/arrays.hpp"
#include "io/io_parts.hpp"
#include "io/python_executor.hpp"
#include "motion/samples.hpp"
#include "polhode/run/map_run.hpp"

namespace polhode::python {

namespace {

// What a map leaves in memory.
struct Map {
  std::vector<double> rows;  // one after the other
  std::size_t width;
  std::vector<io::ColumnGroup> groups;
  std::size_t axes;
  io::MapReport report;
  std::int64_t rows_before = 0;  // of an earlier part of the map: in its files only
};

Map run_map(const io::Scenario& scenario, const nb::list& outputs, int threads, nb::handle executor,
            bool resume, bool restart, bool any_machine, nb::handle progress) {
  const io::ScenarioMap map(scenario);
  Map result{{}, map.plan().axes.size() + map.width(), map.groups(), map.plan().axes.size(), {}};
  std::vector<std::string> paths;
  for (const nb::handle path : outputs) paths.push_back(path_text(path));
  ExecutorLoop loop("the map was stopped", count_to(progress, map.size()), executor);
  const auto begun = [&](bool resumes, bool restarts) {
    io::RunOptions options = run_options("map", resumes, restarts);
    options.threads = threads;
    options.any_machine = any_machine;
    loop.listen(options);
    options.extra_sink = std::make_unique<TableSink>(result.rows);
    return std::make_unique<io::MapRun>(map, paths, std::move(options));
  };
  std::unique_ptr<io::MapRun> run = begun(resume, restart);
  if (run->is_complete()) run = begun(false, true);  // its rows are wanted all the same
  result.rows_before = run->rows();
  loop.do_work([&] { result.report = run->run(); });
  run.reset();  // closes its files
  if (result.rows_before > 0)
    put_first(result.rows,
              io::first_rows(scenario.output.formats, paths, map.groups(), result.rows_before));
  return result;
}

nb::object table_of_map(nb::handle_t<Map> self) {
  const Map& m = nb::cast<const Map&>(self);
  return view_of(m.rows.data(), m.rows.size() / m.width, m.width * sizeof(double), {m.width}, self);
}

// [(name, unit), ...]
nb::list column_list(const Map& m) {
  nb::list columns;
  for (const io::ColumnGroup& group : m.groups)
    for (const io::Column& column : group.columns)
      columns.append(nb::make_tuple(column.name, column.unit));
  return columns;
}

nb::list group_names(const Map& m) {
  nb::list names;
  for (const io::ColumnGroup& group : m.groups) names.append(group.name);
  return names;
}

// [(cells, rows of each), ...]
nb::list cells_and_rows(const Map& m) {
  nb::list list;
  for (const io::MapReport::Group& group : m.report.groups)
    list.append(nb::make_tuple(group.cells, group.rows));
  return list;
}

nb::list failures_of(const Map& m) {
  nb::list failures;
  for (const io::MapReport::Failure& failure : m.report.failures)
    failures.append(nb::make_tuple(failure.cell, failure.why));
  return failures;
}

}  // namespace

void bind_map(nb::module_& m, nb::class_<io::Scenario>& scenario) {
  nb::class_<Map>(m, "_Map")
      .def_prop_ro("table", table_of_map)
      .def_prop_ro("columns", column_list)
      .def_prop_ro("groups", group_names)
      .def_prop_ro("axes", [](const Map& of) { return of.axes; })
      .def_prop_ro("rows_before", [](const Map& of) { return of.rows_before; })
      .def_prop_ro("cells_and_rows", cells_and_rows)
      .def_prop_ro("failures", failures_of);
  scenario.def("map", run_map, "outputs"_a, "threads"_a, "executor"_a.none(), "resume"_a,
               "restart"_a, "any_machine"_a, "progress"_a.none());
  scenario.def(
      "map_cell",
      [](const io::Scenario& s, std::int64_t index) {
        return io::ScenarioMap(s).cell_scenario(index);
      },
      "index"_a);
  scenario.def(
      "map_work",
      [](const io::Scenario& s, bool any_machine) {
        return new WorkerCells{io::map_work(s, any_machine)};
      },
      nb::rv_policy::take_ownership, "any_machine"_a);
}

}  // namespace polhode::python
