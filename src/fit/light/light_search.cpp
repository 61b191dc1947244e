// SPDX-License-Identifier: MIT
#include "polhode/fit/light_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "fit/detail/light_begun_anew.hpp"
#include "fit/detail/light_relations.hpp"
#include "fit/detail/light_search_fits.hpp"
#include "fit/detail/light_starts.hpp"
#include "math/number_text.hpp"
#include "polhode/ensemble/cells.hpp"
#include "polhode/error.hpp"
#include "polhode/fit/likely_periods.hpp"
#include "polhode/light/light_curve_checks.hpp"

namespace polhode {
inline namespace v0 {
namespace {

using detail::LightFinalist;
using detail::LightTrial;

constexpr double same_periods = 1e-3;
// Chi-squares that are one, of a pair of periods.
constexpr double same_chi_square = 0.01;
// Rounds of finalists until the best of a pair was reached twice, and of starts within the limit.
constexpr int rounds_of_pairs = 3, rounds_within = 3;
// Starts that a pair within the limit gets in a round, at most.
constexpr std::size_t most_more = 20;

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

class Search {
 public:
  explicit Search(const LightSearch& search)
      : search_(search),
        fits_(search),
        geometry_(detail::geometry_of(search.curves)),
        trials_(search.periods.size()),
        hits_(search.periods.size(), 0) {
    result_.chi_square_of_periods.assign(search.periods.size(),
                                         std::numeric_limits<double>::infinity());
    result_.best_of_periods.resize(search.periods.size());
  }

  LightSearchResult found() {
    std::vector<std::size_t> numbers(search_.starts);
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    draw(numbers);
    result_.starts = with_body_;
    for (int round = 0; round < rounds_of_pairs; ++round)
      fit(next_of(unsettled(), search_.finalists));
    explore();
    sort_and_limit();
    detail::describe_relations(result_.solutions, geometry_);
    add_notes();
    return std::move(result_);
  }

 private:
  struct Waiting {
    LightTrial trial;
    bool is_taken = false;
  };

  void draw(const std::vector<std::size_t>& numbers) {
    run_cells(
        0, std::ssize(numbers), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
          return fits_.trial(numbers[static_cast<std::size_t>(k)]);
        },
        [&](std::int64_t k, const std::optional<LightTrial>& trial) {
          if (!trial) return;
          ++with_body_;
          const std::size_t p = numbers[static_cast<std::size_t>(k)] % search_.periods.size();
          trials_[p].push_back({*trial});
        });
    for (std::vector<Waiting>& all : trials_)
      std::ranges::stable_sort(all, {}, [](const Waiting& w) { return w.trial.chi_square; });
  }

  // Pairs of periods whose best was not reached by two fits.
  std::vector<std::size_t> unsettled() const {
    std::vector<std::size_t> pairs;
    for (std::size_t p = 0; p < hits_.size(); ++p)
      if (hits_[p] < 2) pairs.push_back(p);
    return pairs;
  }

  // Of each of these pairs the best trials that wait, and after them the next best unlike those.
  std::vector<LightFinalist> next_of(const std::vector<std::size_t>& pairs, std::size_t most) {
    std::vector<LightFinalist> found;
    for (const std::size_t p : pairs) {
      std::vector<const Waiting*> taken;
      for (const Waiting& w : trials_[p])
        if (w.is_taken) taken.push_back(&w);
      std::size_t count = 0;
      for (Waiting& w : trials_[p]) {
        if (count == most) break;
        const bool is_known = w.is_taken || std::ranges::any_of(taken, [&](const Waiting* known) {
                                return detail::are_alike(known->trial.body, w.trial.body);
                              });
        if (is_known) continue;
        w.is_taken = true;
        taken.push_back(&w);
        found.push_back({w.trial.body, p});
        ++count;
      }
    }
    return found;
  }

  void fit(const std::vector<LightFinalist>& finalists) {
    result_.finalists += finalists.size();
    run_cells(
        0, std::ssize(finalists), search_.threads,
        [&](std::int64_t k) {
          if (search_.between) search_.between();
          return fits_.to_end(finalists[static_cast<std::size_t>(k)]);
        },
        [&](std::int64_t k, const LightSolution& s) {
          add(s, finalists[static_cast<std::size_t>(k)].periods);
        });
  }

  // Until a round brings nothing new: more starts of pairs whose best is within the limit, and
  // every solution there begun anew from its images and near states.
  void explore() {
    for (int round = 0; round < rounds_within; ++round) {
      const std::size_t before = count_within();
      const std::vector<std::size_t> pairs = pairs_within();
      const std::size_t of_each =
          (search_.starts + search_.periods.size() - 1) / search_.periods.size();
      std::vector<std::size_t> numbers;
      const std::size_t more = std::min(of_each, most_more);
      for (std::size_t i = 0; i < more; ++i)
        for (const std::size_t p : pairs)
          numbers.push_back(p + search_.periods.size() *
                                    (of_each * 2 + more * static_cast<std::size_t>(round) + i));
      draw(numbers);
      fit(next_of(pairs, 2 * more));
      while (true) {
        const std::vector<LightFinalist> again = begun_anew();
        if (again.empty()) break;
        fit(again);
      }
      if (count_within() == before && round > 0) break;
    }
  }

  double limit() const {
    double least = std::numeric_limits<double>::infinity();
    for (const FoundLight& f : result_.solutions) least = std::min(least, f.solution.result.cost);
    return search_.within * least;
  }
  std::size_t count_within() const {
    const double most = limit();
    return static_cast<std::size_t>(std::ranges::count_if(
        result_.solutions, [&](const FoundLight& f) { return f.solution.result.cost <= most; }));
  }
  // One pair of periods of all that came to the same.
  std::vector<std::size_t> pairs_within() const {
    std::vector<std::size_t> pairs;
    const double most = limit();
    for (std::size_t p = 0; p < result_.best_of_periods.size(); ++p) {
      const std::optional<LightSolution>& best = result_.best_of_periods[p];
      if (!best || !(best->result.cost <= most)) continue;
      const bool is_known = std::ranges::any_of(pairs, [&](std::size_t q) {
        return detail::have_same_periods(*result_.best_of_periods[q], *best, geometry_.time_base);
      });
      if (!is_known) pairs.push_back(p);
    }
    return pairs;
  }

  std::vector<LightFinalist> begun_anew() {
    begun_.resize(result_.solutions.size(), false);
    std::vector<LightFinalist> found;
    const double most = limit();
    for (std::size_t i = 0; i < begun_.size(); ++i) {
      const FoundLight& f = result_.solutions[i];
      if (begun_[i] || !(f.solution.result.cost <= most)) continue;
      begun_[i] = true;
      for (const BrightEllipsoid& b : detail::begun_anew(f.solution.body, geometry_))
        found.push_back({b, f.periods, false});
    }
    return found;
  }

  void add(const LightSolution& s, std::size_t periods) {
    if (!std::isfinite(s.result.chi_square)) return;
    double& least = result_.chi_square_of_periods[periods];
    if (s.result.chi_square < least) {
      if (s.result.chi_square < (1.0 - same_chi_square) * least) hits_[periods] = 0;
      least = s.result.chi_square;
      result_.best_of_periods[periods] = s;
    }
    if (s.result.chi_square <= (1.0 + same_chi_square) * least) ++hits_[periods];
    if (!s.is_found()) return;
    ++result_.converged;
    for (FoundLight& f : result_.solutions) {
      if (!detail::are_same(f.solution, s, search_.unknowns, geometry_.time_base)) continue;
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
    const double most = limit();
    std::ranges::stable_sort(all, {}, [](const FoundLight& f) { return f.solution.result.cost; });
    std::erase_if(all, [&](const FoundLight& f) { return f.solution.result.cost > most; });
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
  detail::LightSearchFits fits_;
  detail::LightGeometry geometry_;
  std::vector<std::vector<Waiting>> trials_;  // of each pair of periods
  std::vector<std::size_t> hits_;             // fits that came to the best of it
  std::vector<bool> begun_;                   // solutions that were begun anew
  std::size_t with_body_ = 0;
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
