// SPDX-License-Identifier: MIT
// Whether a torque jumps where the state says so. The time of such a jump moves with the unknowns,
// which the variational equations do not know: derivatives would be wrong, and nothing would show
// it.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "fit/detail/rotation_vector.hpp"
#include "fit/driven/driven_motion.hpp"
#include "polhode/error.hpp"

namespace polhode {
inline namespace v0 {
namespace detail {
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
}  // namespace v0
}  // namespace polhode
