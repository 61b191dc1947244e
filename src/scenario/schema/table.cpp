// SPDX-License-Identifier: MIT
#include "scenario/table.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void TableRows::add(const Key& row, std::span<const Key> keys, std::span<const Alternatives> sets,
                    std::span<const KindText> kinds) {
  const bool is_head = row.path.empty();  // of the file
  if (!is_head) keys_.push_back(row);
  for (const Key& key : keys) {
    keys_.push_back(key);
    if (!is_head)
      keys_.back().path = words_.emplace_back(std::string(row.path) + "." + std::string(key.path));
  }
  alternatives_.insert(alternatives_.end(), sets.begin(), sets.end());
  texts_.insert(texts_.end(), kinds.begin(), kinds.end());
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
