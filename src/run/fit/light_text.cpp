// SPDX-License-Identifier: MIT
// The solutions of a fit of light curves for people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "polhode/run/light_report.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

using detail::add_fit_line;
using detail::LightFigures;
using detail::WithErrors;
using polhode::detail::counted;

constexpr std::size_t most_pairs = 12, most_shown = 8;

bool is_mesh(const LightReport& report) { return report.shape == LightPlan::Shape::mesh; }

// With as many digits as the error has two of.
std::string number_text(double value, double error) {
  if (!std::isfinite(value)) return "-";
  if (!std::isfinite(error) || !(error > 0.0)) return fmt::format("{:.6g}", value);
  const int digits = 1 - static_cast<int>(std::floor(std::log10(error)));
  return fmt::format("{:.{}f}", value, std::clamp(digits, 0, 12));
}

std::string error_text(double error) {
  return std::isfinite(error) ? fmt::format("{:.2g}", error) : std::string("unknown");
}

std::string with_errors(const WithErrors& x) {
  if (std::isnan(x.error)) return fmt::format("{:.6g} {}", x.value, x.unit);
  return fmt::format("{} {}, error {}, scaled {}", number_text(x.value, x.error), x.unit,
                     error_text(x.error), error_text(x.scaled_error));
}

// "-" where a motion has none: it is steady, or on the separatrix.
std::string period_text(const WithErrors& period) {
  return period.value > 0.0 ? number_text(period.value, period.error) : std::string("-");
}

double period_of(const Scenario& scenario, double frequency) {
  return scenario.units().from_core(1.0 / frequency, Dimension::time);
}

void add_observed(std::string& text, const LightReport& report) {
  std::size_t calibrated = 0;
  for (const light::LightCurve& curve : report.observed.curves)
    calibrated += curve.is_calibrated ? 1 : 0;
  const std::size_t sessions = report.observed.curves.size();
  add_fit_line(text, "observed",
               counted(report.points(), "point", "points") + " of " +
                   counted(sessions, "light curve", "light curves") +
                   (calibrated == 0          ? ", relative"
                    : calibrated == sessions ? ", calibrated"
                                             : fmt::format(", {} calibrated", calibrated)));
}

std::string minimum_notes(const fit::ScanMinimum& m) {
  std::string text;
  if (!m.resolved) text += "  not resolved";
  if (!m.refined.converged) text += "  not converged";
  if (m.at_edge) text += "  at the edge";
  return text;
}

void add_scan(std::string& text, const Scenario& scenario, const LightScan& scan) {
  const fit::Landscape& all = scan.landscape;
  const std::string& time = scenario.units().time();
  const fit::FrequencyGrid& g = all.first;
  add_fit_line(
      text, "scan",
      fmt::format("order {}, {}{} by {} frequencies, periods of {:.4g} to {:.4g} {}",
                  all.orders.second,
                  scan.separate ? counted(scan.separate->sessions, "session", "sessions") + " of "
                                : std::string(),
                  g.count, g.count, period_of(scenario, g.at(g.count - 1)),
                  period_of(scenario, g.at(0)), time));
  if (scan.separate)
    add_fit_line(
        text, "all sessions",
        fmt::format("{} pairs of frequencies in {} about the lowest minima of their sum",
                    scan.separate->pairs, counted(scan.separate->windows, "window", "windows")));
  if (scan.one && !scan.constant->suffices) {
    const fit::FourierFit& fit = scan.one->refined.fit;
    add_fit_line(text, "one frequency",
                 fmt::format("order {}, {:.7g} {}, chi-square {:.5g} on {} degrees of freedom",
                             scan.one->order, period_of(scenario, fit.f2), time, fit.chi_square,
                             fit.degrees_of_freedom - 1));
  }
  if (scan.constant && scan.constant->suffices) return;
  text += fmt::format(
      "\nlowest minima of the scan: lines at sums and multiples of 1/P1 and 1/P2{}\n"
      "{:>4}{:>12}{:>16}{:>11}{:>16}{:>11}\n",
      scan.minima.empty() ? std::string()
                          : fmt::format("; {} degrees of freedom",
                                        scan.minima.front().refined.fit.degrees_of_freedom),
      "", "chi-square", "P1 " + time, "error", "P2 " + time, "error");
  for (std::size_t i = 0; i < scan.minima.size(); ++i) {
    const fit::ScanMinimum& m = scan.minima[i];
    const fit::RefinedPair& r = m.refined;
    const bool is_described = r.scale * r.scale <= fit::most_chi_square;
    const auto error = [&](double f, double sigma) {
      if (!is_described) return std::numeric_limits<double>::infinity();
      return scenario.units().from_core(r.scale * sigma / (f * f), Dimension::time);
    };
    const double e1 = error(r.fit.f1, r.sigma_f1), e2 = error(r.fit.f2, r.sigma_f2);
    text += fmt::format("{:>4}{:>12.5g}{:>16}{:>11}{:>16}{:>11}{}\n", i + 1, r.fit.chi_square,
                        number_text(period_of(scenario, r.fit.f1), e1), error_text(e1),
                        number_text(period_of(scenario, r.fit.f2), e2), error_text(e2),
                        minimum_notes(m));
  }
}

