// SPDX-License-Identifier: MIT
// How well a period or a model of a fit of light curves describes the data, and what in these looks
// wrong.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "run/detail/fit_tables.hpp"
#include "run/detail/light_report.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

namespace {

constexpr double far = 4.0;                      // in spreads
constexpr std::size_t most_far = 10;             // lines that are named
constexpr double of_normal = 1.482602218505602;  // 1 / Phi^-1(3/4)

// A correlation of neighbours is structure from so many of its standard deviations, 1/sqrt(n), on.
constexpr double structured = 3.0;
// The part of chi-square from which on far points explain a misfit.
constexpr double main_part = 0.5;

double median(std::vector<double> x) {
  if (x.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = x.begin() + static_cast<std::ptrdiff_t>(x.size() / 2);
  std::ranges::nth_element(x, middle);
  return *middle;
}

double period_in(const Scenario& scenario, double frequency) {
  return scenario.units().from_core(1.0 / frequency, Dimension::time);
}

// sum r_i r_k / sum r_i^2 over neighbours in time, without points beyond `most`.
double correlation_of_neighbours(const LightReport& report, const fit::LightSolution& s,
                                 double most) {
  double products = 0.0, squares = 0.0;
  std::size_t k = 0;
  for (const light::LightCurve& curve : report.observed.curves) {
    double before = 0.0;
    for (std::size_t i = 0; i < curve.points.size() && k < s.result.numbers.size(); ++i, ++k) {
      const double r = s.result.numbers[k];
      if (std::fabs(r) > most) continue;
      products += before * r;
      squares += r * r;
      before = r;
    }
  }
  return squares > 0.0 ? products / squares : 0.0;
}

// How far a point is from the line through its neighbours, in errors; NaN at the ends of a session
// and beside gaps.
std::vector<double> departures(const light::LightCurve& curve) {
  const std::vector<light::LightPoint>& p = curve.points;
  constexpr double none = std::numeric_limits<double>::quiet_NaN(), gap = 4.0;
  std::vector<double> gaps, found(p.size(), none);
  for (std::size_t i = 1; i < p.size(); ++i) gaps.push_back(p[i].t - p[i - 1].t);
  const double typical = median(gaps);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) {
    const double before = p[i].t - p[i - 1].t, after = p[i + 1].t - p[i].t;
    if (!(std::fmax(before, after) <= gap * typical)) continue;
    const double a = after / (before + after), b = 1.0 - a;
    const double error = std::hypot(p[i].sigma, a * p[i - 1].sigma, b * p[i + 1].sigma);
    found[i] = (p[i].flux - a * p[i - 1].flux - b * p[i + 1].flux) / error;
  }
  return found;
}

std::vector<std::vector<double>> departures_of(std::span<const light::LightCurve> curves) {
  std::vector<std::vector<double>> all;
  for (const light::LightCurve& curve : curves) all.push_back(departures(curve));
  return all;
}

// The standard deviation of departures, by the median of their sizes; NaN of too few.
double neighbour_spread(const std::vector<std::vector<double>>& all) {
  constexpr std::size_t least_points = 20;  // for a spread that means something
  std::vector<double> sizes;
  for (const std::vector<double>& one : all)
    for (const double x : one)
      if (std::isfinite(x)) sizes.push_back(std::fabs(x));
  return sizes.size() < least_points ? std::numeric_limits<double>::quiet_NaN()
                                     : of_normal * median(std::move(sizes));
}

// The lowest chi-square per degree of freedom of all models that were fitted; 0 without one.
double least_misfit(const LightReport& report) {
  std::vector<double> all;
  const auto add = [&](const fit::FourierFit& fit) {
    all.push_back(fit.chi_square / std::fmax(1.0, static_cast<double>(fit.degrees_of_freedom)));
  };
  for (const fit::FoundLight& one : report.solutions)
    all.push_back(std::pow(one.solution.error_factor(), 2));
  if (report.scan && report.scan->one) add(report.scan->one->refined.fit);
  if (report.scan)
    for (const fit::ScanMinimum& one : report.scan->minima) add(one.refined.fit);
  return all.empty() ? 0.0 : std::ranges::min(all);
}

bool begins_like_magnitude(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.starts_with("mag") || name == "m" || name == "v" || name.ends_with("mag");
}

// A note if the numbers of a table look like magnitudes: all of them between those of bright and
// of the faintest asteroids, and near each other.
std::string magnitude_note(const Observation& table, double least, double most) {
  const LightObservation& of = *table.light;
  constexpr double brightest = 5.0, faintest = 30.0, range = 4.0;
  const bool is_flux = of.brightness == LightObservation::Brightness::flux;
  const std::string column = of.columns.size() > 1 ? of.columns[1] : std::string();
  if (is_flux && begins_like_magnitude(column))
    return "the column " + column + " of " + table.shown() +
           " was read as fluxes; brightness = \"magnitude\" reads magnitudes";
  if (is_flux && least > brightest && most < faintest && most - least < range)
    return fmt::format(
        "fluxes of {} are from {:.4g} to {:.4g}, as magnitudes are; brightness = \"magnitude\" "
        "reads "
        "magnitudes",
        table.shown(), least, most);
  if (!is_flux && column.starts_with("flux"))
    return "the column " + column + " of " + table.shown() +
           " was read as magnitudes; brightness = \"flux\" reads fluxes";
  return {};
}

void add_magnitude_notes(const Scenario& scenario, const ReadObservations& observed,
                         std::vector<std::string>& notes) {
  const std::vector<Observation>& tables = require_fit(scenario).observations;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    if (tables[t].light->format != LightObservation::Format::columns) continue;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t c = 0; c < observed.curves.size(); ++c) {
      if (observed.curve_rows[c].front().table != t) continue;
      for (const light::LightPoint& p : observed.curves[c].points) {
        least = std::fmin(least, p.flux);
        most = std::fmax(most, p.flux);
      }
    }
    std::string note = magnitude_note(tables[t], least, most);
    if (!note.empty()) notes.push_back(std::move(note));
  }
}

}  // namespace

