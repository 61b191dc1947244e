// SPDX-License-Identifier: MIT
#include "polhode/fit/light_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fit/detail/light_relations.hpp"
#include "fit/detail/light_starts.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/cells.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/likely_periods.hpp"
#include "polhode/light/light_curve_checks.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::LightTrial;

constexpr double same_periods = 1e-3;

void check(const LightSearch& s) {
  const std::string who = "search_light: ";
  require_sound(s.curves, {.vectors = true});
  if (s.periods.empty()) throw DomainError(who + "no periods to start from; expected one pair");
  for (const TumblerPeriods& p : s.periods) {
    if (p.mode != Regime::short_axis && p.mode != Regime::long_axis)
      throw DomainError(who + "the mode must be short_axis or long_axis");
    for (const double period : {p.precession_period, p.rotation_period})
      if (!(period > 0.0) || !std::isfinite(period))
        throw DomainError(who + "period " + detail::number_text(period) + " must be positive");
  }
  const auto at_least_one = [&](const char* name, auto value) {
    if (value < 1)
      throw DomainError(who + name + " = " + std::to_string(value) + " must be 1 or more");
  };
  at_least_one("starts", s.starts);
  at_least_one("tries", s.tries);
  at_least_one("short_iterations", s.short_iterations);
  at_least_one("finalists", s.finalists);
  at_least_one("most_iterations", s.most_iterations);
  at_least_one("threads", s.threads);
  if (!(s.within >= 1.0))
    throw DomainError(who + "within = " + detail::number_text(s.within) + " must be 1 or more");
}

struct Finalist {
  BrightEllipsoid start;
  std::size_t periods;
};

class Search {
 public:
  explicit Search(const LightSearch& search)
      : search_(search), geometry_(detail::geometry_of(search.curves)) {
    result_.chi_square_of_periods.assign(search.periods.size(),
                                         std::numeric_limits<double>::infinity());
    result_.best_of_periods.resize(search.periods.size());
  }

  LightSearchResult found() {
    fit(finalists());
    sort_and_limit();
    fit(images());
    sort_and_limit();
    detail::describe_relations(result_.solutions, geometry_);
    add_notes();
    return std::move(result_);
  }

 private:
  // Of each pair of periods the best, and after it the next best that is unlike those taken.
  std::vector<Finalist> finalists() {
    std::vector<std::vector<LightTrial>> trials(search_.periods.size());
    run_cells(
        0, static_cast<std::int64_t>(search_.starts), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
          return detail::light_trial(search_, static_cast<std::uint64_t>(k));
        },
        [&](std::int64_t k, const std::optional<LightTrial>& trial) {
          if (!trial) return;
          ++result_.starts;
          trials[static_cast<std::size_t>(k) % search_.periods.size()].push_back(*trial);
        });
    std::vector<Finalist> found;
    for (std::size_t p = 0; p < trials.size(); ++p) {
      std::ranges::stable_sort(trials[p], {}, &LightTrial::cost);
      std::vector<const LightTrial*> taken;
      for (const LightTrial& t : trials[p]) {
        if (taken.size() == search_.finalists) break;
        const bool is_known = std::ranges::any_of(
            taken, [&](const LightTrial* known) { return detail::are_alike(known->body, t.body); });
        if (is_known) continue;
        taken.push_back(&t);
        found.push_back({t.body, p});
      }
    }
    return found;
  }

  std::vector<Finalist> images() const {
    std::vector<Finalist> found;
    for (const FoundLight& f : result_.solutions) {
      for (const LightImage i : {LightImage::normal, LightImage::bisector, LightImage::difference})
        found.push_back(
            {image_of(f.solution.body, i, geometry_.to_sun, geometry_.to_observer), f.periods});
    }
    return found;
  }

  void fit(const std::vector<Finalist>& finalists) {
    result_.finalists += finalists.size();
    run_cells(
        0, std::ssize(finalists), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
          const Finalist& f = finalists[static_cast<std::size_t>(k)];
          LightFit fit{search_.curves, f.start, search_.unknowns, search_.loss,
                       search_.most_iterations};
          return fit_light(fit);
        },
        [&](std::int64_t k, const LightSolution& s) {
          if (s.is_found()) add(s, finalists[static_cast<std::size_t>(k)].periods);
        });
  }

  void add(const LightSolution& s, std::size_t periods) {
    ++result_.converged;
    double& least = result_.chi_square_of_periods[periods];
    if (s.result.cost < least) {
      least = s.result.cost;
      result_.best_of_periods[periods] = s;
    }
    for (FoundLight& f : result_.solutions) {
      if (!detail::are_same(f.solution, s, search_.unknowns)) continue;
      ++f.starts;
      if (s.result.cost < f.solution.result.cost) f.solution = s;
      return;
    }
    FoundLight f;
    f.solution = s;
    f.periods = periods;
    f.starts = 1;
    result_.solutions.push_back(f);
  }

  void sort_and_limit() {
    std::vector<FoundLight>& all = result_.solutions;
    std::ranges::stable_sort(all, {}, [](const FoundLight& f) { return f.solution.result.cost; });
    if (all.empty()) return;
    const double limit = search_.within * all.front().solution.result.cost;
    std::erase_if(all, [&](const FoundLight& f) { return f.solution.result.cost > limit; });
  }

  void add_notes() {
    if (result_.starts == 0)
      result_.notes.push_back(
          "no body has any of these periods with an ellipsoid that is not thinner than 1 : 6.7");
    else if (result_.solutions.empty())
      result_.notes.push_back("no fit converged: more starts, more iterations, or other periods");
    const std::size_t without = search_.starts - result_.starts;
    if (without > 0 && result_.starts > 0)
      result_.notes.push_back(std::to_string(without) + " of " + std::to_string(search_.starts) +
                              " starts had no body with their periods, or no value");
  }

  const LightSearch& search_;
  detail::LightGeometry geometry_;
  LightSearchResult result_;
};

}  // namespace

std::vector<TumblerPeriods> labelled_periods(std::span<const ScanMinimum> minima,
                                             const LabelChoice& choice) {
  std::vector<TumblerPeriods> found;
  const auto is_known = [&](const TumblerPeriods& l) {
    return std::ranges::any_of(found, [&](const TumblerPeriods& p) {
      return p.mode == l.mode &&
             std::abs(p.precession_period / l.precession_period - 1.0) < same_periods &&
             std::abs(p.rotation_period / l.rotation_period - 1.0) < same_periods;
    });
  };
  std::size_t pairs = 0;
  for (const ScanMinimum& m : minima) {
    if (!m.resolved || !m.refined.converged || m.at_edge) continue;
    if (pairs++ == choice.pairs) break;
    std::size_t taken = 0;
    for (const LikelyPeriods& l : likely_periods(m.refined.fit)) {
      if (taken++ == choice.labels) break;
      if (!is_known(l.periods)) found.push_back(l.periods);
    }
  }
  return found;
}

LightSearchResult search_light(const LightSearch& search) {
  check(search);
  return Search(search).found();
}

}  // namespace v0
}  // namespace polhode
