// SPDX-License-Identifier: MIT
// The solutions of a fit of light curves for programs.
#include <cmath>
#include <limits>

#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"
#include "text/json.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::JsonWriter;
using detail::LightFigures;
using detail::WithErrors;

constexpr double unlimited = std::numeric_limits<double>::infinity();

std::int64_t whole(std::size_t n) { return static_cast<std::int64_t>(n); }

void add_sessions(JsonWriter& json, const LightReport& report) {
  json.key("sessions").begin_array();
  for (std::size_t c = 0; c < report.observed.curves.size(); ++c) {
    const LightCurve& curve = report.observed.curves[c];
    json.begin_object();
    json.key("name").value(curve.name).key("points").value(whole(curve.points.size()));
    json.key("table").value(whole(report.observed.curve_rows.at(c).at(0).table + 1));
    json.key("calibrated").value(curve.is_calibrated);
    json.end_object();
  }
  json.end_array();
}

void add_scan(JsonWriter& json, const Scenario& scenario, const LightScan& scan) {
  const double time = scenario.units().from_core(1.0, Dimension::time);
  const FrequencyGrid& g = scan.landscape.first;
  json.key("scan").begin_object();
  json.key("order").value(whole(scan.landscape.orders.second));
  json.key("frequencies").value(whole(g.count));
  json.key("least").value(g.at(0) / time).key("most").value(g.at(g.count - 1) / time);
  json.key("step").value(g.step / time);
  json.key("sessions").value(scan.separate ? "separate" : "joined");
  if (scan.separate) {
    json.key("separate_sessions").value(whole(scan.separate->sessions));
    json.key("windows").value(whole(scan.separate->windows));
    json.key("pairs_in_windows").value(whole(scan.separate->pairs));
  }
  if (scan.constant) {
    json.key("constant").begin_object().key("chi_square").value(scan.constant->chi_square);
    json.key("degrees_of_freedom").value(whole(scan.constant->degrees_of_freedom));
    json.key("suffices").value(scan.constant->suffices).end_object();
  }
  if (scan.one) {
    const FourierFit& fit = scan.one->refined.fit;
    json.key("one_period").begin_object().key("order").value(whole(scan.one->order));
    json.key("period").value(time / fit.f2).key("chi_square").value(fit.chi_square);
    json.key("degrees_of_freedom").value(whole(fit.degrees_of_freedom - 1));
    json.key("suffices").value(scan.one->suffices).key("aliases").begin_array();
    for (const double f : scan.one->aliases) json.value(time / f);
    json.end_array().end_object();
  }
  json.key("minima").begin_array();
  for (const ScanMinimum& m : scan.minima) {
    const RefinedPair& r = m.refined;
    json.begin_object();
    json.key("f1").value(r.fit.f1 / time).key("f2").value(r.fit.f2 / time);
    json.key("sigma_f1").value(r.sigma_f1 / time).key("sigma_f2").value(r.sigma_f2 / time);
    json.key("scale").value(r.scale);
    json.key("period_1").value(time / r.fit.f1).key("period_2").value(time / r.fit.f2);
    json.key("chi_square").value(r.fit.chi_square);
    json.key("converged").value(r.converged).key("resolved").value(m.resolved);
    json.key("at_edge").value(m.at_edge);
    json.end_object();
  }
  json.end_array().end_object();
}

void add_chosen(JsonWriter& json, const Scenario& scenario, const LightReport& report) {
  const double time = scenario.units().from_core(1.0, Dimension::time);
  const auto add = [&](const FourierFit& fit) {
    json.key("period_1").value(time / fit.f1).key("period_2").value(time / fit.f2);
    json.key("chi_square").value(fit.chi_square);
    json.key("degrees_of_freedom").value(whole(fit.degrees_of_freedom));
    json.key("resolved").value(is_resolved(fit));
  };
  json.key("chosen_pairs").begin_array();
  for (const ChosenPair& one : report.chosen) {
    const RefinedPair& r = one.refined;
    json.begin_object();
    json.key("order").value(whole(require_fit(scenario).light.scan.at_order));
    add(one.fit);
    json.key("minimum").begin_object();
    add(r.fit);
    json.key("f1").value(r.fit.f1 / time).key("f2").value(r.fit.f2 / time);
    json.key("sigma_f1").value(r.sigma_f1 / time).key("sigma_f2").value(r.sigma_f2 / time);
    json.key("scale").value(r.scale).key("converged").value(r.converged);
    json.end_object().end_object();
  }
  json.end_array();
}

