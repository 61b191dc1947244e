// SPDX-License-Identifier: MIT
// The parts of bind_io, a file each.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bindings.hpp"
#include "polhode/output/output_format.hpp"
#include "polhode/output/sink.hpp"
#include "polhode/run/scenario_run.hpp"
#include "polhode/run/summary.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode::python {

// Units, Dimension, known_units.
void bind_units(nb::module_& m);
// GoldenCase, golden_cases, write_golden, regime_name.
void bind_golden(nb::module_& m);
// AttitudeEphemeris, AemSegment, read_aem.
void bind_aem(nb::module_& m);
// NutationTheory, PlanetAxis, nutation_theory.
void bind_nutation(nb::module_& m);
// A list of str.
nb::list names_list(const std::vector<std::string_view>& names);
// KindTable, _Kinds and _default_kinds.
void bind_kinds(nb::module_& m);
// _command_line.
void bind_command_line(nb::module_& m);
// OrbitEphemeris, OemSegment, read_oem.
void bind_oem(nb::module_& m);

// Methods run, write and states_of of _Scenario, and what run returns.
void bind_run(nb::module_& m, nb::class_<io::Scenario>& scenario);

// _ExecutorWork: a worker's map or ensemble.
void bind_executor_work(nb::module_& m);

// Methods map, map_cell and map_work of _Scenario, and what map returns.
void bind_map(nb::module_& m, nb::class_<io::Scenario>& scenario);

// Methods ensemble and ensemble_work of _Scenario, the ensemble, and _kinds_of_table.
void bind_ensemble(nb::module_& m, nb::class_<io::Scenario>& scenario);
// What resume and restart ask for, and what messages call them.
io::RunOptions run_options(const char* function, bool resume, bool restart);
// A path as the file system has it.
std::string path_text(nb::handle path);
// In front of the rows of this part of a run, those that an earlier part has left in its files.
void put_first(std::vector<double>& rows, const std::vector<double>& before);
// "PATH.csv or PATH.h5": what such a part can be read from.
std::string readable_paths(const io::OutputFormats& formats);
// Rows into memory, one after the other.
class TableSink : public io::Sink {
 public:
  explicit TableSink(std::vector<double>& rows) : rows_(rows) {}
  void push(std::span<const double> rows) override {
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }
  void finish() override {}

 private:
  std::vector<double>& rows_;
};

// The Python object of an orbit of a scenario: its elements or rows.
nb::object orbit_object(const io::ScenarioOrbit& orbit);
// Properties frame, system and orbits of _Scenario.
void bind_objects(nb::class_<io::Scenario>& scenario);

// (key, label, numbers, text, unit) of each line.
nb::list lines_of(const std::vector<io::SummaryLine>& lines);

}  // namespace polhode::python
