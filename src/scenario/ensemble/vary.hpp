// SPDX-License-Identifier: MIT
// From one table [[ensemble.vary]] to its distribution.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenario/ensemble/ensemble_plan.hpp"
#include "scenario/number_location.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The numbers that a table varies, as the file has them.
struct VariedNumbers {
  std::vector<std::string> keys;
  std::vector<NumberLocation> places;
  std::vector<std::string> units;  // as outputs name them
  std::vector<double> values;      // in these units
};
VariedNumbers varied_numbers(const EnsembleContext& at, const std::string& path);

struct VariedTable {
  EnsembleVaried varied;
  std::optional<Distribution> distribution;  // none of a grid
  std::optional<DrawAxis> axis;              // of a grid
};
VariedTable varied_table(const EnsembleContext& at, const std::string& path,
                         const VariedNumbers& numbers);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
