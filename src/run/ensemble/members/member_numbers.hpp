// SPDX-License-Identifier: MIT
// Which number of a member a name stands for: a column of its rows, or a key that varies.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "polhode/run/ensemble.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

struct MemberNumber {
  enum class From { row, event, drawn };
  From from;
  std::size_t place;  // in a row, or among what was drawn
  Column column;
  bool is_angle;  // of a row
};

// Of a column but t and dates, of q too, or of a key; none where nothing is called so.
std::optional<MemberNumber> member_number(const ScenarioEnsemble& ensemble,
                                          const std::string& name);
// ScenarioError at the place of a fraction or a histogram of what is not there.
void require_known_columns(const ScenarioEnsemble& ensemble);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
