// SPDX-License-Identifier: MIT
#include "polhode/series/detail/orders.hpp"

#include <cstdio>
#include <string>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

namespace {

// Twelve weighted exponents of 16 bits stay below 2^31.
constexpr int largest_weight = 1000;

std::string rounded(double x) {
  char digits[32];
  const int n = std::snprintf(digits, sizeof digits, "%.3g", x);
  return {digits, static_cast<std::size_t>(n)};
}

}  // namespace

Orders::Orders(const Symbols& symbols, const Truncation& keep) : fields_(symbols.exponents()) {
  for (const auto& [name, weight] : keep.weights) {
    if (weight < 0 || weight > largest_weight)
      throw DomainError("Truncation: the weight " + std::to_string(weight) + " of " + name +
                        " is out of [0, " + std::to_string(largest_weight) + "]");
    weights_.emplace_back(symbols.variable(name), weight);
  }
}

void require_room(const ProductSize& size, std::size_t most_bytes) {
  if (size.bytes <= static_cast<double>(most_bytes)) return;
  throw DomainError("product: " + rounded(size.pairs) + " pairs of terms may become " +
                    rounded(size.terms) + " terms and take " + rounded(size.bytes / 1e9) +
                    " GB, more than the " + rounded(static_cast<double>(most_bytes) / 1e9) +
                    " GB allowed; lower the order, or raise Truncation::most_bytes");
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