void add_chosen(std::string& text, const Scenario& scenario, const LightReport& report) {
  const std::string& time = scenario.units().time();
  const auto chi_square = [](const fit::FourierFit& fit) {
    return fmt::format("{:.5g} ({})", fit.chi_square, fit.degrees_of_freedom);
  };
  text += fmt::format(
      "\npairs of fit.scan.at, order {}, and the minimum next to each; in brackets degrees of "
      "freedom\n{:>16}{:>14}{:>14}{:>20}{:>16}{:>16}\n",
      require_fit(scenario).light.scan.at_order, "chi-square", "P1 " + time, "P2 " + time,
      "chi-square", "P1 " + time, "P2 " + time);
  for (const ChosenPair& one : report.chosen) {
    const fit::RefinedPair& r = one.refined;
    const auto minimum = [&](double f, double sigma) {
      const double error = scenario.units().from_core(r.scale * sigma / (f * f), Dimension::time);
      return number_text(period_of(scenario, f), error);
    };
    text += fmt::format(
        "{:>16}{:>14.7g}{:>14.7g}{:>20}{:>16}{:>16}{}{}\n", chi_square(one.fit),
        period_of(scenario, one.fit.f1), period_of(scenario, one.fit.f2), chi_square(r.fit),
        minimum(r.fit.f1, r.sigma_f1), minimum(r.fit.f2, r.sigma_f2),
        fit::is_resolved(r.fit) ? "" : "  not resolved", r.converged ? "" : "  not converged");
  }
}

// A row for each ellipsoid that pairs of periods came to, with the periods that it has.
void add_pair_rows(std::string& text, const Scenario& scenario, const LightReport& report) {
  const std::string& time = scenario.units().time();
  const fit::Loss& loss = require_fit(scenario).loss;
  const char* what = report.shape == LightPlan::Shape::convex ? "the cost that"
                     : loss.kind == fit::Loss::Kind::squared  ? "what"
                                                              : "the loss that";
  const bool has_surface = report.shape != LightPlan::Shape::ellipsoid;
  text += has_surface ? fmt::format("\npairs of periods by {} a {} comes to\n{:>12}{:>12}", what,
                                    is_mesh(report) ? "mesh" : "convex body", "ellipsoid",
                                    detail::shape_word(report.shape))
                      : fmt::format("\npairs of periods by {} an ellipsoid comes to\n{:>12}", what,
                                    detail::rank_word(report, loss));
  text += fmt::format("{:>6}{:>13}{:>13}{:>9}{:>8}{:>9}{:>8}{:>10}\n", "mode", "P_phi " + time,
                      "P_psi " + time, "pole", "", "mirror", "", "readings");
  const std::vector<detail::PairGroup> groups = detail::groups_of_pairs(report);
  for (std::size_t i = 0; i < std::min(groups.size(), most_pairs); ++i) {
    const PairFound& pair = report.pairs[groups[i].best];
    const fit::LightSolution& s = *pair.ellipsoid;
    const fit::TumblerPeriods& p = pair.surface ? pair.surface->periods : s.periods;
    const auto period = [&](double t) {
      return t > 0.0 ? fmt::format("{:.6g}", scenario.units().from_core(t, Dimension::time)) : "-";
    };
    text += fmt::format("{:>12.5g}", s.result.cost);
    if (has_surface)
      text += pair.surface ? fmt::format("{:>12.5g}", pair.surface->result.cost)
                           : fmt::format("{:>12}", "-");
    text += fmt::format("{:>6}{:>13}{:>13}", detail::mode_word(p.mode), period(p.precession_period),
                        period(p.rotation_period));
    const Vec3 pole = pair.surface ? pair.surface->pole : s.pole;
    for (const Vec3& one : {pole, detail::mirror_pole(pole, report)}) {
      const detail::SkyPlace at = detail::sky_place(one);
      text += fmt::format("{:>9.1f}{:>8.1f}",
                          scenario.units().from_core(at.longitude, Dimension::angle),
                          scenario.units().from_core(at.latitude, Dimension::angle));
    }
    text += fmt::format("{:>10}{}\n", groups[i].pairs.size(),
                        pair.surface && !pair.surface->is_found() ? "  not converged" : "");
  }
  if (groups.size() > most_pairs)
    text += fmt::format(" and {} more; --json has all {} readings\n", groups.size() - most_pairs,
                        report.pairs.size());
}

