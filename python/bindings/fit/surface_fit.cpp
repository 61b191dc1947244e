// SPDX-License-Identifier: MIT
// Fits of convex bodies and of given meshes, and likely periods.
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "fit/bind_fit.hpp"
#include "fit/light_curves.hpp"
#include "fit/light_problem.hpp"
#include "io/work_loop.hpp"
#include "motion/samples.hpp"
#include "polhode/fit/likely_periods.hpp"
#include "polhode/fit/mesh_search.hpp"
#include "polhode/fit/scan_points.hpp"

namespace polhode::python {

namespace {

MomentSource moments_of(const std::string& moments) {
  return moments == "shape"   ? MomentSource::shape
         : moments == "start" ? MomentSource::start
                              : MomentSource::fit;
}

Scattering law_of(nb::handle parts) {
  const auto [single, multiple] = nb::cast<std::tuple<double, double>>(parts);
  return {single, multiple};
}

// (spin, degree, rows, coefficients, (single, multiple))
ConvexModel convex_of(const nb::tuple& parts) {
  GaussianImage image(nb::cast<int>(parts[1]), nb::cast<int>(parts[2]));
  const Numbers given(parts[3], "coefficients", {});
  std::vector<double> coefficients;
  for (std::size_t k = 0; k < size_of(given.shape()); ++k) coefficients.push_back(*given.at(k));
  return {spin_of(nb::cast<nb::tuple>(parts[0])), law_of(parts[4]), std::move(image),
          std::move(coefficients)};
}

// (spin, FacetShape, (single, multiple))
MeshModel mesh_of(const nb::tuple& parts) {
  return {spin_of(nb::cast<nb::tuple>(parts[0])), ShadedMesh(nb::cast<const FacetShape&>(parts[1])),
          law_of(parts[2])};
}

nb::dict outcome_dict(const LightOutcome& found) {
  LightSolution all;
  static_cast<LightOutcome&>(all) = found;
  return light_dict(all);
}

struct ConvexProblem {
  ConvexFit fit;
};

// `mesh` is the shape, as Python holds it.
struct MeshProblem {
  MeshFit fit;
  nb::object mesh;
};

// `from` is what convex_parts gives, or empty.
ConvexProblem convex_problem(const nb::list& curves, const nb::tuple& start, const nb::tuple& from,
                             int degree, int rows, const std::string& moments, bool multiple,
                             const std::vector<double>& errors, const std::string& loss,
                             double scale, int most_iterations) {
  ConvexFit fit;
  fit.curves = light_curves_of(curves);
  fit.start = ellipsoid_of(start);
  if (from.size() > 0) fit.from = convex_of(from);
  fit.degree = degree;
  fit.rows = rows;
  fit.moments = moments_of(moments);
  fit.multiple = multiple;
  fit.roughness_error = errors[0];
  fit.moments_error = errors[1];
  fit.closure_error = errors[2];
  fit.axes_error = errors[3];
  fit.loss = loss_of(loss, scale);
  fit.most_iterations = most_iterations;
  return {std::move(fit)};
}

nb::dict fitted_convex(const ConvexProblem& problem) {
  const ConvexSolution found = [&] {
    const WithoutGil released;
    return fit_convex(problem.fit);
  }();
  nb::dict d = outcome_dict(found);
  d["body"] = convex_parts(found.body);
  return d;
}

PythonResiduals convex_residuals(const ConvexProblem& problem) {
  return convex_residuals_of(problem.fit);
}

MeshProblem mesh_problem(const nb::list& curves, const nb::tuple& start, const std::string& moments,
                         bool multiple, const std::string& loss, double scale,
                         int most_iterations) {
  return {{light_curves_of(curves), mesh_of(start), moments_of(moments), multiple,
           loss_of(loss, scale), most_iterations},
          start[1]};
}

nb::dict fitted_mesh(const MeshProblem& problem) {
  const MeshSolution found = [&] {
    const WithoutGil released;
    return fit_mesh(problem.fit);
  }();
  nb::dict d = outcome_dict(found);
  d["body"] = nb::make_tuple(spin_parts(found.body.spin), problem.mesh,
                             nb::make_tuple(found.body.law.single, found.body.law.multiple));
  return d;
}

PythonResiduals mesh_residuals(const MeshProblem& problem) {
  return mesh_residuals_of(problem.fit);
}

// `bodies` are those of the solutions, with the mesh that was given.
nb::dict mesh_search(const nb::list& curves, const nb::tuple& body, const PeriodParts& periods,
                     std::size_t starts, std::size_t tries, int short_iterations,
                     std::size_t finalists, double within, const std::string& moments,
                     bool multiple, const std::string& loss, double scale, int most_iterations,
                     std::uint64_t seed, int threads) {
  MeshSearch search{.curves = light_curves_of(curves),
                    .body = mesh_of(body),
                    .periods = periods_of_parts(periods)};
  search.starts = starts;
  search.tries = tries;
  search.short_iterations = short_iterations;
  search.finalists = finalists;
  search.within = within;
  search.moments = moments_of(moments);
  search.multiple = multiple;
  search.loss = loss_of(loss, scale);
  search.most_iterations = most_iterations;
  search.seed = seed;
  search.threads = checked_threads(threads);
  WorkLoop loop("the search was stopped", nb::none());
  search.between = [&loop] { loop.go_on(); };
  LightSearchResult found;
  loop.do_work(0, [&] { found = search_mesh(search); });
  nb::dict d = search_dict(found);
  nb::list bodies;
  for (const FoundLight& f : found.solutions) {
    const EllipsoidModel& one = f.solution.body;
    bodies.append(nb::make_tuple(spin_parts(one.spin), body[1],
                                 nb::make_tuple(one.law.single, one.law.multiple)));
  }
  d["bodies"] = bodies;
  return d;
}

template <class Body>
nb::list fluxes_of(const Body& body, const nb::list& curves, const std::string& loss,
                   double scale) {
  nb::list list;
  for (const std::vector<double>& flux :
       model_fluxes(body, light_curves_of(curves), loss_of(loss, scale)))
    list.append(array_of(std::span<const double>(flux)));
  return list;
}

// Normals (M, 3) and areas (M,).
nb::tuple facets_of(const nb::tuple& parts) {
  const ConvexModel body = convex_of(parts);
  const std::vector<double> areas = body.areas();
  Result normals({areas.size(), 3});
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const Vec3& n = body.image.normals()[k];
    for (int i = 0; i < 3; ++i) normals.at(0)[3 * k + static_cast<std::size_t>(i)] = n[i];
  }
  return nb::make_tuple(normals.take(), array_of(std::span<const double>(areas)));
}

// (mode, P_phi, P_psi, score)
nb::list likely_of(const nb::list& curves, double f1, double f2, std::size_t order) {
  const ScanPoints points(light_curves_of(curves));
  nb::list list;
  for (const LikelyPeriods& l :
       likely_periods(fourier_fit(points, f1, f2, FourierOrders::pair(order))))
    list.append(nb::make_tuple(l.periods.mode == Regime::short_axis ? "SAM" : "LAM",
                               l.periods.precession_period, l.periods.rotation_period, l.score));
  return list;
}

}  // namespace

