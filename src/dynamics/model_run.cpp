// SPDX-License-Identifier: MIT
#include "polhode/dynamics/detail/model_run.hpp"

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_finite_span(const std::string& function, double start, double stop) {
  if (!std::isfinite(start) || !std::isfinite(stop))
    throw DomainError(function + ": start " + number_text(start) + " and stop " +
                      number_text(stop) + " must be finite");
}

const Adaptive& adaptive_method(std::string_view model, const Method& method, bool has_wide) {
  const auto* adaptive = std::get_if<Adaptive>(&method);
  if (adaptive == nullptr)
    throw DomainError("integrate: method of " + std::string(model) +
                      " must be Adaptive: the others know a System alone");
  if (adaptive->precision == Precision::double_double && !has_wide)
    throw DomainError("integrate: " + std::string(model) +
                      " works on double alone: write its functions as templates on the number type "
                      "for Precision::double_double");
  return *adaptive;
}

bool differ_by_rounding(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double rounding = 8.0 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!(std::abs(a[i] - b[i]) <= rounding * std::fmax(1.0, std::abs(a[i])))) return false;
  return a.size() == b.size();
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