void add_pairs(std::string& text, const Scenario& scenario, const LightReport& report) {
  add_fit_line(text, "search",
               fmt::format("{} of {}; {} fitted to the end, {} converged",
                           counted(report.starts, "start", "starts"),
                           counted(report.pairs.size(), "pair of periods", "pairs of periods"),
                           report.finalists, report.converged));
  if (report.shape != LightPlan::Shape::ellipsoid)
    add_fit_line(
        text, is_mesh(report) ? "fits of the mesh" : "convex bodies",
        fmt::format("{} {}, {} converged", report.surfaces,
                    is_mesh(report) ? "fitted, by periods and from them" : "fitted from them",
                    report.surfaces_converged));
  add_pair_rows(text, scenario, report);
}

// One row for each, in the order in which they joined.
void add_joined(std::string& text, const Scenario& scenario, const LightReport& report) {
  text += fmt::format(
      "\nsessions one by one: a fit for each count of turns; solutions and the lowest of all so "
      "far\n{:>8}{:>8}{:>14}"
      "{:>8}{:>11}{:>11}{:>12}\n",
      "session", "points", "distance " + scenario.units().time(), "fits", "converged", "solutions",
      detail::rank_word(report, require_fit(scenario).loss));
  for (const fit::JoinedSession& one : report.joined)
    text += fmt::format("{:>8}{:>8}{:>14.6g}{:>8}{:>11}{:>11}{:>12}\n", one.session + 1,
                        report.observed.curves.at(one.session).points.size(),
                        scenario.units().from_core(one.distance, Dimension::time), one.counts,
                        one.converged, one.solutions,
                        one.solutions > 0 ? fmt::format("{:.5g}", one.cost) : "-");
}

std::string pole_words(const Scenario& scenario) {
  const std::string& axes = scenario.rotation().axes;
  if (axes == "ecliptic-J2000") return "ecliptic longitude, latitude";
  return axes == "equator-J2000" ? "right ascension, declination" : "longitude, latitude";
}

