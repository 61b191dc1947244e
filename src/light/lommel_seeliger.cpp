// SPDX-License-Identifier: MIT
#include "polhode/light/lommel_seeliger.hpp"

#include <cmath>

#include "light/direction.hpp"

namespace polhode {
inline namespace v0 {

// The letters of lommel_seeliger_brightness: B = p F / sum, with dp/dS = o q, dp/dO = s q, de/dS =
// 2 o d / sum^2 - 2 e u / sum, de/dO = -2 s d / sum^2 - 2 e v / sum.
EllipsoidGradient lommel_seeliger_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                           const Vec3& to_observer) {
  const Vec3 inverse{1.0 / body.a, 1.0 / body.b, 1.0 / body.c};
  const Direction sun(to_sun), observer(to_observer);
  const Vec3 S = product(inverse, sun.unit), O = product(inverse, observer.unit), V = S + O;
  const double s = std::sqrt(dot(S, S)), o = std::sqrt(dot(O, O));
  const Vec3 u = (1.0 / s) * S, v = (1.0 / o) * O;
  const Vec3 q = u + v, d = u - v;
  const double so = s * o, inverse_sum = 1.0 / (s + o), inverse_square = inverse_sum * inverse_sum;
  const double p = 0.5 * so * dot(q, q);
  const double e = so * dot(d, d) * inverse_square;
  const auto [F, slope] = detail::lune_slope(dot(V, V) * inverse_square, e);
  const double B = p * F * inverse_sum;
  const double K = 0.5 * pi<double>() * body.a * body.b * body.c;

  const double along_q = F * inverse_sum, by_e = p * slope * inverse_sum;
  const double along_d = 2.0 * by_e * inverse_square;
  const double along_own = (B + 2.0 * e * by_e) * inverse_sum;
  const Vec3 by_S = o * (along_q * q + along_d * d) - along_own * u;
  const Vec3 by_O = s * (along_q * q - along_d * d) - along_own * v;

  EllipsoidGradient out;
  out.value = out.by_single = K * B;
  out.by_sun = sun.by_vector(K * product(inverse, by_S));
  out.by_observer = observer.by_vector(K * product(inverse, by_O));
  const Vec3 stretched = product(S, by_S) + product(O, by_O);
  out.by_axes = product(inverse, K * (Vec3{B, B, B} - stretched));
  return out;
}

}  // namespace v0
}  // namespace polhode
