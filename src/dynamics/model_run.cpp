// SPDX-License-Identifier: MIT
// Runs of models: the methods that they may have, and the texts of their failures.
#include "polhode/dynamics/detail/model_run.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

const Adaptive& adaptive_method(std::string_view model, const Method& method, bool has_wide,
                                bool has_frozen) {
  const auto* adaptive = std::get_if<Adaptive>(&method);
  if (adaptive == nullptr)
    throw DomainError("integrate: method of " + std::string(model) + " must be Adaptive" +
                      (has_frozen ? ", Collocation or Splitting" : " or Collocation") +
                      ": the others know a System alone");
  if (adaptive->precision == Precision::double_double && !has_wide)
    throw DomainError("integrate: " + std::string(model) +
                      " works on double alone: write its functions as templates on the number type "
                      "for Precision::double_double");
  return *adaptive;
}

void refuse_all_but_splitting(std::string_view model) {
  throw DomainError("integrate: method of " + std::string(model) +
                    " must be Splitting: it has no rates");
}

void refuse_events(std::string_view model, std::size_t count) {
  if (count > 0)
    throw DomainError("integrate: got " + std::to_string(count) + " events of " +
                      std::string(model) + "; expected none: it has no rates");
}

bool equal_but_for_rounding(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return false;
  double largest = 0.0;  // a state may have any unit: 1 says nothing about its size
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::fmax(largest, std::fmax(std::abs(a[i]), std::abs(b[i])));
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= rounding)) return false;
  return true;
}

std::string frozen_failure_text(std::string_view name, double t) {
  return "the state of " + std::string(name) +
         " is not finite after the step from t = " + number_text(t) +
         ": does what it depends on end there?";
}

std::string model_failure_text(std::string_view name, double t, double h, StepOutcome outcome) {
  const std::string where = number_text(t);
  if (outcome == StepOutcome::not_finite)
    return "the rates of " + std::string(name) + " are not finite at t = " + where +
           ": give them a value there, or stop before";
  return "the step at t = " + where + " would be " + number_text(std::abs(h)) +
         ", below the rounding of t: do the rates of " + std::string(name) +
         " jump there, or grow without bound? Try a larger tolerance";
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
