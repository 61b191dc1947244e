// SPDX-License-Identifier: MIT
// Fits of scenarios that observed light curves: the same methods as those of snapshots.

#include <cmath>

#include "fit/bind_fit.hpp"
#include "fit/kept_rows.hpp"
#include "fit/light_problem.hpp"
#include "fit/scan_found.hpp"
#include "io/io_parts.hpp"
#include "io/work_loop.hpp"
#include "motion/samples.hpp"
#include "polhode/run/light_report.hpp"

namespace polhode::python {

namespace {

using LightScenarioFit = FitOf<io::LightReport>;

constexpr std::int64_t thousandths = 1000;  // of the work, that progress counts

LightScenarioFit light_fit_of(const io::Scenario& scenario, int threads, nb::handle progress) {
  LightScenarioFit fit{std::make_shared<const io::Scenario>(scenario), {}};
  // a scan, the search and what comes after it take about as long
  const io::LightPlan& plan = io::require_fit(scenario).light;
  const double scan = plan.searches && plan.periods.empty() ? 1.0 : 0.0;
  const double search = plan.searches ? 1.0 : 0.0;
  const bool goes_on = plan.shape != io::LightPlan::Shape::ellipsoid || plan.one_by_one;
  const double whole = scan + search + (goes_on ? 1.0 : 0.0);
  WorkLoop loop("the fit was stopped", count_to(progress, thousandths));
  io::FitOptions options;
  options.threads = checked_threads(threads);
  options.stop = [&loop] { return loop.is_stopped(); };
  double before = 0.0;
  options.begins = [&](const std::string& stage, const std::string&) {
    before = stage == "scan" ? 0.0 : stage == "search" ? scan : scan + search;
  };
  options.progress = [&](const io::RunProgress& at) {
    loop.reach(std::floor((before + at.part) / whole * static_cast<double>(thousandths)));
  };
  loop.do_work([&] { fit.report = io::fit_light_scenario(*fit.scenario, options); });
  return fit;
}

// None without a scan.
nb::object scan_of(const LightScenarioFit& fit) {
  if (!fit.report.scan) return nb::none();
  return nb::cast(ScanFound{fit.report.scan->landscape, fit.report.scan->minima});
}

// As functions of the unknowns, from a solution on; errors are those that it has scaled, where
// asked for.
PythonResiduals residuals_from(const LightScenarioFit& fit, std::size_t solution, bool scaled) {
  fit::LightFit problem = io::light_fit_at(*fit.scenario, fit.report, solution);
  const double factor = io::light_error_factor(fit.report.solutions.at(solution).solution);
  if (scaled && factor > 0.0)
    for (light::LightCurve& curve : problem.curves)
      for (light::LightPoint& point : curve.points) point.sigma *= factor;
  return light_residuals_of(problem, nb::none());
}

}  // namespace

void bind_light_scenario_fit(nb::module_& m) {
  using F = LightScenarioFit;
  bind_fit_of<io::LightReport>(m, "_LightScenarioFit")
      .def_prop_ro("scan", scan_of)
      .def_prop_ro("curves", [](const F& f) { return curves_parts(f.report.observed.curves); })
      .def("write",
           [](const F& f, std::size_t k, nb::handle path) {
             io::write_solution(*f.scenario, f.report, k, path_text(path));
           })
      .def("raw", [](const F& f, std::size_t k) { return found_dict(f.report.solutions.at(k)); })
      .def("residuals_from", residuals_from);
  m.def("_fit_light_scenario", light_fit_of, "scenario"_a, "threads"_a, "progress"_a.none());
  m.def("_observes_light", io::observes_light);
}

}  // namespace polhode::python