std::size_t count_points(std::span<const light::LightCurve> curves) {
  std::size_t count = 0;
  for (const light::LightCurve& curve : curves) count += curve.points.size();
  return count;
}

std::vector<FarPoint> far_points(const LightReport& report, const fit::LightSolution& s) {
  const double least = far * s.spread();
  std::vector<FarPoint> found;
  std::size_t k = 0;
  for (const std::vector<ObservedRow>& rows : report.observed.curve_rows)
    for (const ObservedRow& row : rows) {
      const double r = k < s.result.numbers.size() ? s.result.numbers[k] : 0.0;
      ++k;
      if (std::fabs(r) > least) found.push_back({row, r});
    }
  return found;
}

std::string lines_of(const Scenario& scenario, const std::vector<ObservedRow>& places) {
  std::string text;
  for (std::size_t i = 0; i < std::min(places.size(), most_far); ++i)
    text += (i == 0 ? "" : ", ") +
            (require_fit(scenario).observations.size() > 1
                 ? fmt::format("{} of table {}", places[i].line, places[i].table + 1)
                 : fmt::format("{}", places[i].line));
  return text + (places.size() > most_far ? ", ..." : "");
}

void add_loss(std::string& text, const Scenario& scenario, const LightReport& report,
              const fit::LightSolution& s) {
  const bool is_squared = s.loss.kind == fit::Loss::Kind::squared;
  if (!is_squared)
    add_fit_line(text, "loss",
                 fmt::format("{:.5g}, which was minimised: {} from {:g} standard errors on",
                             s.result.cost, loss_word(s.loss), s.loss.scale));
  const std::vector<FarPoint> points = far_points(report, s);
  if (is_squared && points.empty()) return;
  std::string words =
      fmt::format("{} beyond {:g} times {:.3g} standard errors, the spread of all",
                  polhode::detail::counted(points.size(), "point", "points"), far, s.spread());
  if (!points.empty()) {
    double part = 0.0;
    std::vector<ObservedRow> places;
    for (const FarPoint& one : points) {
      part += one.r * one.r;
      places.push_back(one.place);
    }
    words += fmt::format("; {:.4g} of chi-square; lines {}", part, lines_of(scenario, places));
  }
  add_fit_line(text, "far points", words);
}

std::string scan_verdict(const Scenario& scenario, const LightScan& scan,
                         std::span<const light::LightCurve> curves) {
  constexpr double scatter_part = 0.5;  // of a misfit, from which on the errors are blamed for it
  if (scan.constant && scan.constant->suffices)
    return fmt::format(
        "no variation is seen in these data: a constant brightness has chi-square {:.5g} on {} "
        "degrees of freedom, and no period lowers it by more than noise does",
        scan.constant->chi_square, scan.constant->degrees_of_freedom);
  if (!scan.one || !scan.one->suffices) return {};
  const fit::FourierFit& fit = scan.one->refined.fit;
  const std::string& time = scenario.units().time();
  const std::size_t freedom = fit.degrees_of_freedom - 1;
  const double reduced = fit.chi_square / static_cast<double>(freedom);
  const auto strongest = std::ranges::max_element(fit.terms, {}, [](const fit::FourierTerm& term) {
    return std::hypot(term.cosine, term.sine);
  });
  const double period = period_in(scenario, fit.f2);
  std::string text;
  if (reduced > fit::most_chi_square) {
    const double factor = std::sqrt(reduced);
    const double spread = neighbour_spread(departures_of(curves));  // NaN of few points
    const std::string small =
        fmt::format("errors of the data may be too small, by a factor of {:.2g}", factor);
    const std::string unexplained = "the light changes in a way that no period explains";
    const std::string cause = std::isnan(spread)               ? small + ", or " + unexplained
                              : spread > scatter_part * factor ? small
                                                               : unexplained;
    text = fmt::format(
        "no model of this kind describes these data: chi-square of one period per degree of "
        "freedom is {:.4g}, above {:g}, and two periods are no better; {}; the period is {:.7g} {}",
        reduced, fit::most_chi_square, cause, period, time);
  } else {
    text = fmt::format(
        "one period describes these data: {:.7g} {}, chi-square {:.5g} on {} degrees of freedom",
        period, time, fit.chi_square, freedom);
  }
  if (strongest != fit.terms.end() && strongest->k == 1)
    text += fmt::format("; if the light has two maxima in a rotation, that takes {:.7g} {}",
                        2.0 * period, time);
  std::string aliases;
  for (const double f : scan.one->aliases)
    aliases += fmt::format("{}{:.7g}", aliases.empty() ? "" : ", ", period_in(scenario, f));
  if (!aliases.empty())
    text += fmt::format("; {} {} fit as well: the times of the observations leave these aliases",
                        aliases, time);
  return text;
}

