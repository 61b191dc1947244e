// SPDX-License-Identifier: MIT
// The solutions of a fit of light curves for programs.
#include <cmath>
#include <limits>

#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"
#include "text/json.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::JsonWriter;
using detail::LightFigures;
using detail::WithErrors;

constexpr double unlimited = std::numeric_limits<double>::infinity();

// In the units of the file.
class LightJson {
 public:
  LightJson(const Scenario& scenario, const LightReport& report, std::span<const double> times)
      : scenario_(scenario),
        report_(report),
        times_(times),
        time_(scenario.units().from_core(1.0, Dimension::time)) {}

  std::string text() {
    json_.begin_object().members("scenario", scenario_.document.name, "observed", "light-curves",
                                 "points", report_.points());
    std::size_t c = 0;
    json_.key("sessions").array(report_.observed.curves, [&](const light::LightCurve& curve) {
      json_.object("name", curve.name, "points", curve.points.size(), "table",
                   report_.observed.curve_rows.at(c++).at(0).table + 1, "calibrated",
                   curve.is_calibrated);
    });
    json_.key("units").object("time", scenario_.units().time(), "angle", scenario_.units().angle());
    if (report_.scan) add_scan(*report_.scan);
    if (!report_.chosen.empty()) add_chosen();
    json_.key("periods").array(report_.pairs, [&](const PairFound& pair) { add(pair); });
    if (!report_.joined.empty())
      json_.key("joined_sessions").array(report_.joined, [&](const fit::JoinedSession& one) {
        json_.object("session", one.session + 1, "distance", time_ * one.distance, "counts",
                     one.counts, "converged", one.converged, "solutions", one.solutions, "cost",
                     one.cost);
      });
    json_.members("starts", report_.starts, "finalists", report_.finalists, "converged",
                  report_.converged, "model", detail::shape_word(report_.shape));
    if (report_.shape != LightPlan::Shape::ellipsoid)
      json_.members("surfaces", report_.surfaces, "surfaces_converged", report_.surfaces_converged);
    if (!report_.verdict.empty()) json_.members("verdict", report_.verdict);
    if (!report_.failure.empty()) json_.members("failure", report_.failure);
    json_.members("notes", report_.notes).key("solutions").begin_array();
    for (std::size_t i = 0; i < report_.solutions.size(); ++i) add_solution(i);
    json_.end_array().end_object();
    return json_.text();
  }

 private:
  double angle(double x) const { return scenario_.units().from_core(x, Dimension::angle); }

  void add_frequencies(const fit::RefinedPair& r) {
    json_.members("f1", r.fit.f1 / time_, "f2", r.fit.f2 / time_, "sigma_f1", r.sigma_f1 / time_,
                  "sigma_f2", r.sigma_f2 / time_, "scale", r.scale);
  }

  void add_scan(const LightScan& scan) {
    const fit::FrequencyGrid& g = scan.landscape.first;
    json_.key("scan").begin_object();
    json_.members("order", scan.landscape.orders.second, "frequencies", g.count, "least",
                  g.at(0) / time_, "most", g.at(g.count - 1) / time_, "step", g.step / time_,
                  "sessions", scan.separate ? "separate" : "joined");
    if (scan.separate)
      json_.members("separate_sessions", scan.separate->sessions, "windows", scan.separate->windows,
                    "pairs_in_windows", scan.separate->pairs);
    if (scan.constant)
      json_.key("constant")
          .object("chi_square", scan.constant->chi_square, "degrees_of_freedom",
                  scan.constant->degrees_of_freedom, "suffices", scan.constant->suffices);
    if (scan.one) {
      const fit::FourierFit& fit = scan.one->refined.fit;
      std::vector<double> aliases;
      for (const double f : scan.one->aliases) aliases.push_back(time_ / f);
      json_.key("one_period")
          .object("order", scan.one->order, "period", time_ / fit.f2, "chi_square", fit.chi_square,
                  "degrees_of_freedom", fit.degrees_of_freedom - 1, "suffices", scan.one->suffices,
                  "aliases", aliases);
    }
    json_.key("minima").array(scan.minima, [&](const fit::ScanMinimum& m) {
      const fit::RefinedPair& r = m.refined;
      json_.begin_object();
      add_frequencies(r);
      json_.members("period_1", time_ / r.fit.f1, "period_2", time_ / r.fit.f2, "chi_square",
                    r.fit.chi_square, "converged", r.converged, "resolved", m.resolved, "at_edge",
                    m.at_edge);
      json_.end_object();
    });
    json_.end_object();
  }

  void add_chosen() {
    const auto add = [&](const fit::FourierFit& fit) {
      json_.members("period_1", time_ / fit.f1, "period_2", time_ / fit.f2, "chi_square",
                    fit.chi_square, "degrees_of_freedom", fit.degrees_of_freedom, "resolved",
                    fit::is_resolved(fit));
    };
    json_.key("chosen_pairs").array(report_.chosen, [&](const ChosenPair& one) {
      json_.begin_object().members("order", require_fit(scenario_).light.scan.at_order);
      add(one.fit);
      json_.key("minimum").begin_object();
      add(one.refined.fit);
      add_frequencies(one.refined);
      json_.members("converged", one.refined.converged).end_object().end_object();
    });
  }

  void add_periods(const fit::TumblerPeriods& p) {
    json_.members("mode", detail::mode_word(p.mode), "precession_period",
                  time_ * p.precession_period, "rotation_period", time_ * p.rotation_period);
  }