void add_overview(std::string& text, const Scenario& scenario, const LightReport& report) {
  const std::string& time = scenario.units().time();
  const FitPlan& plan = require_fit(scenario);
  const bool is_convex = report.shape == LightPlan::Shape::convex;
  const auto cells = [&](const auto& place, const std::string& cost, const std::string& data) {
    return fmt::format("{:>4}{:>12}", place, cost) +
           (is_convex ? fmt::format("{:>12}", data) : std::string());
  };
  text +=
      fmt::format("\nsolutions; pole: {} in {}\n", pole_words(scenario), scenario.units().angle()) +
      cells("", detail::rank_word(report, plan.loss), "chi-square") +
      fmt::format("{:>6}{:>13}{:>13}{:>13}{:>9}{:>8}{:>8}{:>8}  {}\n", "mode", "P_phi " + time,
                  "P_psi " + time, "P_short " + time, "pole", "", "b/a", "c/b", "what it is");
  const std::size_t shown = std::min(report.solutions.size(), plan.most_solutions);
  for (std::size_t i = 0; i < shown; ++i) {
    const fit::FoundLight& one = report.solutions[i];
    const light::Ellipsoid& shape = one.ellipsoid;
    const LightFigures f = detail::light_figures(scenario, report, i);
    std::string what = detail::beside_word(one);
    if (one.beside == fit::FoundLight::Beside::image)
      what += std::string(" (") + detail::image_word(one.image) + ")";
    if (one.beside != fit::FoundLight::Beside::first) what += fmt::format(" of {}", one.of + 1);
    if (!one.solution.result.bound.empty()) what += ", on a bound";
    text +=
        cells(i + 1, fmt::format("{:.5g}", one.solution.result.cost),
              fmt::format("{:.5g}", one.solution.result.chi_square)) +
        fmt::format("{:>6}{:>13}{:>13}{:>13}{:>9.1f}{:>8.1f}{:>8.3f}{:>8.3f}  {}\n",
                    detail::mode_word(one.solution.periods.mode), period_text(f.precession_period),
                    period_text(f.rotation_period), period_text(f.short_axis_period),
                    f.pole.longitude, f.pole.latitude, shape.b / shape.a, shape.c / shape.b, what);
  }
  if (shown < report.solutions.size())
    text += fmt::format(" and {} more; --json has all\n", report.solutions.size() - shown);
}

void add_numbers(std::string& text, const std::vector<FitNumber>& numbers) {
  const bool has_start = !numbers.empty() && numbers.front().start;
  text += fmt::format("{:<9}{:<9}", "unknown", "unit");
  if (has_start) text += fmt::format("{:>13}", "start");
  const bool has_errors = numbers.empty() || !std::isnan(numbers.front().error);
  text += fmt::format("{:>13}", "value") +
          (has_errors ? fmt::format("{:>11}{:>11}\n", "error", "scaled") : std::string("\n"));
  for (const FitNumber& one : numbers) {
    text += fmt::format("{:<9}{:<9}", one.name, one.unit);
    if (has_start) text += fmt::format("{:>13.6g}", *one.start);
    text += fmt::format("{:>13.6g}", one.value);
    if (has_errors)
      text += fmt::format("{:>11.3g}{:>11}", one.error,
                          one.scaled_error ? fmt::format("{:.3g}", *one.scaled_error) : "-");
    text += "\n";
  }
}

// Combinations with coefficients of facets are many, and say nothing of the spin: JSON has them.
void add_notes(std::string& text, const std::vector<std::string>& notes) {
  std::size_t of_facets = 0;
  for (const std::string& note : notes) {
    if (note.find(" c_") == std::string::npos)
      text += "note: " + note + "\n";
    else if (note.starts_with("the data"))
      ++of_facets;
    else
      text +=
          "note: residuals are not linear within the errors, along coefficients of facets among "
          "others; --json has the sentence\n";
  }
  if (of_facets > 0)
    text += "note: the regularisation tells " + counted(of_facets, "combination", "combinations") +
            " of coefficients of facets apart that the data hardly determine\n";
}

// What is seen, for meshes what "converged" means, and for convex bodies what keeps them smooth.
void add_surface(std::string& text, const Scenario& scenario, const LightReport& report,
                 std::size_t i) {
  const fit::LightSolution& s = report.solutions[i].solution;
  if (s.body.is_mesh()) {
    const light::ShadedMesh& mesh = s.body.mesh();
    add_fit_line(text, "mesh",
                 counted(mesh.shape().facets().size(), "facet", "facets") +
                     (mesh.is_shadowless() ? "" : ", with shadows"));
    add_fit_line(text, "convergence",
                 s.result.sentence + ": within one standard error of the least");
  }
  if (!s.body.is_convex()) return;
  const light::GaussianImage& image = s.body.convex().image;
  const light::Ellipsoid& like = report.solutions[i].ellipsoid;
  const ConvexPlan& plan = require_fit(scenario).light.convex;
  add_fit_line(text, "convex body",
               fmt::format("{} facets, degree {}; moments as an ellipsoid 1 : {:.3f} : {:.3f}",
                           image.normals().size(), image.degree(), like.b, like.c));
  add_fit_line(text, "regularisation",
               fmt::format("roughness error {:g}", plan.roughness_error) +
                   (plan.moments == fit::MomentSource::fit
                        ? fmt::format(", moments error {:g}", plan.moments_error)
                        : std::string()));
}

