// SPDX-License-Identifier: MIT
// A scenario whose experiment is made again and again with other numbers: what wraps an experiment
// (a map, an ensemble) takes its cells from here. Text is not read again, and files and tables are
// shared unless a number below them changes.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "scenario/detail/experiment_kinds.hpp"
#include "scenario/number_location.hpp"
#include "text/value_access.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

class PreparedBase {
 public:
  // `keys` are numbers of the file, as number_location finds them. The scenario must outlive it.
  PreparedBase(const Scenario& scenario, std::span<const std::string> keys);

  // With these numbers at the keys, each in the unit that it has in the file. From any thread.
  // ScenarioError, as a file with these numbers would be refused.
  Experiment experiment(std::span<const double> numbers) const;

 private:
  std::unique_ptr<Values> taken() const;

  const Scenario& scenario_;
  std::vector<NumberLocation> locations_;
  Remake remake_;
  // Copies of the values, one for each thread at a time. Every cell sets the same of their numbers,
  // so that what the cell before has left does not matter.
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Values>> free_;
};

}  // namespace detail
}  // namespace v0
}  // namespace polhode
