// SPDX-License-Identifier: MIT
// Checks that torques depend on the unknowns and on the state as their derivatives suppose.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "fit/detail/rotation_vector.hpp"
#include "fit/driven/driven_motion.hpp"
#include "fit/driven/sensitivity_field.hpp"
#include "math/number_text.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace fit {
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

// The derivatives by the unknowns suppose effects that are affine in them.
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
                          polhode::detail::number_text(parameters_[k]) +
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

namespace {

constexpr std::size_t most_jump_times = 8;
constexpr int states_at_a_time = 48;
constexpr int halvings = 80;
// A kink leaves what the last halving does, a jump a part of the torque or of the rate.
constexpr double jump_from = 1e-6;

// Of a torque and of a rate, which have no unit in common.
struct Sizes {
  double u = 0.0, v = 0.0;

  static Sizes of(const Effect& e) { return {norm(e.u), norm(e.v)}; }
  // by either of the two
  bool is_jump_beside(const Sizes& typical) const {
    return u > jump_from * typical.u || v > jump_from * typical.v;
  }
};

// States that have nothing in common, with the momentum of the start and less, down to a tenth.
RotorState drawn(const RotorState& s, int k) {
  const double x = k;
  const Vec3 direction = rotate(turn_by({1.1 * x, 0.9 - 0.6 * x, 0.3 * x}), Vec3{0.0, 0.0, 1.0});
  const double length = norm(s.g) * (k % 4 == 3 ? 0.1 : 1.0 - 0.1 * (k % 4));
  return {normalized(s.q * turn_by({0.7 * x, 0.3 - 0.4 * x, 0.5 * x})), length * direction};
}

RotorState between(const RotorState& a, const RotorState& b, double u) {
  const auto mixed = [u](double x, double y) { return (1.0 - u) * x + u * y; };
  const Quaternion q{mixed(a.q.w, b.q.w), mixed(a.q.x, b.q.x), mixed(a.q.y, b.q.y),
                     mixed(a.q.z, b.q.z)};
  return {normalized(q), (1.0 - u) * a.g + u * b.g};
}

std::vector<double> signs(const std::vector<double>& values) {
  std::vector<double> sides;
  for (const double value : values) sides.push_back(value < 0.0 ? -1.0 : 1.0);
  return sides;
}

// Where, between two states, a switching function changes its sign, and by how much the torque
// jumps there.
class Crossing {
 public:
  Crossing(const AnyPerturbation& term, const Body& body, double t)
      : term_(term), body_(body), t_(t) {}

  std::vector<double> values(const RotorState& s) const { return term_.switches(setting(s, {})); }
  Sizes sizes(const RotorState& s) const { return Sizes::of(term_.effect(setting(s, {}))); }

  Sizes jump(RotorState a, RotorState b, std::size_t f) const {
    const bool is_negative = values(a)[f] < 0.0;
    for (int i = 0; i < halvings; ++i) {
      const RotorState middle = between(a, b, 0.5);
      ((values(middle)[f] < 0.0) == is_negative ? a : b) = middle;
    }
    std::vector<double> sides = signs(values(a));
    sides[f] = 1.0;
    const Effect above = term_.effect(setting(a, sides));
    sides[f] = -1.0;
    const Effect below = term_.effect(setting(a, sides));
    return Sizes::of({above.v - below.v, above.u - below.u});
  }

 private:
  Setting setting(const RotorState& s, std::span<const double> sides) const {
    return {body_, t_, s, {}, 0.0, sides};
  }

  const AnyPerturbation& term_;
  const Body& body_;
  double t_;
};

bool jumps(const AnyPerturbation& term, const Body& body, const RotorState& start, double t) {
  const Crossing crossing(term, body, t);
  Sizes typical;  // the largest of each
  for (int k = 0; k < states_at_a_time; ++k) {
    const Sizes at = crossing.sizes(drawn(start, k));
    typical = {std::max(typical.u, at.u), std::max(typical.v, at.v)};
  }
  for (int k = 0; k + 1 < states_at_a_time; ++k) {
    const RotorState a = drawn(start, k), b = drawn(start, k + 1);
    const std::vector<double> at_a = crossing.values(a), at_b = crossing.values(b);
    for (std::size_t f = 0; f < at_a.size(); ++f) {
      // of no numbers nothing is said: the motion refuses them
      if (!(at_a[f] * at_b[f] < 0.0)) continue;
      if (crossing.jump(a, b, f).is_jump_beside(typical)) return true;
    }
  }
  return false;
}

}  // namespace

// The time of a jump that the state decides moves with the unknowns, which the variational
// equations do not know: derivatives would be wrong, and nothing would show it.
void DrivenMotion::require_no_jumps(std::span<const double> times) const {
  const std::size_t stride = 1 + times.size() / most_jump_times;
  for (const AnyPerturbation& term : system_.terms()) {
    if (!term.supports_switches()) continue;
    for (std::size_t i = 0; i < times.size(); i += stride) {
      if (!jumps(term, system_.body(), initial_, times[i])) continue;
      throw DomainError("fit_driven_spin: the term \"" + std::string(term.name()) +
                        "\" jumps where the attitude or the rate says so, and the time of that "
                        "jump has no derivatives here; expected a torque that is continuous "
                        "there, or that jumps at given times");
    }
  }
}

}  // namespace detail
}  // namespace fit
}  // namespace v0
}  // namespace polhode