void add_solution(std::string& text, const Scenario& scenario, const LightReport& report,
                  std::size_t i) {
  const fit::FoundLight& one = report.solutions[i];
  const fit::LightSolution& s = one.solution;
  const LightFigures f = detail::light_figures(scenario, report, i);
  text += "\n";
  add_fit_line(text, fmt::format("solution {} of {}", i + 1, report.solutions.size()),
               one.sentence.empty() ? s.result.sentence : one.sentence);
  add_fit_line(text, "chi-square",
               fmt::format("{:.5g} on {:.4g} degrees of freedom", s.result.chi_square,
                           s.degrees_of_freedom));
  if (s.terms.size() > 1) {
    std::string terms;
    for (const fit::CostTerm& term : s.terms)
      terms += fmt::format("{}{} {:.5g}", terms.empty() ? "" : ", ", term.name, term.value);
    add_fit_line(text, "cost", fmt::format("{:.5g}: {}", s.result.cost, terms));
  }
  detail::add_loss(text, scenario, report, s);
  if (const double scale = light_error_factor(s); std::isfinite(scale) && report.has_errors())
    add_fit_line(text, "errors scaled by", fmt::format("{:.4g}", scale));
  add_fit_line(text, "mode", detail::mode_word(s.periods.mode));
  if (s.periods.precession_period > 0.0) {
    add_fit_line(text, "P_phi (long axis)", with_errors(f.precession_period));
    add_fit_line(text, "P_psi", with_errors(f.rotation_period));
    add_fit_line(text, "P (short axis)", with_errors(f.short_axis_period));
  }
  std::string pole = fmt::format("{:.4g}, {:.4g} {} ({})", f.pole.longitude, f.pole.latitude,
                                 f.pole_major.unit, pole_words(scenario));
  if (!std::isnan(f.pole_major.error))
    pole += fmt::format(", error {} by {}, scaled {} by {}", error_text(f.pole_major.error),
                        error_text(f.pole_minor.error), error_text(f.pole_major.scaled_error),
                        error_text(f.pole_minor.scaled_error));
  add_fit_line(text, "pole", pole);
  add_surface(text, scenario, report, i);
  std::vector<FitNumber> numbers = fit_numbers(scenario, report, i);
  if (s.body.is_convex())  // coefficients of facets: JSON has them
    numbers.resize(numbers.size() - (s.body.convex().coefficients.size() - 1));
  add_numbers(text, numbers);
  if (!report.start && !s.result.bound.empty()) text += "note: " + s.result.sentence + "\n";
  add_notes(text, s.notes);
}

}  // namespace

std::string fit_text(const Scenario& scenario, const LightReport& report,
                     std::span<const double> times) {
  std::string text;
  if (!scenario.document.title.empty()) text += scenario.document.title + "\n";
  if (!report.verdict.empty()) text += report.verdict + "\n";
  add_observed(text, report);
  if (report.scan) add_scan(text, scenario, *report.scan);
  if (!report.chosen.empty()) add_chosen(text, scenario, report);
  if (!report.pairs.empty()) {
    if (report.scan || !report.chosen.empty()) text += "\n";
    add_pairs(text, scenario, report);
  }
  if (!report.joined.empty()) add_joined(text, scenario, report);
  if (!report.start && report.is_found()) add_overview(text, scenario, report);
  const std::size_t shown =
      std::min({report.solutions.size(), most_shown, require_fit(scenario).most_solutions});
  for (std::size_t i = 0; i < shown; ++i) {
    add_solution(text, scenario, report, i);
    if (!times.empty()) text += prediction_text(scenario, fit_predictions(report, i, times));
  }
  detail::add_end(text, report, shown, report.notes);
  return text;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
