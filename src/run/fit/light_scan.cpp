// SPDX-License-Identifier: MIT
// The scan of light curves for periods: on one grid over all of their time, or session by session.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "fit/session_scan.hpp"
#include "polhode/error.hpp"
#include "run/detail/fit_tables.hpp"
#include "run/detail/light_fit.hpp"
#include "run/detail/light_report.hpp"
#include "text/number_text.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace {

constexpr double most_frequencies = 1e7;  // of one period
constexpr double deviations = 3.0;        // of chi-square, up to which data are within their errors

class Scan {
 public:
  Scan(const Scenario& scenario, std::span<const light::LightCurve> curves,
       const FitOptions& options)
      : scenario_(scenario),
        plan_(require_fit(scenario).light.scan),
        curves_(curves),
        options_(options),
        advice_(fit::scan_advice(curves, plan_.order)),
        least_(plan_.longest ? 1.0 / *plan_.longest : longest_usual()),
        most_(plan_.shortest ? 1.0 / *plan_.shortest : advice_.most) {
    if (!(least_ < most_))
      plan_.places.longest.refuse(
          "expected periods of which the shortest is below the longest; the data give " +
          text_of(1.0 / advice_.most) + " to " + text_of(1.0 / longest_usual()));
  }

  LightScan made() {
    const bool is_joined = plan_.sessions == ScanPlan::Sessions::joined;
    require_points(is_joined);
    LightScan scan = is_joined ? joined() : separate();
    add_simple_models(scan);
    return scan;
  }

 private:
  // One turn in all of the time; of sessions by themselves in the longest of them.
  double longest_usual() const {
    if (plan_.sessions == ScanPlan::Sessions::joined) return advice_.least;
    double longest = 0.0;
    for (const fit::SessionTimes& one : advice_.sessions)
      longest = std::max(longest, one.last - one.first);
    return longest > 0.0 ? 1.0 / longest : advice_.least;
  }

  // More than a series has coefficients: in all sessions, each with a constant, or in one of them.
  void require_points(bool is_joined) const {
    std::size_t points = 0, constants = 0, calibrated = 0;
    for (const light::LightCurve& one : curves_) {
      points = is_joined ? points + one.points.size() : std::max(points, one.points.size());
      (one.is_calibrated ? calibrated : constants) += 1;
    }
    constants = is_joined ? constants + std::min(calibrated, std::size_t{1}) : 1;
    const std::size_t all = 2 * fit::FourierOrders::pair(plan_.order).harmonics() + constants;
    if (points <= all)
      plan_.places.order.refuse(
          fmt::format("expected a lower one: {} points{} do not determine {} "
                      "coefficients",
                      points, is_joined ? "" : " of the longest session", all));
  }

  LightScan joined() {
    const double count = std::floor((most_ - least_) / advice_.step) + 1.0, pairs = count * count;
    if (pairs > most_scan_pairs)
      plan_.places.shortest.refuse("expected at most 1e8 pairs of frequencies; periods of " +
                                   text_of(1.0 / most_) + " to " + text_of(1.0 / least_) +
                                   " in data that cover " + text_of(advice_.time_base) + " are " +
                                   number(pairs) + ": " + way_out());
    const fit::FrequencyGrid grid = fit::FrequencyGrid::between(least_, most_, advice_.step);
    begin(fmt::format("{} pairs of frequencies", grid.count * grid.count) +
          (curves_.size() > 1 ? fmt::format(" over {} sessions", curves_.size()) : std::string()));
    const fit::ScanPoints points(curves_);
    LightScan scan{
        std::move(advice_), fit::scan_pairs(points, grid, how()), {}, std::nullopt, std::nullopt,
        std::nullopt};
    scan.minima = fit::scan_minima(points, scan.landscape, minima(plan_.minima));
    return scan;
  }

  LightScan separate() {
    const fit::SessionScanSize size = fit::session_scan_size(curves_, least_, most_, plan_.order);
    const double pairs = size.pairs(plan_.windows);
    if (pairs > most_scan_pairs)
      plan_.places.windows.refuse(
          "expected at most 1e8 pairs of frequencies; " + words_of(size) + " are " + number(pairs) +
          ": lower fit.scan.windows, bring fit.scan.shortest and fit.scan.longest nearer "
          "to each other, or fit fewer sessions");
    begin(words_of(size));
    fit::SessionScan found = fit::scan_sessions(
        curves_, least_, most_, {.scan = how(), .windows = plan_.windows, .most = plan_.minima});
    if (found.minima.size() > plan_.minima) found.minima.resize(plan_.minima);
    return {std::move(advice_),
            std::move(found.coarse),
            std::move(found.minima),
            SeparateSessions{found.sessions, plan_.windows, found.pairs},
            std::nullopt,
            std::nullopt};
  }

