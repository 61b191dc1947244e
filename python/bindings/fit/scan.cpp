// SPDX-License-Identifier: MIT
// Fourier scans of light curves, and which periods of a tumbler their minima may be.
#include <new>
#include <utility>

#include "fit/bind_fit.hpp"
#include "fit/light_problem.hpp"
#include "fit/scan_found.hpp"
#include "io/work_loop.hpp"
#include "motion/samples.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_fit.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode::python {

namespace {

nb::dict advice_of(const nb::list& curves, std::size_t order) {
  const fit::ScanAdvice a = fit::scan_advice(light_curves_of(curves), order);
  nb::dict d;
  d["time_base"] = a.time_base;
  d["step"] = a.step;
  d["least"] = a.least;
  d["most"] = a.most;
  d["typical_gap"] = a.typical_gap;
  nb::list aliases;
  for (const fit::WindowPeak& p : a.aliases) aliases.append(nb::make_tuple(p.frequency, p.height));
  d["aliases"] = aliases;
  return d;
}

using Grid = std::tuple<double, double, double>;  // least, most, step

fit::FrequencyGrid grid_of(const Grid& grid) {
  const auto& [least, most, step] = grid;
  return fit::FrequencyGrid::between(least, most, step);
}

ScanFound scanned(const nb::list& curves, const Grid& first, const Grid& second, std::size_t order,
                  bool logarithms, std::size_t most, int threads) {
  const fit::ScanPoints points(light_curves_of(curves),
                               logarithms ? fit::ScanQuantity::log_flux : fit::ScanQuantity::flux);
  fit::ScanOptions options;
  options.order = order;
  options.threads = checked_threads(threads);
  WorkLoop loop("the scan was stopped");
  options.between = [&loop] { loop.go_on(); };
  ScanFound found;
  loop.do_work([&] {
    found.landscape = fit::scan_pairs(points, grid_of(first), grid_of(second), options);
    found.minima = fit::scan_minima(points, found.landscape, {most, threads, options.between});
  });
  return found;
}

nb::object chi_square_of(nb::handle_t<ScanFound> self) {
  const fit::Landscape& of = nb::cast<const ScanFound&>(self).landscape;
  const std::size_t width = of.second.count;
  return view_of(of.chi_square.data(), of.first.count, width * sizeof(double), {width}, self);
}

nb::object frequencies_of(const fit::FrequencyGrid& grid) {
  Result all({grid.count});
  for (std::size_t i = 0; i < grid.count; ++i) *all.at(i) = grid.at(i);
  return all.take();
}

nb::list minima_of(const ScanFound& found) {
  nb::list list;
  for (const fit::ScanMinimum& m : found.minima) {
    nb::dict d;
    const fit::RefinedPair& r = m.refined;
    d["f1"] = r.fit.f1;
    d["f2"] = r.fit.f2;
    d["sigma_f1"] = r.sigma_f1;
    d["sigma_f2"] = r.sigma_f2;
    d["chi_square"] = r.fit.chi_square;
    d["degrees_of_freedom"] = r.fit.degrees_of_freedom;
    d["converged"] = r.converged;
    d["resolved"] = m.resolved;
    d["at_edge"] = m.at_edge;
    list.append(d);
  }
  return list;
}

nb::tuple line_of(const fit::LineLabel& line) { return nb::make_tuple(line.j, line.k, line.over); }

// (mode, P_phi, P_psi, line of f1, line of f2, whether of an ellipsoid)
nb::list labels_of(double f1, double f2) {
  nb::list list;
  for (const fit::PeriodLabel& l : fit::period_labels(f1, f2))
    list.append(nb::make_tuple(l.mode == Regime::short_axis ? "SAM" : "LAM", l.precession_period,
                               l.rotation_period, line_of(l.first), line_of(l.second),
                               l.of_ellipsoid));
  return list;
}

nb::list periods_of(const ScanFound& found, std::size_t pairs, std::size_t labels) {
  nb::list list;
  for (const fit::TumblerPeriods& p : fit::labelled_periods(found.minima, {pairs, labels}))
    list.append(nb::make_tuple(p.mode == Regime::short_axis ? "SAM" : "LAM", p.precession_period,
                               p.rotation_period));
  return list;
}

}  // namespace

void bind_scan(nb::module_& m) {
  nb::class_<ScanFound>(m, "_Scan")
      .def_prop_ro("chi_square", chi_square_of)
      .def_prop_ro("f1", [](const ScanFound& s) { return frequencies_of(s.landscape.first); })
      .def_prop_ro("f2", [](const ScanFound& s) { return frequencies_of(s.landscape.second); })
      .def_prop_ro("minima", minima_of)
      .def("periods", periods_of)
      .def("__getstate__", scan_state)
      .def("__setstate__", [](ScanFound& scan, const nb::tuple& state) {
        new (&scan) ScanFound(scan_of_state(state));
      });
  m.def("_scan_advice", advice_of);
  m.def("_fourier_scan", scanned);
  m.def("_period_labels", labels_of);
}

}  // namespace polhode::python
