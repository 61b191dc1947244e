// SPDX-License-Identifier: MIT
// Rows that a function of the library would write into a file, as arrays; and what fits of
// scenarios share.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bindings.hpp"
#include "polhode/run/light_report.hpp"
#include "polhode/scenario/scenario.hpp"

namespace polhode::python {

// (groups, table, notes) of what `write` writes, given a scenario and a path.
nb::tuple kept_rows(const io::Scenario& scenario,
                    const std::function<void(const io::Scenario&, const std::string& path)>& write);

// A fit and what it left; torques in the report refer to the scenario, which stays where it is.
template <class Report>
struct FitOf {
  std::shared_ptr<const io::Scenario> scenario;
  Report report;
};

template <class Report>
nb::class_<FitOf<Report>> bind_fit_of(nb::module_& m, const char* name) {
  using F = FitOf<Report>;
  return nb::class_<F>(m, name)
      .def_prop_ro("json", [](const F& f) { return io::fit_json(*f.scenario, f.report); })
      .def_prop_ro("text", [](const F& f) { return io::fit_text(*f.scenario, f.report); })
      .def("solution_text",
           [](const F& f, std::size_t k) { return io::solution_text(*f.scenario, f.report, k); })
      .def("residuals",
           [](const F& f, std::size_t k) {
             return kept_rows(*f.scenario,
                              [&](const io::Scenario& scenario, const std::string& path) {
                                io::write_residuals(scenario, f.report, k, path);
                              });
           })
      .def("predicted", [](const F& f, std::size_t k, const std::vector<std::string>& words) {
        const std::vector<double> times = words.empty() ? io::prediction_times(*f.scenario)
                                                        : io::prediction_times(*f.scenario, words);
        return kept_rows(*f.scenario, [&](const io::Scenario& scenario, const std::string& path) {
          io::write_predictions(scenario, io::fit_predictions(f.report, k, times), path);
        });
      });
}

}  // namespace polhode::python
