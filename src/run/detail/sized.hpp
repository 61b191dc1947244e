// SPDX-License-Identifier: MIT
// Lists of structs in the bytes of a checkpoint.
#pragma once

#include <cstdint>
#include <vector>

#include "polhode/trajectory/state_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// The number of elements, then each, as `each` transfers it.
template <class T, class Each>
void sized(StateBytes& bytes, std::vector<T>& all, const Each& each) {
  std::uint64_t size = all.size();
  bytes(size);
  if (bytes.reads()) all.clear();
  for (std::uint64_t i = 0; i < size; ++i) each(bytes.reads() ? all.emplace_back() : all[i]);
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