void add_periods(JsonWriter& json, const Scenario& scenario, const LightReport& report) {
  const double time = scenario.units().from_core(1.0, Dimension::time);
  json.key("periods").begin_array();
  const auto add_place = [&](const Vec3& direction, const char* longitude, const char* latitude) {
    const detail::SkyPlace at = detail::sky_place(direction);
    json.key(longitude).value(scenario.units().from_core(at.longitude, Dimension::angle));
    json.key(latitude).value(scenario.units().from_core(at.latitude, Dimension::angle));
  };
  const auto add_poles = [&](const Vec3& pole) {
    add_place(pole, "longitude", "latitude");
    add_place(detail::mirror_pole(pole, report), "mirror_longitude", "mirror_latitude");
  };
  const auto add = [&](const TumblerPeriods& p) {
    json.key("mode").value(detail::mode_word(p.mode));
    json.key("precession_period").value(time * p.precession_period);
    json.key("rotation_period").value(time * p.rotation_period);
  };
  for (const PairFound& pair : report.pairs) {
    json.begin_object();
    add(pair.from);
    json.key("chi_square").value(pair.ellipsoid ? pair.ellipsoid->result.chi_square : unlimited);
    json.key("cost").value(pair.ellipsoid ? pair.ellipsoid->result.cost : unlimited);
    if (pair.ellipsoid) {
      const LightSolution& s = *pair.ellipsoid;
      json.key("found").begin_object();
      add(s.periods);
      add_poles(s.pole);
      const Ellipsoid& shape = s.body.ellipsoid();
      json.key("b/a").value(shape.b / shape.a).key("c/b").value(shape.c / shape.b).end_object();
    }
    if (pair.surface) {
      json.key(detail::shape_word(report.shape)).begin_object();
      json.key("chi_square").value(pair.surface->chi_square);
      json.key("cost").value(pair.surface->cost);
      json.key("converged").value(pair.surface->is_converged);
      add(pair.surface->periods);
      add_poles(pair.surface->pole);
      json.key("sentence").value(pair.surface->sentence).end_object();
    }
    json.end_object();
  }
  json.end_array();
}

void add_joined(JsonWriter& json, const Scenario& scenario, const LightReport& report) {
  json.key("joined_sessions").begin_array();
  for (const JoinedSession& one : report.joined) {
    json.begin_object().key("session").value(whole(one.session + 1));
    json.key("distance").value(scenario.units().from_core(one.distance, Dimension::time));
    json.key("counts").value(whole(one.counts)).key("converged").value(whole(one.converged));
    json.key("solutions").value(whole(one.solutions)).key("cost").value(one.cost);
    json.end_object();
  }
  json.end_array();
}

void add_convex(JsonWriter& json, const Scenario& scenario, const LightModel& body) {
  const ConvexShape& shape = body.convex();
  const ConvexPlan& plan = require_fit(scenario).light.convex;
  json.key("convex").begin_object();
  json.key("degree").value(static_cast<std::int64_t>(shape.image.degree()));
  json.key("facets").value(whole(shape.image.normals().size()));
  json.key("roughness_error").value(plan.roughness_error);
  if (plan.moments == MomentSource::fit) json.key("moments_error").value(plan.moments_error);
  const Mat3& T = body.spin.inertia_F;
  json.key("Ixx/Izz").value(T(0, 0) / T(2, 2)).key("Iyy/Izz").value(T(1, 1) / T(2, 2));
  json.key("coefficients").begin_array();
  for (const double c : shape.coefficients) json.value(c);
  json.end_array().end_object();
}

void add_with_errors(JsonWriter& json, const char* key, const WithErrors& x) {
  json.key(key).begin_object();
  json.key("value").value(x.value).key("error").value(x.error);
  json.key("scaled_error").value(x.scaled_error).key("unit").value(x.unit);
  json.end_object();
}

void add_pole(JsonWriter& json, const Scenario& scenario, const LightFigures& f) {
  json.key("pole").begin_object();
  json.key("axes").value(scenario.rotation().axes);
  json.key("longitude").value(f.pole.longitude).key("latitude").value(f.pole.latitude);
  json.key("error_major").value(f.pole_major.error).key("error_minor").value(f.pole_minor.error);
  json.key("scaled_error_major").value(f.pole_major.scaled_error);
  json.key("scaled_error_minor").value(f.pole_minor.scaled_error);
  json.key("unit").value(f.pole_major.unit);
  json.end_object();
}

void add_unknowns(JsonWriter& json, const Scenario& scenario, const LightReport& report,
                  std::size_t i) {
  json.key("unknowns").begin_object();
  for (const FitNumber& one : light_numbers(scenario, report, i)) {
    json.key(one.name).begin_object().key("unit").value(one.unit);
    if (report.start) json.key("start").value(one.start);
    json.key("value").value(one.value).key("error").value(one.error);
    if (one.scaled_error) json.key("scaled_error").value(*one.scaled_error);
    json.end_object();
  }
  json.end_object();
}

