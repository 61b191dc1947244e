// SPDX-License-Identifier: MIT
// Fits of light curves: one start, and many.
#include "polhode/fit/light_fit.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "fit/bind_fit.hpp"
#include "fit/light_curves.hpp"
#include "fit/light_problem.hpp"
#include "io/work_loop.hpp"
#include "polhode/fit/light_extension.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode::python {

namespace {

nb::tuple body_parts(const EllipsoidModel& body) {
  const Ellipsoid& s = body.shape;
  return nb::make_tuple(spin_parts(body.spin), nb::make_tuple(s.a, s.b, s.c),
                        nb::make_tuple(body.law.single, body.law.multiple));
}

LightUnknowns light_unknowns_of(bool shape, const std::string& moments, bool multiple) {
  const MomentSource source = moments == "shape"   ? MomentSource::shape
                              : moments == "start" ? MomentSource::start
                                                   : MomentSource::fit;
  return {shape, source, multiple};
}

const char* mode_word(Regime mode) {
  switch (mode) {
    case Regime::short_axis:
      return "SAM";
    case Regime::long_axis:
      return "LAM";
    case Regime::separatrix:
      return "separatrix";
    case Regime::steady:
      return "steady";
    case Regime::rest:
      break;
  }
  return "rest";
}

nb::tuple period_parts(const TumblerPeriods& p) {
  return nb::make_tuple(mode_word(p.mode), p.precession_period, p.rotation_period);
}

LightFit light_problem(const nb::list& curves, const nb::tuple& start, bool shape,
                       const std::string& moments, bool multiple, const std::string& loss,
                       double scale, int most_iterations) {
  return {light_curves_of(curves), ellipsoid_of(start), light_unknowns_of(shape, moments, multiple),
          loss_of(loss, scale), most_iterations};
}

nb::dict fitted_light(const LightFit& fit) {
  LightSolution found;
  {
    const WithoutGil released;
    found = fit_light(fit);
  }
  return light_dict(found);
}

nb::list model_of(const nb::tuple& body, const nb::list& curves, const std::string& loss,
                  double scale) {
  nb::list list;
  for (const std::vector<double>& flux :
       model_fluxes(ellipsoid_of(body), light_curves_of(curves), loss_of(loss, scale)))
    list.append(array_of(std::span<const double>(flux)));
  return list;
}

const char* beside_word(FoundLight::Beside beside) {
  switch (beside) {
    case FoundLight::Beside::first:
      return "first";
    case FoundLight::Beside::image:
      return "image";
    case FoundLight::Beside::alias:
      return "alias";
    case FoundLight::Beside::other_mode:
      return "other-mode";
    case FoundLight::Beside::other_pole:
      break;
  }
  return "other-pole";
}

nb::dict searched(const nb::list& curves, const PeriodParts& periods, std::size_t starts,
                  std::size_t tries, int short_iterations, std::size_t finalists, double within,
                  bool shape, const std::string& moments, bool multiple, double single,
                  const std::string& loss, double scale, int most_iterations, std::uint64_t seed,
                  int threads) {
  LightSearch search;
  search.curves = light_curves_of(curves);
  search.periods = periods_of_parts(periods);
  search.starts = starts;
  search.tries = tries;
  search.short_iterations = short_iterations;
  search.finalists = finalists;
  search.within = within;
  search.unknowns = light_unknowns_of(shape, moments, multiple);
  search.law = {1.0, single};
  search.loss = loss_of(loss, scale);
  search.most_iterations = most_iterations;
  search.seed = seed;
  search.threads = checked_threads(threads);
  WorkLoop loop("the search was stopped", nb::none());
  search.between = [&loop] { loop.go_on(); };
  LightSearchResult found;
  loop.do_work(0, [&] { found = search_light(search); });
  return search_dict(found);
}

nb::dict extended(const nb::list& curves, const nb::list& starts, std::size_t first, double within,
                  bool shape, const std::string& moments, bool multiple, const std::string& loss,
                  double scale, std::size_t most_counts, int most_iterations, int threads) {
  LightExtension how;
  how.curves = light_curves_of(curves);
  for (const nb::handle start : starts)
    how.starts.push_back(ellipsoid_of(nb::cast<nb::tuple>(start)));
  how.first = first;
  how.within = within;
  how.unknowns = light_unknowns_of(shape, moments, multiple);
  how.loss = loss_of(loss, scale);
  how.most_counts = most_counts;
  how.most_iterations = most_iterations;
  how.threads = checked_threads(threads);
  WorkLoop loop("the extension was stopped", nb::none());
  how.between = [&loop] { loop.go_on(); };
  LightExtensionResult found;
  loop.do_work(0, [&] { found = extend_light(how); });
  nb::dict d;
  nb::list solutions, joined;
  for (const FoundLight& f : found.solutions) solutions.append(found_dict(f));
  for (const JoinedSession& j : found.joined)
    joined.append(
        nb::make_tuple(j.session, j.distance, j.counts, j.converged, j.solutions, j.cost));
  d["solutions"] = solutions;
  d["joined"] = joined;
  d["failure"] = found.failure;
  d["notes"] = nb::tuple(nb::cast(found.notes));
  return d;
}

}  // namespace

