// SPDX-License-Identifier: MIT
// What the fits of a search came to: solutions, each once, and the best of each pair of periods.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "fit/light_geometry.hpp"
#include "polhode/fit/light_search.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class LightFinds {
 public:
  // Rounds of more starts, at most.
  static constexpr int most_rounds = 6;

  // Whether the second solution is the first one again.
  using AreSame = std::function<bool(const LightSolution&, const LightSolution&)>;

  // `half_turns`: of bodies that are the same after half turns about their axes.
  LightFinds(std::span<const LightCurve> curves, std::size_t periods, double within,
             AreSame are_same, bool half_turns);

  // Solutions from here on have other unknowns; the best of each pair of periods stays.
  void begin(AreSame are_same);
  void add(const LightSolution& found, std::size_t periods);

  const std::vector<FoundLight>& all() const { return solutions_; }
  const std::optional<LightSolution>& best_of(std::size_t periods) const { return best_[periods]; }
  // The lowest first, with what each is beside those before it.
  std::vector<FoundLight> within_limit() const;
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
}  // namespace v0
}  // namespace polhode
