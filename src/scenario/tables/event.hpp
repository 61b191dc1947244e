// SPDX-License-Identifier: MIT
// [[event]]: the times to find.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "polhode/output/column_kind.hpp"
#include "polhode/scenario/rotation.hpp"
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

SchemaPart event_keys();
std::vector<ScenarioEvent> events_of(const FileValues& file, const ColumnKinds& columns);
// Throws a ScenarioError at the column of event i.
[[noreturn]] void refuse_event_column(const FileValues& file, std::size_t i,
                                      std::string_view message);

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
