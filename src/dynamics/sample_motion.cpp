// SPDX-License-Identifier: MIT
#include "dynamics/detail/sample_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polhode {
inline namespace v0 {
namespace detail {
namespace {

using Field = std::variant<RotorField<double>, DamperField<double>>;

Field field_of(const System& system) {
  if (system.damper()) return DamperField<double>(system);
  return RotorField<double>(system);
}

}  // namespace

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

SampleMotion::SampleMotion(const System& system) : field_(field_of(system)), breakpoints_(system) {}

DamperValues<double> SampleMotion::rates(const Sample& s, bool forward) const {
  const double far = (forward ? 1.0 : -1.0) * std::numeric_limits<double>::infinity();
  const DoubleDouble t = breakpoints_.stretch(s.t, far).inside(s.t);
  if (const auto* field = std::get_if<DamperField<double>>(&field_))
    return (*field)(t, damper_values(s.s, s.damper_rate));
  const RotorValues<double> y = std::get<RotorField<double>>(field_)(t, rotor_values(s.s));
  DamperValues<double> r{};
  std::copy_n(y.begin(), 7, r.begin());
  return r;
}

Sample SampleMotion::moved(const Sample& s, double time) const {
  const DamperValues<double> r = rates(s, time > 0.0);
  const auto& [q, g] = s.s;
  const Quaternion q1{q.w + time * r[0], q.x + time * r[1], q.y + time * r[2], q.z + time * r[3]};
  return {s.t + time,
          {normalized(q1), g + time * Vec3{r[4], r[5], r[6]}},
          s.damper_rate + time * Vec3{r[7], r[8], r[9]}};
}

double SampleMotion::turning_rate(const Sample& s, bool forward) const {
  const System& system =
      std::visit([](const auto& field) -> const System& { return field.system(); }, field_);
  const DamperValues<double> r = rates(s, forward);
  const double relative = 2.0 * std::hypot(std::hypot(r[0], r[1]), std::hypot(r[2], r[3]));
  const double frame = system.frame().is_inertial() ? 0.0 : norm(system.frame().at(s.t).mu_S);
  return std::fmax(relative, fastest_rate(system.body(), s.s.g)) + frame;
}

}  // namespace detail
}  // namespace v0
}  // namespace polhode
