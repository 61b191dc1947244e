// SPDX-License-Identifier: MIT
// Words and numbers of fits of light curves.
#include "run/detail/light_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "fit/light_states.hpp"
#include "polhode/math/real.hpp"
#include "run/detail/fit_tables.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {
namespace {

// Of periods and costs of fits that came to one.
constexpr double same_part = 1e-4;

}  // namespace

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

const char* beside_word(const fit::FoundLight& found) {
  using enum fit::FoundLight::Beside;
  switch (found.beside) {
    case image:
      return "image";
    case alias:
      return "alias";
    case other_mode:
      return "other-mode";
    case other_pole:
      return "other-pole";
    case first:
      break;
  }
  return "first";
}

const char* image_word(fit::LightImage image) {
  using enum fit::LightImage;
  return image == normal       ? "normal"
         : image == bisector   ? "bisector"
         : image == difference ? "difference"
                               : "none";
}

const char* loss_word(const fit::Loss& loss) {
  using enum fit::Loss::Kind;
  return loss.kind == huber     ? "huber"
         : loss.kind == soft_l1 ? "soft-l1"
         : loss.kind == cauchy  ? "cauchy"
                                : "squared";
}

const char* rank_word(const LightReport& report, const fit::Loss& loss) {
  if (report.shape == LightPlan::Shape::convex) return "cost";
  return loss.kind == fit::Loss::Kind::squared ? "chi-square" : "loss";
}

SkyPlace sky_place(const Vec3& d) {
  const double longitude = std::atan2(d.y, d.x);
  return {longitude < 0.0 ? longitude + 2.0 * pi<double>() : longitude,
          std::atan2(d.z, std::hypot(d.x, d.y))};
}

Vec3 mirror_pole(const Vec3& pole, const LightReport& report) {
  const fit::detail::LightGeometry mean = fit::detail::geometry_of(report.observed.curves);
  const Vec3 normal = cross(mean.to_sun, mean.to_observer);
  const double size2 = dot(normal, normal);
  return size2 > 0.0 ? (2.0 * dot(normal, pole) / size2) * normal - pole : pole;
}

LightFigures light_figures(const Scenario& scenario, const LightReport& report,
                           std::size_t solution) {
  const fit::LightSolution& s = report.solutions.at(solution).solution;
  const fit::DerivedParameters f = fit::derived_parameters(s, report.unknowns);
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double known = report.has_errors() ? 1.0 : none, scale = known * light_error_factor(s);
  const Units& units = scenario.units();
  const auto with = [&](double value, double error, Dimension d) {
    return WithErrors{units.from_core(value, d), units.from_core(known * error, d),
                      units.from_core(scale * error, d), units.label(d)};
  };
  const SkyPlace pole = sky_place(f.pole_I);
  return {with(f.periods.precession_period, f.precession_error, Dimension::time),
          with(f.periods.rotation_period, f.rotation_error, Dimension::time),
          with(f.short_period, f.short_error, Dimension::time),
          {units.from_core(pole.longitude, Dimension::angle),
           units.from_core(pole.latitude, Dimension::angle)},
          with(0.0, f.pole_major, Dimension::angle),
          with(0.0, f.pole_minor, Dimension::angle)};
}

const char* shape_word(LightPlan::Shape shape) {
  using enum LightPlan::Shape;
  return shape == convex ? "convex" : shape == mesh ? "mesh" : "ellipsoid";
}

std::vector<PairGroup> groups_of_pairs(const LightReport& report) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < report.pairs.size(); ++i)
    if (report.pairs[i].ellipsoid) order.push_back(i);
  const auto rank = [&](std::size_t i) {
    const PairFound& pair = report.pairs[i];
    const double ellipsoid = pair.ellipsoid->result.cost;
    return std::pair(pair.surface ? pair.surface->result.cost : ellipsoid, ellipsoid);
  };
  std::ranges::stable_sort(order, {}, rank);
  std::vector<PairGroup> groups;
  for (const std::size_t i : order) {
    const fit::LightSolution& s = *report.pairs[i].ellipsoid;
    const auto same = std::ranges::find_if(groups, [&](const PairGroup& group) {
      const fit::LightSolution& of = *report.pairs[group.best].ellipsoid;
      const fit::TumblerPeriods &a = of.periods, &b = s.periods;
      const auto are_near = [](double x, double y) { return std::fabs(x - y) <= same_part * y; };
      return a.mode == b.mode && are_near(a.precession_period, b.precession_period) &&
             are_near(a.rotation_period, b.rotation_period) &&
             are_near(of.result.cost, s.result.cost);
    });
    if (same == groups.end())
      groups.push_back({i, {i}});
    else
      same->pairs.push_back(i);
  }
  return groups;
}

std::vector<std::vector<double>> fluxes_of(const LightReport& report, std::size_t solution) {
  const fit::LightSolution& found = report.solutions.at(solution).solution;
  return fit::model_fluxes(found.body, report.observed.curves, found.loss);
}

}  // namespace detail

double light_error_factor(const fit::LightSolution& found) {
  const double factor = found.error_factor();
  return factor > 0.0 ? factor : std::numeric_limits<double>::quiet_NaN();
}

std::vector<FitNumber> fit_numbers(const Scenario& scenario, const LightReport& report,
                                   std::size_t solution) {
  const fit::LightSolution& found = report.solutions.at(solution).solution;
  fit::LightModel about = report.start.value_or(found.body);
  if (report.start && found.body.is_convex()) {
    const light::GaussianImage& image = found.body.convex().image;
    about.shape = fit::ConvexShape{image, image.coefficients(about.ellipsoid())};
  }
  std::vector<double> start = fit::light_unknowns_at(report.unknowns, about, about);
  std::vector<double> value = fit::light_unknowns_at(report.unknowns, about, found.body);
  std::fill_n(start.begin(), 3, 0.0);  // not what rounding leaves
  if (!report.start) std::fill_n(value.begin(), 3, 0.0);
  const double known = report.has_errors() ? 1.0 : std::numeric_limits<double>::quiet_NaN();
  const double scale = known * light_error_factor(found);
  std::vector<FitNumber> numbers;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string& name = found.covariance.names.at(i);
    const Dimension d = detail::dimension_of_unknown(name);
    const auto shown = [&](double x) { return scenario.units().from_core(x, d); };
    FitNumber one{name, scenario.units().label(d), shown(value[i]),
                  shown(known * found.covariance.error(i))};
    if (report.start) one.start = shown(start[i]);
    if (std::isfinite(scale)) one.scaled_error = scale * one.error;
    numbers.push_back(std::move(one));
  }
  return numbers;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
