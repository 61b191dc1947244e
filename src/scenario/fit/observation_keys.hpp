// SPDX-License-Identifier: MIT
// The rows of [[observation]] in the table of keys, from the descriptions of its kinds.
#pragma once

#include <deque>
#include <span>
#include <string_view>
#include <vector>

#include "polhode/scenario/observation_kind.hpp"
#include "scenario/detail/kind_rows.hpp"

namespace polhode {
inline namespace v0 {
namespace io {
namespace detail {

// True if tables of all kinds have a key of this name.
bool is_shared_observation_key(std::string_view name);

class ObservationRows {
 public:
  explicit ObservationRows(std::span<const ObservationKind> kinds);

  SchemaPart part() const { return rows_.part(); }

 private:
  std::deque<std::vector<Key>> keys_;
  KindRows rows_;
};

}  // namespace detail
}  // namespace io
}  // namespace v0
}  // namespace polhode