PythonResiduals light_residuals_of(const LightFit& fit) {
  return {ResidualFunction(least_squares_of(fit)),
          [fit](std::span<const double> x) -> nb::object { return body_parts(body_at(fit, x)); }};
}

EllipsoidModel ellipsoid_of(const nb::tuple& parts) {
  const Vec3 axes = vec3(parts[1], "axes");
  const auto [single, multiple] = nb::cast<std::tuple<double, double>>(parts[2]);
  return {spin_of(nb::cast<nb::tuple>(parts[0])), {axes.x, axes.y, axes.z}, {single, multiple}};
}

nb::dict light_dict(const LightSolution& found) {
  nb::dict d = dict_of(found.result, found.covariance, found.degrees_of_freedom, found.notes);
  d["body"] = body_parts(found.body);
  d["factors"] = array_of(std::span<const double>(found.factors));
  d["periods"] = period_parts(found.periods);
  d["pole"] = array_of(found.pole);
  d["loss"] = loss_parts(found.loss);
  d["points"] = found.points;
  return d;
}

nb::dict found_dict(const FoundLight& found) {
  nb::dict d = light_dict(found.solution);
  d["place_of_periods"] = found.periods;
  d["starts"] = found.starts;
  d["beside"] = beside_word(found.beside);
  d["of"] = found.of;
  d["relation"] = found.sentence;
  return d;
}

std::vector<TumblerPeriods> periods_of_parts(const PeriodParts& parts) {
  std::vector<TumblerPeriods> periods;
  for (const auto& [mode, precession, rotation] : parts)
    periods.push_back(
        {mode == "SAM" ? Regime::short_axis : Regime::long_axis, precession, rotation});
  return periods;
}

nb::dict search_dict(const LightSearchResult& result) {
  nb::dict d;
  nb::list solutions;
  for (const FoundLight& f : result.solutions) solutions.append(found_dict(f));
  d["solutions"] = solutions;
  d["chi_square_of_periods"] = array_of(std::span<const double>(result.chi_square_of_periods));
  d["starts"] = result.starts;
  d["finalists"] = result.finalists;
  d["converged"] = result.converged;
  d["notes"] = nb::tuple(nb::cast(result.notes));
  return d;
}

nb::list curves_parts(const std::vector<LightCurve>& curves) {
  nb::list list;
  for (const LightCurve& curve : curves) {
    Result table({curve.points.size(), 9});
    double* x = table.at(0);
    for (const LightPoint& p : curve.points) {
      const double row[] = {
          p.t,        p.flux,          p.sigma,         p.to_sun.x,     p.to_sun.y,
          p.to_sun.z, p.to_observer.x, p.to_observer.y, p.to_observer.z};
      x = std::copy(std::begin(row), std::end(row), x);
    }
    list.append(nb::make_tuple(curve.name, curve.is_calibrated, table.take()));
  }
  return list;
}

std::vector<LightCurve> light_curves_of(const nb::list& curves) {
  std::vector<LightCurve> all;
  for (const nb::handle given : curves) {
    const nb::tuple parts = nb::cast<nb::tuple>(given);
    LightCurve curve{nb::cast<std::string>(parts[0]), nb::cast<bool>(parts[1]), {}};
    curve.points =
        rows_of_table<LightPoint>(parts[2], "table", 9, [](const double* x) -> LightPoint {
          return {x[0], x[1], x[2], vector_at(x + 3), vector_at(x + 6)};
        });
    all.push_back(std::move(curve));
  }
  return all;
}

void bind_light_fit(nb::module_& m) {
  nb::class_<LightFit>(m, "_LightProblem")
      .def("fit", fitted_light)
      .def("residuals", light_residuals_of);
  m.def("_light_problem", light_problem);
  m.def("_model_fluxes", model_of);
  m.def("_search_light", searched);
  m.def("_extend_light", extended);
}

}  // namespace polhode::python
