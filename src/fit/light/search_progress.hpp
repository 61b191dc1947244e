// SPDX-License-Identifier: MIT
// Progress of a search of light curves, by estimates of the work that is left.
//
// The unit of work is one iteration of a fit. How many solutions a search finds decides how many
// further rounds and fits follow, so the reported part may fall when many solutions are found.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "fit/detail/distinct_solutions.hpp"
#include "fit/light/search_checks.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Starts of a round for each pair of periods, and their iterations over those of the first starts.
inline constexpr std::size_t starts_of_round = 50;
inline constexpr int more_short_iterations = 3;

class SearchProgress {
 public:
  explicit SearchProgress(const LightSearch& search) : search_(search) {}

  // The remaining steps of the search.
  std::size_t further_models = 0;
  std::size_t open_pairs = 1;  // of the present or next round
  int round = 0;
  double part_near = 0.5;  // the part of the starts of a round that is fitted to the end
  bool rounds_are_done = false, images_are_done = false;

  // A start of `iterations` has ended; `left` more of this step follow, then about `fits` fits.
  void add_start(int iterations, double left, double fits, const DistinctSolutions& finds) {
    work_ += work_of_start(iterations);
    tell(left * work_of_start(iterations), fits, finds);
  }
  // The cost that one of the first starts came to.
  void add_cost(double cost) {
    costs_.push_back(cost);
    const double limit = search_.within * std::min(least_, cost);
    if (cost < least_) {
      least_ = cost;
      near_ = static_cast<std::size_t>(
          std::ranges::count_if(costs_, [limit](double c) { return c <= limit; }));
    } else if (cost <= limit) {
      ++near_;
    }
  }
  // A fit has ended; `left` more of this step follow.
  void add_fit(int iterations, double left, const DistinctSolutions& finds) {
    work_ += iterations;
    iterations_ += iterations;
    ++fits_;
    tell(left * work_of_fit(), 0.0, finds);
  }
  void end() const {
    if (search_.progress) search_.progress(1.0);
  }

 private:
  // The work of trying an attitude, and of a fit before any has ended.
  static constexpr double work_of_try = 0.5, first_work_of_fit = 25.0;
  // With more solutions than this for each pair of periods, new ones turn up in every round.
  static constexpr double many_solutions = 10.0;
  double work_of_start(int iterations) const {
    return iterations + work_of_try * static_cast<double>(search_.tries);
  }
  double work_of_fit() const {
    return fits_ == 0 ? first_work_of_fit : iterations_ / static_cast<double>(fits_);
  }

  void tell(double left, double fits, const DistinctSolutions& finds) const {
    if (!search_.progress) return;
    const auto pairs = static_cast<double>(search_.periods.size());
    double within = static_cast<double>(finds.count_within()),
           open = static_cast<double>(open_pairs);
    if (fits_ == 0 && !costs_.empty()) {  // by the starts so far
      const double part = static_cast<double>(near_) / static_cast<double>(costs_.size());
      within = part * pairs * static_cast<double>(search_.finalists);
      open = std::clamp(part * pairs, 1.0, static_cast<double>(DistinctSolutions::pairs_of_round));
    }
    if (!images_are_done) fits += 3.0 * within;
    fits += static_cast<double>(further_models) * (pairs + within);
    if (!rounds_are_done) {
      const int rounds = within > many_solutions * open ? DistinctSolutions::most_rounds
                                                        : DistinctSolutions::least_rounds;
      const double starts =
          std::max(rounds - round, 0) * open * static_cast<double>(starts_of_round);
      left += starts * work_of_start(times(search_.short_iterations, more_short_iterations));
      fits += starts * part_near;
    }
    search_.progress(work_ / (work_ + left + fits * work_of_fit()));
  }

  const LightSearch& search_;
  double work_ = 0.0, iterations_ = 0.0;
  std::size_t fits_ = 0;
  std::vector<double> costs_;
  double least_ = std::numeric_limits<double>::infinity();
  std::size_t near_ = 0;  // of these costs, those within the limit over the least
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
