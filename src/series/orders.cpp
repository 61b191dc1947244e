// SPDX-License-Identifier: MIT
// Orders of terms by the weights of a truncation, and the limit on the size of a product.
#include "polhode/series/detail/orders.hpp"

#include <cstddef>
#include <string>

#include "math/number_text.hpp"
#include "polhode/error.hpp"
#include "polhode/series/symbols.hpp"

namespace polhode {
inline namespace v0 {
namespace series {
namespace detail {
namespace {

// Twelve weighted exponents of 16 bits stay below 2^31.
constexpr int largest_weight = 1000;

}  // namespace

Orders::Orders(const Symbols& symbols, const Truncation& keep) : fields_(symbols.exponents()) {
  for (const auto& [name, weight] : keep.weights) {
    if (weight < 0 || weight > largest_weight)
      throw DomainError("Truncation: the weight " + std::to_string(weight) + " of " + name +
                        " is out of [0, " + std::to_string(largest_weight) + "]");
    const int variable = symbols.variable(name);
    if (weight != 0 && variable < static_cast<int>(symbols.values().size()))
      throw DomainError("Truncation: " + name +
                        " has a value, and coefficients are functions of it: it has no order");
    weights_.emplace_back(variable, weight);
  }
}

void require_room(const ProductSize& size, std::size_t most_bytes) {
  if (size.bytes <= static_cast<double>(most_bytes)) return;
  throw DomainError("product: " + polhode::detail::rounded_text(size.pairs) +
                    " pairs of terms may become " + polhode::detail::rounded_text(size.terms) +
                    " terms and take " + polhode::detail::rounded_text(size.bytes / 1e9) +
                    " GB, more than the " +
                    polhode::detail::rounded_text(static_cast<double>(most_bytes) / 1e9) +
                    " GB allowed; lower the order, or raise Truncation::most_bytes");
}

}  // namespace detail
}  // namespace series
}  // namespace v0
}  // namespace polhode
