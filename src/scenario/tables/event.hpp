// SPDX-License-Identifier: MIT
// [[event]]: the times to find.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "polhode/scenario/rotation.hpp"
#include "polhode/tables/chart_kind.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

SchemaPart event_keys();
std::vector<ScenarioEvent> events_of(const FileValues& file, std::span<const ChartKind> charts);
// Throws a ScenarioError at the column of event i.
[[noreturn]] void refuse_event_column(const FileValues& file, std::size_t i,
                                      std::string_view message);

}  // namespace detail
}  // namespace v0
}  // namespace polhode
