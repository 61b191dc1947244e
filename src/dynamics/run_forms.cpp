// SPDX-License-Identifier: MIT
#include "polhode/dynamics/detail/run_forms.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/dynamics/detail/finite_span.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {

void require_finite_span(const std::string& function, double start, double stop) {
  if (!std::isfinite(start) || !std::isfinite(stop))
    throw DomainError(function + ": start " + number_text(start) + " and stop " +
                      number_text(stop) + " must be finite");
}

FiniteSpan::FiniteSpan(double start, double stop) { require_finite_span("Problem", start, stop); }

}  // namespace detail
}  // namespace v0
}  // namespace polhode
