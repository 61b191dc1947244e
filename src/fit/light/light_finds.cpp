// SPDX-License-Identifier: MIT
#include "fit/detail/light_finds.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "fit/detail/light_relations.hpp"
#include "fit/light_states.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr double near_limit = 2.0;
// How many pairs of periods a round takes, and how many rounds one with a solution within the limit
// has at least.
constexpr std::size_t pairs_of_round = 8;
constexpr int least_rounds = 2;
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

LightFinds::LightFinds(std::span<const LightCurve> curves, std::size_t periods, double within,
                       AreSame are_same, bool half_turns)
    : within_(within),
      geometry_(geometry_of(curves)),
      are_same_(std::move(are_same)),
      half_turns_(half_turns),
      best_(periods) {}

void LightFinds::begin(AreSame are_same) {
  are_same_ = std::move(are_same);
  solutions_.clear();
}

void LightFinds::add(const LightSolution& found, std::size_t periods) {
  ++converged_;
  std::optional<LightSolution>& best = best_[periods];
  if (!best || found.result.cost < best->result.cost) best = found;
  for (FoundLight& f : solutions_) {
    if (!are_same_(f.solution, found)) continue;
    ++f.starts;
    if (found.result.cost < f.solution.result.cost) f.solution = found;
    return;
  }
  FoundLight f;
  f.solution = found;
  f.periods = periods;
  f.starts = 1;
  solutions_.push_back(f);
}

double LightFinds::limit() const {
  double least = infinite;
  for (const FoundLight& f : solutions_) least = std::min(least, f.solution.result.cost);
  return within_ * least;
}

bool LightFinds::is_near(double cost) const { return cost <= near_limit * limit(); }

std::vector<FoundLight> LightFinds::within_limit() const {
  const double most = limit();
  std::vector<FoundLight> found;
  for (const FoundLight& f : solutions_)
    if (f.solution.result.cost <= most) found.push_back(f);
  sort_by_cost(found, [](const FoundLight& f) -> const LightSolution& { return f.solution; });
  describe_relations(found, geometry_, half_turns_);
  return found;
}

// Where a solution was found by one start alone, some are unseen still; what is unseen where none
// was would be found by few starts of the next ones (Good 1953).
std::vector<std::size_t> LightFinds::open_pairs(int round) const {
  const std::vector<FoundLight> within = within_limit();
  const std::vector<std::size_t> found_by = starts_of_images(within);
  const auto is_open = [&](std::size_t p) {
    bool has_one = false;
    for (std::size_t k = 0; k < within.size(); ++k) {
      if (within[k].periods != p) continue;
      if (round < least_rounds || found_by[k] < 2) return true;
      has_one = true;
    }
    return !has_one && round == 0 && best_[p] && is_near(best_[p]->result.cost);
  };
  std::vector<std::size_t> open;
  for (std::size_t p = 0; p < best_.size(); ++p)
    if (is_open(p)) open.push_back(p);
  std::ranges::stable_sort(open, {}, [&](std::size_t p) { return best_[p]->result.cost; });
  if (open.size() > pairs_of_round) open.resize(pairs_of_round);
  return open;
}

std::size_t LightFinds::seldom() const {
  const std::vector<FoundLight> within = within_limit();
  const std::vector<std::size_t> found_by = starts_of_images(within);
  std::size_t count = 0;
  for (std::size_t k = 0; k < within.size(); ++k)
    if (found_by[k] == 1 && within[k].beside != FoundLight::Beside::image) ++count;
  return count;
}

void LightFinds::move_to(LightSearchResult& result) {
  result.solutions = within_limit();
  result.converged = converged_;
  for (const auto& best : best_)
    result.chi_square_of_periods.push_back(best ? best->result.cost : infinite);
  result.best_of_periods = std::move(best_);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