  void add_poles(const Vec3& pole) {
    const detail::SkyPlace at = detail::sky_place(pole);
    const detail::SkyPlace mirror = detail::sky_place(detail::mirror_pole(pole, report_));
    json_.members("longitude", angle(at.longitude), "latitude", angle(at.latitude),
                  "mirror_longitude", angle(mirror.longitude), "mirror_latitude",
                  angle(mirror.latitude));
  }

  void add(const PairFound& pair) {
    json_.begin_object();
    add_periods(pair.from);
    json_.members("chi_square", pair.ellipsoid ? pair.ellipsoid->result.chi_square : unlimited,
                  "cost", pair.ellipsoid ? pair.ellipsoid->result.cost : unlimited);
    if (pair.ellipsoid) {
      const light::Ellipsoid& shape = pair.ellipsoid->body.ellipsoid();
      json_.key("found").begin_object();
      add_periods(pair.ellipsoid->periods);
      add_poles(pair.ellipsoid->pole);
      json_.members("b/a", shape.b / shape.a, "c/b", shape.c / shape.b).end_object();
    }
    if (pair.surface) {
      const fit::LeastSquaresResult& r = pair.surface->result;
      json_.key(detail::shape_word(report_.shape)).begin_object();
      json_.members("chi_square", r.chi_square, "cost", r.cost, "converged", r.is_converged());
      add_periods(pair.surface->periods);
      add_poles(pair.surface->pole);
      json_.members("sentence", r.sentence).end_object();
    }
    json_.end_object();
  }

  void add_convex(const fit::LightModel& body) {
    const fit::ConvexShape& shape = body.convex();
    const ConvexPlan& plan = require_fit(scenario_).light.convex;
    const Mat3& T = body.spin.inertia_F;
    json_.key("convex").begin_object();
    json_.members("degree", shape.image.degree(), "facets", shape.image.normals().size(),
                  "roughness_error", plan.roughness_error);
    if (plan.moments == fit::MomentSource::fit) json_.members("moments_error", plan.moments_error);
    json_.members("Ixx/Izz", T(0, 0) / T(2, 2), "Iyy/Izz", T(1, 1) / T(2, 2), "coefficients",
                  shape.coefficients);
    json_.end_object();
  }

  void add_figures(const fit::LightSolution& s, const LightFigures& f) {
    const auto add = [&](const char* key, const WithErrors& x) {
      json_.key(key).object("value", x.value, "error", x.error, "scaled_error", x.scaled_error,
                            "unit", x.unit);
    };
    if (s.periods.precession_period > 0.0) {
      add("precession_period", f.precession_period);
      add("rotation_period", f.rotation_period);
      add("short_axis_period", f.short_axis_period);
    }
    json_.key("pole").object("axes", scenario_.rotation().axes, "longitude", f.pole.longitude,
                             "latitude", f.pole.latitude, "error_major", f.pole_major.error,
                             "error_minor", f.pole_minor.error, "scaled_error_major",
                             f.pole_major.scaled_error, "scaled_error_minor",
                             f.pole_minor.scaled_error, "unit", f.pole_major.unit);
  }

  void add_solution(std::size_t i) {
    const fit::FoundLight& one = report_.solutions[i];
    const fit::LightSolution& s = one.solution;
    json_.begin_object();
    json_.members("beside", detail::beside_word(one), "of", one.of + 1, "image",
                  detail::image_word(one.image), "sentence",
                  one.sentence.empty() ? s.result.sentence : one.sentence, "chi_square",
                  s.result.chi_square, "cost", s.result.cost);
    json_.key("cost_terms").begin_object();
    for (const fit::CostTerm& term : s.terms) json_.members(term.name, term.value);
    json_.end_object().members("degrees_of_freedom", s.degrees_of_freedom, "describes_data",
                               s.describes_data());
    if (const double scale = light_error_factor(s); std::isfinite(scale))
      json_.members("error_factor", scale);
    json_.members("starts", one.starts, "iterations", s.result.iterations, "mode",
                  detail::mode_word(s.periods.mode));
    add_figures(s, detail::light_figures(scenario_, report_, i));
    json_.members("converged", true, "convergence", s.result.sentence);
    if (s.body.is_convex()) add_convex(s.body);
    json_.key("shape").object("b/a", one.ellipsoid.b / one.ellipsoid.a, "c/b",
                              one.ellipsoid.c / one.ellipsoid.b);
    json_.members("multiple", s.body.law.multiple, "epoch", time_ * s.body.spin.t0, "quaternion",
                  s.body.spin.q);
    detail::add_unknowns(json_, fit_numbers(scenario_, report_, i), s.covariance);
    std::vector<std::string> bound;
    for (const std::size_t k : s.result.bound) bound.push_back(s.covariance.names.at(k));
    json_.members("factors", s.factors, "bound", bound);
    if (!times_.empty())
      detail::add_predictions(json_.key("predicted"), scenario_,
                              fit_predictions(report_, i, times_));
    json_.key("far_points").array(detail::far_points(report_, s), [&](const auto& point) {
      json_.object("table", point.place.table + 1, "line", point.place.line, "r", point.r);
    });
    json_.members("notes", s.notes).end_object();
  }

  const Scenario& scenario_;
  const LightReport& report_;
  std::span<const double> times_;
  double time_;
  JsonWriter json_;
};

}  // namespace

std::string fit_json(const Scenario& scenario, const LightReport& report,
                     std::span<const double> times) {
  return LightJson(scenario, report, times).text();
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
