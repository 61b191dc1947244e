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

// The one place that knows what the methods are: each gives its traits and refuses what is out of
// range.
struct Traits {
  MethodTraits operator()(const Adaptive& m) const {
    return {.kind = "adaptive",
            .text = "adaptive, tolerance " + detail::number_text(m.tolerance) +
                    (m.precision == Precision::double_double ? ", double-double" : ""),
            .further = {m.first_step, m.largest_step}};
  }
  MethodTraits operator()(const Splitting& m) const {
    return {.kind = "splitting",
            .text = "splitting " + scheme_name(m.scheme) + ", step " + detail::number_text(m.step),
            .step = m.step,
            .needs_flows = true};
  }
  MethodTraits operator()(const VariationOfConstants& m) const {
    return {.kind = "variation-of-constants",
            .text = "variation of constants, tolerance " + detail::number_text(m.tolerance),
            .further = {m.largest_step}};
  }
  MethodTraits operator()(const Collocation& m) const {
    const std::string stages =
        m.stages == Collocation{}.stages ? "" : ", " + std::to_string(m.stages) + " stages";
    if (m.step > 0.0)
      return {.kind = "collocation",
              .text = "collocation" + stages + ", step " + detail::number_text(m.step),
              .further = {static_cast<double>(m.stages)},
              .step = m.step};
    return {.kind = "collocation",
            .text = "collocation" + stages + ", tolerance " + detail::number_text(m.tolerance),
            .further = {static_cast<double>(m.stages), m.largest_step}};
  }
  MethodTraits operator()(const CustomMethod& m) const { return m.traits; }
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
  void operator()(const Collocation& m) const {
    require_tolerance("Collocation", m.tolerance, 1e-15);
    if (m.stages != 4 && m.stages != 8 && m.stages != 16)
      throw DomainError("Collocation: stages " + std::to_string(m.stages) + " must be 4, 8 or 16");
    if (m.step != 0.0) require_positive("Collocation", "step", m.step);
    if (!std::isfinite(m.step)) throw DomainError("Collocation: step inf must be finite");
    require_positive("Collocation", "largest_step", m.largest_step);
    if (m.step > 0.0 && m.tolerance != Collocation{}.tolerance)
      throw DomainError("Collocation: tolerance " + detail::number_text(m.tolerance) +
                        " goes with steps under control; got step " + detail::number_text(m.step));
    if (m.step > 0.0 && std::isfinite(m.largest_step))
      throw DomainError("Collocation: largest_step " + detail::number_text(m.largest_step) +
                        " goes with steps under control; got step " + detail::number_text(m.step));
  }
  void operator()(const CustomMethod& m) const {
    if (m.maker == nullptr)
      throw DomainError("CustomMethod: got nothing that steps; use custom_method");
  }
};

}  // namespace

MethodTraits method_traits(const Method& method) { return std::visit(Traits{}, method); }
std::string method_text(const Method& method) { return method_traits(method).text; }
void require_valid(const Method& method) { std::visit(Validity{}, method); }
bool moves_any_state(const Method& method) {
  return std::holds_alternative<Adaptive>(method) || std::holds_alternative<Collocation>(method);
}
const Splitting* method_of_frozen_models(const Method& method) {
  return std::get_if<Splitting>(&method);
}

}  // namespace v0
}  // namespace polhode
