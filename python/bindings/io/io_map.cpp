// SPDX-License-Identifier: MIT
// Maps of scenarios: single cells, which Python's threads run at the same time, and their rows. The
// function that drives them is Python's (python/polhode/maps.py).
#include <atomic>
#include <stdexcept>

#include "interface/arrays.hpp"
#include "io/io_parts.hpp"
#include "motion/samples.hpp"
#include "polhode/run/map.hpp"
#include "polhode/run/run.hpp"

namespace polhode::python {

namespace {

// A map that can be told to stop, from any thread.
struct PythonMap {
  explicit PythonMap(const Scenario& scenario)
      : map(scenario.text,
            scenario.folder.empty() ? scenario.name : scenario.folder + "/" + scenario.name) {}

  ScenarioMap map;
  std::atomic<bool> stopped = false;
};

MapCell cell_of(PythonMap& of, std::int64_t index) {
  const WithoutGil released;
  return of.map.cell(index, [&of](double) {
    if (of.stopped.load(std::memory_order_relaxed)) throw std::runtime_error("the map was stopped");
  });
}

struct PythonRows {
  PythonRows(const PythonMap& of, const nb::list& outputs, bool resume, bool restart)
      : map(of.map) {
    std::vector<std::string> paths;
    for (const nb::handle path : outputs) paths.push_back(path_text(path));
    rows.emplace(map, std::move(paths), begin_of("map", resume, restart), begin_words());
  }

  const ScenarioMap& map;
  std::optional<MapRows> rows;
};

// {table (N, columns), the cell of each row, [(cell, why), ...] of those that failed}
nb::tuple table_of(const PythonRows& of) {
  auto numbers = std::make_shared<std::vector<double>>();
  TableSink sink(*numbers);
  of.rows->write(sink);
  const std::size_t width = of.map.plan().axes.size() + of.map.width();
  const nb::object table = view_of(numbers->data(), numbers->size() / width, width * sizeof(double),
                                   {width}, keeper(numbers));
  nb::list cells, failures;
  for (std::int64_t k = 0; k < of.rows->size(); ++k) {
    const MapCell& cell = of.rows->cells()[static_cast<std::size_t>(k)];
    for (std::size_t row = 0; row < cell.numbers.size() / of.map.width(); ++row) cells.append(k);
    if (!cell.failure.empty()) failures.append(nb::make_tuple(k, cell.failure));
  }
  return nb::make_tuple(table, cells, failures);
}

nb::list columns_of(const ScenarioMap& map) {
  nb::list columns;
  for (const ColumnGroup& group : map.groups())
    for (const Column& column : group.columns)
      columns.append(nb::make_tuple(column.name, column.unit));
  return columns;
}

}  // namespace

void bind_map(nb::module_& m) {
  nb::class_<MapCell>(m, "_MapCell").def_ro("failure", &MapCell::failure);
  nb::class_<PythonMap>(m, "_ScenarioMap")
      .def(nb::init<const Scenario&>(), nb::arg("scenario"))
      .def("__len__", [](const PythonMap& of) { return of.map.size(); })
      .def_prop_ro("axes", [](const PythonMap& of) { return of.map.plan().axes.size(); })
      .def_prop_ro("columns", [](const PythonMap& of) { return columns_of(of.map); })
      .def("cell", cell_of, nb::arg("index"))
      .def("stop", [](PythonMap& of) { of.stopped = true; });
  nb::class_<PythonRows>(m, "_MapRows")
      .def(nb::init<const PythonMap&, const nb::list&, bool, bool>(), nb::arg("map"),
           nb::arg("outputs"), nb::arg("resume"), nb::arg("restart"), nb::keep_alive<1, 2>())
      .def("__len__", [](const PythonRows& of) { return of.rows->size(); })
      .def("push", [](PythonRows& of, const MapCell& cell) { of.rows->push(cell); })
      .def("finish", [](PythonRows& of) { of.rows->finish(); })
      .def("close", [](PythonRows& of) { of.rows.reset(); })  // others may have the file
      .def("table", table_of);
}

}  // namespace polhode::python