void add_solution(JsonWriter& json, const Scenario& scenario, const LightReport& report,
                  std::size_t i, std::span<const double> times) {
  const FoundLight& one = report.solutions[i];
  const LightSolution& s = one.solution;
  const LightFigures f = detail::light_figures(scenario, report, i);
  json.begin_object();
  json.key("beside").value(detail::beside_word(one)).key("of").value(whole(one.of + 1));
  json.key("image").value(detail::image_word(one.image));
  json.key("sentence").value(one.sentence.empty() ? s.result.sentence : one.sentence);
  json.key("chi_square").value(s.result.chi_square).key("cost").value(s.result.cost);
  json.key("cost_terms").begin_object();
  for (const CostTerm& term : s.terms) json.key(term.name).value(term.value);
  json.end_object();
  json.key("degrees_of_freedom").value(s.degrees_of_freedom);
  json.key("describes_data").value(s.describes_data());
  if (const double scale = light_error_factor(s); std::isfinite(scale))
    json.key("error_factor").value(scale);
  json.key("starts").value(whole(one.starts));
  json.key("iterations").value(static_cast<std::int64_t>(s.result.iterations));
  json.key("mode").value(detail::mode_word(s.periods.mode));
  if (s.periods.precession_period > 0.0) {
    add_with_errors(json, "precession_period", f.precession_period);
    add_with_errors(json, "rotation_period", f.rotation_period);
    add_with_errors(json, "short_axis_period", f.short_axis_period);
  }
  add_pole(json, scenario, f);
  json.key("converged").value(true).key("convergence").value(s.result.sentence);
  if (s.body.is_convex()) add_convex(json, scenario, s.body);
  json.key("shape").begin_object();
  json.key("b/a").value(one.ellipsoid.b / one.ellipsoid.a);
  json.key("c/b").value(one.ellipsoid.c / one.ellipsoid.b).end_object();
  json.key("multiple").value(s.body.law.multiple);
  json.key("epoch").value(scenario.units().from_core(s.body.spin.t0, Dimension::time));
  const Quaternion& q = s.body.spin.q;
  json.key("quaternion").begin_array().value(q.w).value(q.x).value(q.y).value(q.z).end_array();
  add_unknowns(json, scenario, report, i);
  json.key("covariance_core").begin_array();
  const std::size_t n = s.covariance.names.size();
  for (std::size_t a = 0; a < n; ++a) {
    json.begin_array();
    for (std::size_t b = 0; b < n; ++b) json.value(s.covariance.matrix[a * n + b]);
    json.end_array();
  }
  json.end_array().key("factors").begin_array();
  for (const double factor : s.factors) json.value(factor);
  json.end_array().key("bound").begin_array();
  for (const std::size_t k : s.result.bound) json.value(s.covariance.names.at(k));
  json.end_array();
  if (!times.empty())
    detail::add_predictions(json.key("predicted"), scenario, fit_predictions(report, i, times));
  json.key("far_points").begin_array();
  for (const detail::FarPoint& point : detail::far_points(report, s)) {
    json.begin_object().key("table").value(whole(point.place.table + 1));
    json.key("line").value(static_cast<std::int64_t>(point.place.line)).key("r").value(point.r);
    json.end_object();
  }
  json.end_array().key("notes").begin_array();
  for (const std::string& note : s.notes) json.value(note);
  json.end_array().end_object();
}

}  // namespace

std::string light_json(const Scenario& scenario, const LightReport& report,
                       std::span<const double> times) {
  JsonWriter json;
  json.begin_object();
  json.key("scenario").value(scenario.document.name);
  json.key("observed").value("light-curves").key("points").value(whole(report.points()));
  add_sessions(json, report);
  json.key("units").begin_object().key("time").value(scenario.units().time());
  json.key("angle").value(scenario.units().angle()).end_object();
  if (report.scan) add_scan(json, scenario, *report.scan);
  if (!report.chosen.empty()) add_chosen(json, scenario, report);
  add_periods(json, scenario, report);
  if (!report.joined.empty()) add_joined(json, scenario, report);
  json.key("starts").value(whole(report.starts)).key("finalists").value(whole(report.finalists));
  json.key("converged").value(whole(report.converged));
  json.key("model").value(detail::shape_word(report.shape));
  if (report.shape != LightPlan::Shape::ellipsoid) {
    json.key("surfaces").value(whole(report.surfaces));
    json.key("surfaces_converged").value(whole(report.surfaces_converged));
  }
  if (!report.verdict.empty()) json.key("verdict").value(report.verdict);
  if (!report.failure.empty()) json.key("failure").value(report.failure);
  json.key("notes").begin_array();
  for (const std::string& note : report.notes) json.value(note);
  json.end_array().key("solutions").begin_array();
  for (std::size_t i = 0; i < report.solutions.size(); ++i)
    add_solution(json, scenario, report, i, times);
  json.end_array().end_object();
  return json.text();
}

}  // namespace v0
}  // namespace polhode
