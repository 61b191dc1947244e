// SPDX-License-Identifier: MIT
#include "polhode/ensemble/sobol_points.hpp"

#include <boost/random/sobol.hpp>
#include <string>

#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

std::size_t checked(std::size_t dimensions) {
  if (dimensions < 1 || dimensions > SobolPoints::most_dimensions)
    throw DomainError("SobolPoints: " + std::to_string(dimensions) +
                      " dimensions must be from 1 to " +
                      std::to_string(SobolPoints::most_dimensions));
  return dimensions;
}

}  // namespace

const std::size_t SobolPoints::most_dimensions = boost::random::default_sobol_table::max_dimension;

// Boost's engine goes from point to point; its points at which the Gray code has one bit are the
// direction numbers. Its points begin with ours of index 1.
SobolPoints::SobolPoints(std::size_t dimensions) : directions_(64 * checked(dimensions)) {
  boost::random::sobol engine(dimensions);
  for (std::size_t bit = 0; bit < 64; ++bit) {
    const std::uint64_t index = ~std::uint64_t{0} >> (63 - bit);  // Gray code 2^bit
    engine.seed(index - 1);
    for (std::size_t i = 0; i < dimensions; ++i) directions_[64 * i + bit] = engine();
  }
}

}  // namespace v0
}  // namespace polhode
