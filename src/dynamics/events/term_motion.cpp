// SPDX-License-Identifier: MIT
#include "dynamics/events/term_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode {
inline namespace v0 {
namespace detail {
// |I^-1 g|^2 is linear in the squares of the components, and so are G^2 and 2 T: along a polhode it
// is linear in the square of the middle component, and largest at an end of its range.
double fastest_rate(const Body& body, const Vec3& g) {
  Vec3 I = body.moments(), w{g.x / I.x, g.y / I.y, g.z / I.z};
  const auto order = [&](int i, int j) {
    if (!(I[i] > I[j])) return;
    std::swap(I[i], I[j]);
    std::swap(w[i], w[j]);
  };
  order(0, 1), order(1, 2), order(0, 1);
  const double now = std::hypot(w.x, w.y, w.z);
  if (!(I.z > I.x) || !(now > 0.0) || !std::isfinite(now)) return now;
  // in units of now: squares w1^2 + c1 w2^2 and w3^2 + c3 w2^2 are constants of the motion
  const double x = w.x / now, y = w.y / now, z = w.z / now;
  const double c1 = I.y * (I.z - I.y) / (I.x * (I.z - I.x));
  const double c3 = I.y * (I.y - I.x) / (I.z * (I.z - I.x));
  const double most = std::fmin((x * x + c1 * y * y) / c1, (z * z + c3 * y * y) / c3);
  const double slope = 1.0 - c1 - c3, rest = 1.0 - slope * y * y;
  return now * std::sqrt(std::fmax(1.0, std::fmax(rest, rest + slope * most)));
}

template <class Field>
auto TermMotion<Field>::rates(const Sample& s, bool forward) const -> typename Field::Values {
  ++evaluations_;
  const double far = (forward ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
  const DoubleDouble t = breakpoints_.stretch(s.t, far).inside(s.t);
  return field_(t, Field::values(s.s));
}

template <class Field>
auto TermMotion<Field>::moved(const Sample& s, double time) const -> Sample {
  const typename Field::Values r = rates(s, time > 0.0);
  typename Field::Values y = Field::values(s.s);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] + time * r[i];
  return {s.t + time, Field::state(y)};
}

template <class Field>
double TermMotion<Field>::turning_rate(const Sample& s, bool forward) const {
  const System& system = field_.system();
  const typename Field::Values r = rates(s, forward);
  const double relative = 2.0 * std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
  const double frame = system.frame().is_inertial() ? 0.0 : norm(system.frame().at(s.t).mu_S);
  return std::fmax(relative, fastest_rate(system.body(), rotor_of(s.s).g)) + frame;
}

template class TermMotion<RotorField<double>>;
template class TermMotion<DamperField<double>>;
template class EventWatch<RotorMotion>;

}  // namespace detail
}  // namespace v0
}  // namespace polhode
