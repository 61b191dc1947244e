// SPDX-License-Identifier: MIT
// The distinct solutions of a search of light curves, and how they are related.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fit/light_states.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
namespace detail {

// Near enough that fits from both would most likely meet.
bool are_alike(const LightModel& a, const LightModel& b);
// Ellipsoids: within the errors of the first, with the same counts of turns over the time base:
// these are known far better than each unknown by itself. Others as are_same_spins, of facets that
// a fit may move up to half turns.
bool are_same(const FoundLight& a, const FoundLight& b, const LightUnknowns& unknowns,
              double time_base);

// How many starts came to each solution or to one of its images. They have been described.
std::vector<std::size_t> starts_of_images(const std::vector<FoundLight>& solutions);

// Says of each solution what it is beside those before it; `half_turns` as describe_solutions.
void describe_relations(std::vector<FoundLight>& solutions, const LightGeometry& geometry,
                        bool half_turns);

// Groups equivalent solutions and labels ambiguities: each solution once, and the best of each pair
// of periods.
class DistinctSolutions {
 public:
  // Rounds of more starts for pairs of periods that have a solution.
  static constexpr int least_rounds = 2, most_rounds = 6;
  // Pairs of periods that a round takes at most.
  static constexpr std::size_t pairs_of_round = 8;

  // Whether the second solution is the first one again.
  using AreSame = std::function<bool(const FoundLight&, const FoundLight&)>;

  // `half_turns`: of bodies that are the same after half turns about their axes.
  DistinctSolutions(std::span<const light::LightCurve> curves, std::size_t periods, double within,
                    AreSame are_same, bool half_turns);

  // Solutions from here on have other unknowns; the best of each pair of periods stays.
  void begin(AreSame are_same);
  // `begun` as FoundLight, that of the fit with the lowest sum.
  void add(const LightSolution& solution, std::size_t periods,
           const std::optional<LightModel>& begun = std::nullopt);

  const std::vector<FoundLight>& all() const { return solutions_; }
  const std::optional<LightSolution>& best_of(std::size_t periods) const { return best_[periods]; }
  // The lowest first, with what each is beside those before it.
  std::vector<FoundLight> within_limit() const;
  std::size_t count_within() const;
  // Not so far beyond the limit that it is given up.
  bool is_near(double cost) const;

  // The pairs of periods for which more starts may find something, the lowest first.
  std::vector<std::size_t> open_pairs(int round) const;
  // How many of the solutions within the limit one start alone came to, images taken as one.
  std::size_t seldom() const;

  void move_to(LightSearchResult& result);

 private:
  double limit() const;

  double within_;
  LightGeometry geometry_;
  AreSame are_same_;
  bool half_turns_;
  std::size_t converged_ = 0;
  std::vector<FoundLight> solutions_;
  std::vector<std::optional<LightSolution>> best_;
};

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
