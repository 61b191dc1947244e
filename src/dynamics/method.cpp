// SPDX-License-Identifier: MIT
#include "polhode/dynamics/method.hpp"

#include <cmath>

#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace {

constexpr double largest_tolerance = 1e-2;

std::string scheme_name(SplittingScheme scheme) {
  switch (scheme) {
    case SplittingScheme::order2:
      return "order 2";
    case SplittingScheme::order4:
      return "order 4";
    case SplittingScheme::order6:
      return "order 6";
    case SplittingScheme::order8:
      return "order 8";
    case SplittingScheme::ABA864:
      return "ABA864";
    case SplittingScheme::ABA1064:
      return "ABA1064";
  }
  return "";
}

void require_tolerance(const char* method, double tolerance, double smallest) {
  if (!(smallest <= tolerance && tolerance <= largest_tolerance))
    throw DomainError(std::string(method) + ": tolerance " + detail::number_text(tolerance) +
                      " must be from " + detail::number_text(smallest) + " to " +
                      detail::number_text(largest_tolerance));
}

void require_positive(const char* method, const char* name, double step) {
  if (!(step > 0.0))
    throw DomainError(std::string(method) + ": " + name + " " + detail::number_text(step) +
                      " must be positive");
}

struct Text {
  std::string operator()(const Adaptive& m) const {
    return "adaptive, tolerance " + detail::number_text(m.tolerance) +
           (m.precision == Precision::double_double ? ", double-double" : "");
  }
  std::string operator()(const Splitting& m) const {
    return "splitting " + scheme_name(m.scheme) + ", step " + detail::number_text(m.step);
  }
  std::string operator()(const VariationOfConstants& m) const {
    return "variation of constants, tolerance " + detail::number_text(m.tolerance);
  }
};

struct Validity {
  void operator()(const Adaptive& m) const {
    const bool wide = m.precision == Precision::double_double;
    require_tolerance("Adaptive", m.tolerance, wide ? 1e-30 : 1e-15);
    require_positive("Adaptive", "largest_step", m.largest_step);
    if (m.first_step != 0.0) require_positive("Adaptive", "first_step", m.first_step);
  }
  void operator()(const Splitting& m) const {
    require_positive("Splitting", "step", m.step);
    if (!std::isfinite(m.step)) throw DomainError("Splitting: step inf must be finite");
  }
  void operator()(const VariationOfConstants& m) const {
    require_tolerance("VariationOfConstants", m.tolerance, 1e-15);
    require_positive("VariationOfConstants", "largest_step", m.largest_step);
  }
};

}  // namespace

std::string method_text(const Method& method) { return std::visit(Text{}, method); }
void require_valid(const Method& method) { std::visit(Validity{}, method); }

}  // namespace v0
}  // namespace polhode
