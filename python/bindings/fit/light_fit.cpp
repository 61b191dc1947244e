// SPDX-License-Identifier: MIT
// Fits of light curves: one start, many, sessions that join one by one; and likely periods.
#include "polhode/fit/light_fit.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

#include "fit/bind_fit.hpp"
#include "fit/light_problem.hpp"
#include "io/work_loop.hpp"
#include "motion/samples.hpp"
#include "polhode/fit/fourier_fit.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode::python {

namespace {

// A fit, and the mesh of its body as Python holds it, or None.
struct LightProblem {
  fit::LightFit fit;
  nb::object mesh;
};

nb::object mesh_of(const nb::tuple& parts) {
  return nb::isinstance<shape::FacetShape>(parts[1]) ? nb::object(parts[1]) : nb::none();
}

fit::LightShape shape_of(nb::handle given) {
  if (nb::isinstance<shape::FacetShape>(given))
    return light::ShadedMesh(nb::cast<const shape::FacetShape&>(given));
  if (!nb::isinstance<nb::tuple>(given)) {
    const Vec3 axes = vec3(given, "axes");
    return light::Ellipsoid{axes.x, axes.y, axes.z};
  }
  const nb::tuple parts = nb::cast<nb::tuple>(given);
  light::GaussianImage image(nb::cast<int>(parts[0]), nb::cast<int>(parts[1]));
  const Numbers numbers(parts[2], "coefficients", {});
  std::vector<double> coefficients;
  for (std::size_t k = 0; k < size_of(numbers.shape()); ++k) coefficients.push_back(*numbers.at(k));
  return fit::ConvexShape{std::move(image), std::move(coefficients)};
}

nb::object shape_parts(const fit::LightShape& shape, nb::handle mesh) {
  if (const auto* e = std::get_if<light::Ellipsoid>(&shape))
    return array_of(Vec3{e->a, e->b, e->c});
  if (const auto* c = std::get_if<fit::ConvexShape>(&shape))
    return nb::make_tuple(c->image.degree(), c->image.rows(),
                          array_of(std::span<const double>(c->coefficients)));
  if (mesh.is_valid() && !mesh.is_none()) return nb::borrow(mesh);
  return nb::cast(std::get<light::ShadedMesh>(shape).shape());
}

// (shape, moments, multiple)
using UnknownParts = std::tuple<bool, std::string, bool>;
fit::LightUnknowns light_unknowns_of(const UnknownParts& parts) {
  const auto& [shape, moments, multiple] = parts;
  const fit::MomentSource source = moments == "shape"   ? fit::MomentSource::shape
                                   : moments == "start" ? fit::MomentSource::start
                                                        : fit::MomentSource::fit;
  return {shape, source, multiple};
}

// (roughness, moments, closure and axes errors, the usual body or None)
using RegularisationParts = std::tuple<double, double, double, double, nb::object>;
fit::Regularisation regularisation_of(const RegularisationParts& parts) {
  const auto& [roughness, moments, closure, axes, about] = parts;
  fit::Regularisation r{closure, axes, roughness, moments};
  if (!about.is_none()) r.about = body_of(nb::cast<nb::tuple>(about));
  return r;
}

// (kind, scale)
using LossParts = std::tuple<std::string, double>;
fit::Loss loss_of_parts(const LossParts& parts) {
  return loss_of(std::get<0>(parts), std::get<1>(parts));
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

nb::tuple period_parts(const fit::TumblerPeriods& p) {
  return nb::make_tuple(mode_word(p.mode), p.precession_period, p.rotation_period);
}

LightProblem light_problem(const nb::list& curves, const nb::tuple& start,
                           const UnknownParts& unknowns, const LossParts& loss, int most_iterations,
                           const RegularisationParts& regularisation) {
  return {{light_curves_of(curves), body_of(start), light_unknowns_of(unknowns),
           loss_of_parts(loss), most_iterations, 0.0, regularisation_of(regularisation)},
          mesh_of(start)};
}

nb::dict light_dict(const fit::LightSolution& found, nb::handle mesh) {
  nb::dict d = dict_of(found.result, found.covariance, found.degrees_of_freedom, found.notes);
  d["body"] = body_parts(found.body, mesh);
  d["factors"] = array_of(std::span<const double>(found.factors));
  d["periods"] = period_parts(found.periods);
  d["pole"] = array_of(found.pole);
  d["loss"] = loss_parts(found.loss);
  d["points"] = found.points;
  return d;
}

nb::dict fitted_light(const LightProblem& problem) {
  fit::LightSolution found;
  {
    const WithoutGil released;
    found = fit::fit_light(problem.fit);
  }
  return light_dict(found, problem.mesh);
}

nb::list model_of(const nb::tuple& body, const nb::list& curves, const LossParts& loss) {
  nb::list list;
  for (const std::vector<double>& flux :
       fit::model_fluxes(body_of(body), light_curves_of(curves), loss_of_parts(loss)))
    list.append(array_of(std::span<const double>(flux)));
  return list;
}

const char* beside_word(fit::FoundLight::Beside beside) {
  switch (beside) {
    case fit::FoundLight::Beside::first:
      return "first";
    case fit::FoundLight::Beside::image:
      return "image";
    case fit::FoundLight::Beside::alias:
      return "alias";
    case fit::FoundLight::Beside::other_mode:
      return "other-mode";
    case fit::FoundLight::Beside::other_pole:
      break;
  }
  return "other-pole";
}

nb::list found_list(const std::vector<fit::FoundLight>& all, nb::handle mesh) {
  nb::list list;
  for (const fit::FoundLight& f : all) list.append(found_dict(f, mesh));
  return list;
}

// (mesh or (degree, rows), unknowns, regularisation, most_iterations)
using SurfaceParts = std::tuple<nb::tuple, UnknownParts, RegularisationParts, int>;
fit::SurfaceSearch surface_of(const SurfaceParts& parts) {
  const auto& [shape, unknowns, regularisation, most_iterations] = parts;
  fit::SurfaceSearch surface{.unknowns = light_unknowns_of(unknowns),
                             .regularisation = regularisation_of(regularisation),
                             .most_iterations = most_iterations};
  if (shape.size() == 2)
    std::tie(surface.degree, surface.rows) = nb::cast<std::tuple<int, int>>(shape);
  else
    surface.mesh = body_of(shape);
  return surface;
}

// `body` is one that is known, or None.
nb::dict searched(const nb::list& curves,
                  const std::vector<std::tuple<std::string, double, double>>& periods,
                  const nb::object& body, const std::optional<SurfaceParts>& surface,
                  std::size_t starts, std::size_t tries, int short_iterations,
                  std::size_t finalists, double within, const UnknownParts& unknowns,
                  double lambert, const LossParts& loss, int most_iterations, std::uint64_t seed,
                  int threads) {
  fit::LightSearch search;
  search.curves = light_curves_of(curves);
  for (const auto& [mode, precession, rotation] : periods)
    search.periods.push_back(
        {mode == "SAM" ? Regime::short_axis : Regime::long_axis, precession, rotation});
  nb::object mesh = nb::none();
  if (!body.is_none()) {
    search.body = body_of(nb::cast<nb::tuple>(body));
    mesh = mesh_of(nb::cast<nb::tuple>(body));
  }
  if (surface) {
    search.surface = surface_of(*surface);
    if (search.surface->mesh) mesh = mesh_of(std::get<0>(*surface));
  }
  search.starts = starts;
  search.tries = tries;
  search.short_iterations = short_iterations;
  search.finalists = finalists;
  search.within = within;
  search.unknowns = light_unknowns_of(unknowns);
  search.law = {1.0, lambert};
  search.loss = loss_of_parts(loss);
  search.most_iterations = most_iterations;
  search.seed = seed;
  search.threads = checked_threads(threads);
  WorkLoop loop("the search was stopped");
  search.between = [&loop] { loop.go_on(); };
  fit::LightSearchResult found;
  loop.do_work([&] { found = fit::search_light(search); });
  nb::dict d;
  d["solutions"] = found_list(found.solutions, mesh);
  d["chi_square_of_periods"] = array_of(std::span<const double>(found.chi_square_of_periods));
  d["starts"] = found.starts;
  d["finalists"] = found.finalists;
  d["converged"] = found.converged;
  d["surfaces"] = found.surfaces;
  d["surfaces_converged"] = found.surfaces_converged;
  d["failure"] = found.failure;
  d["notes"] = nb::tuple(nb::cast(found.notes));
  return d;
}

nb::dict extended(const nb::list& curves, const nb::list& starts, std::size_t first, double within,
                  const UnknownParts& unknowns, const LossParts& loss, std::size_t most_counts,
                  int most_iterations, int threads, const RegularisationParts& regularisation) {
  fit::LightExtension how;
  how.curves = light_curves_of(curves);
  nb::object mesh = nb::none();
  for (const nb::handle start : starts) {
    const nb::tuple parts = nb::cast<nb::tuple>(start);
    how.starts.push_back(body_of(parts));
    if (mesh.is_none()) mesh = mesh_of(parts);
  }
  how.first = first;
  how.within = within;
  how.unknowns = light_unknowns_of(unknowns);
  how.loss = loss_of_parts(loss);
  how.most_counts = most_counts;
  how.most_iterations = most_iterations;
  how.threads = checked_threads(threads);
  how.regularisation = regularisation_of(regularisation);
  WorkLoop loop("the extension was stopped");
  how.between = [&loop] { loop.go_on(); };
  fit::LightExtensionResult found;
  loop.do_work([&] { found = fit::extend_light(how); });
  nb::dict d;
  nb::list joined;
  for (const fit::JoinedSession& j : found.joined)
    joined.append(
        nb::make_tuple(j.session, j.distance, j.counts, j.converged, j.solutions, j.cost));
  d["solutions"] = found_list(found.solutions, mesh);
  d["joined"] = joined;
  d["failure"] = found.failure;
  d["notes"] = nb::tuple(nb::cast(found.notes));
  return d;
}

fit::ConvexShape convex_of(const nb::tuple& parts) {
  return std::get<fit::ConvexShape>(shape_of(parts));
}

// (degree, rows, coefficients) of the facets of an ellipsoid.
nb::object facets_like(nb::handle axes, int degree, int rows) {
  const Vec3 e = vec3(axes, "axes");
  return shape_parts(fit::ConvexShape::of({e.x, e.y, e.z}, degree, rows), {});
}

// Normals (M, 3) and areas (M,).
nb::tuple facets_of(const nb::tuple& parts) {
  const fit::ConvexShape shape = convex_of(parts);
  const std::vector<double> areas = shape.areas();
  Result normals({areas.size(), 3});
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const Vec3& n = shape.image.normals()[k];
    for (int i = 0; i < 3; ++i) normals.at(0)[3 * k + static_cast<std::size_t>(i)] = n[i];
  }
  return nb::make_tuple(normals.take(), array_of(std::span<const double>(areas)));
}

// (mode, P_phi, P_psi, score)
nb::list likely_of(const nb::list& curves, double f1, double f2, std::size_t order) {
  const fit::ScanPoints points(light_curves_of(curves));
  nb::list list;
  for (const fit::LikelyPeriods& l :
       fit::likely_periods(fit::fourier_fit(points, f1, f2, fit::FourierOrders::pair(order))))
    list.append(nb::make_tuple(mode_word(l.periods.mode), l.periods.precession_period,
                               l.periods.rotation_period, l.score));
  return list;
}

}  // namespace

