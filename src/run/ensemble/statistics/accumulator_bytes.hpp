// SPDX-License-Identifier: MIT
// Accumulators in the bytes of a checkpoint or a message.
#pragma once

#include <vector>

#include "polhode/trajectory/state_bytes.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

// Of each its numbers, and how many these are before them.
template <class A>
void transfer_all(StateBytes& bytes, std::vector<A>& all) {
  for (A& one : all) {
    std::vector<double> numbers;
    if (!bytes.reads()) numbers = one.numbers();
    bytes(numbers);
    if (bytes.reads()) one = one.restored(numbers);
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
