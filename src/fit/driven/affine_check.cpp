// SPDX-License-Identifier: MIT
// Whether effects depend on what is unknown as their derivatives suppose.
#include <algorithm>
#include <cmath>

#include "fit/detail/rotation_vector.hpp"
#include "fit/driven/driven_motion.hpp"
#include "fit/driven/sensitivity_model.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

constexpr const char* function = "fit_driven_spin";
// Of the effects: far above rounding, far below what a square would leave.
constexpr double affine_to = 1e-9;
constexpr std::size_t most_times = 16;

double size(const Effect& e) { return norm(e.u) + norm(e.v); }
Effect scaled(double a, const Effect& e) { return {a * e.v, a * e.u}; }
Effect less(const Effect& a, const Effect& b) { return a + scaled(-1.0, b); }

// Settings at some of the times, at attitudes that have nothing in common.
std::vector<Setting> settings(const System& system, const RotorState& s,
                              std::span<const double> times) {
  std::vector<Setting> found;
  const std::size_t stride = 1 + times.size() / most_times;
  for (std::size_t i = 0; i < times.size(); i += stride) {
    const double k = static_cast<double>(found.size());
    const Quaternion q = normalized(s.q * turn_by({0.7 * k, 0.3 - 0.4 * k, 0.5 * k}));
    found.push_back({system.body(), times[i], {q, s.g}, {}, 0.0});
  }
  return found;
}

void require_one_order(const std::vector<AnyPerturbation>& a, const std::vector<AnyPerturbation>& b,
                       const std::string& name) {
  if (a.size() == b.size()) return;
  throw DomainError(std::string(function) + ": " + std::to_string(a.size()) + " terms become " +
                    std::to_string(b.size()) + " where " + name +
                    " varies; expected always as many");
}

}  // namespace

void DrivenMotion::require_affine(std::span<const double> times, bool moments) const {
  const std::vector<AnyPerturbation>& terms = system_.terms();
  for (const AnyPerturbation& term : terms) {
    if (term.supports_any_real()) continue;
    throw DomainError(std::string(function) + ": the term \"" + term.name() +
                      "\" works on double alone: write it as a template on the number type");
  }
  const std::vector<Setting> at = settings(system_, initial_, times);
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    const std::string& name = drive_.parameters[k].name;
    double step = 1.0;
    const std::vector<AnyPerturbation> two = stepped_terms(k, step);
    std::vector<double> between = parameters_;
    between[k] += 0.5 * step;
    const std::vector<AnyPerturbation> one = drive_.terms(between);
    require_one_order(terms, two, name);
    require_one_order(terms, one, name);
    for (const Setting& here : at) {
      for (std::size_t i = 0; i < terms.size(); ++i) {
        const Effect a = terms[i].effect(here), b = one[i].effect(here), c = two[i].effect(here);
        if (size(less(b, scaled(0.5, a + c))) <= affine_to * (size(a) + size(c))) continue;
        throw DomainError(std::string(function) + ": the term \"" + terms[i].name() +
                          "\" does not change in proportion to " + name + ", at " +
                          number_text(parameters_[k]) +
                          "; expected a parameter that its torque is linear in, such as a "
                          "component, a pressure or a tensor");
      }
    }
  }
  if (!moments) return;
  const double u = start_.inertia_F(2, 2);
  const Body sphere(u, u, u), x(1.5 * u, u, u), y(u, 1.5 * u, u), both(1.3 * u, 1.2 * u, u);
  const Vec3 w = angular_velocity(system_.body(), initial_);
  for (const Setting& here : at) {
    for (const AnyPerturbation& term : terms) {
      const std::vector<AnyPerturbation> alone{term};
      const auto of = [&](const Body& body) { return effect_at_rate(alone, body, here, w); };
      const Effect one = of(sphere), a = of(x), b = of(y), c = of(both);
      const Effect sum = one + scaled(0.6, less(a, one)) + scaled(0.4, less(b, one));
      if (size(less(c, sum)) <= affine_to * (size(one) + size(a) + size(b) + size(c))) continue;
      throw DomainError(std::string(function) + ": the term \"" + term.name() +
                        "\" is not linear in the moments at a given rate, so that ratios of "
                        "moments are no unknowns beside it; fix them");
    }
  }
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