fit::LightModel body_of(const nb::tuple& parts) {
  const auto [single, multiple] = nb::cast<std::tuple<double, double>>(parts[2]);
  return {spin_of(nb::cast<nb::tuple>(parts[0])), shape_of(parts[1]), {single, multiple}};
}

nb::tuple body_parts(const fit::LightModel& body, nb::handle mesh) {
  return nb::make_tuple(spin_parts(body.spin), shape_parts(body.shape, mesh),
                        nb::make_tuple(body.law.single, body.law.multiple));
}

PythonResiduals light_residuals_of(const fit::LightFit& fit, const nb::object& mesh) {
  return {fit::ResidualFunction(fit::least_squares_of(fit)),
          [fit, mesh](std::span<const double> x) -> nb::object {
            return body_parts(fit::body_at(fit, x), mesh);
          }};
}

nb::dict found_dict(const fit::FoundLight& found, nb::handle mesh) {
  nb::dict d = light_dict(found.solution, mesh);
  d["place_of_periods"] = found.periods;
  d["starts"] = found.starts;
  d["beside"] = beside_word(found.beside);
  d["of"] = found.of;
  d["relation"] = found.sentence;
  return d;
}

nb::list curves_parts(const std::vector<light::LightCurve>& curves) {
  nb::list list;
  for (const light::LightCurve& curve : curves) {
    Result table({curve.points.size(), 9});
    double* x = table.at(0);
    for (const light::LightPoint& p : curve.points) {
      const double row[] = {
          p.t,        p.flux,          p.sigma,         p.to_sun.x,     p.to_sun.y,
          p.to_sun.z, p.to_observer.x, p.to_observer.y, p.to_observer.z};
      x = std::copy(std::begin(row), std::end(row), x);
    }
    list.append(nb::make_tuple(curve.name, curve.is_calibrated, table.take()));
  }
  return list;
}

