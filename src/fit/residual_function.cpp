// SPDX-License-Identifier: MIT
#include "polhode/fit/residual_function.hpp"

#include <string>
#include <utility>
#include <vector>

#include "fit/detail/stacked_numbers.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {

ResidualFunction::ResidualFunction(LeastSquares problem)
    : problem_(std::make_shared<const LeastSquares>(std::move(problem))),
      numbers_(std::make_shared<const detail::StackedNumbers>(*problem_)) {}

std::size_t ResidualFunction::size() const { return numbers_->size(); }

bool ResidualFunction::at(std::span<const double> x, std::span<double> numbers,
                          std::span<double> jacobian) const {
  if (x.size() != unknowns() || numbers.size() != size() ||
      (!jacobian.empty() && jacobian.size() != size() * unknowns()))
    throw DomainError("ResidualFunction: got " + std::to_string(x.size()) +
                      " unknowns and room for " + std::to_string(numbers.size()) +
                      " numbers; expected " + std::to_string(unknowns()) + " and " +
                      std::to_string(size()));
  const std::vector<double> at(x.begin(), x.end());
  return numbers_->at(at, numbers.data(), jacobian.empty() ? nullptr : jacobian.data());
}

}  // namespace v0
}  // namespace polhode