  // A model of the light: chi-square, its degrees of freedom with frequencies counted as unknowns,
  // and the number of frequencies or pairs that it was chosen from.
  struct Model {
    double chi_square, freedom, choices;

    bool is_within_errors() const {
      return chi_square <= freedom + deviations * std::sqrt(2.0 * freedom);
    }
    bool is_described() const { return chi_square <= fit::most_chi_square * freedom; }
  };
  static Model model_of(const fit::FourierFit& fit, double frequencies, double choices) {
    return {fit.chi_square, static_cast<double>(fit.degrees_of_freedom) - frequencies, choices};
  }

  // The series with the fewest harmonics that describes the data, or else the one with the most,
  // and whether a constant describes them. Series with more harmonics also fit at multiples of the
  // period, and at aliases of evenly spaced observations.
  void add_simple_models(LightScan& scan) const {
    constexpr std::size_t most_order = 9;
    const double count = std::floor((most_ - least_) / scan.advice.step) + 1.0;
    if (count > most_frequencies) return;
    const fit::ScanPoints points(curves_);
    std::optional<Model> two;
    if (const auto pair = std::ranges::find_if(scan.minima, is_sound); pair != scan.minima.end())
      two = model_of(pair->refined.fit, 2.0, 0.5 * count * count);
    // lines of two frequencies to an order, if they are multiples of one, are those to twice it
    const std::size_t most = std::min(2 * plan_.order, most_order);
    scan.one = one_period(scan, points, most);
    const std::optional<Model> most_terms =
        scan.one ? std::optional(model_of(scan.one->refined.fit, 1.0, count)) : std::nullopt;
    const std::size_t freedom = points.size() - points.constants();
    const Model constant{points.total(), static_cast<double>(freedom), 1.0};
    bool varies = is_better(two, constant) || is_better(most_terms, constant);
    if (scan.one && !suffices(*most_terms, two, std::nullopt)) scan.one->suffices = false;
    for (std::size_t order = 1; order < most; order *= 2) {
      std::optional<OnePeriod> one = one_period(scan, points, order);
      if (!one) continue;
      const Model model = model_of(one->refined.fit, 1.0, count);
      varies = varies || is_better(model, constant);
      if (!one->suffices || !suffices(model, two, most_terms)) continue;
      scan.one = std::move(one);
      break;
    }
    scan.constant = ConstantLight{constant.chi_square, freedom, !varies};
    if (scan.one && !varies) scan.one->suffices = false;
  }

  // The lowest; it suffices if the data cover its period twice, as a longer one has harmonics
  // enough for any curve.
  std::optional<OnePeriod> one_period(const LightScan& scan, const fit::ScanPoints& points,
                                      std::size_t order) const {
    constexpr std::size_t few = 5;
    fit::ScanOptions how{.order = order};
    detail::follow(scenario_, options_, where_, how);
    how.progress = {};  // the scan of pairs is nearly all of the work
    const std::vector<fit::ScanMinimum> all = fit::scan_minima(
        points,
        fit::scan_periods(points, fit::FrequencyGrid::between(least_, most_, scan.advice.step),
                          how),
        minima(few));
    const auto one = std::ranges::find_if(all, is_sound);
    if (one == all.end()) return std::nullopt;
    const fit::FourierFit& fit = one->refined.fit;
    OnePeriod found{order, one->refined, fit.f2 * scan.advice.time_base >= 2.0, {}};
    for (const fit::ScanMinimum& other : all)
      if (is_sound(other) && is_alias(other.refined.fit, fit, scan.advice.step))
        found.aliases.push_back(other.refined.fit.f2);
    return found;
  }

  static bool is_sound(const fit::ScanMinimum& m) {
    return m.resolved && m.refined.converged && m.refined.fit.degrees_of_freedom > 2;
  }

  // Another frequency that fits as well to 3 sigma and is neither a multiple nor a part of
  // `lowest`.
  static bool is_alias(const fit::FourierFit& other, const fit::FourierFit& lowest, double step) {
    constexpr double three_sigma = 9.0;
    const double noise =
        lowest.chi_square / std::fmax(1.0, static_cast<double>(lowest.degrees_of_freedom));
    if (other.chi_square - lowest.chi_square > three_sigma * noise) return false;
    const double high = std::fmax(other.f2, lowest.f2), low = std::fmin(other.f2, lowest.f2);
    return std::fabs(high - low * std::round(high / low)) > 2.0 * step;
  }

  // Whether one period describes the data as well as two, or one with more harmonics, do.
  static bool suffices(const Model& one, const std::optional<Model>& two,
                       const std::optional<Model>& most_terms) {
    if (!two) return one.is_within_errors();
    // within the errors as they are given, unless they are far too large
    constexpr double far_too_large = 0.5;
    if (one.is_within_errors() && two->chi_square > far_too_large * two->freedom) return true;
    return !is_better(two, one) && !is_better(most_terms, one);
  }