std::vector<light::LightCurve> light_curves_of(const nb::list& curves) {
  std::vector<light::LightCurve> all;
  for (const nb::handle given : curves) {
    const nb::tuple parts = nb::cast<nb::tuple>(given);
    light::LightCurve curve{nb::cast<std::string>(parts[0]), nb::cast<bool>(parts[1]), {}};
    curve.points = rows_of_table<light::LightPoint>(
        parts[2], "table", 9, [](const double* x) -> light::LightPoint {
          return {x[0], x[1], x[2], vector_at(x + 3), vector_at(x + 6)};
        });
    all.push_back(std::move(curve));
  }
  return all;
}

void bind_light_fit(nb::module_& m) {
  nb::class_<LightProblem>(m, "_LightProblem")
      .def("fit", fitted_light)
      .def("residuals", [](const LightProblem& problem) {
        return light_residuals_of(problem.fit, problem.mesh);
      });
  m.def("_light_problem", light_problem);
  m.def("_model_fluxes", model_of);
  m.def("_search_light", searched, "curves"_a, "periods"_a, "body"_a.none(), "surface"_a.none(),
        "starts"_a, "tries"_a, "short_iterations"_a, "finalists"_a, "within"_a, "unknowns"_a,
        "lambert"_a, "loss"_a, "most_iterations"_a, "seed"_a, "threads"_a);
  m.def("_extend_light", extended);
  m.def("_facets_like", facets_like);
  m.def("_convex_facets", facets_of);
  m.def("_convex_mesh", [](const nb::tuple& parts) { return convex_of(parts).mesh(); });
  m.def("_homogeneous_inertia",
        [](const shape::FacetShape& shape) { return array_of(fit::homogeneous_inertia(shape)); });
  m.def("_likely_periods", likely_of);
}

}  // namespace polhode::python
