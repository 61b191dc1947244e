// SPDX-License-Identifier: MIT
#include "polhode/ensemble/parts.hpp"

#include <string>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

// So that the last ones to end are late by little.
constexpr std::size_t parts_per_thread = 16;

std::size_t quotient_up(std::size_t a, std::size_t b) { return a / b + (a % b != 0 ? 1 : 0); }

}  // namespace

Parts parts_for(std::size_t size, std::size_t least, int threads) {
  if (threads < 1)
    throw DomainError("run_parts: threads " + std::to_string(threads) + " must be at least 1");
  if (size == 0) return {0, 1, 0};
  const std::size_t blocks = threads == 1 ? 1 : std::max<std::size_t>(1, size / least);
  const std::size_t each =
      blocks == 1
          ? size
          : least * quotient_up(blocks, parts_per_thread * static_cast<std::size_t>(threads));
  return {size, each, static_cast<std::int64_t>(quotient_up(size, each))};
}

}  // namespace v0
}  // namespace polhode