nb::tuple convex_parts(const ConvexModel& body) {
  const std::size_t facets = body.image.normals().size();
  int rows = 1;
  while (8 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows) < facets) ++rows;
  return nb::make_tuple(spin_parts(body.spin), body.image.degree(), rows,
                        array_of(std::span<const double>(body.coefficients)),
                        nb::make_tuple(body.law.single, body.law.multiple));
}

PythonResiduals convex_residuals_of(const ConvexFit& fit) {
  return {ResidualFunction(least_squares_of(fit)),
          [fit](std::span<const double> x) -> nb::object { return convex_parts(body_at(fit, x)); }};
}

PythonResiduals mesh_residuals_of(const MeshFit& fit) {
  return {ResidualFunction(least_squares_of(fit)), [fit](std::span<const double> x) -> nb::object {
            const MeshModel body = body_at(fit, x);
            return nb::make_tuple(spin_parts(body.spin), body.shape.shape(),
                                  nb::make_tuple(body.law.single, body.law.multiple));
          }};
}

void bind_surface_fit(nb::module_& m) {
  nb::class_<ConvexProblem>(m, "_ConvexProblem")
      .def("fit", fitted_convex)
      .def("residuals", convex_residuals);
  nb::class_<MeshProblem>(m, "_MeshProblem")
      .def("fit", fitted_mesh)
      .def("residuals", mesh_residuals);
  m.def("_convex_problem", convex_problem);
  m.def("_mesh_problem", mesh_problem);
  m.def("_search_mesh", mesh_search);
  m.def("_convex_fluxes",
        [](const nb::tuple& body, const nb::list& curves, const std::string& loss, double scale) {
          return fluxes_of(convex_of(body), curves, loss, scale);
        });
  m.def("_mesh_fluxes", [](const nb::tuple& body, const nb::list& curves, const std::string& loss,
                           double scale) { return fluxes_of(mesh_of(body), curves, loss, scale); });
  m.def("_convex_facets", facets_of);
  m.def("_convex_mesh", [](const nb::tuple& body) { return convex_of(body).mesh(); });
  m.def("_homogeneous_inertia",
        [](const FacetShape& shape) { return array_of(homogeneous_inertia(shape)); });
  m.def("_likely_periods", likely_of);
}

}  // namespace polhode::python