std::string misfit_text(const Scenario& scenario, const LightReport& report) {
  const fit::LightSolution* best = nullptr;
  for (const fit::FoundLight& one : report.solutions) {
    if (one.solution.describes_data()) return {};
    if (best == nullptr || one.solution.error_factor() < best->error_factor()) best = &one.solution;
  }
  if (best == nullptr) return {};
  const double factor = best->error_factor();
  std::string text = fmt::format(
      "{} these data: {} per degree of freedom is {:.4g}{}, above {:g}; errors would mean "
      "nothing and are left out",
      report.start ? "the solution from this start does not describe"
                   : "no model of this kind describes",
      best->loss.kind == fit::Loss::Kind::squared ? "chi-square" : "the square of the spread",
      factor * factor, report.solutions.size() > 1 ? " or more" : "", fit::most_chi_square);
  double part = 0.0;
  std::vector<ObservedRow> places;
  for (const FarPoint& one : far_points(report, *best)) {
    part += one.r * one.r;
    places.push_back(one.place);
  }
  if (part > main_part * best->result.chi_square)
    return text + fmt::format(
                      "; {} far from the model, lines {}: {:.0f} % of chi-square; see "
                      "leave_out and fit.loss",
                      polhode::detail::counted(places.size(), "point is", "points are"),
                      lines_of(scenario, places), 100.0 * part / best->result.chi_square);
  const double together = correlation_of_neighbours(report, *best, far * best->spread());
  if (std::fabs(together) > structured / std::sqrt(static_cast<double>(best->points)))
    return text + fmt::format(
                      "; residuals of neighbours have the correlation {:.2f}: the light "
                      "changes in a way that the model does not",
                      together);
  return text + fmt::format(
                    "; residuals of neighbours are independent: errors of the data may be "
                    "too small, by a factor of {:.2g}",
                    factor);
}

std::vector<std::string> data_notes(const Scenario& scenario, const LightReport& report) {
  constexpr double isolated = 8.0, most_spread = 3.0;
  const ReadObservations& observed = report.observed;
  std::vector<std::string> notes;
  add_magnitude_notes(scenario, observed, notes);
  const std::size_t points = count_points(observed.curves);
  if (points > many_points && require_fit(scenario).light.searches)
    notes.push_back(
        fmt::format("{} points: means of neighbouring points, a hundredth of a period apart, would "
                    "give the same solutions in less time",
                    points));
  const std::vector<std::vector<double>> all = departures_of(observed.curves);
  const double spread = neighbour_spread(all);
  if (std::isnan(spread)) return notes;
  if (spread < 1.0 / most_spread)
    notes.push_back(
        fmt::format("points are {:.2g} of their errors from their neighbours: errors of "
                    "the data are too large, and only scaled ones are of use",
                    spread));
  if (spread > most_spread && least_misfit(report) > most_spread * most_spread)
    notes.push_back(
        fmt::format("points are {:.2g} of their errors from their neighbours, and no model "
                    "describes them: errors of the data are too small, or the light changes from "
                    "point to point",
                    spread));
  std::vector<ObservedRow> places;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::vector<double>& x = all[c];
    for (std::size_t k = 1; k + 1 < x.size(); ++k) {
      const double size = std::fabs(x[k]);
      // beside a point that is far out, the line through it is
      const bool is_peak = !(std::fabs(x[k - 1]) > size) && !(std::fabs(x[k + 1]) > size);
      if (is_peak && size > isolated * std::fmax(1.0, spread))
        places.push_back(observed.curve_rows[c][k]);
    }
  }
  if (!places.empty())
    notes.push_back(
        fmt::format("{} more than {:g} times the scatter from the neighbours, lines {}: leave_out "
                    "leaves lines out, fit.loss makes them count less",
                    polhode::detail::counted(places.size(), "point is", "points are"), isolated,
                    lines_of(scenario, places)));
  return notes;
}

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
