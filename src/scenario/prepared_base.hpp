// SPDX-License-Identifier: MIT
// A scenario whose experiment is made again and again with other numbers: what wraps an experiment
// (a map, an ensemble) takes its cells from here. Text is not read again, and files and tables are
// shared unless a number below them changes.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/map_plan.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class PreparedBase {
 public:
  // `keys` are numbers of the file, as number_location finds them. The scenario must outlive it.
  PreparedBase(const Scenario& scenario, std::span<const std::string> keys);

  // With these numbers at the keys, each in its unit of the file. From any thread. ScenarioError,
  // as a file with these numbers would be refused.
  Experiment experiment(std::span<const double> numbers) const;

 private:
  const Scenario& scenario_;
  std::vector<NumberLocation> places_;
  Remake remake_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
