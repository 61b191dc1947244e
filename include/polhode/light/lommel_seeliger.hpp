// SPDX-License-Identifier: MIT
// The brightness of an ellipsoid that scatters by the law of Lommel and Seeliger, in closed form,
// with its gradient.
//
// Equations   the integral of mu mu0 / (mu + mu0) dA over what is lit and seen. With S = (s_x/a,
//             s_y/b, s_z/c) of the direction s to the Sun, O of the one to the observer, it is
//             (pi/2) a b c (|S||O| + S.O) / (|S| + |O|) F(w), w = |S + O| / (|S| + |O|) in [0, 1],
//             F = (1 - (1 - w^2) atanh(w) / w) / w^2 = sum over k >= 1 of 2 w^(2k-2) / (4k^2 - 1):
//             that of Muinonen & Lumme (2015, A&A 584, A23), whose half-angles and logarithms of
//             cotangents this has no need of; docs/design/0045-brightness.md derives it.
// Units       semi-axes in any unit of length, brightness in its square.
// Domain      semi-axes > 0; directions as vectors of any length but 0, squares in the range of T.
//             Sun and observer on one line: behind each other (w = 1) half the area seen, opposite
//             0; both with their derivatives. Second derivatives grow like the logarithm of the
//             phase angle as it goes to 0.
// Accuracy    budget light_ellipsoid, relative; times 1 / (pi - alpha) close to opposition to the
//             Sun. light_ellipsoid_gradient: of template and gradient, relative to the area.
// Errors      none; NaN in, NaN out.
// Cost        benchmarks/brightness.cpp: some tens of ns, the gradient twice that.
#pragma once

#include <cmath>

#include "polhode/light/brightness_gradient.hpp"
#include "polhode/light/detail/lune_function.hpp"
#include "polhode/light/ellipsoid.hpp"
#include "polhode/math/real.hpp"
#include "polhode/math/vector.hpp"

namespace polhode {
inline namespace v0 {

template <Real T>
T lommel_seeliger_brightness(const BasicEllipsoid<T>& body, const BasicVec3<T>& to_sun,
                             const BasicVec3<T>& to_observer) {
  using std::sqrt;
  const auto scaled = [&body](const BasicVec3<T>& v) {
    const T k = T(1.0) / sqrt(dot(v, v));
    return BasicVec3<T>{k * v.x / body.a, k * v.y / body.b, k * v.z / body.c};
  };
  const BasicVec3<T> S = scaled(to_sun), O = scaled(to_observer), V = S + O;
  const T s = sqrt(dot(S, S)), o = sqrt(dot(O, O));
  const BasicVec3<T> u = (T(1.0) / s) * S, v = (T(1.0) / o) * O;
  const BasicVec3<T> q = u + v, d = u - v;
  // |S||O| + S.O and 1 - w^2 by these: as they are written above they cancel
  const T so = s * o, sum = s + o;
  const T p = T(0.5) * so * dot(q, q);
  const T e = so * dot(d, d) / (sum * sum);
  const T F = detail::lune_function<T>(dot(V, V) / (sum * sum), e);
  return T(0.5) * pi<T>() * body.a * body.b * body.c * (p / sum * F);
}

// The same with its derivatives.
EllipsoidGradient lommel_seeliger_gradient(const Ellipsoid& body, const Vec3& to_sun,
                                           const Vec3& to_observer);

}  // namespace v0
}  // namespace polhode