  // Whether chi-square falls by more than noise lets it: an F test of the further unknowns, at the
  // best of all choices. If the simpler model fails and the other is within the errors, p times
  // the choices need only be below 1: with few degrees of freedom it cannot be smaller.
  static bool is_better(const std::optional<Model>& model, const Model& simpler) {
    if (!model || !(model->freedom > 0.0) || !(model->freedom < simpler.freedom)) return false;
    constexpr double chance = 1e-3, least_noise = 0.1;
    const auto misfit = [](const Model& of) {
      return std::fmax(of.chi_square, least_noise * of.freedom);
    };
    const double ratio = misfit(*model) / misfit(simpler);
    const double usual = model->freedom / simpler.freedom;  // the mean of noise
    if (!(ratio < usual)) return false;
    const bool errors_decide = !simpler.is_described() && model->is_within_errors();
    return model->choices *
               beta_chance(0.5 * model->freedom, 0.5 * (simpler.freedom - model->freedom), ratio) <
           (errors_decide ? 1.0 : chance);
  }

  // The regularised incomplete beta function I_x(a, b), by its series of positive terms.
  static double beta_chance(double a, double b, double x) {
    double term = 1.0, sum = 1.0;
    for (double k = 1.0; term > 1e-16 * sum; k += 1.0)
      sum += term *= x * (a + b + k - 1.0) / (a + k);
    return std::exp(std::lgamma(a + b) - std::lgamma(a + 1.0) - std::lgamma(b) + a * std::log(x) +
                    b * std::log1p(-x)) *
           sum;
  }

  // What to do about too many pairs.
  std::string way_out() const {
    const std::string nearer =
        "set fit.scan.shortest and fit.scan.longest nearer to each other, or fit fewer sessions";
    if (curves_.size() > 1)
      return "set fit.scan.sessions = \"separate\", which scans session by session first; or " +
             nearer;
    return nearer +
           "; where the data are of several nights, say so by session_column or a table "
           "[[observation]] for each, and set fit.scan.sessions = \"separate\"";
  }

  std::string words_of(const fit::SessionScanSize& size) const {
    return fmt::format("{} of {:.0f} pairs of frequencies each, and {} of {:.0f} on all of them",
                       polhode::detail::counted(size.sessions, "session", "sessions"), size.coarse,
                       polhode::detail::counted(plan_.windows, "window", "windows"), size.fine);
  }

  void begin(const std::string& work) const {
    if (!options_.begins) return;
    const std::size_t points = detail::count_points(curves_);
    options_.begins("scan", work + (points > detail::many_points
                                        ? fmt::format(" of {} points; means of neighbouring points "
                                                      "would take less time",
                                                      points)
                                        : std::string()));
  }

  fit::ScanOptions how() const {
    fit::ScanOptions how{.order = plan_.order};
    detail::follow(scenario_, options_, where_, how);
    return how;
  }
  fit::MinimaOptions minima(std::size_t most) const {
    fit::MinimaOptions how{.most = most};
    detail::follow(scenario_, options_, where_, how);
    return how;
  }

  static std::string number(double x) { return polhode::detail::rounded_text(x); }
  std::string text_of(double period) const {
    return fmt::format("{:.5g} {}", scenario_.units().from_core(period, Dimension::time),
                       scenario_.units().time());
  }

  const Scenario& scenario_;
  const ScanPlan& plan_;
  std::span<const light::LightCurve> curves_;
  const FitOptions& options_;
  fit::ScanAdvice advice_;
  double least_, most_;
  std::string where_ = "in the scan";
};

}  // namespace

LightScan detail::light_scan(const Scenario& scenario, std::span<const light::LightCurve> curves,
                             const FitOptions& options) {
  return Scan(scenario, curves, options).made();
}

std::vector<ChosenPair> detail::chosen_pairs(const Scenario& scenario,
                                             std::span<const light::LightCurve> curves) {
  const ScanPlan& plan = require_fit(scenario).light.scan;
  std::vector<ChosenPair> chosen;
  if (plan.at.empty()) return chosen;
  plan.places.at.built([&] {
    const fit::ScanPoints points(curves);
    const double reach = fit::scan_advice(curves, plan.at_order).step;
    const fit::FourierOrders orders = fit::FourierOrders::pair(plan.at_order);
    for (const ScanPlan::Pair& pair : plan.at)
      chosen.push_back(
          {fit::fourier_fit(points, 1.0 / pair.first, 1.0 / pair.second, orders),
           fit::refined_pair(points, 1.0 / pair.first, 1.0 / pair.second, orders, reach)});
    return 0;
  });
  return chosen;
}

}  // namespace io
}  // namespace v0
}  // namespace polhode
